"""
The card that a project hands in: what was raced, and the goals of each run.

On the card a run is a life: cards that were handed in keep their words.
The scene of page 12 writes the same text.  A person can read it, and :func:`verify`
runs the race again, and says which line is not so.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..abstraction import FEATURES
from ..maps import parse_map
from .prediction import Prediction, gain, half_up, read_line
from .racing import Race
from .setup import GUIDES, Setup, column_of, run, scale
from .student import written

TITLE = "# Result card"
COUNTS = ("cells", "rooms", "goals", "abstract_states")
HEAD = ("robot", "drives", "goals of a life", "over none")


class Verified(NamedTuple):
    """A race that was run again."""

    setup: Setup  #: what was raced
    race: Race  #: the race, run again
    prediction: Prediction | None = None  #: what was sealed before it, if that is told


def card_text(
    setup: Setup,
    goals: Mapping[str, Sequence[int]],
    own: Mapping[str, np.ndarray] | None = None,
    prediction: Prediction | None = None,
) -> str:
    """
    Return the text to hand in; `goals` are those of each run, by robot.

    `own` holds abstract policies (Z, A) of one's own, of names in ``setup.guides``.
    A `prediction` is told with what became of it.
    """
    found, (steps, tau) = column_of(setup, own=own), scale(setup.map)
    seen = "all" if setup.features == FEATURES else ", ".join(setup.features) or "none"
    whose = {"Student": written(setup.student)} if setup.student else {}
    settings = whose | {
        "Building": ", ".join(f"{found[n]} {n.replace('_', ' ')}" for n in COUNTS),
        "Advice from": setup.advice,
        "Features": seen,
        "Strategy": setup.strategy,
        "Steps": steps,
        "Tau": tau,
        "Lives": setup.runs,
        "Seed": setup.seed,
    }
    if prediction is not None:
        settings["Prediction"] = prediction.line(whose.get("Student", ""))
        if prediction.robot:
            settings["Found"] = prediction.compare(goals)
    head = (*HEAD, *(f"life {i + 1}" for i in range(setup.runs)))
    rows = [head, ["---"] * len(head)]
    for name in ("none", *setup.robots, "optimal"):
        mine = [int(n) for n in goals.get(name, ())]
        value = f"{found[name]:.2f}" if name != "none" else ""
        mean = f"{half_up(sum(mine) / len(mine))}" if mine else ""
        more = gain(sum(mine), sum(goals["none"])) if mine and name != "none" else ""
        rows.append([name, value, mean, more, *(mine or [""] * setup.runs)])
    lines = [TITLE, "", *(f"- {name}: {value}" for name, value in settings.items())]
    lines += ["", *(f"| {' | '.join(map(str, row))} |" for row in rows), ""]
    return "\n".join([*lines, "```text", str(setup.map), "```", ""])


def verify(text: str, own: Mapping[str, np.ndarray] | None = None) -> list[Verified]:
    """
    Run the races of all cards in a text again.

    The text may come by mail: quoted by ``>``, with blanks and lines of its own
    before, between and after the cards.  What a card says must be right to the
    last digit.

    Parameters
    ----------
    text : str
    own : dict from name to ndarray (Z, A), optional
        Advice that a card only has the name of.

    Raises
    ------
    ValueError
        At the first line that the new race does not confirm: its number, what it
        says, and what it should say.

    Examples
    --------
    >>> from abstransfer.project.setup import Setup, run
    >>> setup = Setup(parse_map("+---+\\n|.d*|\\n+---+"), guides=("eager",), runs=1)
    >>> card = card_text(setup, run(setup).goals)
    >>> [found.setup == setup for found in verify("By me.\\n" + card)]
    [True]
    >>> verify(card.replace("Tau: 400", "Tau: 9"))
    Traceback (most recent call last):
    ...
    ValueError: line 8: the card says '- Tau: 9', the race again '- Tau: 400'
    """
    return [_verified(lines, own or {}) for lines in _cards(text)]


def _cards(text: str) -> list[list[tuple[int, str]]]:
    """Return the lines of each card and their numbers, to its end, no blank ones."""
    cards = []
    for number, line in enumerate(text.splitlines(), 1):
        line = re.sub(r"^\s*(> ?)+", "", line.replace("\xa0", " ")).strip()
        if line == TITLE:
            cards.append([])
        is_inside = cards and (not cards[-1] or cards[-1][-1][1] != "```")
        if line and is_inside:
            cards[-1].append((number, line))
    if not cards:
        raise ValueError(f"text must hold a card, which begins with {TITLE!r}")
    return cards


def _setup(lines: list[tuple[int, str]]) -> tuple[Setup, Prediction | None]:
    """Return what a card says was raced and predicted; what it lacks is named."""
    first, bare = lines[0][0], [line for _, line in lines]

    def of(name, otherwise=None):
        for number, line in lines:
            if line.startswith(f"- {name}: "):
                return number, line.split(": ", 1)[1]
        if otherwise is not None:
            return first, otherwise
        raise ValueError(f"line {first}: the card must hold '- {name}: ...'")

    if "```text" not in bare or "```" not in bare:
        wanted = "a building between ```text and ```"
        raise ValueError(f"line {first}: the card must hold {wanted}")
    above, below = bare.index("```text"), bare.index("```")
    rows = [line for line in bare[:above] if line.startswith("| ")]
    table = [row.strip("| ").split(" | ") for row in rows]
    head, (number, lives) = [*table, []][0], of("Lives")
    columns = sum(name.startswith("life ") for name in head)
    if lives != str(columns):  # before anything is run for so long
        said = f"the card says '- Lives: {lives}', its table has {columns}"
        raise ValueError(f"line {number}: {said}")
    seen = of("Features")[1]
    features = {"all": FEATURES, "none": ()}.get(seen, tuple(seen.split(", ")))
    raced = tuple(row[0] for row in table if row[-1].isdecimal() and row[0] != "none")
    map_ = parse_map("\n".join(bare[above + 1 : below]))
    strategy, advice = of("Strategy")[1], of("Advice from")[1]
    student = of("Student", "")[1]
    setup = Setup(map_, features, raced, advice, strategy, columns, student)
    number, said = of("Prediction", "")
    try:
        return setup, read_line(said) if said else None
    except ValueError as error:
        raise ValueError(f"line {number}: {error}") from None


def _verified(lines: list[tuple[int, str]], own: Mapping) -> Verified:
    setup, prediction = _setup(lines)
    for name in setup.guides:
        if name not in (*GUIDES, *own):
            raise ValueError(f"own must hold {name!r}: the card has its name only")
    again = run(setup, own)
    text = card_text(setup, again.goals, own, prediction)
    right = [line for line in text.splitlines() if line]
    missing = [(lines[-1][0], "")] * len(right)
    for (number, said), wanted in zip([*lines, *missing], right, strict=False):
        if said != wanted:
            difference = f"the card says {said!r}, the race again {wanted!r}"
            raise ValueError(f"line {number}: {difference}")
    return Verified(setup, again, prediction)
