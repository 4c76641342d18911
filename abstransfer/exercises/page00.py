"""Exercises of page 0: a race."""

from ._model import Exercise, Open

EXERCISES: list[Exercise] = []

OPEN = [
    Open(
        "ex-0-1",
        hints=(
            "What did the third and the fourth robot have that came from another "
            "building?",
        ),
        good="that rules from another building were given, and that learning in a new "
        "one was compared",
    ),
    Open(
        "ex-0-2",
        hints=(
            '`curves["nd-hard"].mean(axis=0)` is the average curve of ND.',
            "`(curve > 5000).argmax()` is the first place where that is true.",
        ),
        good="ND after 5.0, Prob after 9.5, the wanderer after 11.5, no advice after "
        "17.5 million steps; the order of the totals, not that of the ends",
    ),
    Open(
        "ex-0-3",
        hints=(
            "What does a robot learn about a door that its advice never sends it "
            "through?",
        ),
        good="any reason that an experiment could refute",
    ),
]
