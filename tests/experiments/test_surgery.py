"""Surgery on notes, by hand; and a run that goes on is the run that would have been."""

import numpy as np
import pytest

from abstransfer import navigation_tasks, read_map
from abstransfer.experiments.diagnosis import (
    change_of_mind,
    judged,
    obeyed,
    ready,
    return_variation,
    stuck,
)
from abstransfer.experiments.surgery import (
    best_notes,
    digest,
    directions,
    drawn,
    erase,
    go_on,
    graft,
    leave,
    noted,
    shuffle_actions,
    shuffle_states,
)
from abstransfer.learning import q_learning
from abstransfer.mdp import MDP
from abstransfer.policies import uniform_policy
from abstransfer.solvers import evaluate_policy

NOTES = np.array([[0.0, 0.3, 0.1], [0.0, 0.0, 0.0], [0.2, 0.0, -np.inf]])


@pytest.fixture(scope="module")
def tasks():
    return navigation_tasks(read_map("source"), reward="goal")


@pytest.fixture(scope="module")
def eager(tasks):
    return uniform_policy(tasks.available)


# Arrays, by hand


def test_erasing_leaves_masked_actions_masked():
    where = np.array([True, False, True])

    assert erase(NOTES, where).tolist() == [[0, 0, 0], [0, 0, 0], [0, 0, -np.inf]]


def test_grafting_what_was_erased_gives_the_notes_back():
    where = np.array([True, True, False])

    np.testing.assert_array_equal(graft(erase(NOTES, where), NOTES, where), NOTES)


def test_drawn_states_are_as_many_as_asked_and_among_those_offered():
    where = np.array([True, False, True, True])
    mask = drawn(where, 2, np.random.default_rng(3))

    assert mask.sum() == 2
    assert (mask <= where).all()
    with pytest.raises(ValueError, match=r"n must lie in 0..3, got 4"):
        drawn(where, 4, np.random.default_rng(3))


def test_shuffled_actions_keep_each_states_notes_among_what_is_available():
    available = np.array([[True, True, True], [True, True, True], [True, True, False]])
    deals = [
        shuffle_actions(NOTES, available, np.random.default_rng(i)) for i in range(20)
    ]

    for dealt in deals:
        np.testing.assert_array_equal(np.sort(dealt, axis=1), np.sort(NOTES, axis=1))
        assert np.isneginf(dealt[2, 2])
    assert {deal[2, 0] for deal in deals} == {0.0, 0.2}  # all places are dealt
    assert len({tuple(deal[0]) for deal in deals}) == 6


def test_shuffled_states_are_whole_rows_in_the_states_that_had_one():
    rows = {tuple(shuffle_states(NOTES, np.random.default_rng(i))[0]) for i in range(9)}

    assert rows == {tuple(NOTES[0]), tuple(NOTES[2])}
    dealt = shuffle_states(NOTES, np.random.default_rng(0))
    np.testing.assert_array_equal(noted(dealt), noted(NOTES))


def test_directions_keep_ties_and_blank_states():
    tied = np.array([[0.4, 0.4, 0.1], [0.0, 0.0, 0.0]])

    assert directions(tied, 1.0).tolist() == [[1, 1, 0], [0, 0, 0]]


def test_perfect_notes_are_what_learning_leaves_unchanged(tasks):
    """Backed up once by hand: Q = E[r + gamma max Q]."""
    best = best_notes(tasks.mdp, 0.9)
    state, action, next_state, prob = tasks.mdp.transitions
    backed_up = np.zeros_like(best)
    gain = tasks.mdp.reward[next_state] + 0.9 * best.max(axis=1)[next_state]
    np.add.at(backed_up, (state, action), prob * gain)
    way = ~tasks.mdp.terminal

    np.testing.assert_allclose(best[way], backed_up[way], rtol=1e-12)


def test_experience_of_everything_is_digested_into_nearly_perfect_notes(tasks, eager):
    run = q_learning(tasks.mdp, 400_000, rng=0, guide=eager, tau=400_000, trace=400_000)
    tried, best = run.q > 0, best_notes(tasks.mdp)
    notes = digest(tasks.mdp, run.trace)

    assert tried.sum() > 1000
    ratio = notes[tried & tasks.available] / best[tried & tasks.available]
    assert np.median(ratio) == pytest.approx(1, abs=0.05)
    assert noted(notes).sum() > noted(run.q).sum()  # told to states that had none


# A run that goes on


def test_notes_that_are_left_alone_are_those_of_the_advised_run(tasks, eager):
    left = leave(
        tasks.mdp, tasks.available, {"eager": eager}, 20_000, seed=5, think=["eager"]
    )
    run = q_learning(tasks.mdp, 20_000, rng=5, guide=eager, tau=20_000)

    assert noted(run.q).any()
    np.testing.assert_array_equal(left.notes["eager"], run.q)
    assert noted(left.digested["eager"]).sum() >= noted(run.q).sum()


def test_after_the_advice_a_run_depends_on_its_notes_alone(tasks, eager):
    """Who left them does not matter; the same notes and luck give the same goals."""
    left = leave(tasks.mdp, tasks.available, {"eager": eager}, 20_000, seed=5)
    copy = graft(np.zeros_like(left.best), left.notes["eager"], noted(left.best))
    tables = [left.notes["eager"], copy, 0 * copy]
    goals = go_on(tasks.mdp, tables, 30_000, seed=8)

    assert goals[0] == goals[1] > goals[2]
    assert go_on(tasks.mdp, tables[:1], 30_000, seed=8) == goals[:1]  # no company


# What the surgeon measures


def two_cells(gamma):
    """One step succeeds half of the time; the second cell is the goal."""
    return MDP(
        [[[0, 1]], [[1, 1]]], np.full((2, 1, 2), 0.5), [-1, 0], [False, True], gamma
    )


def test_obeying_is_greedy_but_for_epsilon_among_what_is_allowed():
    policy = obeyed(NOTES, np.isfinite(NOTES), 0.3)

    np.testing.assert_allclose(
        policy, [[0.1, 0.8, 0.1], [1 / 3] * 3, [0.85, 0.15, 0]], atol=1e-12
    )


def test_perfect_notes_are_ready_and_blank_ones_are_not(tasks):
    best = best_notes(tasks.mdp)

    assert ready(tasks.mdp, best) > 0.999
    assert ready(tasks.mdp, 0 * best, n_steps=20) < 0.2


def test_who_is_stuck_is_who_has_not_arrived():
    """After three tries, one in eight."""
    assert stuck(two_cells(0.5), np.ones((2, 1)), 3).tolist() == [0.125, 0.0]


def test_a_judge_measures_in_percent_of_the_worst_at_any_patience():
    """The first cell is worth -1 / (1 - gamma / 2), the second 0."""
    for gamma in (0.0, 0.5, 0.99):
        expected = -100 * (1 - gamma) / (1 - gamma / 2) / 2
        value = judged(two_cells(0.9), np.ones((2, 1)), gamma)
        assert value == pytest.approx(expected)
    with pytest.raises(ValueError, match="gamma must satisfy 0 <= gamma < 1, got 1"):
        judged(two_cells(0.9), np.ones((2, 1)), 1)


def test_a_patient_judge_prefers_the_sure_way_and_an_impatient_one_the_short():
    """
    From cell 0, action 0 arrives at once or never, evenly; action 1 surely, in 3.

    In percent of the worst the short way costs 1 - gamma / 2 and the sure one
    1 - gamma^3, less the same of the other cells: alike at gamma^2 = 1 / 2.
    """
    mdp = MDP(
        next_state=[
            [[4, 3], [1, 1]],
            [[2, 2], [2, 2]],
            [[4, 4], [4, 4]],
            [[3, 3], [3, 3]],
            [[4, 4], [4, 4]],
        ],
        prob=np.full((5, 2, 2), 0.5),
        reward=[-1, -1, -1, -1, 0],
        terminal=[False, False, False, False, True],
        gamma=0.9,
    )
    short, sure = np.eye(2)[[0] * 5], np.eye(2)[[1] * 5]

    found = change_of_mind(mdp, short, sure, 0.5, 0.99)
    assert found == pytest.approx(np.sqrt(0.5), abs=1e-3)
    assert np.isnan(change_of_mind(mdp, short, short))


def test_the_variation_of_a_return_is_that_of_many_drives():
    mdp = two_cells(0.9)
    rng = np.random.default_rng(0)
    tries = rng.geometric(0.5, 200_000)
    returns = -(1 - 0.9**tries) / (1 - 0.9)

    assert returns.mean() == pytest.approx(
        evaluate_policy(mdp, np.ones((2, 1)))[0], rel=0.01
    )
    assert return_variation(mdp, np.ones((2, 1))) == pytest.approx(
        returns.std() / abs(returns.mean()), rel=0.01
    )
