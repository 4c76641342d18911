"""The induced policies: counted by hand, and the same however the tasks come."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import chisquare
from strategies import map_texts

from abstransfer import (
    LABELS,
    beta_policy,
    break_ties,
    count_votes,
    induce_nondeterministic,
    induce_probabilistic,
    navigation_tasks,
    optimal_actions,
    optimal_values,
    parse_map,
    read_map,
    restrict_policy,
    uniform_policy,
)
from abstransfer.policies import ground, spoken
from abstransfer.solvers import evaluate_policy

BUILDERS = pytest.mark.parametrize(
    "induce", [induce_probabilistic, induce_nondeterministic]
)

# Cells 0 to 3 in a row; the door is between 2 and 3; goals at 0 and 3.
TWO_ROOMS = """\
+-----+-+
|*    d*|
+-----+-+"""


def votes_of(tasks):
    """Return the optimal policy of the tasks, ties shared."""
    return break_ties(optimal_actions(tasks.mdp, optimal_values(tasks.mdp)))


def by_label(row):
    """Return what a row over LABELS gives to each label, zeros left out."""
    return {LABELS[a]: row[a] for a in np.flatnonzero(row)}


# By hand


def test_both_formulas_on_three_states_are_as_worked_out_by_hand():
    """Three states look alike: 1 + 1/2 votes for a, 1/2 for b, 1 for c, of 3."""
    votes = np.array([[1.0, 0, 0], [0.5, 0.5, 0], [0, 0, 1.0]])
    rho, fallback = np.zeros(3, int), np.ones((1, 3), bool)

    np.testing.assert_allclose(
        induce_probabilistic(votes, rho, fallback), [[1 / 2, 1 / 6, 1 / 3]]
    )
    np.testing.assert_allclose(
        induce_nondeterministic(votes, rho, fallback), [[1 / 3, 1 / 3, 1 / 3]]
    )


def test_each_abstract_state_counts_its_own_votes():
    votes = np.array([[1.0, 0], [0, 1.0], [0, 1.0], [1.0, 0]])
    rho, fallback = np.array([0, 2, 2, 2]), np.ones((3, 2), bool)

    np.testing.assert_array_equal(count_votes(votes, rho, 3), [[1, 0], [0, 0], [1, 2]])
    np.testing.assert_allclose(
        induce_probabilistic(votes, rho, fallback), [[1, 0], [0.5, 0.5], [1 / 3, 2 / 3]]
    )
    np.testing.assert_allclose(
        induce_nondeterministic(votes, rho, fallback), [[1, 0], [0.5, 0.5], [0.5, 0.5]]
    )


@pytest.mark.parametrize(
    ("state", "label"),
    [
        (1, "see_empty_space_head_to_goal"),
        (2, "see_empty_space_head_to_goal"),
        (3, "see_room_head_to_goal"),
        (4, "see_empty_space_head_to_goal"),
        (5, "see_door_far_head_to_goal"),
        (6, "see_room_head_to_goal"),
    ],
)
def test_each_cell_of_two_rooms_votes_for_the_way_to_the_goal(state, label):
    """States 0 to 3 have their goal on the left, 4 to 7 on the right."""
    tasks = navigation_tasks(parse_map(TWO_ROOMS))

    assert by_label(votes_of(tasks)[state]) == {label: 1.0}


def test_the_goals_of_two_rooms_do_not_vote():
    votes = votes_of(navigation_tasks(parse_map(TWO_ROOMS)))

    assert votes.sum(axis=1).tolist() == [0, 1, 1, 1, 1, 1, 1, 0]


def test_the_policies_of_two_rooms_are_as_worked_out_on_paper():
    """All cells look alike; of the 6 votes 3 are for empty space, 2 for a room."""
    tasks = navigation_tasks(parse_map(TWO_ROOMS), features=["in_room"])
    votes = votes_of(tasks)
    assert tasks.rho.tolist() == [1] * 8

    prob = induce_probabilistic(votes, tasks.rho, tasks.possible)
    assert by_label(prob[1]) == {
        "see_empty_space_head_to_goal": pytest.approx(3 / 6),
        "see_room_head_to_goal": pytest.approx(2 / 6),
        "see_door_far_head_to_goal": pytest.approx(1 / 6),
    }
    nd = induce_nondeterministic(votes, tasks.rho, tasks.possible)
    assert by_label(nd[1]) == dict.fromkeys(by_label(prob[1]), pytest.approx(1 / 3))


def test_two_abstract_states_of_two_rooms_are_as_worked_out_on_paper():
    """Next to the goal: one vote each for empty space and room; else 2, 1, 1."""
    tasks = navigation_tasks(parse_map(TWO_ROOMS), features=["near_goal"], near=1)
    prob = induce_probabilistic(votes_of(tasks), tasks.rho, tasks.possible)

    assert by_label(prob[1]) == {
        "see_empty_space_head_to_goal": pytest.approx(1 / 2),
        "see_room_head_to_goal": pytest.approx(1 / 2),
    }
    assert by_label(prob[0]) == {
        "see_empty_space_head_to_goal": pytest.approx(2 / 4),
        "see_room_head_to_goal": pytest.approx(1 / 4),
        "see_door_far_head_to_goal": pytest.approx(1 / 4),
    }


# However the tasks come


def test_the_votes_of_the_union_are_those_of_each_task_added_up():
    source = read_map("source")
    union = navigation_tasks(source)
    single = [navigation_tasks(source, keep=[k]) for k in range(len(union.goal))]

    added = sum(count_votes(votes_of(task), task.rho, 2048) for task in single)
    assert added.sum() == pytest.approx(11 * 134)
    np.testing.assert_allclose(count_votes(votes_of(union), union.rho, 2048), added)


def test_the_votes_of_several_maps_are_those_of_each_map_added_up():
    maps = [read_map("source"), parse_map(TWO_ROOMS)]
    tasks = navigation_tasks(maps)

    added = sum(
        count_votes(votes_of(part), part.rho, 2048)
        for part in map(navigation_tasks, maps)
    )
    np.testing.assert_allclose(count_votes(votes_of(tasks), tasks.rho, 2048), added)


@BUILDERS
@given(text=map_texts(4, 4))
@settings(deadline=None, max_examples=25)
def test_an_induced_policy_uses_only_what_is_seen(induce, text):
    tasks = navigation_tasks(parse_map(text))
    policy = induce(votes_of(tasks), tasks.rho, tasks.possible)

    np.testing.assert_allclose(policy.sum(axis=1), 1)
    assert not (policy[tasks.rho] > 0)[~tasks.available & ~goal_rows(tasks)].any()


def goal_rows(tasks):
    return tasks.mdp.terminal[:, None]


@given(text=map_texts(4, 4))
@settings(deadline=None, max_examples=25)
def test_both_builders_use_the_same_actions(text):
    tasks = navigation_tasks(parse_map(text))
    votes = votes_of(tasks)
    prob, nd = (
        induce(votes, tasks.rho, tasks.possible)
        for induce in (induce_probabilistic, induce_nondeterministic)
    )

    np.testing.assert_array_equal(prob > 0, nd > 0)
    np.testing.assert_allclose(nd, uniform_policy(prob > 0))


# Ties


OPTIMAL = np.array([[True, False, True], [False, True, False], [False] * 3])


def test_shared_ties_are_equal_parts():
    assert break_ties(OPTIMAL).tolist() == [[0.5, 0, 0.5], [0, 1, 0], [0, 0, 0]]


def test_the_first_of_several_takes_it_all():
    assert break_ties(OPTIMAL, "first").tolist() == [[1, 0, 0], [0, 1, 0], [0, 0, 0]]


def test_a_random_tie_is_drawn_uniformly():
    """Three of four actions tie in 3,000 rows; chi-square with a fixed seed."""
    optimal = np.tile([True, True, False, True], (3000, 1))
    policy = break_ties(optimal, "random", rng=1)

    assert set(policy.ravel()) == {0.0, 1.0}
    assert (policy.sum(axis=1) == 1).all()
    counts = policy.sum(axis=0)
    assert counts[2] == 0
    assert chisquare(counts[[0, 1, 3]]).pvalue > 0.01


def test_random_ties_leave_single_actions_and_terminal_states_alone():
    policy = break_ties(OPTIMAL, "random", rng=0)

    assert policy[1:].tolist() == [[0, 1, 0], [0, 0, 0]]
    assert policy[0].tolist() in ([1, 0, 0], [0, 0, 1])


def test_the_same_seed_draws_the_same_ties_and_another_seed_others():
    optimal = np.ones((50, 4), bool)
    first = break_ties(optimal, "random", rng=3)

    np.testing.assert_array_equal(first, break_ties(optimal, "random", rng=3))
    np.testing.assert_array_equal(
        first, break_ties(optimal, "random", rng=np.random.default_rng(3))
    )
    assert (first != break_ties(optimal, "random", rng=4)).any()


def test_a_random_tie_needs_a_seed():
    with pytest.raises(ValueError, match='ties="random" needs rng, got None'):
        break_ties(OPTIMAL, "random")


def test_an_unknown_rule_for_ties_is_refused():
    with pytest.raises(
        ValueError, match="ties must be 'share', 'first' or 'random', got 'last'"
    ):
        break_ties(OPTIMAL, "last")


# The beta family


ROWS = np.array([[0.6, 0.3, 0.1, 0], [0.4, 0.4, 0.2, 0], [0, 1, 0, 0]])


def test_beta_0_is_the_nondeterministic_policy_and_1_the_probabilistic():
    tasks = navigation_tasks(read_map("source"))
    votes = votes_of(tasks)
    prob = induce_probabilistic(votes, tasks.rho, tasks.possible)
    nd = induce_nondeterministic(votes, tasks.rho, tasks.possible)
    assert abs(prob - nd).max() > 0.1

    np.testing.assert_allclose(beta_policy(prob, 0), nd)
    np.testing.assert_allclose(beta_policy(prob, 1), prob)


def test_beta_raises_each_row_to_a_power():
    """36 + 9 + 1 = 46; 16 + 16 + 4 = 36."""
    np.testing.assert_allclose(
        beta_policy(ROWS, 2),
        [[36 / 46, 9 / 46, 1 / 46, 0], [16 / 36, 16 / 36, 4 / 36, 0], [0, 1, 0, 0]],
    )


@pytest.mark.parametrize("beta", [1e4, 1e300, np.inf])
def test_a_large_beta_gives_all_to_the_winners_and_ties_share(beta):
    expected = [[1, 0, 0, 0], [0.5, 0.5, 0, 0], [0, 1, 0, 0]]

    np.testing.assert_allclose(beta_policy(ROWS, beta), expected, atol=1e-300)


@pytest.mark.parametrize("beta", [1e300, np.inf])
def test_votes_that_tie_but_for_rounding_share(beta):
    """Six thirds of a vote are two votes, but not in floating point."""
    thirds = np.tile([1 / 3, 0, 2 / 3], (6, 1))
    votes = np.vstack([thirds, [[0, 1, 0], [0, 1, 0]]])
    prob = induce_probabilistic(votes, np.zeros(8, int), np.ones((1, 3)))
    assert prob[0, 0] != prob[0, 1]

    np.testing.assert_allclose(beta_policy(prob[:, :2], beta), [[0.5, 0.5]])


@given(
    weight=st.lists(st.floats(0.0, 1.0), min_size=2, max_size=5),
    beta=st.floats(0.0, 1e300),
)
@settings(deadline=None, max_examples=100)
def test_any_beta_gives_a_policy_over_the_same_actions(weight, beta):
    row = np.array([[*weight, 1.0]])
    policy = beta_policy(row / row.sum(), beta)

    assert policy.sum() == pytest.approx(1)
    assert (policy[row == 0] == 0).all()
    assert policy[0, -1] == policy.max()


@pytest.mark.parametrize("beta", [-1, np.nan])
def test_a_beta_below_zero_is_refused(beta):
    with pytest.raises(ValueError, match=f"beta must be at least 0, got {beta}"):
        beta_policy(ROWS, beta)


# Fallback, masks


@BUILDERS
def test_an_abstract_state_without_vote_draws_from_the_fallback(induce):
    fallback = np.array(
        [[True, True, True], [False, True, True], [False, False, False]]
    )
    policy = induce(np.array([[1.0, 0, 0]]), np.array([0]), fallback)

    np.testing.assert_allclose(
        policy, [[1, 0, 0], [0, 0.5, 0.5], [1 / 3, 1 / 3, 1 / 3]]
    )


@BUILDERS
def test_an_abstract_state_of_goals_only_draws_from_the_fallback(induce):
    policy = induce(np.zeros((2, 2)), np.zeros(2, int), np.array([[False, True]]))

    assert policy.tolist() == [[0, 1]]


def test_a_uniform_policy_draws_from_its_mask():
    mask = [[True, False, True, True], [False, False, True, False], [False] * 4]

    np.testing.assert_allclose(
        uniform_policy(mask), [[1 / 3, 0, 1 / 3, 1 / 3], [0, 0, 1, 0], [1 / 4] * 4]
    )


def test_a_restricted_policy_keeps_its_proportions():
    policy = np.array([[0.2, 0.2, 0.6], [0.2, 0.2, 0.6], [0.0, 0.0, 1.0]])
    mask = np.array([[True, True, True], [True, False, True], [True, True, False]])

    np.testing.assert_allclose(
        restrict_policy(policy, mask), [[0.2, 0.2, 0.6], [0.25, 0, 0.75], [0.5, 0.5, 0]]
    )


# Refusals


@BUILDERS
@pytest.mark.parametrize(
    ("rho", "fallback", "said"),
    [
        (
            [0, 0, 0],
            np.ones((1, 2)),
            "rho must have shape (2,), got (3,)",
        ),
        ([0, 1], np.ones((1, 2)), "rho must lie in 0..0, got 1"),
        ([0, -1], np.ones((2, 2)), "rho must lie in 0..1, got -1"),
        ([0, 1], np.ones((2, 1)), "fallback must have shape (2, 2), got (2, 1)"),
        ([0, 1], np.ones((2, 3)), "fallback must have shape (2, 2), got (2, 3)"),
    ],
    ids=["rho too long", "rho above", "rho below", "narrow fallback", "wide fallback"],
)
def test_shapes_that_do_not_match_are_refused(induce, rho, fallback, said):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011 (compared below)
        induce(np.array([[1.0, 0], [0, 1.0]]), np.array(rho), fallback)

    assert str(refusal.value) == said


# Advice over labels, for a robot that moves by compass


def test_grounded_advice_is_as_worked_out_by_hand():
    """Row by row: shared among carriers; a label that is not there; only that one."""
    labels = np.array([[0, 0, 1, -1], [1, -1, 2, -1], [0, -1, -1, 0]])
    advice = np.array([[0.4, 0.2, 0.4], [0.5, 0.5, 0.0], [0.0, 1.0, 0.0]])

    np.testing.assert_allclose(
        ground(advice, np.arange(3), labels),
        [[1 / 3, 1 / 3, 1 / 3, 0], [1, 0, 0, 0], [0.5, 0, 0, 0.5]],
    )


def test_what_moves_say_is_as_worked_out_by_hand():
    labels = np.array([[0, 0, 1, -1]])

    np.testing.assert_allclose(
        spoken(np.array([[0.1, 0.2, 0.7, 0.0]]), labels, 3), [[0.3, 0.7, 0]]
    )


def test_advice_drives_a_compass_robot_as_it_drives_one_that_goes_by_labels():
    tasks = navigation_tasks(read_map("source"))
    compass = navigation_tasks(read_map("source"), actions="compass")
    advice = induce_probabilistic(votes_of(tasks), tasks.rho, tasks.possible)

    np.testing.assert_allclose(
        evaluate_policy(compass.mdp, ground(advice, compass.rho, compass.labels)),
        evaluate_policy(tasks.mdp, advice[tasks.rho]),
    )


def test_a_label_that_the_advice_does_not_know_is_refused():
    with pytest.raises(ValueError, match="labels must lie below 2, got 2"):
        ground(np.array([[0.5, 0.5]]), np.zeros(1, int), np.array([[0, 1, 2, -1]]))


POLICY, MASK = np.array([[0.5, 0.5], [1.0, 0.0]]), np.ones((2, 2), bool)
RHO, LABELLED = np.zeros(2, int), np.array([[0, 1, -1], [0, 0, 1]])
NAN = np.array([[np.nan, 1.0]])


@pytest.mark.parametrize(
    ("function", "arguments", "said"),
    [
        (uniform_policy, ([True, False],), "mask must have shape 2 axes"),
        (uniform_policy, ([[0.5, 1.0]],), "mask must hold bool, got float64"),
        (uniform_policy, (None,), "mask must hold numbers, got object"),
        (
            restrict_policy,
            (-POLICY, MASK),
            "policy must be finite and not negative: at state 0, action 0 it was -0.5",
        ),
        (restrict_policy, (NAN, MASK[:1]), "policy must be finite and not negative"),
        (
            restrict_policy,
            (POLICY, MASK[:1]),
            r"mask must have shape \(2, 2\), got \(1, 2\)",
        ),
        (break_ties, ([True, False],), "optimal must have shape 2 axes"),
        (break_ties, (POLICY,), "optimal must hold bool, got float64"),
        (
            beta_policy,
            ([[0.5, 0.5], [0.0, 0.0]], 2),
            "abstract_policy must leave every abstract state an action, "
            "but abstract state 1 has none",
        ),
        (beta_policy, (NAN, 2), "abstract_policy must be finite and not negative"),
        (beta_policy, (POLICY[0], 2), "abstract_policy must have shape 2 axes"),
        (beta_policy, (POLICY, "2"), "beta must hold numbers, got <U1"),
        (ground, (NAN, RHO[:1], LABELLED[:1]), "advice must be finite"),
        (ground, (POLICY, RHO, LABELLED[:1]), "rho must have shape"),
        (ground, (POLICY, RHO + 2, LABELLED), "rho must lie in 0..1, got 2"),
        (spoken, (POLICY, LABELLED, 2), r"labels must have shape \(2, 2\)"),
        (count_votes, (-POLICY, RHO, 1), "policy must be finite and not negative"),
        (count_votes, (POLICY, RHO + 0.5, 1), "rho must hold int64, got float64"),
        (count_votes, (POLICY, None, 1), "rho must hold numbers, got object"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name(function, arguments, said):
    with pytest.raises(ValueError, match=f"^{said}"):
        function(*arguments)
