"""Exercises of page 3: learning by bumping."""

import copy

import numpy as np

from ._model import Wrong, function, stub, value
from ._read import Unreadable, numbers, shown


def updated(old, reward, next_values, reached_goal, cut, alpha, gamma):
    """Return the new value of Q(s, a), by the paper's equation (1)."""
    following = 0 if reached_goal else max(next_values)
    return (1 - alpha) * old + alpha * (reward + gamma * following)


def updated_by_error(old, reward, next_values, reached_goal, cut, alpha, gamma):
    error = reward + (not reached_goal) * gamma * np.max(next_values) - old
    return old + alpha * error


def _unmasked(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, next_values, False, cut, alpha, gamma)


def _cut_as_goal(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, next_values, reached_goal or cut, cut, alpha, gamma)


def _old_state(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, [old], reached_goal, cut, alpha, gamma)


def _away(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, next_values, reached_goal, cut, -alpha, gamma)


def _replaced(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, next_values, reached_goal, cut, 1, gamma)


def _swapped(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, next_values, reached_goal, cut, 1 - alpha, gamma)


def _undiscounted(old, reward, next_values, reached_goal, cut, alpha, gamma):
    return updated(old, reward, next_values, reached_goal, cut, alpha, 1)


def _mean(old, reward, next_values, reached_goal, cut, alpha, gamma):
    mean = [np.mean(next_values)]
    return updated(old, reward, mean, reached_goal, cut, alpha, gamma)


def _old_not_reduced(old, reward, next_values, reached_goal, cut, alpha, gamma):
    new = updated(old, reward, next_values, reached_goal, cut, alpha, gamma)
    return new + alpha * old


def _reward_only(old, reward, next_values, reached_goal, cut, alpha, gamma):
    following = 0 if reached_goal else max(next_values)
    return (1 - alpha) * old + alpha * reward + gamma * following


def _steps(rng):
    ends = [(False, False), (True, False), (False, True)]
    yield 0.5, 0, np.array([0.2, 0.8]), False, False, 0.1, 0.9
    for alpha, gamma in ((0.1, 0.9), (0.3, 0.8), (0.5, 0.99), (0.2, 0.5)):
        for reached_goal, cut in ends:
            old, *following = rng.uniform(0.1, 0.9, 4).round(2).tolist()
            for reward in (int(reached_goal), int(reached_goal) - 1):
                after = np.array(following)
                yield old, reward, after, reached_goal, cut, alpha, gamma


UPDATED = function(
    "ex-3-1",
    "Write `updated`, the new value of Q(s, a) after one step. `old` is the value "
    "before "
    "it, `next_values` is the row of the next state. `reached_goal` says that the step "
    "ended on the goal, `cut` that it was the 5,000th of its episode.",
    updated,
    cases=_steps,
    stub=stub(
        """\
def updated(old, reward, next_values, reached_goal, cut, alpha, gamma):
    following = {following}
    return {value}
""",
        following=(
            "0 if reached_goal else max(next_values)",
            {
                "something follows the goal": "max(next_values)",
                "a cut is a goal": "0 if reached_goal or cut else max(next_values)",
                "the largest value of the wrong state": "0 if reached_goal else old",
                "the mean of the next values": (
                    "0 if reached_goal else np.mean(next_values)"
                ),
            },
        ),
        value=(
            "(1 - alpha) * old + alpha * (reward + gamma * following)",
            {
                "away from the target": (
                    "(1 + alpha) * old - alpha * (reward + gamma * following)"
                ),
                "the target replaces the old value": "reward + gamma * following",
                "alpha and 1 - alpha swapped": (
                    "alpha * old + (1 - alpha) * (reward + gamma * following)"
                ),
                "no discount": "(1 - alpha) * old + alpha * (reward + following)",
                "the old value is kept whole": (
                    "old + alpha * (reward + gamma * following)"
                ),
                "alpha for the reward only": (
                    "(1 - alpha) * old + alpha * reward + gamma * following"
                ),
            },
        ),
    ),
    same=(updated_by_error,),
    hints=(
        "How much of `old` is kept, and what is mixed in?",
        "The target is the reward plus `gamma` times the largest next value. "
        "When does nothing follow?",
        "(1 - alpha) times `old`, plus alpha times the target; on the goal the target "
        "is the reward alone. `cut` changes nothing.",
    ),
    wrong=[
        Wrong(
            "something follows the goal",
            _unmasked,
            "The episode ends on the goal. Whatever the table holds there, nothing is "
            "added to the reward.",
        ),
        Wrong(
            "a cut is a goal",
            _cut_as_goal,
            "After 5,000 steps the robot is carried away, but the building goes on: "
            "the "
            "last step is learned from like any other.",
        ),
        Wrong(
            "the largest value of the wrong state",
            _old_state,
            "You look at the state that was left. What follows is the *next* state: "
            "otherwise news never travels.",
        ),
        Wrong(
            "away from the target",
            _away,
            "A sign is wrong: the value must move towards the target, not away from "
            "it.",
        ),
        Wrong(
            "the target replaces the old value",
            _replaced,
            "Keep a share 1 - alpha of the old value: one step is only one sample.",
        ),
        Wrong(
            "alpha and 1 - alpha swapped",
            _swapped,
            "Alpha is the share of the *new*. With alpha = 0.1 most of the old is "
            "kept.",
        ),
        Wrong(
            "no discount",
            _undiscounted,
            "What comes one step later counts `gamma` times as much.",
        ),
        Wrong(
            "the mean of the next values",
            _mean,
            "Q-learning asks what the *best* next action would bring, whichever the "
            "robot will take.",
        ),
        Wrong(
            "the old value is kept whole",
            _old_not_reduced,
            "You add a share of the target, and take away nothing: the value grows "
            "without end. Keep a share 1 - alpha of the old one.",
        ),
        Wrong(
            "alpha for the reward only",
            _reward_only,
            "Alpha belongs to the whole target: reward plus what follows. Are there "
            "brackets?",
        ),
    ],
)


N_DRAWS, N_AGAIN = 2000, 100
NEAR = 0.035  # three to five times as much as angles of shares vary


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


def _zero_is_none(q_row, epsilon, rng):
    best = epsilon_greedy(q_row, 0, rng)
    return best if best and rng.random() >= epsilon else rng.integers(len(q_row))


def _own_luck(q_row, epsilon, rng):
    return epsilon_greedy(q_row, epsilon, np.random.default_rng())


def _off_by_one(q_row, epsilon, rng):
    if rng.random() < epsilon:
        return rng.integers(max(1, len(q_row) - 1))
    return epsilon_greedy(q_row, 0, rng)


def shares(choose, q_row, epsilon, rng):
    """Return the shares of the actions, as angles; and whether a seed repeats itself.

    The angle of a share varies from sample to sample by 0.011, whatever the share.
    """
    drawn = []
    for n in (N_DRAWS, N_AGAIN):
        luck = copy.deepcopy(rng)
        drawn.append([_action(choose(q_row.copy(), epsilon, luck)) for _ in range(n)])
    n_actions, actions = len(q_row), set(range(len(q_row)))
    if strange := [a for a in drawn[0] if a not in actions]:
        raise Unreadable(
            f"An action is a whole number from 0 to {n_actions - 1} where q_row has "
            f"{n_actions} entries; yours was {shown(strange[0])}"
        )
    counts = np.bincount(np.array(drawn[0], int), minlength=n_actions)
    return np.append(_angles(counts / N_DRAWS), drawn[1] == drawn[0][:N_AGAIN])


def _angles(shares):
    return np.arcsin(np.sqrt(shares))


def _action(returned):
    if isinstance(returned, (int, np.integer)):
        return int(returned)
    array = numbers(returned)
    if array.size != 1:
        raise Unreadable("The function must return one number, that of an action")
    return array.item()


def exact_shares(q_row, epsilon, rng):
    """Return the angles of how likely the actions are; and a seed repeats itself."""
    best = q_row == q_row.max()
    likely = epsilon / len(q_row) + (1 - epsilon) * best / best.sum()
    return np.append(_angles(np.minimum(likely, 1)), 1)


def _shares_differ(ours, right):
    a, b = ours.values[:-1], right.values[:-1]
    if np.allclose(a, b, rtol=NEAR, atol=NEAR):
        return "With the same luck in `rng`, yours draws other actions"
    a, b = (shown(np.sin(angles) ** 2, 2) for angles in (a, b))
    return f"Yours draws the actions in the shares {a}, not in about {b}"


def _choices(rng):
    """Yield few and clear cases."""
    rows = (
        [0.0, 0, 0, 0],
        [0.2, 0.5, 0.5, 0.1],
        [0.5, 0.1, 0.2, 0.5],
        [0.3, -1],
        [1, 4, 2],
    )
    for seed, (row, epsilon) in enumerate(zip(rows, (0.3, 0, 0.6, 1, 1), strict=True)):
        yield np.array(row, float), epsilon, np.random.default_rng(seed)


EPSILON_GREEDY = function(
    "ex-3-2",
    "Write `epsilon_greedy`, which returns the number of an action: with probability "
    "`epsilon` any action, else one of the best, equal ones by chance. Draw all luck "
    "from `rng`.",
    epsilon_greedy,
    cases=_choices,
    stub=stub(
        """\
def epsilon_greedy(q_row, epsilon, rng):
    if {explores}:
        return {any}
    return {best}
""",
        explores=(
            "rng.random() < epsilon",
            {"epsilon the wrong way round": "rng.random() > epsilon"},
        ),
        any=(
            "rng.integers(len(q_row))",
            {"the last action is never explored": "rng.integers(len(q_row) - 1)"},
        ),
        best=(
            "rng.choice(np.flatnonzero(q_row == q_row.max()))",
            {
                "the first of equals": "np.argmax(q_row)",
                "the last of equals": "len(q_row) - 1 - np.argmax(q_row[::-1])",
            },
        ),
    ),
    same=(epsilon_greedy_by_weights,),
    probe=shares,
    exact=exact_shares,
    tell=_shares_differ,
    tolerance=NEAR,
    alike=0.04,  # of two samples
    hints=(
        "Before the first goal every entry is 0, so all are the largest. Two draws are "
        "needed: whether to explore, and which action.",
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
            "action 0 is none",
            _zero_is_none,
            "Action 0 is an action as any other, but `if action:` is false for it.",
        ),
        Wrong(
            "luck of its own",
            _own_luck,
            "The same seed must give the same actions: draw from `rng` only.",
        ),
        Wrong(
            "the last action is never explored",
            _off_by_one,
            "`rng.integers(n)` stops below n already: give it `len(q_row)`.",
        ),
    ],
)


Q0 = value(
    "ex-3-3",
    "Which of the first notes 0, -5, -9, -10, -11 lets the paying robot reach most "
    "goals in the large building?",
    -10,
    hints=(
        "What does a note promise that nobody has tested yet? To try it, give "
        "`at.q_learning` the first notes as q0.",
        "What does a state cost that is far from the goal? Its value is nearly "
        "`-1 / (1 - 0.9)`.",
        "What does a robot prefer if everything it tried turned out better than its "
        "first notes? Above that value the robot sweeps; below it, it keeps to what it "
        "tried first.",
    ),
    wrong=[
        Wrong(
            "zero is neutral",
            0,
            "If every step costs, a 0 promises too much: every untried action looks "
            "best.",
        ),
        Wrong(
            "the more pessimistic the better",
            -11,
            "Below the worst possible value, anything that was tried looks better than "
            "what was not: the robot stops exploring.",
        ),
        Wrong("half-way", -5, "Half-way is still a promise that will be broken."),
        Wrong(
            "nearly there",
            -9,
            "A difference of 1 from the worst value is still worth many sweeps.",
        ),
    ],
)

SAME_LEARNER = value(
    "ex-3-4",
    "A robot that is paid 1 on the goal starts from notes of 0. With a discount of "
    "0.95, from which value must the paying robot start to learn the same?",
    -20,
    hints=(
        "Write c = 1 / (1 - gamma), so that -1 - gamma c = -c. On the goal nothing "
        "follows, so there is no maximum.",
        "What does a robot pay that never arrives, 1 on each step for ever? That is "
        "what the first notes must say.",
        "A note of 0 becomes (0 - 1) / (1 - gamma): `-1 / (1 - 0.95)`.",
    ),
    wrong=[
        Wrong("the sign", 20, "The robot pays: its notes lie below 0."),
        Wrong(
            "the discount of the page", -10, "That is right for 0.9. Here it is 0.95."
        ),
        Wrong(
            "without the first payment", -19, "The payment of this moment counts too."
        ),
        Wrong("a difference, not a ratio", -0.05, "Divide by 1 - gamma."),
    ],
)

EXERCISES = [UPDATED, EPSILON_GREEDY, Q0, SAME_LEARNER]
