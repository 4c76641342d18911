"""Exercise 2 of page 3: any action now and then, else one of the best."""

import numpy as np

from ._model import Wrong, function
from ._read import Unreadable, numbers

N_DRAWS, N_AGAIN = 4000, 200


def epsilon_greedy(q_row, epsilon, rng):
    """Return an action: any with probability epsilon, else one of the best."""
    if rng.random() < epsilon:
        return rng.integers(len(q_row))
    return rng.choice(np.flatnonzero(q_row == np.max(q_row)))


def epsilon_greedy_by_weights(q_row, epsilon, rng):
    best = np.asarray(q_row) == max(q_row)
    weight = (1 - epsilon) * best / best.sum() + epsilon / len(q_row)
    return int((rng.random() >= np.cumsum(weight)[:-1]).sum())


def _first_best(q_row, epsilon, rng):
    return rng.integers(len(q_row)) if rng.random() < epsilon else np.argmax(q_row)


def _last_best(q_row, epsilon, rng):
    last = len(q_row) - 1 - np.argmax(q_row[::-1])
    return rng.integers(len(q_row)) if rng.random() < epsilon else last


def _inverted(q_row, epsilon, rng):
    return epsilon_greedy(q_row, 1 - epsilon, rng)


def _never_the_best(q_row, epsilon, rng):
    others = np.flatnonzero(q_row < np.max(q_row))
    if len(others) and rng.random() < epsilon:
        return rng.choice(others)
    return epsilon_greedy(q_row, 0, rng)


def _never_explores(q_row, epsilon, rng):
    return epsilon_greedy(q_row, 0, rng)


def _own_luck(q_row, epsilon, rng):
    return epsilon_greedy(q_row, epsilon, np.random.default_rng())


def shares(choose, q_row, epsilon, seed):
    """Return how often each action is drawn, and whether a seed repeats itself."""
    draws = []
    for n in (N_DRAWS, N_AGAIN):
        rng = np.random.default_rng(seed)
        draws.append([numbers(choose(q_row.copy(), epsilon, rng)) for _ in range(n)])
    if any(a.size != 1 for a in draws[0]):
        raise Unreadable("The function must return one number, that of an action")
    actions = np.array([a.item() for a in draws[0]])
    if not np.isin(actions, np.arange(len(q_row))).all():
        raise Unreadable(f"An action is a whole number from 0 to {len(q_row) - 1}")
    counts = np.bincount(actions.astype(int), minlength=len(q_row))
    again = [a.item() for a in draws[1]] == actions[:N_AGAIN].tolist()
    return np.append(counts / N_DRAWS, again)


def _choices(rng):
    yield np.array([0.0, 0.0, 0.0, 0.0]), 0.1, 1
    yield np.array([0.2, 0.5, 0.5, 0.1]), 0.15, 2
    yield np.array([0.3, -1.0]), 0.15, 3


EPSILON_GREEDY = function(
    "ex-3-2",
    "Write `epsilon_greedy`, which returns the number of an action: with probability "
    "`epsilon` any action, else one of the best, equal ones by chance. Draw all luck "
    "from `rng`.",
    epsilon_greedy,
    cases=_choices,
    same=(epsilon_greedy_by_weights,),
    probe=shares,
    tolerance=0.06,
    hints=(
        "Two draws: whether to explore, and which action.",
        "`rng.random() < epsilon` is true in a share `epsilon` of the calls; "
        "`rng.integers(n)` draws a whole number below n.",
        "The best actions are `np.flatnonzero(q_row == q_row.max())`; `rng.choice` "
        "draws one of them.",
    ),
    wrong=[
        Wrong(
            "the first of equals",
            _first_best,
            "`argmax` returns the first of equal values. A robot whose notes are all 0 "
            "would walk into the same wall for hours: draw among the best.",
        ),
        Wrong(
            "the last of equals",
            _last_best,
            "Where several actions are best, you take the last one. Draw among them.",
        ),
        Wrong(
            "epsilon the wrong way round",
            _inverted,
            "Epsilon is the share of *random* actions; yours is the share of best "
            "ones.",
        ),
        Wrong(
            "exploring leaves out the best",
            _never_the_best,
            "A random action is *any* action; the best ones may be drawn as well.",
        ),
        Wrong(
            "never explores",
            _never_explores,
            "In a share `epsilon` of the calls the values must not matter.",
        ),
        Wrong(
            "luck of its own",
            _own_luck,
            "The same seed must give the same actions: draw from `rng` only.",
        ),
    ],
)
