"""
Alt texts, made from the data: what a figure shows, and what one finds in it.

Each takes what the plotting function of the same name takes, without `ax`,
and returns 40 to 300 characters.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ._charts import ladder_columns
from ._style import arm_style, number
from .maps import CORRIDOR, Map
from .table1 import PAPER, ROWS

LONGEST = 300


def describe_map(map_: Map, *, goal: int | None = None) -> str:
    """
    Return the alt text of a map: its size, and what is in it.

    >>> from abstransfer.maps import read_map
    >>> describe_map(read_map("source"))
    'A building of 9 by 15 cells: 11 rooms with 11 goals, 11 doors, and a corridor
    of 36 cells.'
    """
    height, width = map_.shape
    goals = _count(len(map_.goals), "goal") if goal is None else _place(map_, goal)
    corridor = int((map_.cells == CORRIDOR).sum())
    return (
        f"A building of {height} by {width} cells: {_count(map_.n_rooms, 'room')} with "
        f"{goals}, {_count(map_.n_doors, 'door')}, and a corridor of "
        f"{_count(corridor, 'cell')}."
    )


def describe_ladder(
    result: Mapping, *, paper: Mapping | None = PAPER, rows: Sequence[str] = ROWS
) -> str:
    """Return the alt text of the ladder: its rungs from the top, and the order."""
    columns = ladder_columns(result, rows)
    text, same = "Mean value by policy, best first.", True
    for name, column in columns.items():
        order = sorted(rows, key=lambda row: -column[row])
        rungs = [f"{arm_style(row).name} {number(column[row])}" for row in order]
        text += f" {name.capitalize()}: {', '.join(rungs)}."
        theirs = (paper or {}).get(name, {})
        same &= order == sorted(rows, key=lambda row: -theirs.get(row, np.inf))
    if paper:
        text += f" The order {'is' if same else 'is not'} the paper's."
    return text


def _count(n: int, noun: str) -> str:
    return f"{n} {noun}{'s' * (n != 1)}"


def _place(map_: Map, cell: int) -> str:
    row, column = divmod(int(cell), map_.shape[1])
    return f"the goal in row {row + 1}, column {column + 1}"
