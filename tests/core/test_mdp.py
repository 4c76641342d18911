"""Markov decision processes: what is accepted, and what is refused, and how."""

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import mdps, random_policy

from abstransfer import MDP
from abstransfer.mdp import check_policy

RIGHT, STAY = 0, 1


def arguments(**changed):
    """Return the arguments of a corridor of three cells, walked right, or stayed in."""
    given_ = {
        "next_state": [[[1, 0], [0, 0]], [[2, 1], [1, 1]], [[2, 2], [2, 2]]],
        "prob": np.tile([0.8, 0.2], (3, 2, 1)),
        "reward": [-1, -1, 0],
        "terminal": [False, False, True],
        "gamma": 0.5,
    }
    return given_ | changed


def spoilt(name, place, value):
    """Return the arguments with one entry of an array changed."""
    array = np.array(arguments()[name], dtype=float)
    array[place] = value
    return arguments(**{name: array})


def test_the_sizes_are_those_of_the_arrays():
    mdp = MDP(**arguments())

    assert (mdp.n_states, mdp.n_actions) == (3, 2)
    assert mdp.next_state.shape == mdp.prob.shape == (3, 2, 2)


def test_all_actions_are_allowed_by_default():
    assert MDP(**arguments()).allowed.tolist() == [[True, True]] * 3


@pytest.mark.parametrize(
    "name", ["next_state", "prob", "reward", "terminal", "allowed"]
)
def test_arrays_are_read_only_copies(name):
    mine = {
        key: np.array(value)
        for key, value in arguments(allowed=np.ones((3, 2), bool)).items()
    }
    mdp = MDP(**mine)

    with pytest.raises(ValueError, match="read-only"):
        getattr(mdp, name)[:] = 0
    assert mine[name].flags.writeable
    before = getattr(mdp, name).copy()
    mine[name][:] = 0
    assert before.any()
    np.testing.assert_array_equal(getattr(mdp, name), before)


def test_transitions_are_the_outcomes_that_can_happen():
    """Of the two outcomes of each action, those of state 1 are certain here."""
    prob = np.array(arguments()["prob"])
    prob[1] = [1.0, 0.0]
    transitions = MDP(**arguments(prob=prob)).transitions

    assert [tuple(row) for row in np.transpose(transitions).tolist()] == [
        (0, 0, 1, 0.8),
        (0, 0, 0, 0.2),
        (0, 1, 0, 0.8),
        (0, 1, 0, 0.2),
        (1, 0, 2, 1.0),
        (1, 1, 1, 1.0),
        (2, 0, 2, 0.8),
        (2, 0, 2, 0.2),
        (2, 1, 2, 0.8),
        (2, 1, 2, 0.2),
    ]
    assert not any(array.flags.writeable for array in transitions)


REFUSED = {
    "too few axes": (
        arguments(next_state=[[1, 0], [2, 1]]),
        "next_state must have shape 3 axes, none of length 0, got (2, 2)",
    ),
    "no state": (
        arguments(next_state=np.zeros((0, 2, 2), int)),
        "next_state must have shape 3 axes, none of length 0, got (0, 2, 2)",
    ),
    "other shape": (
        arguments(prob=np.ones((3, 2, 1))),
        "prob must have shape (3, 2, 2), got (3, 2, 1)",
    ),
    "reward by action": (
        arguments(reward=np.zeros((3, 2))),
        "reward must have shape (3,), got (3, 2)",
    ),
    "terminal too short": (
        arguments(terminal=[False, True]),
        "terminal must have shape (3,), got (2,)",
    ),
    "allowed by state": (
        arguments(allowed=[True, True, True]),
        "allowed must have shape (3, 2), got (3,)",
    ),
    "half a state": (
        spoilt("next_state", (0, 0, 0), 0.5),
        "next_state must hold int32, got float64",
    ),
    "half a truth": (
        arguments(terminal=[0.0, 0.5, 1.0]),
        "terminal must hold bool, got float64",
    ),
    "state below": (
        spoilt("next_state", (1, 0, 1), -1),
        "next_state must lie in 0..2: at state 1, action 0, outcome 1 it was -1",
    ),
    "state above": (
        spoilt("next_state", (0, 1, 0), 3),
        "next_state must lie in 0..2: at state 0, action 1, outcome 0 it was 3",
    ),
    "negative": (
        spoilt("prob", (2, 1), [1.5, -0.5]),
        "prob must not be negative or nan: at state 2, action 1, outcome 1 it was -0.5",
    ),
    "nan": (
        spoilt("prob", (0, 1, 0), np.nan),
        "prob must not be negative or nan: at state 0, action 1, outcome 0 it was nan",
    ),
    "sum": (
        spoilt("prob", (1, 0), 0.25),
        "prob must sum to 1 in each row: at state 1, action 0 it was 0.5",
    ),
    "endless reward": (
        spoilt("reward", 1, -np.inf),
        "reward must lie in -1e+290..1e+290: at state 1 it was -inf",
    ),
    "no action left": (
        arguments(allowed=[[True, False], [False, False], [False, False]]),
        "allowed must leave every state an action: at state 1 it was False",
    ),
    "gamma 1": (arguments(gamma=1), "gamma must satisfy 0 <= gamma < 1, got 1"),
    "gamma below": (
        arguments(gamma=-0.1),
        "gamma must satisfy 0 <= gamma < 1, got -0.1",
    ),
    "gamma nan": (
        arguments(gamma=np.nan),
        "gamma must satisfy 0 <= gamma < 1, got nan",
    ),
}


@pytest.mark.parametrize(("given_", "said"), REFUSED.values(), ids=REFUSED)
def test_what_is_no_mdp_is_refused_with_name_and_place(given_, said):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011 (compared below)
        MDP(**given_)

    assert str(refusal.value) == said


def test_a_terminal_state_needs_no_action():
    mdp = MDP(**arguments(allowed=[[True, False], [True, False], [False, False]]))

    assert mdp.allowed.sum() == 2


def test_a_policy_is_returned_as_floats():
    policy = check_policy([[1, 0], [0, 1], [1, 0]], MDP(**arguments()))

    assert policy.dtype == float
    assert policy.tolist() == [[1, 0], [0, 1], [1, 0]]


def test_rows_of_terminal_states_are_not_read():
    mdp = MDP(**arguments(allowed=[[True, False], [True, False], [False, False]]))

    check_policy([[1, 0], [1, 0], [np.nan, 7]], mdp)


@pytest.mark.parametrize(
    ("policy", "said"),
    [
        ([[1, 0], [0, 1]], "guide must have shape (3, 2), got (2, 2)"),
        (
            [[1, 0], [0.5, 0.25], [1, 0]],
            "guide must sum to 1 in each row: at state 1 it was 0.75",
        ),
        (
            [[1.5, -0.5], [1, 0], [1, 0]],
            "guide must not be negative or nan: at state 0, action 1 it was -0.5",
        ),
        (
            [[1, 0], [np.nan, 1], [1, 0]],
            "guide must not be negative or nan: at state 1, action 0 it was nan",
        ),
        (
            [[1, 0], [0.75, 0.25], [1, 0]],
            "guide must use allowed actions only: at state 1, action 1 it was 0.25",
        ),
    ],
    ids=["shape", "sum", "negative", "nan", "not allowed"],
)
def test_what_is_no_policy_is_refused_with_name_and_place(policy, said):
    mdp = MDP(**arguments(allowed=[[True, True], [True, False], [True, True]]))
    with pytest.raises(ValueError) as refusal:  # noqa: PT011 (compared below)
        check_policy(policy, mdp, "guide")

    assert str(refusal.value) == said


@given(mdps(masks=True))
@settings(deadline=None, max_examples=40)
def test_a_policy_over_allowed_actions_is_accepted(mdp):
    policy = random_policy(mdp)

    np.testing.assert_array_equal(check_policy(policy, mdp), policy)
