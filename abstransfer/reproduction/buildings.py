"""
Buildings drawn by chance in the style of the target: for tests in many buildings.

A building is made of blocks of 3 x 3 cells, 6 by 10 of them in that of the target's
size.  Of every three rows of blocks the middle one is a corridor, two columns link
neighbouring corridors, one block more is a stub; all others are rooms with a goal in
the centre.  The doors make a tree: each room has one way to a corridor.
"""

from __future__ import annotations

import numpy as np

from ..maps import CORRIDOR, DOOR, GOAL, OPEN, ROOM, Map, parse_map

BLOCK = 3  # cells on a side
BLOCKS = 6, 10  # rows and columns of blocks in a building of the target's size
LINKS = 2  # columns of blocks that link two corridors


def draw_building(seed: int, blocks: tuple[int, int] = BLOCKS) -> Map:
    """
    Return the building of a seed.

    Parameters
    ----------
    seed : int
    blocks : (rows, columns), default (6, 10)
        Rows of blocks, a multiple of 3, and columns, at least 3.  The default has
        18 x 30 cells, 35 rooms, 35 goals and 35 doors.

    Raises
    ------
    ValueError
        If there cannot be such a building.

    Examples
    --------
    >>> draw_building(0)
    Map(18 x 30 cells, 35 rooms, 35 goals)
    >>> draw_building(0, (3, 6))
    Map(9 x 18 cells, 11 rooms, 11 goals)
    """
    rows, columns = blocks
    if rows < 3 or rows % 3 or columns <= LINKS:
        raise ValueError(
            f"blocks must have 3, 6, 9, ... rows and at least {LINKS + 1} columns, "
            f"got {rows} x {columns}"
        )
    rng = np.random.default_rng([2015, seed])
    room = np.ones((rows, columns), dtype=bool)
    room[1::3] = False
    for row in range(2, rows - 1, 3):
        room[row : row + 2, rng.choice(columns, LINKS, replace=False)] = False
    stub = rng.choice(np.flatnonzero(room))
    room.ravel()[stub] = False
    return parse_map(_drawing(room, _tree(room, rng)))


def _tree(room: np.ndarray, rng) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return doors between blocks: one at a time, to a room that has none yet."""
    reached, doors = ~room, []
    rows, columns = room.shape
    while not reached.all():
        ways = [
            ((row, column), (row + down, column + right))
            for row, column in np.argwhere(reached).tolist()
            for down, right in ((-1, 0), (0, 1), (1, 0), (0, -1))
            if 0 <= row + down < rows and 0 <= column + right < columns
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
