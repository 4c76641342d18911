"""Exercises of page 2: solving what is known."""

import numpy as np

from ._model import Open, Wrong, function, stub, value
from ._read import numbers_of_actions


def backup(reward, gamma, values, probabilities):
    """Return the value of a state from those of its successors, both (A, K)."""
    expected = (probabilities * values).sum(axis=1)
    return reward + gamma * expected.max()


def backup_by_loops(reward, gamma, values, probabilities):
    best = -np.inf
    for v, p in zip(values, probabilities, strict=True):
        best = max(best, sum(a * b for a, b in zip(v, p, strict=True)))
    return gamma * best + reward


def _expected(v, p):
    return (v * p).sum(axis=1)


def _states(rng):
    for n_actions, n_outcomes in ((2, 1), (1, 2), (2, 2), (3, 2), (4, 3)):
        for reward, gamma in ((-1, 0.9), (-2, 0.99), (0.5, 0.95)):
            p = rng.random((n_actions, n_outcomes))
            v = rng.uniform(-20, 5, (n_actions, n_outcomes)).round(1)
            yield reward, gamma, v, p / p.sum(axis=1, keepdims=True)
    yield -1, 0.99, np.array([[-5.0, -6], [-6, -6]]), np.array([[0.9, 0.1], [0, 1]])


def greedy_set(q_row, tolerance):
    """Return the actions whose value is within `tolerance` of the best."""
    return np.flatnonzero(q_row >= np.max(q_row) - tolerance)


def greedy_set_by_loop(q_row, tolerance):
    best = max(q_row)
    return {a for a, q in enumerate(q_row) if best - q <= tolerance}


def _values_instead(q_row, tolerance):
    return q_row[greedy_set(q_row, tolerance)]


def _rows(rng):
    tiny = 1e-12
    yield np.array([-1.0, -2, -1, -3]), 0
    yield np.array([-3.0, -2.0, -2.0 - tiny, -4.0]), 1e-9
    yield np.array([1.0, 2.0 - tiny, 0.0, 2.0]), 1e-9
    yield np.array([2.0, 2.0 - tiny, 0.0, 2.0]), 0
    yield np.array([-2.5, -3.0, -2.4, -2.0]), 0.45
    yield np.array([-2.5, -3.0, -2.75, -2.0]), 0.5  # one exactly at the edge
    yield np.array([-1.0, -1.0, -1.0]), 1e-9
    for tolerance in (0, 1e-9, 1e-9, 1) * 3:
        yield rng.integers(-4, 0, 6) * 1.0 + rng.choice([0, tiny], 6), tolerance


EXERCISES = [
    function(
        "ex-2-1",
        "Write `backup`, one Bellman backup of one state. `values` and "
        "`probabilities` have a row for each action and a column for each outcome. The "
        "reward is that of the state itself.",
        backup,
        cases=_states,
        stub=stub(
            """\
def backup(reward, gamma, values, probabilities):
    expected = {expected}
    return {value}
""",
            expected=(
                "[np.dot(v, p) for v, p in zip(values, probabilities, strict=True)]",
                {
                    "the best outcome instead of the expected one": (
                        "[max(v) for v in values]"
                    ),
                    "all outcomes alike": "[np.mean(v) for v in values]",
                },
            ),
            value=(
                "reward + gamma * max(expected)",
                {
                    "no discount": "reward + max(expected)",
                    "the reward is discounted too": "gamma * (reward + max(expected))",
                    "the mean over actions instead of the best": (
                        "reward + gamma * np.mean(expected)"
                    ),
                    "the worst action": "reward + gamma * min(expected)",
                    "the largest is sought from 0 on": (
                        "reward + gamma * max(0, *expected)"
                    ),
                },
            ),
        ),
        same=(backup_by_loops,),
        hints=(
            "First one number for each action, then the best of them.",
            "An action is worth the sum of probability times value over its outcomes. "
            "The best is discounted, and the reward here comes on top.",
            "`best = (probabilities * values).sum(axis=1).max()`; then it is `reward + "
            "gamma * best`.",
        ),
        wrong=[
            Wrong(
                "no discount",
                lambda reward, gamma, v, p: reward + _expected(v, p).max(),
                "What comes one step later counts `gamma` times as much.",
            ),
            Wrong(
                "the reward is discounted too",
                lambda reward, gamma, v, p: gamma * (reward + _expected(v, p).max()),
                "The reward of this state counts in full; only what follows is "
                "discounted.",
            ),
            Wrong(
                "the best outcome instead of the expected one",
                lambda reward, gamma, v, p: reward + gamma * v.max(),
                "The robot chooses the action, but chance chooses the outcome.",
            ),
            Wrong(
                "the mean over actions instead of the best",
                lambda reward, gamma, v, p: reward + gamma * _expected(v, p).mean(),
                "That is the value of drawing at random. The best driver chooses.",
            ),
            Wrong(
                "the worst action",
                lambda reward, gamma, v, p: reward + gamma * _expected(v, p).min(),
                "Values are rewards, not costs: larger is better, also below 0.",
            ),
            Wrong(
                "all outcomes alike",
                lambda reward, gamma, v, p: reward + gamma * v.mean(axis=1).max(),
                "Outcomes are not equally likely: weigh them with `probabilities`.",
            ),
            Wrong(
                "the largest is sought from 0 on",
                lambda reward, gamma, v, p: (
                    reward + gamma * max(0, _expected(v, p).max())
                ),
                "Where all values lie below 0, a 0 to begin with is never beaten. "
                "Begin with the first action, or with -inf.",
            ),
        ],
    ),
    function(
        "ex-2-2",
        "Write `greedy_set`, which returns the numbers of all actions whose value is "
        "within `tolerance` of the best.",
        greedy_set,
        cases=_rows,
        stub=stub(
            """\
def greedy_set(q_row, tolerance):
    largest = max(q_row)
    return [{kept} for a, q in enumerate(q_row) if {is_best}]
""",
            kept=("a", {"values instead of actions": "q"}),
            is_best=(
                "q >= largest - tolerance",
                {
                    "the first best only": "a == np.argmax(q_row)",
                    "equal to the last digit": "q == largest",
                    "less than the tolerance": "largest - q < tolerance",
                    "the worst instead of the best": "q <= min(q_row) + tolerance",
                },
            ),
        ),
        same=(
            greedy_set_by_loop,
            lambda q_row, tolerance: np.abs(q_row - q_row.max()) <= tolerance,
        ),
        read=numbers_of_actions,
        hints=(
            "What is the largest entry? `np.argmax` gives one action; you want every "
            "one.",
            "Compare with the largest entry minus the tolerance: numbers that should "
            "be equal may differ in the last digit.",
            "`np.flatnonzero(q_row >= np.max(q_row) - tolerance)` are the places where "
            "that is true.",
        ),
        wrong=[
            Wrong(
                "the first best only",
                lambda q_row, tolerance: [np.argmax(q_row)],
                "`argmax` returns one action, the first. Where several tie, return "
                "all.",
            ),
            Wrong(
                "equal to the last digit",
                lambda q_row, tolerance: np.flatnonzero(q_row == np.max(q_row)),
                "Two values that should tie can differ by rounding: use the tolerance.",
            ),
            Wrong(
                "the worst instead of the best",
                lambda q_row, tolerance: np.flatnonzero(
                    q_row <= np.min(q_row) + tolerance
                ),
                "Values are rewards, also below 0: the best is the largest.",
            ),
            Wrong(
                "less than the tolerance",
                lambda q_row, tolerance: np.flatnonzero(
                    np.max(q_row) - q_row < tolerance
                ),
                "A value that lies exactly `tolerance` below the best is within it. "
                "With a tolerance of 0 you return nothing at all.",
            ),
            Wrong(
                "values instead of actions",
                _values_instead,
                "You return the values of the best actions; asked are their numbers.",
            ),
        ],
    ),
    value(
        "ex-2-3",
        "Values start at the rewards: -1, and 0 on the goal; the discount is 0.99. "
        "What "
        "is the value, after 7 sweeps, of a cell that is more than 7 steps from the "
        "goal?",
        -(1 - 0.99**8) / (1 - 0.99),
        tolerance=1e-3,
        hints=(
            "A cell looks at its neighbors only, so no news of the goal has come that "
            "far. What does such a cell believe?",
            "That it will pay 1 in each of the sweeps so far: each adds one discounted "
            "coin to the one that was there at the start.",
            "-(1 + 0.99 + ... + 0.99^7): how many terms are that?",
        ),
        wrong=[
            Wrong(
                "one coin too few",
                -(1 - 0.99**7) / (1 - 0.99),
                "Before the first sweep the value is -1 already: eight coins, not "
                "seven.",
            ),
            Wrong(
                "one coin too many",
                -(1 - 0.99**9) / (1 - 0.99),
                "One coin at the start and one per sweep: eight, not nine.",
            ),
            Wrong(
                "no discount", -8, "Eight coins, but each later one counts 0.99 times."
            ),
            Wrong(
                "the end, not seven sweeps",
                -100,
                "That is what a cell believes that never hears of the goal.",
            ),
            Wrong(
                "the sign",
                (1 - 0.99**8) / (1 - 0.99),
                "The size is right. But the robot pays: the value is below 0.",
            ),
        ],
    ),
]

OPEN = [
    Open(
        "ex-2-4",
        hints=(
            "What does a tie say about the two states that the two actions lead to?",
            '`at.break_ties(optimal, "first")` is a policy, but for the rows of the '
            "goals: no action is best there, so give each 1/8. "
            "`at.evaluate_policy(office.mdp, policy)` judges it.",
        ),
        good="in the 64 states with a tie; all drive at -14.00, because a tie says "
        "that what follows is worth the same",
    ),
]
