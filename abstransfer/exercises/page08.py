"""Exercises of page 8: advice while learning."""

import numpy as np

from ._model import Open, Wrong, function, stub, value
from ._read import letters


def advice_probability(t, tau):
    """Return how likely advice is obeyed in step t = 1, 2, ..., soft strategy."""
    if t > tau:
        return 0.0
    return (tau - t) / tau


def advice_probability_hard(t, tau):
    """Return how likely advice is obeyed in step t = 1, 2, ..., hard strategy."""
    return 1.0 if t <= tau else 0.0


def _steps(rng):
    for tau in (1, 4, 10, 1000):
        for t in {1, 2, 3, tau - 1, tau, tau + 1, 2 * tau} - {0}:
            yield t, tau


EXERCISES = [
    function(
        "ex-8-1",
        "Write `advice_probability`: how likely does the soft strategy obey the advice "
        "in step t, for t = 1, 2, ...? After step tau, never.",
        advice_probability,
        cases=_steps,
        stub=stub(
            """\
def advice_probability(t, tau):
    return {chance}
""",
            chance=(
                "max(0, (tau - t) / tau)",
                {
                    "the sign": "min(0, (t - tau) / tau)",
                    "divided by t": "max(0, (tau - t) / t)",
                    "counted from 0": "max(0, (tau - t + 1) / tau)",
                    "negative after tau": "(tau - t) / tau",
                    "its own ways instead of the advice": "min(1, t / tau)",
                    "hard instead of soft": "1.0 if t <= tau else 0.0",
                    "never quite 0 at tau": "max(0, (tau + 1 - t) / (tau + 1))",
                },
            ),
        ),
        same=(
            lambda t, tau: max(0, 1 - t / tau),
            lambda t, tau: np.clip((tau - t) / tau, 0, 1),
        ),
        hints=(
            "It falls along a straight line, and stays at 0.",
            "Line 4 of Algorithm 2, and line 11 for the rest. In line 6 epsilon-greedy "
            "is asked with probability 1 - lambda only.",
            "(tau - t) / tau while t is at most tau, else 0.",
        ),
        wrong=[
            Wrong(
                "the sign",
                lambda t, tau: (t - tau) / tau if t <= tau else 0,
                "That is below 0; a probability lies from 0 to 1.",
            ),
            Wrong(
                "divided by t",
                lambda t, tau: (tau - t) / t if t <= tau else 0,
                "At t = 1 that is tau - 1, no probability: divide by tau.",
            ),
            Wrong(
                "counted from 0",
                lambda t, tau: max(0, (tau - t + 1) / tau),
                "You give the first step probability 1. Steps are counted from 1, and "
                "the paper's line 4 uses t itself.",
            ),
            Wrong(
                "negative after tau",
                lambda t, tau: (tau - t) / tau,
                "After step tau your value falls below 0. There the advice has no say.",
            ),
            Wrong(
                "its own ways instead of the advice",
                lambda t, tau: min(1, t / tau),
                "That is 1 - lambda, how likely the robot goes its own way.",
            ),
            Wrong(
                "hard instead of soft",
                advice_probability_hard,
                "That is the hard strategy: all, then nothing. Soft fades.",
            ),
            Wrong(
                "never quite 0 at tau",
                lambda t, tau: max(0, (tau + 1 - t) / (tau + 1)),
                "In step t = tau the probability is 0 already.",
            ),
        ],
    ),
    value(
        "ex-8-1b",
        "A soft guide has tau = 6 million. How large is lambda in step 1,500,000?",
        0.75,
        share=True,
        hints=(
            "Put the numbers into your function.",
            "It falls along a straight line from 1 to 0. A quarter of tau is over.",
            "(6 - 1.5) / 6, in millions.",
        ),
        wrong=[
            Wrong(
                "its own ways instead of the advice",
                0.25,
                "That is 1 - lambda, how likely the robot goes its own way.",
            ),
            Wrong("divided by t", 3, "Divide by tau: a probability is at most 1."),
            Wrong("hard instead of soft", 1, "So the hard strategy would obey."),
            Wrong("of all steps", 0.95, "Tau is 6 million, not the 30 of the run."),
        ],
    ),
    value(
        "ex-8-1c",
        "A soft guide has tau = 6 million, and epsilon is 0.1. Which share of the "
        "actions in step 3,000,000 is random?",
        0.05,
        share=True,
        hints=(
            "Two draws decide: first whether the advice is obeyed, then epsilon.",
            "Half of tau is over: how often is epsilon-greedy asked at all?",
            "(1 - 0.5) times 0.1.",
        ),
        wrong=[
            Wrong(
                "one in ten",
                0.1,
                "Epsilon-greedy decides only the steps in which the advice is not "
                "obeyed.",
            ),
            Wrong(
                "all of its own ways",
                0.5,
                "So often the robot goes its own way; most of these steps are greedy.",
            ),
            Wrong(
                "added",
                0.55,
                "A random action needs both: no advice, and then epsilon.",
            ),
            Wrong(
                "the greedy ones",
                0.45,
                "So often it takes what its notes say is best.",
            ),
        ],
    ),
    value(
        "ex-8-1d",
        "A soft guide has tau = 6 million. In how many million steps is it obeyed, on "
        "average?",
        3,
        tolerance=1e-3,
        hints=(
            "Add up the probabilities of all steps.",
            "They fall along a straight line from almost 1 to 0.",
            "The sum of a straight line from 1 to 0 is half of its length.",
        ),
        wrong=[
            Wrong("hard instead of soft", 6, "So often the hard strategy would obey."),
            Wrong(
                "steps, not millions",
                2_999_999.5,
                "Right, but the answer is asked for in millions.",
            ),
            Wrong("of all steps", 0.1, "That is the share of the 30 million steps."),
            Wrong(
                "the rest of the run",
                24,
                "These are the steps in which it has no say at all.",
            ),
        ],
    ),
    function(
        "ex-8-2",
        "Write `advice_probability_hard`: the same for the hard strategy.",
        advice_probability_hard,
        cases=_steps,
        stub=stub(
            """\
def advice_probability_hard(t, tau):
    return {chance}
""",
            chance=(
                "1.0 if t <= tau else 0.0",
                {
                    "off by one at t = tau": "1.0 if t < tau else 0.0",
                    "one step too long": "1.0 if t <= tau + 1 else 0.0",
                    "the wrong way round": "1.0 if t > tau else 0.0",
                    "soft instead of hard": "max(0, (tau - t) / tau)",
                    "for ever": "1.0",
                },
            ),
        ),
        same=(lambda t, tau: t <= tau, lambda t, tau: int(not t > tau)),
        hints=(
            "All, then nothing. Count the steps that obey.",
            "Look at the conditions of both loops in Algorithm 1. How large is lambda "
            "in step tau?",
            "`1 if t <= tau else 0`. In the trace of a run, how is 0 where the advice "
            "was obeyed.",
        ),
        wrong=[
            Wrong(
                "off by one at t = tau",
                lambda t, tau: float(t < tau),
                "Algorithm 1 obeys for t up to tau, step tau included.",
            ),
            Wrong(
                "one step too long",
                lambda t, tau: float(t <= tau + 1),
                "You still obey in step tau + 1.",
            ),
            Wrong(
                "the wrong way round",
                lambda t, tau: float(t > tau),
                "Advice comes first, learning on its own afterwards.",
            ),
            Wrong(
                "soft instead of hard",
                advice_probability,
                "That is the soft strategy, which fades.",
            ),
            Wrong(
                "for ever",
                lambda t, tau: 1.0,
                "After step tau the advice has no say any more.",
            ),
        ],
    ),
    value(
        "ex-8-2b",
        "Four programs take hard advice with tau = 3. Which of them, A to D, obey in "
        "the same steps as Algorithm 1? Write their letters.",
        "AB",
        read=letters,
        hints=(
            "Write down for each program in which steps it obeys. How many are they?",
            "Algorithm 1 obeys in its first three steps, whatever their numbers are.",
            "A obeys at t = 1, 2, 3, and B at t = 0, 1, 2.",
        ),
        wrong=[
            Wrong(
                "by the sign alone",
                "AC",
                "C counts from 0: it obeys at 0, 1, 2 and 3, which are four steps.",
            ),
            Wrong("only the same text", "A", "Another program has three steps, too."),
            Wrong(
                "the shorter loops",
                "BD",
                "D counts from 1: it obeys at 1 and 2, which are two steps.",
            ),
            Wrong("counted from 0", "B", "Another program has three steps, too."),
            Wrong("all", "ABCD", "Count the steps of each: 3, 3, 4 and 2."),
        ],
    ),
]

OPEN = [
    Open(
        "ex-8-3",
        hints=(
            '`at.q_learning(tasks.mdp, 30_000_000, rng=0, guide=advice["nd"], '
            "tau=...)`.",
            "With tau = 0 nobody gives advice.",
            "With tau = 30 million the robot learns all the time. Does it ever use "
            "what it learned?",
        ),
        good="the left end is plain Q-learning (274,539 goals), the right end the "
        "driving test (16,839), the top at 3.5 million",
    ),
    Open(
        "ex-8-4",
        hints=(
            "Make the number of obeyed steps equal: hard with tau/2 against soft with "
            "tau.",
            "The argument `checkpoints=(9_000_000,)` keeps a copy of the table.",
            "`copy.max(axis=1) > 0` is true where the goal has been heard of.",
        ),
        good="a control with as many obeyed steps; the difference stays, with the news "
        "in 70 % of the states against 14 %",
    ),
    Open(
        "ex-8-5",
        hints=(
            "What does the wanderer's advice do right? Take that away.",
            "`tasks.actions` names the actions, `tasks.available` says which have "
            "somewhere to go.",
            "A robot that always walks away from its goal.",
        ),
        good="advice that keeps the robot from its goals, three runs of it, and three "
        "without advice",
    ),
]
