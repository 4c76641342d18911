"""Exercises of page 3: learning by bumping."""

import numpy as np

from ._epsilon_greedy import EPSILON_GREEDY
from ._model import Wrong, function, value


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


def _steps(rng):
    ends = [(False, False), (True, False), (False, True)]
    yield 0.5, 0, np.array([0.2, 0.8]), False, False, 0.1, 0.9
    for reached_goal, cut in ends * 4:
        old, *following = rng.uniform(0.1, 0.9, 4).round(2)
        reward = int(reached_goal)
        yield old, reward, np.array(following), reached_goal, cut, 0.1, 0.9


UPDATED = function(
    "ex-3-1",
    "Write `updated`, the new value of Q(s, a) after one step. `old` is the value "
    "before "
    "it, `next_values` is the row of the next state. `reached_goal` says that the step "
    "ended on the goal, `cut` that it was the 5,000th of its episode.",
    updated,
    cases=_steps,
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
    ],
)


Q0 = value(
    "ex-3-3",
    "Which of the first notes 0, -5, -9, -10, -11 lets the paying robot reach most "
    "goals in the large building?",
    -10,
    hints=(
        "What does a note promise that nobody has tested yet?",
        "A cell far from the goal is worth nearly -1 / (1 - 0.9).",
        "Above that value the robot sweeps; below it, it keeps to what it tried first.",
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
        "A cost of 1 on each step, for ever, must be what the first notes say.",
        "Put 0 into (Q - 1) / (1 - gamma), but mind: a state that never reaches "
        "the goal pays on every step.",
        "-1 / (1 - 0.95).",
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
