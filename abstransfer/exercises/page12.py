"""Exercises of page 12: your turn."""

import numpy as np

from ._model import Open, Wrong, function, stub


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
        "ex-12-3",
        "Write `toward_goal`, which makes advice. `possible` (Z, A) says "
        "which actions an abstract state allows, `heads` (A,) which of them lead "
        "toward the goal. Every row draws uniformly among the possible actions toward "
        "the goal; where there is none, among all possible ones.",
        toward_goal,
        cases=_cases,
        stub=stub(
            """\
def toward_goal(possible, heads):
    wanted = possible & heads
    chosen = {chosen}
    return {advice}
""",
            chosen=(
                "np.where(wanted.any(axis=1, keepdims=True), wanted, possible)",
                {
                    "no advice where no way leads to the goal": "wanted",
                    "ways that are not there": "np.tile(heads, (len(possible), 1))",
                    "all that is possible": "possible",
                    "anything at all where no way leads to the goal": (
                        "np.where(wanted.any(axis=1, keepdims=True), wanted, True)"
                    ),
                },
            ),
            advice=(
                "chosen / np.maximum(chosen.sum(axis=1, keepdims=True), 1)",
                {"rows that do not sum to 1": "1.0 * chosen"},
            ),
        ),
        same=(toward_goal_row_by_row,),
        hints=(
            "Advice has a row of probabilities for each abstract state.",
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

OPEN = [
    Open(
        "ex-12-1",
        hints=(
            "What may stand between a room and a corridor?",
            "`at.parse_map` stops at the first mistake. Mend it and run again.",
            "How does a robot get into the room on the right?",
        ),
        good="a door into each room, found one message at a time",
    ),
    Open(
        "ex-12-2",
        hints=(
            "Copy the loop above; the list of features is `at.FEATURES`.",
            "An interval that lies on one side of 0 tells you the sign; two intervals "
            "that overlap tell you little.",
        ),
        good="without `near_goal` +7.3 %, without either of the others still below 0",
    ),
    Open(
        "ex-12-4",
        hints=(
            "What cuts an endless wait short? What else decides how much of a run the "
            "advice takes?",
            "Try another `tau`, or another door.",
            "Which wall makes the robot wait?",
        ),
        good="one change with its reason, for instance two more doors: +8.6 %",
    ),
    Open(
        "ex-12-5",
        hints=(
            "`at.project.verify(text)`; a text in quotes three times may have many "
            "lines.",
            "What does the card not say, if your friend wrote the advice alone? Ask "
            "for it.",
        ),
        good="the card is confirmed; after the change, the first line that is not so",
    ),
]
