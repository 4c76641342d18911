"""Statistics and measures of transfer, against values worked out by hand."""

import numpy as np
import pytest
from scipy import stats as scipy_stats

from abstransfer.experiments import stats
from abstransfer.experiments.curves import (
    asymptotic_level,
    critical_point,
    jumpstart,
    rises,
    time_to_threshold,
)


def held(ends, truth):
    """The share of intervals, (low, high), that hold the truth."""
    return np.mean([low < truth < high for low, high in ends])


@pytest.mark.parametrize("n", [5, 6, 12, 20])
def test_a_t_interval_holds_its_level_for_few_runs(n):
    """Of 4,000 experiments, 95 % hold the mean: +- 1.1 % (three standard errors)."""
    x = np.random.default_rng(n).normal(7, 2, (n, 4000))
    _, low, high = stats.t_interval(x)

    assert abs(held(zip(low, high, strict=True), 7) - 0.95) < 0.011


@pytest.mark.parametrize("n", [5, 12])
def test_the_interval_of_a_gain_holds_its_level(n):
    """Runs that vary by 5 %, skewed, in pairs; the true gain is 25 %."""
    rng = np.random.default_rng(n)
    luck = rng.lognormal(0, 0.03, (4000, n))
    a = 125 * luck * rng.lognormal(0, 0.05, (4000, n))
    b = 100 * luck * rng.lognormal(0, 0.05, (4000, n))
    ends = [stats.gain_interval(*pair)[1:] for pair in zip(a, b, strict=True)]

    assert abs(held(ends, 0.25) - 0.95) < 0.011


@pytest.mark.parametrize("n", [5, 8, 50])
def test_the_interval_of_an_interquartile_mean_holds_its_level(n):
    """Tails as heavy as those of Student's law with four degrees of freedom."""
    runs = np.random.default_rng(n).standard_t(4, (4000, n))

    assert abs(held([stats.iqm_interval(x)[1:] for x in runs], 0) - 0.95) < 0.015


@pytest.mark.parametrize("n", [7, 12])
def test_the_interval_of_a_rank_correlation_holds_its_level_or_more(n):
    """Normal pairs with correlation -0.8: Kendall's is 2 arcsin(-0.8) / pi."""
    law = np.linalg.cholesky([[1, -0.8], [-0.8, 1]])
    pairs = np.random.default_rng(n).normal(size=(1500, n, 2)) @ law.T
    orders = [scipy_stats.kendalltau(x, y).statistic for x, y in pairs.swapaxes(1, 2)]
    ends = [stats.rank_interval(order, n)[1:] for order in orders]

    assert held(ends, 2 / np.pi * np.arcsin(-0.8)) > 0.935


def test_a_perfect_order_leaves_its_end_open():
    assert stats.rank_interval(1.0, 7).high == 1
    assert stats.rank_interval(-1.0, 7).low == -1
    assert -1 < stats.rank_interval(-1.0, 7).high < 0


def test_no_interval_is_given_for_fewer_than_five():
    few, enough = np.arange(4.0) + 1, np.arange(5.0) + 1

    for interval in (
        stats.t_interval,
        stats.iqm_interval,
        lambda x: stats.gain_interval(x, x[::-1]),
        lambda x: stats.rank_interval(0.5, len(x)),
    ):
        assert np.isfinite(interval(few).estimate)
        assert np.isnan(interval(few)[1:]).all()
        assert np.isfinite(interval(enough)).all()


def test_a_t_interval_of_windows_is_that_of_each():
    x = np.random.default_rng(0).normal(size=(6, 3))
    found = stats.t_interval(x)

    for window in range(3):
        one = stats.t_interval(x[:, window])
        np.testing.assert_allclose([e[window] for e in found], one)


def test_the_iqm_leaves_a_quarter_out_at_either_end():
    """Of 8 runs the middle four count: (3 + 4 + 5 + 6) / 4."""
    x = np.array([-900.0, 2, 3, 4, 5, 6, 7, 900])

    assert stats.iqm_interval(x).estimate == 4.5


def test_pairing_removes_what_runs_share():
    luck = np.array([10.0, 200.0, 3000.0, 7.0, 8.0])

    assert stats.t_interval((luck + 1) - luck) == (1.0, 1.0, 1.0)


def test_the_gain_is_that_of_the_means():
    """Means 3 and 2: half as much again."""
    found = stats.gain_interval(np.array([2.0, 4.0]), np.array([1.0, 3.0]))

    assert found.estimate == pytest.approx(0.5)


def test_a_gain_over_nothing_is_unknown():
    assert np.isnan(stats.gain_interval(np.array([1.0, 2.0]), np.zeros(2))).all()


def test_the_probability_of_improvement_is_mann_and_whitneys():
    rng = np.random.default_rng(5)
    a, b = rng.integers(0, 9, 20).astype(float), rng.integers(0, 7, 20).astype(float)
    u = scipy_stats.mannwhitneyu(a, b).statistic

    assert stats.probability_of_improvement(a, b) == pytest.approx(u / 400)


@pytest.mark.parametrize(("shift", "chance"), [(5.0, 1.0), (0.0, 0.5), (-5.0, 0.0)])
def test_a_certain_improvement_has_probability_one(shift, chance):
    b = np.arange(4.0)

    assert stats.probability_of_improvement(b + shift, b) == chance


@pytest.mark.parametrize("runs", [np.array([]), np.array([1.0, np.nan])])
def test_bad_runs_are_refused(runs):
    with pytest.raises(ValueError, match="runs must be finite numbers, at least one"):
        stats.t_interval(runs)
    with pytest.raises(ValueError, match=r"one shape \(N,\), got \(3,\), \(2,\)"):
        stats.gain_interval(np.ones(3), np.ones(2))


def test_jumpstart_and_final_level_are_means_of_three_windows():
    guided = np.array([[6, 6, 9, 9, 9, 12], [0, 0, 3, 9, 9, 9]])
    plain = np.array([[0, 0, 3, 9, 9, 9], [0, 0, 3, 9, 9, 9]])

    np.testing.assert_array_equal(jumpstart(guided, plain), [6, 0])
    np.testing.assert_array_equal(asymptotic_level(guided), [10, 9])


def test_a_threshold_is_reached_at_the_end_of_its_window():
    curves = np.array([[0, 7, 3, 9], [7, 0, 0, 0], [0, 0, 0, 6]])

    np.testing.assert_array_equal(
        time_to_threshold(curves, 7, window=500), [1000, 500, np.inf]
    )


@pytest.mark.parametrize("jump", [3, 10, 57])
def test_the_critical_point_of_a_jump_is_the_jump(jump):
    curve = np.where(np.arange(60) < jump, 100.0, 900.0)

    assert critical_point(curve) == jump


def test_the_critical_point_of_a_logistic_curve_is_its_middle():
    window = np.arange(60) + 0.5
    curve = 9000 / (1 + np.exp(-(window - 22) / 4))

    assert critical_point(curve) == 22


def test_the_critical_point_stands_noise():
    """The rise is 8,000 goals in 20 windows, the noise 100 a window."""
    window, rng = np.arange(60) + 0.5, np.random.default_rng(0)
    curve = 8000 / (1 + np.exp(-(window - 22) / 2.5))
    noisy = curve + rng.normal(0, 100, (200, 60))

    assert np.abs(critical_point(noisy) - 22).max() <= 2


def test_a_late_small_step_does_not_hide_a_long_steep_climb():
    curve = np.concatenate(
        [np.zeros(9), np.arange(0, 80, 8), np.full(20, 80), [85] * 9]
    )

    assert 9 <= critical_point(curve) <= 19


def test_too_short_a_curve_is_refused():
    with pytest.raises(ValueError, match="at least 6 windows"):
        rises(np.arange(5))
