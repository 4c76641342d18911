"""The best tau of a grid, with the sureness of the choice."""

import numpy as np
import pytest

from abstransfer.experiments.arms import ARMS, TAUS, tau_cells
from abstransfer.experiments.results import Results
from abstransfer.experiments.tuning import tune, tuned_arms

N_RUNS = 10


def grid(mean, noise, names=("nd-hard", "nd-soft"), seed=0):
    """Results of a grid whose goals are mean(tau) with noise that runs share."""
    arms = tuple(arm for arm in tau_cells() if arm.name in names)
    rng = np.random.default_rng(seed)
    shared = 50 * rng.normal(size=N_RUNS)
    goals = np.array([mean(arm.tau) + shared for arm in arms])
    goals = goals + noise * rng.normal(size=goals.shape)
    windows = np.stack([goals, 0 * goals], axis=2).round().astype(int)
    return Results(arms, windows, {"parameters": {"window": 1}})


def peak(tau):
    return 1000 - abs(tau - 3_500_000) / 1e4


def test_a_clear_peak_is_found_for_sure():
    hard, soft = tune(grid(peak, noise=1))

    assert (hard.name, soft.name) == ("nd-hard", "nd-soft")
    assert hard.best == 3_500_000
    assert hard.as_good == (3_500_000,)
    assert hard.taus.tolist() == list(TAUS)
    assert hard.goals.estimate.argmax() == TAUS.index(3_500_000)


def test_whether_the_papers_tau_is_the_best_follows_from_the_interval():
    """The paper's tau is 3.5 million for ND hard, 11 for ND soft."""
    hard, soft = tune(grid(peak, noise=1))

    assert hard.paper_inside
    assert hard.paper_gain.estimate == 0
    assert not soft.paper_inside
    assert soft.paper == 11_000_000
    assert soft.paper_gain.estimate == pytest.approx(-0.75, abs=0.03)
    assert soft.paper_gain.high < 0


def test_a_flat_top_leaves_the_choice_open():
    hard, soft = tune(grid(lambda tau: 1000, noise=20))

    assert len(hard.as_good) > 3
    assert len(soft.as_good) > 3


def test_the_set_of_good_tau_holds_the_true_best_as_often_as_it_says():
    """All tau are equal, so each is a best; the first must be in 95 % of the sets."""
    inside = [
        TAUS[0] in tuning.as_good
        for seed in range(60)
        for tuning in tune(grid(lambda tau: 1000, noise=20, seed=seed))
    ]

    assert np.mean(inside) >= 0.9


def test_pairing_tells_apart_what_shared_luck_would_hide():
    """Runs differ by 50, tau by 5: pairs of the same seed still see it."""
    hard = tune(grid(lambda tau: 1000 + 5 * (tau == 6_000_000), noise=1))[0]

    assert hard.as_good == (6_000_000,)


@pytest.mark.parametrize(("tau", "at_edge"), [(500_000, True), (9_000_000, False)])
def test_a_best_tau_at_the_end_of_the_grid_is_told(tau, at_edge):
    assert tune(grid(lambda t: 1000 - abs(t - tau) / 1e4, 1))[0].at_edge == at_edge


def test_tuned_arms_take_the_best_tau_and_leave_q_learning_alone():
    arms = tuned_arms(tune(grid(peak, noise=1)))

    assert [arm.name for arm in arms] == [arm.name for arm in ARMS]
    assert arms[0] == ARMS[0]
    assert {arm.name: arm.tau for arm in arms}["nd-soft"] == 3_500_000
    assert {arm.name: arm.tau for arm in arms}["rand-hard"] == 9_000_000


def test_one_tau_is_no_grid():
    results = grid(peak, 1)
    with pytest.raises(ValueError, match=r"several tau of 'nd-hard', got \[500000\]"):
        tune(Results(results.arms[:1], results.goals[:1], {}))
