"""Exact solutions: by hand, against dense linear algebra, against iteration."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import dense_transitions, mdps, random_policy

from abstransfer import (
    MDP,
    action_values,
    evaluate_policy,
    navigation_tasks,
    optimal_actions,
    optimal_values,
    parse_map,
    solvers,
    transition_matrix,
    value_iteration,
)

RIGHT, STAY = 0, 1


@pytest.fixture
def corridor():
    """
    Three cells, the last the goal; RIGHT succeeds with 0.8, gamma is 0.5.

    Each step to a cell that is not the goal costs 1: R = (-1, -1, 0).
    """
    return MDP(
        next_state=[[[1, 0], [0, 0]], [[2, 1], [1, 1]], [[2, 2], [2, 2]]],
        prob=np.tile([0.8, 0.2], (3, 2, 1)),
        reward=[-1, -1, 0],
        terminal=[False, False, True],
        gamma=0.5,
    )


@pytest.fixture
def fork():
    """Two ways of one step to the goal, and one of two steps."""
    return MDP(
        next_state=[[[2], [2], [1]], [[2], [2], [2]], [[2], [2], [2]]],
        prob=np.ones((3, 3, 1)),
        reward=[-1, -1, 0],
        terminal=[False, False, True],
        gamma=0.5,
    )


# By hand


def test_the_transitions_under_a_policy_are_the_ones_worked_out_by_hand(corridor):
    """Half the time RIGHT: 0.5 * 0.8 = 0.4 to the right, else no move."""
    p = transition_matrix(corridor, np.full((3, 2), 0.5))

    np.testing.assert_allclose(p.toarray(), [[0.6, 0.4, 0], [0, 0.6, 0.4], [0, 0, 0]])
    assert p.nnz == 4  # no zero is stored, and nothing for the goal


def test_the_value_of_walking_right_is_the_one_worked_out_by_hand(corridor):
    """
    V(s) = R(s) + gamma sum P V, the paper's rule.

    V1 = -1 + 0.5 (0.8 * 0 + 0.2 V1), so V1 = -1 / 0.9;
    V0 = -1 + 0.5 (0.8 V1 + 0.2 V0), so V0 = (-1 + 0.4 V1) / 0.9.
    """
    v = evaluate_policy(corridor, np.tile([1.0, 0.0], (3, 1)))

    np.testing.assert_allclose(v, [-1.3 / 0.81, -1 / 0.9, 0], rtol=1e-14)


def test_the_value_of_staying_is_the_geometric_series(corridor):
    """1 + 0.5 + 0.25 + ... = 2."""
    v = evaluate_policy(corridor, np.tile([0.0, 1.0], (3, 1)))

    np.testing.assert_allclose(v, [-2, -2, 0], rtol=1e-14)


def test_the_value_of_a_stochastic_policy_is_the_one_worked_out_by_hand(corridor):
    """V1 = -1 + 0.5 (0.6 V1) = -1 / 0.7; V0 = (-1 + 0.2 V1) / 0.7."""
    v = evaluate_policy(corridor, np.full((3, 2), 0.5))

    np.testing.assert_allclose(v, [-0.9 / 0.49, -1 / 0.7, 0], rtol=1e-14)


def test_a_terminal_state_is_worth_its_reward_and_ends_the_episode(corridor):
    """R = 1 at the goal: V2 = 1, V1 = 0.4 V2 / 0.9, V0 = 0.4 V1 / 0.9."""
    mdp = MDP(
        corridor.next_state, corridor.prob, [0, 0, 1], corridor.terminal, corridor.gamma
    )
    v = evaluate_policy(mdp, np.tile([1.0, 0.0], (3, 1)))

    np.testing.assert_allclose(v, [(4 / 9) ** 2, 4 / 9, 1], rtol=1e-14)


def test_what_a_policy_would_do_in_a_terminal_state_is_not_read(corridor):
    v = evaluate_policy(corridor, np.array([[1.0, 0], [1.0, 0], [np.nan, np.inf]]))

    np.testing.assert_allclose(v, [-1.3 / 0.81, -1 / 0.9, 0], rtol=1e-14)


def test_an_action_is_worth_the_value_it_is_expected_to_reach(corridor):
    q = action_values(corridor, np.array([-5.0, -3.0, 0.0]))

    np.testing.assert_allclose(q, [[0.8 * -3 + 0.2 * -5, -5], [0.2 * -3, -3], [0, 0]])


def test_what_is_not_allowed_is_worth_minus_infinity(corridor):
    allowed = [[True, False], [False, True], [False, False]]
    mdp = MDP(
        corridor.next_state,
        corridor.prob,
        corridor.reward,
        corridor.terminal,
        0.5,
        allowed,
    )
    q = action_values(mdp, np.array([-5.0, -3.0, 0.0]))

    np.testing.assert_allclose(q, [[-3.4, -np.inf], [-np.inf, -3.0], [0, 0]])


def test_optimal_values_are_those_of_walking_right(corridor):
    v = optimal_values(corridor)

    np.testing.assert_allclose(v, [-1.3 / 0.81, -1 / 0.9, 0], rtol=1e-14)
    assert optimal_actions(corridor, v).tolist() == [
        [True, False],
        [True, False],
        [False, False],
    ]


def test_all_of_several_best_actions_are_optimal(fork):
    v = optimal_values(fork)

    assert v.tolist() == [-1, -1, 0]
    assert optimal_actions(fork, v).tolist() == [
        [True, True, False],
        [True, True, True],
        [False, False, False],
    ]


def test_a_masked_action_is_not_optimal_however_good(fork):
    """Only the detour is left: V0 = -1 + 0.5 V1 = -1.5."""
    allowed = [[False, False, True], [True, False, True], [False] * 3]
    mdp = MDP(fork.next_state, fork.prob, fork.reward, fork.terminal, 0.5, allowed)
    v = optimal_values(mdp)

    assert v.tolist() == [-1.5, -1, 0]
    assert optimal_actions(mdp, v).tolist() == allowed


def test_the_sweeps_are_the_ones_worked_out_by_hand(corridor):
    """
    After sweep k the values are those of a robot that has k steps left.

    V1: -1, then -1 + 0.5 * 0.2 * -1 = -1.1, then -1.11.
    V0: -1, then -1 + 0.5 * -1 = -1.5, then -1 + 0.5 (0.8 * -1.1 + 0.2 * -1.5).
    """
    sweeps = list(islice(value_iteration(corridor), 3))

    np.testing.assert_allclose(sweeps[0], [-1, -1, 0])
    np.testing.assert_allclose(sweeps[1], [-1.5, -1.1, 0])
    np.testing.assert_allclose(sweeps[2], [-1.59, -1.11, 0])


def test_a_sweep_does_not_change_the_sweeps_before_it(corridor):
    sweeps = list(islice(value_iteration(corridor), 5))
    again = list(islice(value_iteration(corridor), 5))

    assert len({id(v) for v in sweeps}) == 5
    np.testing.assert_array_equal(sweeps, again)
    assert corridor.reward.tolist() == [-1, -1, 0]


# On random MDPs, against other ways


@given(mdps(masks=True))
@settings(deadline=None, max_examples=60)
def test_the_sparse_transitions_are_the_dense_ones(mdp):
    policy = random_policy(mdp)

    sparse = transition_matrix(mdp, policy).toarray()
    np.testing.assert_allclose(sparse, dense_transitions(mdp, policy), atol=1e-15)
    np.testing.assert_allclose(sparse.sum(axis=1), ~mdp.terminal, atol=1e-12)


@given(mdps(masks=True))
@settings(deadline=None, max_examples=60)
def test_the_sparse_solution_is_the_dense_one(mdp):
    policy = random_policy(mdp)
    p = dense_transitions(mdp, policy)

    expected = np.linalg.solve(np.eye(mdp.n_states) - mdp.gamma * p, mdp.reward)
    np.testing.assert_allclose(evaluate_policy(mdp, policy), expected, atol=1e-10)


@given(mdps(masks=True))
@settings(deadline=None, max_examples=30)
def test_value_iteration_comes_to_the_optimal_values(mdp):
    v = next(islice(value_iteration(mdp), 2600, None))  # 0.99 ** 2600 < 1e-11

    np.testing.assert_allclose(optimal_values(mdp), v, atol=1e-7)


@given(mdps(masks=True))
@settings(deadline=None, max_examples=60)
def test_optimal_values_solve_the_equation_of_bellman(mdp):
    v = optimal_values(mdp)

    best = np.where(mdp.terminal, 0.0, action_values(mdp, v).max(axis=1))
    np.testing.assert_allclose(v, mdp.reward + mdp.gamma * best, atol=1e-8)


@given(mdps(masks=True))
@settings(deadline=None, max_examples=60)
def test_no_policy_is_better_than_the_optimal_values(mdp):
    v = evaluate_policy(mdp, random_policy(mdp))

    assert (v <= optimal_values(mdp) + 1e-8).all()


@given(mdps(masks=True))
@settings(deadline=None, max_examples=60)
def test_any_mixture_of_optimal_actions_reaches_the_optimal_values(mdp):
    v = optimal_values(mdp)
    optimal = optimal_actions(mdp, v)
    assert optimal[~mdp.terminal].any(axis=1).all()
    assert not optimal[mdp.terminal].any()
    assert not (optimal & ~mdp.allowed).any()

    weight = optimal * (1.0 + np.arange(mdp.n_actions))
    total = weight.sum(axis=1, keepdims=True)
    mixture = np.divide(weight, total, out=np.zeros_like(weight), where=total > 0)
    np.testing.assert_allclose(evaluate_policy(mdp, mixture), v, atol=1e-6)


@given(mdps(masks=True))
@settings(deadline=None, max_examples=30)
def test_however_few_sweeps_go_before_the_optimal_values_are_the_same(mdp):
    v = optimal_values(mdp)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solvers, "SWEEPS", 0)
        np.testing.assert_allclose(optimal_values(mdp), v, atol=1e-8)


def test_sweeps_reach_what_is_far_before_the_first_round(monkeypatch):
    """A corridor of 300 cells: policy iteration alone would carry news by the cell."""
    n, rounds = 300, []
    cell = np.arange(n)
    mdp = MDP(
        np.stack([np.maximum(cell - 1, 0), np.minimum(cell + 1, n - 1)], 1)[:, :, None],
        np.ones((n, 2, 1)),
        -1.0 * (cell < n - 1),
        cell == n - 1,
        0.99,
    )

    def counted(*arguments):
        rounds.append(arguments)
        return evaluate_policy(*arguments)

    monkeypatch.setattr(solvers, "evaluate_policy", counted)
    v = optimal_values(mdp)

    np.testing.assert_allclose(v, -100 * (1 - 0.99 ** (n - 1 - cell)), atol=1e-9)
    assert len(rounds) <= 3


# Ties


@pytest.mark.parametrize("scale", [1e-12, 1e-3, 1.0, 1e6, 1e12])
@pytest.mark.parametrize("gamma", [0.5, 0.999])
def test_ties_are_the_same_in_whatever_unit_the_reward_is_paid(scale, gamma):
    """A ring walked around either way: both ways tie at the far end, and only there."""
    n = 40
    around = np.stack([np.roll(range(n), 1), np.roll(range(n), -1)], axis=1)
    mdp = MDP(
        next_state=np.stack([around, np.tile(np.arange(n)[:, None], 2)], axis=2),
        prob=np.tile([0.7, 0.3], (n, 2, 1)),
        reward=scale * np.where(np.arange(n) == 0, 0.0, -1.0),
        terminal=np.arange(n) == 0,
        gamma=gamma,
    )
    optimal = optimal_actions(mdp, optimal_values(mdp))

    expected = np.zeros((n, 2), bool)
    expected[1 : n // 2 + 1, 0] = True
    expected[n // 2 :, 1] = True
    assert optimal.tolist() == expected.tolist()


def test_a_thousand_equal_actions_do_not_swap_for_ever():
    """Every action leads anywhere, at the same price: all are optimal."""
    rng = np.random.default_rng(0)
    n = 60
    prob = rng.dirichlet(np.ones(4), size=(n, 20))
    mdp = MDP(
        rng.integers(n, size=prob.shape), prob, -np.ones(n), np.zeros(n, bool), 0.99
    )
    v = optimal_values(mdp)

    np.testing.assert_allclose(v, -100, rtol=1e-12)
    assert optimal_actions(mdp, v).all()


# Refusals


def test_a_policy_of_another_mdp_is_refused(corridor):
    with pytest.raises(
        ValueError, match=r"policy must have shape \(3, 2\), got \(3, 3\)"
    ):
        evaluate_policy(corridor, np.ones((3, 3)) / 3)


def test_a_policy_that_does_not_sum_to_one_is_refused(corridor):
    with pytest.raises(
        ValueError, match="policy must sum to 1 in each row: at state 0"
    ):
        evaluate_policy(corridor, np.ones((3, 2)))


VALUES = np.zeros(3)


@pytest.mark.parametrize(
    ("v", "said"),
    [
        (np.zeros(18_900), r"v must have shape \(3,\), got \(18900,\)"),
        (np.zeros((3, 1)), r"v must have shape \(3,\), got \(3, 1\)"),
        ([0, np.nan, 0], "v must be finite, got"),
        ([0, np.inf, 0], "v must be finite, got"),
        (None, "v must hold numbers, got object"),
    ],
)
@pytest.mark.parametrize("function", [action_values, optimal_actions])
def test_values_of_another_mdp_are_refused(corridor, function, v, said):
    with pytest.raises(ValueError, match=f"^{said}"):
        function(corridor, v)


@pytest.mark.parametrize(
    "call",
    [
        lambda tasks: evaluate_policy(tasks, np.ones((3, 2)) / 2),
        lambda tasks: transition_matrix(tasks, np.ones((3, 2)) / 2),
        lambda tasks: action_values(tasks, VALUES),
        lambda tasks: optimal_actions(tasks, VALUES),
        lambda tasks: optimal_values(tasks),
        lambda tasks: next(value_iteration(tasks)),
    ],
)
def test_tasks_are_refused_where_their_mdp_is_wanted(call):
    tasks = navigation_tasks(parse_map("+---+\n|.d*|\n+---+"))

    with pytest.raises(ValueError, match="^mdp must be an MDP, as in tasks.mdp, got N"):
        call(tasks)


def test_transitions_of_what_is_no_policy_are_refused(corridor):
    with pytest.raises(ValueError, match="^policy must not be negative or nan"):
        transition_matrix(corridor, np.tile([-1.0, 2.0], (3, 1)))
