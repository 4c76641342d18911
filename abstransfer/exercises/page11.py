"""Exercises of page 11: your turn."""

import numpy as np

from ._model import Wrong, function


def toward_goal(possible, heads):
    """Return advice (Z, A) that goes toward the goal wherever it sees a way."""
    wanted = possible & heads
    wanted = np.where(wanted.any(axis=1, keepdims=True), wanted, possible)
    return wanted / wanted.sum(axis=1, keepdims=True)


def toward_goal_row_by_row(possible, heads):
    rows = []
    for row in np.asarray(possible):
        ahead = [bool(p and h) for p, h in zip(row, heads, strict=True)]
        chosen = ahead if any(ahead) else list(row)
        rows.append([int(x) / sum(map(int, chosen)) for x in chosen])
    return np.array(rows)


def _share(weight):
    total = weight.sum(axis=1, keepdims=True)
    return weight / np.where(total > 0, total, 1)


def _gives_up(possible, heads):
    return _share((possible & heads).astype(float))


def _goes_where_nothing_is(possible, heads):
    return _share(np.tile(heads, (len(possible), 1)).astype(float))


def _forgets_the_goal(possible, heads):
    return _share(possible.astype(float))


def _not_a_policy(possible, heads):
    wanted = possible & heads
    return np.where(wanted.any(axis=1, keepdims=True), wanted, possible).astype(float)


def _anything_instead(possible, heads):
    wanted = possible & heads
    return _share(np.where(wanted.any(axis=1, keepdims=True), wanted, True) * 1.0)


def _cases(rng):
    for n_states, n_actions in ((2, 4), (2, 4), (6, 8), (6, 8), (5, 6), (5, 6)):
        heads = np.zeros(n_actions, bool)
        heads[rng.permutation(n_actions)[: n_actions // 2]] = True
        possible = rng.random((n_states, n_actions)) < 0.4
        possible[0], possible[0, heads] = True, False  # nothing leads to the goal
        possible[0, rng.choice(np.flatnonzero(~heads))] = False
        possible[1:, rng.choice(np.flatnonzero(heads))] = True
        yield possible, heads


EXERCISES = [
    function(
        "ex-11-3",
        "Write `toward_goal`, which makes advice. `possible` (Z, A) says "
        "which actions an abstract state allows, `heads` (A,) which of them lead "
        "toward the goal. Every row draws uniformly among the possible actions toward "
        "the goal; where there is none, among all possible ones.",
        toward_goal,
        cases=_cases,
        same=(toward_goal_row_by_row,),
        hints=(
            "Advice is an array of probabilities, with a row for each view.",
            "`wanted = possible & heads` is what you want, in rows that are not empty.",
            "`wanted = np.where(wanted.any(axis=1, keepdims=True), wanted, possible)`; "
            "then divide each row by its sum.",
        ),
        wrong=[
            Wrong(
                "no advice where no way leads to the goal",
                _gives_up,
                "Some rows sum to 0. A robot that sees no way to the goal must still "
                "do something.",
            ),
            Wrong(
                "ways that are not there",
                _goes_where_nothing_is,
                "You send the robot to things it does not see; then it stands still.",
            ),
            Wrong(
                "all that is possible",
                _forgets_the_goal,
                "This is the eager robot: it does not care where the goal is.",
            ),
            Wrong(
                "rows that do not sum to 1",
                _not_a_policy,
                "Divide each row by its sum: these are probabilities.",
            ),
            Wrong(
                "anything at all where no way leads to the goal",
                _anything_instead,
                "In rows without a way to the goal you allow actions that are not "
                "possible.",
            ),
        ],
    ),
]
