"""
Buildings drawn by chance in the style of the target: for tests in many buildings.

60 blocks of 3 x 3 cells, 6 by 10.  Two rows of blocks are corridors, two columns
link them, one block more is a stub; the other 35 are rooms with a goal in the
centre.  The doors make a tree: each room has one way to a corridor.
"""

from __future__ import annotations

import numpy as np

from ..maps import CORRIDOR, DOOR, GOAL, OPEN, ROOM, Map, parse_map

ROWS, COLUMNS, BLOCK = 6, 10, 3
CORRIDORS = (1, 4)  # rows of blocks


def draw_building(seed: int) -> Map:
    """
    Return the building of a seed: 18 x 30 cells, 35 rooms, 35 goals, 35 doors.

    >>> draw_building(0)
    Map(18 x 30 cells, 35 rooms, 35 goals)
    """
    rng = np.random.default_rng([2015, seed])
    room = np.ones((ROWS, COLUMNS), dtype=bool)
    room[CORRIDORS, :] = False
    room[2:4, rng.choice(COLUMNS, 2, replace=False)] = False
    stub = rng.choice(np.flatnonzero(room))
    room.ravel()[stub] = False
    return parse_map(_drawing(room, _tree(room, rng)))


def _tree(room: np.ndarray, rng) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return doors between blocks: one at a time, to a room that has none yet."""
    reached, doors = ~room, []
    while not reached.all():
        ways = [
            ((row, column), (row + down, column + right))
            for row, column in np.argwhere(reached).tolist()
            for down, right in ((-1, 0), (0, 1), (1, 0), (0, -1))
            if 0 <= row + down < ROWS and 0 <= column + right < COLUMNS
            if not reached[row + down, column + right]
        ]
        doors.append(ways[rng.integers(len(ways))])
        reached[doors[-1][1]] = True
    return doors


def _drawing(room: np.ndarray, doors) -> str:
    """Return the text of a building; corners are drawn by who reads it."""
    cells = np.where(np.kron(room, np.ones((BLOCK, BLOCK), bool)), ROOM, CORRIDOR)
    cells[1::BLOCK, 1::BLOCK][room] = GOAL
    block = np.arange(room.size).reshape(room.shape)
    block[~room] = -1  # corridors are one region
    region = np.kron(block, np.ones((BLOCK, BLOCK), int))
    region = np.pad(region, 1, constant_values=-2)  # outside
    height, width = cells.shape
    text = np.full((2 * height + 1, 2 * width + 1), OPEN)
    text[1::2, 1::2] = cells
    text[::2, ::2] = "+"
    text[::2, 1::2][region[:-1, 1:-1] != region[1:, 1:-1]] = "-"
    text[1::2, ::2][region[1:-1, :-1] != region[1:-1, 1:]] = "|"
    for (row, column), (other_row, other_column) in doors:
        place = BLOCK * np.array([row + other_row + 1, column + other_column + 1])
        text[tuple(place)] = DOOR  # half way between the centres
    return "\n".join("".join(line) for line in text)
