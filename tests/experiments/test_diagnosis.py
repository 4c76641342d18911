"""What a guide does before the learner takes over, worked out by hand."""

import numpy as np
import pytest

from abstransfer import MDP, navigation_tasks, read_map
from abstransfer.experiments.diagnosis import (
    arrival,
    can_arrive,
    notes_after,
    stuck,
)
from abstransfer.experiments.problem import Problem, target_tasks
from abstransfer.learning import q_learning_runs
from abstransfer.reproduction.guides import make_guides


@pytest.fixture(scope="module")
def guides():
    return make_guides(["beta-0", "beta-1", "available"])  # none needs a climb


@pytest.fixture
def corridor():
    """Three cells and the goal; left, right; a step succeeds half of the time."""
    left, right = [[0, 0], [0, 1], [1, 2], [3, 3]], [[0, 1], [1, 2], [2, 3], [3, 3]]
    return MDP(
        next_state=np.stack([left, right], axis=1),
        prob=np.full((4, 2, 2), 0.5),
        reward=[0, 0, 0, 1],
        terminal=[False, False, False, True],
        gamma=0.9,
    )


def test_arrival_is_worked_out_by_hand(corridor):
    found = arrival(corridor, np.tile([0.0, 1.0], (4, 1)), n_steps=3)

    # From cell 1 two of three steps must succeed: 4 of 8 ways.
    np.testing.assert_allclose(found.arrived, [1 / 8, 4 / 8, 7 / 8, 1])
    # Steps are 1 + P(not there after 1) + P(not there after 2).
    np.testing.assert_allclose(found.steps, [3, 1 + 1 + 3 / 4, 1 + 1 / 2 + 1 / 4, 0])
    expected = (1 / 8 + 4 / 8 + 7 / 8) / (3 + 2.75 + 1.75)
    assert found.goals_per_step(~corridor.terminal) == pytest.approx(expected)


def test_arrival_agrees_with_walking(guides):
    tasks = target_tasks(Problem())
    guide = guides["beta-0"][tasks.rho]
    exact = arrival(tasks.mdp, guide).goals_per_step(~tasks.mdp.terminal)
    n = 10_000_000
    options = {"guide": guide, "tau": n, "rngs": range(12)}
    walks = q_learning_runs(tasks.mdp, n, **options)

    walked = np.mean([walk.goals.sum() for walk in walks])
    assert walked == pytest.approx(n * exact, rel=0.03)


def test_states_may_be_numbered_in_any_order(guides):
    """Neighbours a few distances apart are multiplied faster, and as all others."""
    tasks = target_tasks(Problem())
    mdp, policy = tasks.mdp, guides["beta-0"][tasks.rho]
    order = np.random.default_rng(0).permutation(mdp.n_states)
    mixed = MDP(
        np.argsort(order)[mdp.next_state[order]],
        mdp.prob[order],
        mdp.reward[order],
        mdp.terminal[order],
        mdp.gamma,
    )
    found, again = arrival(mdp, policy, 100), arrival(mixed, policy[order], 100)

    np.testing.assert_allclose(again.arrived, found.arrived[order], atol=1e-12)
    np.testing.assert_allclose(again.steps, found.steps[order])
    there = stuck(mdp, policy, 100)
    np.testing.assert_allclose(stuck(mixed, policy[order], 100), there[order])


def test_a_loop_of_chances_ends_and_a_closed_loop_does_not(corridor):
    policy = np.array([[1.0, 0.0], [1 - 1e-6, 1e-6], [0.0, 1.0], [0.5, 0.5]])

    np.testing.assert_array_equal(
        can_arrive(corridor, policy), [False, True, True, True]
    )


def test_who_arrives_at_all_depends_on_the_support_alone(guides):
    tasks = target_tasks(Problem())
    nd, prob = (can_arrive(tasks.mdp, guides[f"beta-{b}"][tasks.rho]) for b in (0, 1))

    np.testing.assert_array_equal(nd, prob)
    assert not nd.all()
    assert can_arrive(tasks.mdp, guides["available"][tasks.rho]).all()


def test_notes_of_a_walk_that_is_known_step_by_step():
    """From cell 0 to the goal in three steps, for ever: rewards come every third."""
    line = MDP(
        next_state=[[[1], [0]], [[2], [1]], [[3], [2]], [[3], [3]]],
        prob=np.ones((4, 2, 1)),
        reward=[0, 0, 0, 1],
        terminal=[False, False, False, True],
        gamma=0.5,
    )
    guide = np.tile([1.0, 0.0], (4, 1))
    found = notes_after(line, guide, 300, rngs=range(4), gamma=0.5)
    none = notes_after(line, np.tile([0.0, 1.0], (4, 1)), 300, rngs=[0], gamma=0.5)

    assert [len(of) for of in found] == [4] * 5  # a number per run
    assert (found.tried == 0.5).all()  # one of two actions, everywhere
    assert (found.noted == 1).all()
    assert found.skill == pytest.approx(np.ones(4))
    assert found.ready == pytest.approx(np.ones(4))
    assert ((found.goals >= 100) & (found.goals <= 300)).all()  # of 1 to 3 steps each
    assert (none.goals, none.noted) == (0, 0)
    assert none.tried == pytest.approx(1 / 6)  # it stays in its first cell
    # Blank notes are obeyed by tossing a coin: V(s) = gamma (V(s) + V(s+1)) / 2,
    v = np.array([1 / 27, 1 / 9, 1 / 3])  # that is V(s+1) / 3
    assert none.skill == pytest.approx(v.sum() / (1 / 8 + 1 / 4 + 1 / 2))


def test_notes_that_zero_flatters_are_refused(corridor):
    cost = navigation_tasks(read_map("source")).mdp

    with pytest.raises(ValueError, match="reward must not be negative"):
        notes_after(cost, np.full((cost.n_states, 8), 1 / 8), 10, rngs=[0])
