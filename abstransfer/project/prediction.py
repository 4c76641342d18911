"""
A prediction of a race, sealed before it, and compared after it.

On a card it is one line.  Its seal follows from who predicts, what, and before which
race, and from nothing else: eight letters to write on the board.  They show that the
line was not changed later; they do not hide it.
"""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

DIRECTIONS = ("+", "-", "0")
LINE = re.compile(
    r"(?:none|(?P<robot>.+), direction (?P<direction>[+0-]), "
    r"refuted (?:below|above) (?P<percent>\d+) %), race (?P<race>\d+), sealed \S+"
)


def seal(text: str) -> str:
    """
    Return eight letters that follow from a text.

    >>> seal("none, race 1")
    '37004e81'
    """
    return hashlib.sha256(text.encode()).hexdigest()[:8]


class Prediction(NamedTuple):
    """By which share of goals a robot will exceed the one without advice."""

    race: int = 1  #: before which race of the reader it was sealed, counted from 1
    robot: str = ""  #: whom it is about; "" if nothing was predicted
    direction: str = "+"  #: "+" more goals, "-" fewer, "0" as many
    percent: int = 5  #: the least effect in this direction; for "0" the largest

    def line(self, student: str = "") -> str:
        """
        Return the line of a card, with its seal.

        >>> Prediction(2, "nd", "-", 3).line("Ann Lee")
        'nd, direction -, refuted below 3 %, race 2, sealed cdf23e08'
        """
        said = "none"
        if self.robot:
            side = "above" if self.direction == "0" else "below"
            said = f"{self.robot}, direction {self.direction}, refuted {side}"
            said += f" {self.percent} %"
        said += f", race {self.race}"
        return f"{said}, sealed {seal(f'{student}: {said}')}"

    def compare(self, goals: Mapping[str, Sequence[int]]) -> str:
        """
        Return what goals of runs, by robot, say to it: "" if nothing was predicted.

        >>> Prediction(robot="nd").compare({"none": [100, 100], "nd": [110, 104]})
        '+7.0 %, as predicted'
        """
        if not self.robot:
            return ""
        mine, none = (
            sum(int(n) for n in goals.get(name, ())) for name in (self.robot, "none")
        )
        if self.robot not in goals or not none:
            return "nothing to compare"
        more = 100 * (mine - none)
        size = {"+": more, "-": -more, "0": -abs(more)}[self.direction]
        least = self.percent * none * (-1 if self.direction == "0" else 1)
        word = "as predicted" if size >= least else "refuted"
        return f"{gain(mine, none)}, {word}"


def read_line(said: str) -> Prediction:
    """
    Return the prediction that a line of a card holds.

    >>> read_line("nd, direction 0, refuted above 5 %, race 1, sealed 0f0f0f0f")
    Prediction(race=1, robot='nd', direction='0', percent=5)
    """
    found = LINE.fullmatch(said)
    if not found:
        wanted = (
            "'none' or 'nd, direction +, refuted below 5 %', then ', race 1, sealed '"
        )
        raise ValueError(f"a prediction must be {wanted} and its seal, got {said!r}")
    race, parts = int(found["race"]), found.groupdict()
    if not parts["robot"]:
        return Prediction(race)
    return Prediction(race, parts["robot"], parts["direction"], int(parts["percent"]))


def gain(mine: int, none: int) -> str:
    """
    Return how many more goals than none, as "+1.5 %"; nothing over nothing.

    >>> gain(43, 40), gain(1, 0)
    ('+7.5 %', '')
    """
    return f"{half_up(1000 * mine / none - 1000) / 10:+.1f} %" if none else ""


def half_up(x: float) -> int:
    """Return a whole number as JavaScript rounds: halves go up."""
    return math.floor(x + 0.5)
