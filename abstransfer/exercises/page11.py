"""Exercises of page 11: neighbours, and whispered advice."""

import numpy as np

from ._model import Open, Wrong, function, stub, value


def whisper(values, rho, size):
    """Return first notes (S, A): the values of each state's view, times a size."""
    return size * np.take(values, rho, axis=0)


def whisper_state_by_state(values, rho, size):
    return [[size * x for x in values[view]] for view in rho]


def _one_for_all(values, rho, size):
    best = values[rho].max(axis=1, keepdims=True)
    return np.repeat(size * best, values.shape[1], axis=1)


def _buildings(rng):
    for size in (0.5, 0.25, 0.02):
        for n_views, n_states in ((2, 5), (6, 9)):
            values = rng.random((n_views, 8)).round(3) + 0.1
            yield values, rng.integers(0, n_views, n_states), size


EXERCISES = [
    value(
        "ex-11-1",
        "Alpha is 0.1, gamma 0.9, the reward of the step 0. The potential is 2 here "
        "and 6 there. A robot starts with the potential as first notes: 2 for all "
        "actions here, 6 for all actions there. What is its note after this one step?",
        2.34,
        hints=(
            "It is one step of Q-learning: nine tenths of the old note, one tenth of "
            "the target.",
            "The target is 0 + 0.9 times the largest note there.",
            "`0.9 * 2 + 0.1 * (0 + 0.9 * 6)`.",
        ),
        wrong=[
            Wrong(
                "the target", 5.4, "That is the target: a note goes a tenth of the way."
            ),
            Wrong("no discount", 2.4, "The largest note there counts 0.9 times."),
            Wrong("alpha the other way", 5.06, "Nine tenths of the old note stay."),
            Wrong(
                "the shaped robot's",
                0.34,
                "That is the note of the robot with shaping, which starts from 0.",
            ),
        ],
    ),
    value(
        "ex-11-1b",
        "The same step of a robot with shaping: its notes are 0, and gamma times the "
        "potential there, less the potential here, is added to the reward. What is its "
        "note?",
        0.34,
        hints=(
            "First the reward with what is added, then the step of Q-learning.",
            "Added is 0.9 times 6, less 2.",
            "`0.9 * 0 + 0.1 * (0 + 0.9 * 6 - 2 + 0.9 * 0)`.",
        ),
        wrong=[
            Wrong(
                "the target", 3.4, "That is the target: a note goes a tenth of the way."
            ),
            Wrong("no discount", 0.4, "The potential there counts 0.9 times."),
            Wrong("the sign", -0.34, "There is added, here is taken away."),
            Wrong("with first notes", 2.34, "This robot starts from notes of 0."),
        ],
    ),
    function(
        "ex-11-2",
        "Write `whisper`: first notes (S, A) for a robot. `values` (Z, A) is what the "
        "small building teaches of each view, `rho` (S,) is the view of each state, "
        "`size` is how loud the whisper is.",
        whisper,
        cases=_buildings,
        stub=stub(
            """\
def whisper(values, rho, size):
    return {notes}
""",
            notes=(
                "size * values[rho]",
                {
                    "said aloud": "values[rho]",
                    "added": "size + values[rho]",
                    "divided": "values[rho] / size",
                    "to a power": "values[rho] ** size",
                    "the same for all actions": (
                        "size * values[rho].max(axis=1, keepdims=True) "
                        "* np.ones(values.shape[1])"
                    ),
                },
            ),
        ),
        same=(whisper_state_by_state,),
        hints=(
            "A state's first notes are those of its view.",
            "`values[rho]` is an array (S, A): for each state the row of its view.",
            "`size * values[rho]`.",
        ),
        wrong=[
            Wrong(
                "said aloud",
                lambda values, rho, size: values[rho],
                "So loud it has to be unlearned first. Make it small.",
            ),
            Wrong(
                "added",
                lambda values, rho, size: size + values[rho],
                "That makes it louder. A size is a factor.",
            ),
            Wrong(
                "divided",
                lambda values, rho, size: values[rho] / size,
                "The smaller the size, the louder this is.",
            ),
            Wrong(
                "to a power",
                lambda values, rho, size: values[rho] ** size,
                "At a small power all notes are near 1. A size is a factor.",
            ),
            Wrong(
                "the same for all actions",
                _one_for_all,
                "That is shaping: it says which states are good, and not which way.",
            ),
        ],
    ),
    value(
        "ex-11-3",
        "Jump-start draws for each episode how many steps the guide has: 0, 1, ..., "
        "19, all equally likely. How many are they on average?",
        9.5,
        hints=(
            "The numbers are spread evenly: look at the two ends.",
            "The least is 0, the largest is 19.",
            "`(0 + 19) / 2`.",
        ),
        wrong=[
            Wrong("half of H", 10, "The largest that can be drawn is 19, not 20."),
            Wrong("from 1", 10.5, "The least is 0: then the robot acts at once."),
            Wrong("the most", 19, "So many at most; fewer are as likely."),
            Wrong("H", 20, "That is how many numbers there are."),
        ],
    ),
]

OPEN = [
    Open(
        "ex-11-4",
        hints=(
            "What is in the notes after the first step, if each step pays -1?",
            "A whisper breaks ties until there is news. When is there news here?",
            'Try `at.experiments.Problem(reward="cost")`, with sizes 1 and 1e-9.',
        ),
        good="a reason from how soon news comes: a vanishing whisper is drowned by the "
        "first step, so the notes must be loud, or the method another",
    ),
]
