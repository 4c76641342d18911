"""Exercises of page 1: a building as a decision problem."""

import numpy as np

from ._model import Open, Wrong, function, stub, value
from ._read import size

GAMMA = 0.99


def step(neighbors, goal, success, cell, direction, luck):
    """Return the next cell and the reward, as the paper pays it."""
    there = neighbors[cell, direction]
    if luck < success and there >= 0:
        cell = there
    return cell, (0 if cell == goal else -1)


def step_in_other_words(neighbors, goal, success, cell, direction, luck):
    moved = luck < success and neighbors[cell][direction] != -1
    now = neighbors[cell][direction] if moved else cell
    return [now, float(now == goal) - 1]


def _through_walls(neighbors, goal, success, cell, direction, luck):
    now = neighbors[cell, direction] if luck < success else cell
    return now, (0 if now == goal else -1)


def _never_fails(neighbors, goal, success, cell, direction, luck):
    return step(neighbors, goal, 2, cell, direction, luck)


def _fails_when_lucky(neighbors, goal, success, cell, direction, luck):
    return step(neighbors, goal, success, cell, direction, -1 if luck >= success else 2)


def _pays_where_it_was(neighbors, goal, success, cell, direction, luck):
    now, _ = step(neighbors, goal, success, cell, direction, luck)
    return now, (0 if cell == goal else -1)


def _paid_on_the_goal(neighbors, goal, success, cell, direction, luck):
    now, _ = step(neighbors, goal, success, cell, direction, luck)
    return now, (1 if now == goal else 0)


def _reward_first(neighbors, goal, success, cell, direction, luck):
    return step(neighbors, goal, success, cell, direction, luck)[::-1]


def _fails_at_equal(neighbors, goal, success, cell, direction, luck):
    return step(neighbors, goal, success, cell, direction, luck - 1e-9)


def _four_cells(rng):
    """Yield each step from cells of a corridor and of a square, with three lucks."""
    corridor = [[-1, 1, -1, -1], [-1, 2, -1, 0], [-1, 3, -1, 1], [-1, -1, -1, 2]]
    square = [[-1, 1, 2, -1], [-1, -1, 3, 0], [0, 3, -1, -1], [1, -1, -1, 2]]
    for neighbors, goal in ((corridor, 3), (square, 0), (square, 2)):
        for cell in set(range(4)) - {goal}:
            for direction in range(4):
                for i in range(3):
                    success = (0.5, 0.9)[(cell + i) % 2]
                    low, high = rng.uniform(0, success), rng.uniform(success, 1)
                    luck = (round(low, 2), round(high, 2), success)[i]
                    yield np.array(neighbors), goal, success, cell, direction, luck


EXERCISES = [
    value(
        "ex-1-1",
        "A robot stands 20 steps from the goal and no move fails. It pays 1 where it "
        "stands now and in each cell on its way, and nothing on the goal; each step "
        "later counts 0.99 times as much. What is the return of its way?",
        -(1 - GAMMA**20) / (1 - GAMMA),
        hints=(
            "Write down the first three payments, and what each counts.",
            "The payments are -1, -0.99, -0.99^2, ...: a geometric series of 20 terms.",
            "(1 - g)(1 + g + ... + g^(n-1)) is short: it is 1 - g^n. Divide by 1 - g, "
            "and mind the sign.",
        ),
        wrong=[
            Wrong("no discount", -20, "Later steps count less: multiply each by 0.99."),
            Wrong(
                "the sign",
                (1 - GAMMA**20) / (1 - GAMMA),
                "The size is right. But the robot pays, so the return is below 0.",
            ),
            Wrong(
                "one payment too many",
                -(1 - GAMMA**21) / (1 - GAMMA),
                "On the goal, 20 steps from here, nothing is paid. "
                "How many cells before it cost something?",
            ),
            Wrong(
                "one payment too few",
                -(1 - GAMMA**19) / (1 - GAMMA),
                "The cell where the robot stands now costs something too.",
            ),
            Wrong(
                "the first payment is discounted already",
                -GAMMA * (1 - GAMMA**20) / (1 - GAMMA),
                "The payment of this moment counts in full; the next one counts 0.99.",
            ),
        ],
        tolerance=1e-3,  # two decimals are enough
    ),
    value(
        "ex-1-2",
        "With discount 0.99 and a cost of 1 per step, what does a robot pay that never "
        "arrives?",
        100,
        hints=(
            "What is the most that any single payment can be? The robot pays it for "
            "ever; each step later counts less.",
            "Put it into every term of the return, and call the sum x. Without its "
            "first term it is 0.99 times itself.",
            "From x = 1 + 0.99 x follows x = `1 / (1 - 0.99)`.",
        ),
        wrong=[
            Wrong(
                "without the first payment",
                99,
                "The payment of this moment counts too, and in full.",
            ),
            Wrong(
                "a sum without end is infinite",
                np.inf,
                "The terms shrink by the same factor; such a sum stays finite.",
            ),
            Wrong(
                "one over gamma", 1 / 0.99, "Divide by what is lost per step: 1 - 0.99."
            ),
            Wrong(
                "the discount of learning",
                10,
                "That is the sum for a discount of 0.9, used for learning. Here it is "
                "0.99.",
            ),
        ],
        read=size,
    ),
    function(
        "ex-1-3",
        "Write `step`, which returns the next cell and the reward. `neighbors[cell, "
        "direction]` is the cell behind that edge, or -1 behind a wall. The move "
        "succeeds if `luck < success`, else the robot stays. Arriving at the goal pays "
        "0, any other step -1; staying counts as arriving where it was.",
        step,
        cases=_four_cells,
        stub=stub(
            """\
def step(neighbors, goal, success, cell, direction, luck):
    there = neighbors[cell, direction]
    now = there if {moves} else cell
    return {told}
""",
            moves=(
                "luck < success and there >= 0",
                {
                    "walking through walls": "luck < success",
                    "no move fails": "there >= 0",
                    "lucky the wrong way round": "luck >= success and there >= 0",
                    "luck equal to success": "luck <= success and there >= 0",
                },
            ),
            told=(
                "now, (0 if now == goal else -1)",
                {
                    "paid for where it was": "now, (0 if cell == goal else -1)",
                    "the other reward rule": "now, (1 if now == goal else 0)",
                    "the reward first": "(0 if now == goal else -1), now",
                },
            ),
        ),
        same=(step_in_other_words,),
        hints=(
            "Two things can keep the robot where it is. Which?",
            "It stays if its luck is `success` or more, or if the neighbor is -1. The "
            "reward belongs to the cell that it reaches.",
            "First set `cell` to `neighbors[cell, direction]` if it may go; then the "
            "reward is 0 if `cell == goal`, else -1.",
        ),
        wrong=[
            Wrong(
                "walking through walls",
                _through_walls,
                "Behind a wall `neighbors` holds -1, which is no cell: the robot "
                "stays.",
            ),
            Wrong(
                "no move fails",
                _never_fails,
                "A move succeeds only if `luck < success`.",
            ),
            Wrong(
                "lucky the wrong way round",
                _fails_when_lucky,
                "`luck` is drawn from 0 to 1; it lies *below* 0.9 nine times in ten.",
            ),
            Wrong(
                "paid for where it was",
                _pays_where_it_was,
                "The reward belongs to the cell that the robot reaches.",
            ),
            Wrong(
                "the other reward rule",
                _paid_on_the_goal,
                "That is 1 on the goal and 0 elsewhere. The paper pays 0 and -1.",
            ),
            Wrong(
                "the reward first",
                _reward_first,
                "Return the cell first, then the reward.",
            ),
            Wrong(
                "luck equal to success",
                _fails_at_equal,
                "The move succeeds if `luck` lies *below* `success`; equal fails.",
            ),
        ],
    ),
]

OPEN = [
    Open(
        "ex-1-4",
        hints=(
            "Let `read` look at it, or put it into the Map Studio under *The building "
            "as text*, and go to the row and column of the answer.",
            "What may stand between a room and a corridor?",
        ),
        good="the room is open to the corridor below it: two pieces of wall close it",
    ),
]
