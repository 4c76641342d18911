"""The deduced policy: gradients by closed form and by differences, and the climb."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import dense_transitions, mdps, random_policy

from abstransfer import (
    MDP,
    absprob_pi,
    abstract_gradient,
    evaluate_policy,
    natural_ascent,
    navigation_tasks,
    parse_map,
    random_starts,
    read_map,
    uniform_policy,
)
from abstransfer.builders._refactorize import refactorize
from abstransfer.navigation import tasks_in_parts
from abstransfer.solvers import factorize, transition_matrix

GRAD = -30.27  # design 1.7: pi_AbsGrad in the source map
ALL = np.ones((1, 2), bool)
ONE = np.zeros(2, int)  # rho of the bump MDP: one abstract state


def bump(gamma=0.5, reward=-1.0):
    """Action 0 leads to the goal, action 1 bumps into a wall and stays."""
    return MDP(
        [[[1], [0]], [[1], [1]]], np.ones((2, 2, 1)), [reward, 0], [False, True], gamma
    )


@pytest.fixture(scope="module")
def source():
    return navigation_tasks(read_map("source"))


def start_in(mdp, *states):
    """Return the start distribution that is uniform over some states."""
    start = np.zeros(mdp.n_states)
    start[list(states)] = 1 / len(states)
    return start


# The gradient


@pytest.mark.parametrize("p", [1.0, 0.75, 0.2, 0.0])
@pytest.mark.parametrize("gamma", [0.5, 0.99])
def test_the_gradient_of_the_bump_is_its_closed_form(p, gamma):
    """
    V = -1 + gamma (1 - p) V, so V = -1 / (1 - gamma (1 - p)) and d = -V.

    The goal adds nothing: dV = gamma d Q = gamma d (0, V).
    """
    mdp = bump(gamma)
    value, gradient, visits = abstract_gradient(
        mdp, np.array([[p, 1 - p]]), ONE, start_in(mdp, 0)
    )

    v = -1 / (1 - gamma * (1 - p))
    assert value == pytest.approx(v, rel=1e-12)
    assert visits == pytest.approx([-v], rel=1e-12)
    np.testing.assert_allclose(gradient, [[0, -gamma * v**2]], rtol=1e-12)


def test_episodes_start_in_all_states_alike_by_default():
    """The goal is half of the states, and its value is 0."""
    value, gradient, visits = abstract_gradient(bump(), np.array([[0.5, 0.5]]), ONE)

    assert value == pytest.approx(-4 / 3 / 2)
    np.testing.assert_allclose(gradient, [[0, -0.5 * (4 / 3) ** 2 / 2]])
    np.testing.assert_allclose(visits, [4 / 3 / 2])


def test_a_policy_of_whole_numbers_has_the_same_gradient():
    whole = abstract_gradient(bump(), np.array([[1, 0]]), ONE)
    fractional = abstract_gradient(bump(), np.array([[1.0, 0.0]]), ONE)

    np.testing.assert_array_equal(whole[1], fractional[1])
    assert whole[1].any()


def dense_value(mdp, abstract_policy, rho, start):
    """Return the value for any numbers in the policy, also off the simplex."""
    p = dense_transitions(mdp, abstract_policy[rho])
    return start @ np.linalg.solve(np.eye(mdp.n_states) - mdp.gamma * p, mdp.reward)


@given(mdp=mdps(), seed=st.integers(0, 1000))
@settings(deadline=None, max_examples=40)
def test_the_gradient_is_the_one_by_finite_differences_on_any_mdp(mdp, seed):
    rng = np.random.default_rng(seed)
    rho = rng.integers(3, size=mdp.n_states)
    policy = rng.dirichlet(np.ones(mdp.n_actions), size=3)
    start = rng.dirichlet(np.ones(mdp.n_states))
    h = 1e-6

    expected = np.zeros(policy.shape)
    for entry in np.ndindex(policy.shape):
        nudge = np.zeros(policy.shape)
        nudge[entry] = h
        up = dense_value(mdp, policy + nudge, rho, start)
        down = dense_value(mdp, policy - nudge, rho, start)
        expected[entry] = (up - down) / (2 * h)
    value, gradient, _ = abstract_gradient(mdp, policy, rho, start)

    assert value == pytest.approx(dense_value(mdp, policy, rho, start), abs=1e-9)
    scale = max(1.0, abs(expected).max())
    np.testing.assert_allclose(gradient / scale, expected / scale, atol=1e-5)


@pytest.mark.parametrize("features", ["all", "near_goal only"])
@pytest.mark.parametrize("seed", range(3))
def test_the_gradient_is_the_one_by_finite_differences_on_the_source_map(
    source, seed, features
):
    tasks = source
    if features == "near_goal only":
        tasks = navigation_tasks(read_map("source"), features=["near_goal"])
    policy, other = random_starts(tasks.possible, 2, rng=seed)
    way, h = other - policy, 1e-5
    up, down = (
        evaluate_policy(tasks.mdp, (policy + sign * h * way)[tasks.rho]).mean()
        for sign in (1, -1)
    )
    gradient = abstract_gradient(tasks.mdp, policy, tasks.rho)[1]

    assert abs(up - down) > 1e-6
    assert (gradient * way).sum() == pytest.approx((up - down) / (2 * h), rel=1e-5)


def equal_to_the_bit(mdp, policies):
    """Compare what is solved with factors made again and anew, policy by policy."""
    b = np.random.default_rng(0).normal(size=mdp.n_states)
    for policy in policies:
        again = refactorize(mdp, policy)
        anew = factorize(transition_matrix(mdp, policy), mdp.gamma)
        for way in ("N", "T"):
            np.testing.assert_array_equal(again.solve(b, way), anew.solve(b, way))


@given(mdps(max_states=20, masks=True))
@settings(deadline=None)
def test_factors_that_are_made_again_are_those_made_anew(mdp):
    some = np.eye(mdp.n_actions)[mdp.allowed.argmax(axis=1)]  # uses fewer actions
    draws = [random_policy(mdp, seed) for seed in range(3)]

    equal_to_the_bit(mdp, [*draws[:2], some, some / 2 + draws[2] / 2])


def test_factors_that_are_made_again_are_those_made_anew_in_the_source(source):
    equal_to_the_bit(
        source.mdp,
        (start[source.rho] for start in random_starts(source.possible, 3, rng=0)),
    )


def test_each_step_that_is_not_at_the_goal_costs_one(source):
    policy = random_starts(source.possible, 1, rng=0)[0]
    value, _, visits = abstract_gradient(source.mdp, policy, source.rho)

    assert value == pytest.approx(-visits.sum(), rel=1e-10)


def test_the_union_weighs_its_tasks_by_their_cells():
    """Several maps: each task counts by its share of all states."""
    maps = [read_map("source"), parse_map("+-----+-+\n|*    d*|\n+-----+-+")]
    union = navigation_tasks(maps)
    policy = random_starts(union.possible, 1, rng=1)[0]

    value, gradient, visits = 0.0, 0.0, 0.0
    for k in range(len(union.goal)):
        task = navigation_tasks(maps, keep=[k])
        share = task.mdp.n_states / union.mdp.n_states
        part = abstract_gradient(task.mdp, policy, task.rho)
        value += share * part[0]
        gradient += share * part[1]
        visits += share * part[2]
    together = abstract_gradient(union.mdp, policy, union.rho)

    assert together[0] == pytest.approx(value)
    np.testing.assert_allclose(together[1], gradient, atol=1e-10)
    np.testing.assert_allclose(together[2], visits, atol=1e-10)


@pytest.mark.parametrize("method", [absprob_pi, natural_ascent])
def test_blocks_of_the_union_are_climbed_as_the_union(source, method):
    blocks = list(tasks_in_parts(read_map("source"), states=300))
    assert len(blocks) == 5
    mdps = [block.mdp for block in blocks]
    start = np.random.default_rng(0).dirichlet(np.ones(source.mdp.n_states))

    together, apart = (
        method(mdp, source.rho, source.possible, start=start, iterations=5)
        for mdp in (source.mdp, mdps)
    )
    np.testing.assert_allclose(apart.policy, together.policy, atol=1e-12)
    np.testing.assert_allclose(apart.history, together.history)


# AbsProb-PI


def test_two_iterations_are_as_worked_out_by_hand():
    """
    The target is (0.95 + 0.025, 0.025); first half of the way, then a third.

    0.5 -> 0.7375 -> 0.7375 + (0.975 - 0.7375) / 3.
    """
    climb = absprob_pi(bump(), ONE, ALL, start=np.array([1.0, 0]), iterations=2)

    p = 0.7375 + (0.975 - 0.7375) / 3
    np.testing.assert_allclose(climb.policy, [[p, 1 - p]])
    values = [-1 / (1 - 0.5 * (1 - x)) for x in (0.5, 0.7375, p)]
    np.testing.assert_allclose(climb.history, values)


@pytest.mark.parametrize("n", [0, 1, 9, 99])
def test_without_softness_the_wrong_action_fades_as_one_over_n(n):
    """(1/2) (1/2) (2/3) (3/4) ... = (1/2) / (n + 1)."""
    climb = absprob_pi(bump(), ONE, ALL, iterations=n, softness=0)

    np.testing.assert_allclose(climb.policy[0, 1], 0.5 / (n + 1))
    assert len(climb.history) == n + 1


def test_softness_that_falls_on_impossible_actions_is_given_back():
    """0.06 over 3 actions: (0.94 + 0.02, 0.02) / 0.98 on the two possible ones."""
    mdp = MDP(
        [[[1], [0], [0]], [[1], [1], [1]]],
        np.ones((2, 3, 1)),
        [-1, 0],
        [False, True],
        0.5,
    )
    possible = np.array([[True, True, False]])
    climb = absprob_pi(mdp, ONE, possible, iterations=1, softness=0.06)

    p = (0.5 + 0.96 / 0.98) / 2
    np.testing.assert_allclose(climb.policy, [[p, 1 - p, 0]])


def test_the_climb_starts_where_it_is_told():
    climb = absprob_pi(bump(), ONE, ALL, initial=[[0.2, 0.8]], iterations=0)

    assert climb.policy.tolist() == [[0.2, 0.8]]
    assert climb.history == pytest.approx([-1 / (1 - 0.4) / 2])


def test_the_initial_policy_is_not_changed():
    initial = np.array([[0.2, 0.8]])
    absprob_pi(bump(), ONE, ALL, initial=initial, iterations=3)
    natural_ascent(bump(), ONE, ALL, initial=initial, iterations=3)

    assert initial.tolist() == [[0.2, 0.8]]


@pytest.fixture(scope="module")
def climb(source):
    return absprob_pi(source.mdp, source.rho, source.possible)


def test_the_climb_on_the_source_map_reaches_the_value_of_the_design(climb):
    assert climb.history[-1] == pytest.approx(GRAD, abs=0.3)


@pytest.mark.parametrize("seed", range(5))
def test_whatever_the_start_the_climb_ends_near(source, seed):
    initial = random_starts(source.possible, 1, rng=seed)[0]
    climb = absprob_pi(source.mdp, source.rho, source.possible, initial=initial)

    assert climb.history[0] < -60
    assert climb.history[-1] == pytest.approx(GRAD, abs=0.3)


@pytest.mark.parametrize("method", [absprob_pi, natural_ascent])
def test_the_last_value_is_that_of_the_policy(source, method):
    climb = method(source.mdp, source.rho, source.possible, iterations=5)
    v = evaluate_policy(source.mdp, climb.policy[source.rho])

    assert climb.history[-1] == pytest.approx(v.mean(), rel=1e-10)
    assert climb.history[-1] > climb.history[0] + 1


@pytest.mark.parametrize("method", [absprob_pi, natural_ascent])
def test_the_policy_uses_possible_actions_only(source, method):
    climb = method(source.mdp, source.rho, source.possible, iterations=5)

    np.testing.assert_allclose(climb.policy.sum(axis=1), 1)
    assert (climb.policy[~source.possible] == 0).all()
    assert (climb.policy >= 0).all()


@pytest.mark.parametrize("method", [absprob_pi, natural_ascent])
def test_a_single_task_is_climbed_higher_than_it_is_with_all_others(method, climb):
    """AbsProb-PI of one task need not please the other ten."""
    task = navigation_tasks(read_map("source"), keep=[0])
    alone = method(task.mdp, task.rho, task.possible)
    shared = evaluate_policy(task.mdp, climb.policy[task.rho]).mean()

    assert alone.history[-1] > shared + 1


def test_abstract_states_that_are_never_visited_keep_their_row():
    """From state 0 only the goal is reached; state 2 looks different."""
    mdp = MDP(
        [[[1], [0]], [[1], [1]], [[1], [2]]],
        np.ones((3, 2, 1)),
        [-1, 0, -1],
        [False, True, False],
        0.5,
    )
    climb = absprob_pi(
        mdp,
        np.array([0, 0, 1]),
        np.ones((2, 2), bool),
        initial=[[0.5, 0.5], [0.3, 0.7]],
        start=start_in(mdp, 0),
    )

    assert climb.policy[1].tolist() == [0.3, 0.7]
    assert climb.policy[0, 0] > 0.97


def test_masking_what_is_impossible_anyway_changes_nothing(source):
    masked = navigation_tasks(read_map("source"), unavailable="masked")
    plain, same = (
        absprob_pi(tasks.mdp, tasks.rho, tasks.possible, iterations=20)
        for tasks in (source, masked)
    )

    np.testing.assert_allclose(same.policy, plain.policy, atol=1e-9)
    np.testing.assert_allclose(same.history, plain.history)


def test_progress_sees_every_iteration_and_changes_nothing():
    seen = []

    def watch(iterations):
        for i in iterations:
            seen.append(i)
            yield i

    watched = absprob_pi(bump(), ONE, ALL, iterations=4, progress=watch)
    plain = absprob_pi(bump(), ONE, ALL, iterations=4)
    assert seen == [1, 2, 3, 4]
    np.testing.assert_array_equal(watched.policy, plain.policy)


# Natural gradient


def test_one_natural_step_is_as_worked_out_by_hand():
    """V = -4/3, so Q = (0, -4/3); gamma halves it, and the first step is 0.1."""
    climb = natural_ascent(
        bump(), ONE, ALL, start=np.array([1.0, 0]), iterations=1, floor=0
    )

    p = 1 / (1 + np.exp(-0.1 * 0.5 * 4 / 3))
    np.testing.assert_allclose(climb.policy, [[p, 1 - p]])
    np.testing.assert_allclose(climb.history, [-4 / 3, -1 / (1 - 0.5 * (1 - p))])


@pytest.fixture(scope="module")
def natural_climb(source):
    return natural_ascent(source.mdp, source.rho, source.possible)


def test_every_natural_step_is_a_gain(natural_climb):
    assert len(natural_climb.history) > 20
    assert (np.diff(natural_climb.history) > 0).all()


def test_every_natural_step_from_another_start_is_a_gain(source):
    climb = natural_ascent(
        source.mdp,
        source.rho,
        source.possible,
        initial=random_starts(source.possible, 1, rng=2)[0],
        iterations=30,
    )

    assert len(climb.history) == 31
    assert (np.diff(climb.history) > 0).all()


def test_the_natural_gradient_reaches_the_place_of_the_other_rule(natural_climb):
    assert natural_climb.history[-1] == pytest.approx(GRAD, abs=0.3)


def test_no_possible_action_falls_below_about_the_floor(source, natural_climb):
    """Rows are raised to 0.005, then divided by their sum, at most 1 + 7 * 0.005."""
    lowest = natural_climb.policy[source.possible].min()

    assert 0.005 / 1.04 <= lowest <= 0.005


def test_the_natural_gradient_stops_at_the_top():
    """All but the floor on the right action: 1 to 0.005."""
    climb = natural_ascent(bump(), ONE, ALL, iterations=10_000)

    assert len(climb.history) < 200
    np.testing.assert_allclose(climb.policy, [[1 / 1.005, 0.005 / 1.005]])


@pytest.mark.parametrize("reward", [-1e290, -1e6, 1e6, 1e290])
def test_large_rewards_do_not_overflow(reward):
    """To leave is best where it costs to stay, to bump where it pays."""
    climb = natural_ascent(bump(0.99, reward), ONE, ALL)

    best = [1 / 1.005, 0.005 / 1.005]
    np.testing.assert_allclose(climb.policy, [best if reward < 0 else best[::-1]])


def test_an_action_given_up_without_a_floor_stays_given_up():
    climb = natural_ascent(bump(), ONE, ALL, initial=[[0.0, 1.0]], floor=0)

    assert climb.policy.tolist() == [[0, 1]]
    assert len(climb.history) == 1


# Random starts


def test_random_starts_are_policies_over_possible_actions(source):
    starts = random_starts(source.possible, 4, rng=0)

    assert starts.shape == (4, *source.possible.shape)
    np.testing.assert_allclose(starts.sum(axis=2), 1)
    np.testing.assert_array_equal(
        starts > 0, np.broadcast_to(source.possible, starts.shape)
    )


def test_random_starts_are_uniform_on_the_simplex():
    """Of n shares each is 1/n on average, with variance (n - 1) / n^2 (n + 1)."""
    starts = random_starts(np.ones((1, 3), bool), 20_000, rng=1)[:, 0]

    np.testing.assert_allclose(starts.mean(axis=0), 1 / 3, atol=0.005)
    np.testing.assert_allclose(starts.var(axis=0), 2 / 36, atol=0.001)


def test_the_seed_of_random_starts_decides(source):
    possible = source.possible
    first = random_starts(possible, 2, rng=1)

    np.testing.assert_array_equal(first, random_starts(possible, 2, rng=1))
    assert (first[0] != first[1]).any()
    assert (first != random_starts(possible, 2, rng=2)).any()


# Refusals


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"iterations": -1}, "iterations must not be negative, got -1"),
        ({"softness": 1.5}, "softness must lie in 0..1, got 1.5"),
        ({"softness": -0.1}, "softness must lie in 0..1, got -0.1"),
        ({"softness": None}, "softness must hold numbers, got object"),
        ({"iterations": 1.5}, "iterations must hold int64, got float64"),
        ({"iterations": "3"}, "iterations must hold numbers, got <U1"),
        ({"possible": None}, "possible must hold numbers, got object"),
    ],
)
def test_a_bad_option_is_refused_by_name(options, said):
    assert refusal(absprob_pi, **options) == said


@pytest.mark.parametrize("floor", [-0.1, 0.5, np.nan])
def test_a_floor_that_leaves_no_room_is_refused(floor):
    assert (
        refusal(natural_ascent, floor=floor) == f"floor must lie in 0..1/A, got {floor}"
    )


@pytest.mark.parametrize(
    ("mdp", "policy", "rho", "said"),
    [
        (bump(), [[0.5, 0.5]], [0, 1], r"rho must lie in 0..0, got 1"),
        (bump(), [[0.5, 0.5]], [0], r"rho must have shape \(2,\), got \(1,\)"),
        (bump(), [[0.5, 0.5]], None, "rho must hold numbers, got object"),
        (bump(), [0.5, 0.5], ONE, "policy must have shape 2 axes"),
        (bump(), [[np.nan, 1]], ONE, "policy must not be negative or nan"),
        (bump(), [[1 / 3] * 3], ONE, r"policy must have shape \(2, 2\), got \(2, 3"),
        (None, [[0.5, 0.5]], ONE, "mdp must be an MDP, as in tasks.mdp, got NoneType"),
        ([], [[0.5, 0.5]], ONE, "mdp must be an MDP, as in tasks.mdp, got NoneType"),
        ([None], [[0.5, 0.5]], ONE, "mdp must be an MDP, as in tasks.mdp, got None"),
    ],
)
def test_a_gradient_of_what_does_not_match_is_refused(mdp, policy, rho, said):
    with pytest.raises(ValueError, match=f"^{said}"):
        abstract_gradient(mdp, policy, rho)


@pytest.mark.parametrize(
    ("possible", "n", "said"),
    [
        (
            [[True, True], [False, False]],
            2,
            "possible must leave every abstract state an action, "
            "but abstract state 1 has none",
        ),
        ([True, False], 2, "possible must have shape 2 axes"),
        ([[0.3, 1.0]], 2, "possible must hold bool, got float64"),
        ([[True]], 1.5, "n must hold int64, got float64"),
    ],
)
def test_random_starts_where_nothing_can_be_drawn_are_refused(possible, n, said):
    with pytest.raises(ValueError, match=f"^{said}"):
        random_starts(possible, n, rng=0)


@pytest.mark.parametrize("method", [absprob_pi, natural_ascent])
@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"start": [1.0]}, "start must have shape (2,), got (1,)"),
        (
            {"start": [0.5, 0.25]},
            "start must be probabilities that sum to 1, got [0.5  0.25]",
        ),
        (
            {"start": [1.5, -0.5]},
            "start must be probabilities that sum to 1, got [ 1.5 -0.5]",
        ),
        (
            {"start": [np.nan, 1]},
            "start must be probabilities that sum to 1, got [nan  1.]",
        ),
        ({"initial": [[1.0]]}, "initial must have shape (1, 2), got (1, 1)"),
        (
            {"initial": [[0.5, 0.25]]},
            "policy must sum to 1 in each row: at state 0 it was 0.75",
        ),
        (
            {"possible": np.array([[True, True], [False, False]])},
            "possible must leave every abstract state an action, "
            "but abstract state 1 has none",
        ),
    ],
)
def test_what_cannot_be_climbed_is_refused(method, options, said):
    assert refusal(method, **options) == said


def refusal(method, possible=ALL, **options):
    """Return what a climb on the bump says when it refuses."""
    with pytest.raises(ValueError) as error:  # noqa: PT011 (compared by the caller)
        method(bump(), ONE, possible, **options)
    return str(error.value)


def test_a_policy_that_uses_masked_actions_is_refused_with_the_state():
    """Without the features that see, nothing says which actions are available."""
    tasks = navigation_tasks(
        read_map("source"), unavailable="masked", features=["near_goal"]
    )
    with pytest.raises(
        ValueError, match="policy must use allowed actions only: at state 0, action"
    ):
        abstract_gradient(tasks.mdp, uniform_policy(tasks.possible), tasks.rho)
