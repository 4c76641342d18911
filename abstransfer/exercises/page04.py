"""Exercises of page 4: forgetting on purpose."""

import numpy as np

from ._model import Open, Wrong, function, stub, value


def abstract_state(features):
    """Return the number whose bit f is feature f, counted from bit 0."""
    return sum(int(x) << f for f, x in enumerate(features))


def abstract_state_by_dot(features):
    return np.dot(features, 2.0 ** np.arange(len(features)))


def _weighted(weight):
    return lambda features: sum(
        x * weight(f, len(features)) for f, x in enumerate(features)
    )


def _views(rng):
    yield (np.array([1, 0, 0]),)
    yield (np.array([0, 1, 1]),)
    yield (np.zeros(11, int),)
    for _ in range(8):
        yield (rng.integers(0, 2, 11),)


def near_goal(cell, goal, width, near):
    """Return whether a cell is within a Manhattan distance of the goal."""
    rows = abs(cell // width - goal // width)
    columns = abs(cell % width - goal % width)
    return rows + columns <= near


def near_goal_by_divmod(cell, goal, width, near):
    (a, b), (c, d) = divmod(cell, width), divmod(goal, width)
    return int(np.abs([a - c, b - d]).sum() < near + 1)


def _apart(cell, goal, width):
    return abs(cell // width - goal // width), abs(cell % width - goal % width)


def _pairs(rng):
    for width, near in ((15, 5), (15, 8), (30, 5), (30, 3)):
        for _ in range(30):
            cell, goal = (int(i) for i in rng.integers(0, 9 * width, 2))
            yield cell, goal, width, near
    yield 0, 5, 15, 5
    yield 0, 15 * 3 + 3, 15, 5


EXERCISES = [
    function(
        "ex-4-1",
        "Write `abstract_state`, which turns a list of features, each 0 or 1, into one "
        "number: feature 0 is worth 1, feature 1 is worth 2, feature 2 is worth 4, ...",
        abstract_state,
        cases=_views,
        stub=stub(
            """\
def abstract_state(features):
    return sum({worth} for f, x in enumerate(features))
""",
            worth=(
                "int(x) << f",
                {
                    "counting the features": "int(x)",
                    "read from the other end": "int(x) << len(features) - 1 - f",
                    "decimal digits": "int(x) * 10**f",
                    "weights from 2": "int(x) << f + 1",
                    "adding the places": "int(x) * f",
                },
            ),
        ),
        same=(abstract_state_by_dot,),
        hints=(
            "Different lists must get different numbers.",
            "Feature number f, counted from 0, is worth 2 to the power f; add up those "
            "that hold.",
            "`sum(x * 2**f for f, x in enumerate(features))`, or shifts by f bits.",
        ),
        wrong=[
            Wrong(
                "counting the features",
                _weighted(lambda f, n: 1),
                "How many hold is not enough: [1, 0] and [0, 1] must differ.",
            ),
            Wrong(
                "read from the other end",
                _weighted(lambda f, n: 2 ** (n - 1 - f)),
                "You give the *last* feature the weight 1. Here the first one has it.",
            ),
            Wrong(
                "decimal digits",
                _weighted(lambda f, n: 10**f),
                "Each feature has two values, so each place is worth twice the one "
                "before.",
            ),
            Wrong(
                "weights from 2",
                _weighted(lambda f, n: 2 ** (f + 1)),
                "Feature 0 is worth 1, that is 2 to the power 0.",
            ),
            Wrong(
                "adding the places",
                _weighted(lambda f, n: f),
                "Then feature 0 never counts, and 1 and 2 together look like 3.",
            ),
        ],
    ),
    function(
        "ex-4-2",
        "Write `near_goal`: is the Manhattan distance of the two cells at most `near`? "
        "Cells are numbered row by row, `width` in a row. Walls do not count.",
        near_goal,
        cases=_pairs,
        stub=stub(
            """\
def near_goal(cell, goal, width, near):
    rows = abs(cell // width - goal // width)
    columns = abs(cell % width - goal % width)
    return {is_near}
""",
            is_near=(
                "rows + columns <= near",
                {
                    "as the crow flies": "np.hypot(rows, columns) <= near",
                    "at least instead of at most": "rows + columns >= near",
                    "the larger of the two distances": "max(rows, columns) <= near",
                    "less than": "rows + columns < near",
                    "the distance itself": "rows + columns",
                    "numbers of cells subtracted": "abs(cell - goal) <= near",
                },
            ),
        ),
        same=(near_goal_by_divmod,),
        hints=(
            "First the row and the column of each cell, from its number.",
            "The row is `cell // width`, the column `cell % width`.",
            "Rows apart plus columns apart, both without sign, is at most `near`.",
        ),
        wrong=[
            Wrong(
                "as the crow flies",
                lambda cell, goal, width, near: (
                    np.hypot(*_apart(cell, goal, width)) <= near
                ),
                "Manhattan distance goes along rows and columns: add the two, no "
                "roots.",
            ),
            Wrong(
                "at least instead of at most",
                lambda cell, goal, width, near: sum(_apart(cell, goal, width)) >= near,
                "So the paper's text says, and so a cell far away would be 'near'. "
                "It must mean at most.",
            ),
            Wrong(
                "the larger of the two distances",
                lambda cell, goal, width, near: max(_apart(cell, goal, width)) <= near,
                "A robot makes no diagonal moves: rows and columns add up.",
            ),
            Wrong(
                "less than",
                lambda cell, goal, width, near: sum(_apart(cell, goal, width)) < near,
                "A distance of exactly `near` still is near.",
            ),
            Wrong(
                "the distance itself",
                lambda cell, goal, width, near: sum(_apart(cell, goal, width)),
                "You return how far it is; asked is whether that is at most `near`.",
            ),
            Wrong(
                "numbers of cells subtracted",
                lambda cell, goal, width, near: abs(cell - goal) <= near,
                "The cell below differs by a whole `width`, and is one step away. "
                "The last cell of a row and the first of the next are far apart.",
            ),
        ],
    ),
    value(
        "ex-4-3",
        "From a cell one to four ways are open, and each shows one of eight sights; "
        "two may show the same. A goal is near, almost near or neither, and a cell is "
        "in a room or not. How many abstract states can there be?",
        972,
        also=(162,),
        hints=(
            "Count the sets of sights first: one, two, three or four of eight.",
            "There are 8 sets of one, 28 of two, 56 of three and 70 of four.",
            "Multiply by the three distances, and by in a room or not.",
        ),
        wrong=[
            Wrong(
                "all that can be written",
                2048,
                "11 answers can be combined in 2 to the power 11 ways. Which of them "
                "can no cell give?",
            ),
            Wrong(
                "near and almost near at once",
                8 * 162,
                "You let the three last answers be anything. But almost near means: "
                "not near any more.",
            ),
            Wrong(
                "more ways than four",
                6 * 255,
                "A cell has four sides, so no more than four sights at once.",
            ),
            Wrong(
                "no way open",
                6 * 163,
                "You count the empty set, too: a cell from which no way is open.",
            ),
            Wrong(
                "the sights alone",
                162,
                "That many sets of sights there are. Distance and room come on top.",
            ),
            Wrong(
                "those that occur",
                88,
                "So many occur in the small building. Asked is how many there can be.",
            ),
        ],
    ),
    value(
        "ex-4-3b",
        "From a cell one to four ways are open, and each shows one of eight sights; "
        "two may show the same. How many different sets of sights can there be?",
        162,
        hints=(
            "Count by how many different sights there are: one, two, three or four.",
            "In how many ways can two of eight be chosen? Their order does not count.",
            "`import math`, then `sum(math.comb(8, n) for n in (1, 2, 3, 4))`.",
        ),
        wrong=[
            Wrong(
                "more ways than four",
                255,
                "A cell has four sides, so no more than four sights at once.",
            ),
            Wrong(
                "no way open",
                163,
                "You count the empty set, too: a cell from which no way is open.",
            ),
            Wrong(
                "only four different sights",
                70,
                "Those are the sets of four. Fewer ways may be open, and two may show "
                "the same.",
            ),
            Wrong(
                "in an order",
                8 + 8 * 7 + 8 * 7 * 6 + 8 * 7 * 6 * 5,
                "A set has no order: divide by the number of orders.",
            ),
            Wrong(
                "a sight for each way",
                8**4,
                "That counts which way shows which sight. Asked are sets of sights.",
            ),
            Wrong(
                "distance and room as well",
                972,
                "That many abstract states there are. Asked are the sights alone.",
            ),
        ],
    ),
]

OPEN = [
    Open(
        "ex-4-4",
        hints=(
            "`best`, made for the picture with the arrows, says what is best in each "
            "state; `at.count_votes(best, source.rho, source.n_abstract)` counts, for "
            "each abstract state, how often each action is.",
            "Subtract the largest count of a row from its sum.",
        ),
        good="three views of empty space both ways; the robot would have to know where "
        "the door is",
    ),
    Open(
        "ex-4-5",
        hints=(
            "`compass` and `judge` stand in the first cell of this page.",
            'What would "go north" mean to a robot in another room, with the same '
            "view?",
            "The goal lies south, north or level, and east, west or level: nine sides. "
            "Nine times `rho` plus the side is a new abstract state.",
        ),
        good="right in 51 % of the states; the mended robot drives well at home (Grad "
        "-21.7) and badly in the target (-89.9)",
    ),
]
