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
from abstransfer.experiments.stats import (
    iqm_interval,
    mean_interval,
    paired_difference,
    probability_of_improvement,
    relative_gain,
)


def test_the_interval_of_a_mean_is_near_that_of_the_normal_law():
    x = np.random.default_rng(1).normal(10.0, 2.0, 400)
    found = mean_interval(x, rng=0)
    half = 1.96 * x.std() / np.sqrt(400)

    assert found.estimate == pytest.approx(x.mean())
    assert found.low == pytest.approx(x.mean() - half, abs=0.02)
    assert found.high == pytest.approx(x.mean() + half, abs=0.02)


def test_intervals_cover_the_truth_as_often_as_they_say():
    """At 40 runs, 95 % of the intervals hold the true mean, give or take."""
    rng = np.random.default_rng(2)
    found = [mean_interval(rng.normal(0, 1, 40), rng=i) for i in range(200)]
    covered = np.mean([low <= 0 <= high for _, low, high in found])

    assert 0.90 <= covered <= 0.99


def test_the_same_seed_gives_the_same_interval_and_another_one_another():
    x = np.arange(10.0)

    assert mean_interval(x, rng=3) == mean_interval(x, rng=3)
    assert mean_interval(x, rng=3) != mean_interval(x, rng=4)


def test_curves_get_an_interval_per_window():
    curves = np.array([[0.0, 5.0, 1.0], [2.0, 5.0, 3.0], [4.0, 5.0, 5.0]])
    found = mean_interval(curves, rng=0)

    np.testing.assert_array_equal(found.estimate, [2, 5, 3])
    assert found.low[1] == found.high[1] == 5
    np.testing.assert_array_equal(found.low[2], found.low[0] + 1)  # the same runs drawn


def test_the_iqm_leaves_a_quarter_out_at_either_end():
    """Of 8 runs the middle four count: (3 + 4 + 5 + 6) / 4."""
    x = np.array([-900.0, 2, 3, 4, 5, 6, 7, 900])

    assert iqm_interval(x, rng=0).estimate == 4.5


def test_pairing_removes_what_runs_share():
    luck = np.array([10.0, 200.0, 3000.0])
    found = paired_difference(luck + 1, luck, rng=0)

    assert found == (1.0, 1.0, 1.0)


def test_the_relative_gain_is_that_of_the_means():
    """Means 3 and 2: half as much again."""
    assert (
        relative_gain(np.array([2.0, 4.0]), np.array([1.0, 3.0]), rng=0).estimate == 0.5
    )


def test_a_gain_over_nothing_is_unknown():
    found = relative_gain(np.array([1.0, 2.0]), np.zeros(2), rng=0)

    assert np.isnan(found).all()


def test_the_probability_of_improvement_is_mann_and_whitneys():
    rng = np.random.default_rng(5)
    a, b = rng.integers(0, 9, 20).astype(float), rng.integers(0, 7, 20).astype(float)
    u = scipy_stats.mannwhitneyu(a, b).statistic

    assert probability_of_improvement(a, b, rng=0).estimate == pytest.approx(u / 400)


@pytest.mark.parametrize(("shift", "chance"), [(5.0, 1.0), (0.0, 0.5), (-5.0, 0.0)])
def test_a_certain_improvement_has_probability_one(shift, chance):
    b = np.arange(4.0)

    assert probability_of_improvement(b + shift, b, rng=0).estimate == chance


def test_one_run_says_nothing_about_others():
    found = mean_interval(np.array([3.0]), rng=0)

    assert found.estimate == 3
    assert np.isnan([found.low, found.high]).all()


@pytest.mark.parametrize(
    ("samples", "complaint"),
    [
        ((np.array([]),), "none empty"),
        ((np.array([1.0, np.nan]),), "finite"),
        ((np.ones(3), np.ones(2)), r"\(3,\), \(2,\)"),
    ],
)
def test_bad_samples_are_refused(samples, complaint):
    function = mean_interval if len(samples) == 1 else paired_difference
    with pytest.raises(ValueError, match=complaint):
        function(*samples, rng=0)


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


# Student's intervals


@pytest.mark.parametrize("n", [5, 6, 12, 20])
def test_a_t_interval_holds_its_level_where_the_bootstrap_does_not(n):
    """Of 4,000 experiments, 95 % hold the mean: +- 1.1 % (three standard errors)."""
    x = np.random.default_rng(n).normal(7, 2, (n, 4000))
    found = stats.t_interval(x)
    held = ((found.low < 7) & (found.high > 7)).mean()

    assert abs(held - 0.95) < 0.011


@pytest.mark.parametrize("n", [5, 12])
def test_the_interval_of_a_gain_holds_its_level(n):
    """Runs that vary by 5 %, skewed, in pairs; the true gain is 25 %."""
    rng = np.random.default_rng(n)
    luck = rng.lognormal(0, 0.03, (4000, n))
    a = 125 * luck * rng.lognormal(0, 0.05, (4000, n))
    b = 100 * luck * rng.lognormal(0, 0.05, (4000, n))
    ends = [stats.gain_interval(*pair)[1:] for pair in zip(a, b, strict=True)]
    held = np.mean([low < 0.25 < high for low, high in ends])

    assert abs(held - 0.95) < 0.011


def test_no_interval_is_given_for_fewer_runs_than_five():
    assert np.isnan(stats.t_interval(np.arange(4.0)).low)
    assert np.isfinite(stats.t_interval(np.arange(5.0)).low)


def test_a_t_interval_of_windows_is_that_of_each():
    x = np.random.default_rng(0).normal(size=(6, 3))
    found = stats.t_interval(x)

    for window in range(3):
        one = stats.t_interval(x[:, window])
        np.testing.assert_allclose([e[window] for e in found], one)
