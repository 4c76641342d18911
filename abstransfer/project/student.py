"""
Whose work it is: from a student's name follow the seed, and a building of one's own.

A class shares no number, each answer can be computed again from the name alone, and
the answers of all together are a sample of many buildings.
"""

from __future__ import annotations

import hashlib
import unicodedata

from ..maps import Map
from ..reproduction.buildings import draw_building


def written(student: str) -> str:
    """
    Return a name in one form: one line, one blank between words.

    >>> written(" Ann   Lee ")
    'Ann Lee'
    """
    if not isinstance(student, str):
        raise ValueError(f"student must be a name, got {type(student).__name__}")
    name = " ".join(unicodedata.normalize("NFC", student).split())
    if not name.strip("."):
        raise ValueError(
            f'student must be your name, as in student = "Ann Lee", got {student!r}'
        )
    return name


def seed_of(student: str) -> int:
    """
    Return the seed of a name, from 0 to below 2**32; capitals do not matter.

    Signs become capitals and small again one by one, as JavaScript can do it too.

    >>> seed_of("Ann Lee"), seed_of("ann  lee")
    (3835007348, 3835007348)
    """
    name = "".join(sign.upper().lower() for sign in written(student))
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big")


def building_of(student: str) -> Map:
    """
    Return a student's own building, in the style of the paper's target.

    >>> building_of("Ann Lee")
    Map(18 x 30 cells, 35 rooms, 35 goals)
    """
    return draw_building(seed_of(student))
