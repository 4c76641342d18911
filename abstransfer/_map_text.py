"""
What a legal picture of a building is, and what to say of one that is not.

The format is in :mod:`abstransfer.maps`, the only module that uses this one.
Refusals count rows and columns of the text from 1, as an editor does.
"""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

CORRIDOR, ROOM, GOAL = ".", " ", "*"
WALLS = ("-", "|")
DOOR, OPEN = "d", " "
STEP = np.array([[-1, 0], [0, 1], [1, 0], [0, -1]])  # (4, 2): row, column


def components(neighbors: np.ndarray) -> np.ndarray:
    """Return the connected component of each cell, (C,), for neighbors (C, 4)."""
    start, direction = np.nonzero(neighbors >= 0)
    size = len(neighbors)
    links = (np.ones(len(start)), (start, neighbors[start, direction]))
    return connected_components(coo_array(links, shape=(size, size)))[1]


def to_text(chars: np.ndarray) -> str:
    """Draw the corners that the edges make; return the picture as text."""
    chars = chars.copy()
    solid = np.pad(np.isin(chars, (*WALLS, DOOR)), 1)
    north, south = solid[:-2:2, 1:-1:2], solid[2::2, 1:-1:2]
    west, east = solid[1:-1:2, :-2:2], solid[1:-1:2, 2::2]
    corner = np.full(north.shape, "+")
    corner[north & south & ~west & ~east] = "|"
    corner[west & east & ~north & ~south] = "-"
    corner[~(north | south | west | east)] = " "
    chars[::2, ::2] = corner
    return "\n".join("".join(line) for line in chars)


def refuse(row: int, column: int, problem: str, remedy: str):
    raise ValueError(f"row {row + 1}, column {column + 1}: {problem}; {remedy}")


def rectangle(lines: list[str], n_blank: int) -> np.ndarray:
    """Return the characters of lines of one length, or refuse the first other."""
    if not lines:
        raise ValueError("the map is empty; draw at least two cells, one a goal")
    for i, line in enumerate(lines):
        if len(line) != len(lines[0]):
            problem = f"this line has {len(line)} characters, the first {len(lines[0])}"
            place = min(len(line), len(lines[0]))
            refuse(n_blank + i, place, problem, "make all lines equally long")
    rows, columns = len(lines), len(lines[0])
    if (
        rows % 2 == 0
        or columns % 2 == 0
        or min(rows, columns) < 3
        or rows * columns < 15
    ):
        raise ValueError(
            "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or "
            f"more; got {rows} rows and {columns} columns"
        )
    return np.array([list(line) for line in lines])


def check_characters(chars: np.ndarray, n_blank: int) -> None:
    """Refuse the first character that cannot stand where it does."""
    kinds = (
        (slice(0, None, 2), slice(0, None, 2), "corner", "+-| "),
        (slice(1, None, 2), slice(1, None, 2), "cell", CORRIDOR + ROOM + GOAL),
        (slice(0, None, 2), slice(1, None, 2), "edge", WALLS[0] + DOOR + OPEN),
        (slice(1, None, 2), slice(0, None, 2), "edge", WALLS[1] + DOOR + OPEN),
    )
    for rows, columns, kind, known in kinds:
        unknown = np.argwhere(~np.isin(chars[rows, columns], list(known)))
        if len(unknown):
            row, column = unknown[0] * 2 + [rows.start, columns.start]
            char = str(chars[row, column]) or "\0"  # NumPy drops a trailing NUL
            problem = f"unknown character {char!r}"
            remedy = f"the {kind} here must be one of {', '.join(map(repr, known))}"
            refuse(n_blank + row, column, problem, remedy)
    border = np.ones(chars.shape, bool)
    border[1:-1, 1:-1] = False
    border[::2, ::2] = False  # corners carry no information
    holes = np.argwhere(border & np.isin(chars, (OPEN, DOOR)))
    if len(holes):
        row, column = holes[0]
        refuse(n_blank + row, column, "the border has a hole", "put a wall there")


def check_building(map_, n_blank: int) -> None:
    """Refuse a drawing that is no building a robot can learn in."""
    cells, regions = map_.cells, map_.regions
    neighbors, doors = map_.neighbors, map_.doors

    def refuse_first(bad, problem, remedy):
        """Refuse the first True of bad, (C,) for cells or (C, 4) for edges."""
        places = np.argwhere(bad)
        if len(places):
            cell, *direction = places[0]
            row, column = np.array(divmod(cell, map_.shape[1])) * 2 + 1
            d_row, d_column = STEP[direction[0]] if direction else (0, 0)
            refuse(n_blank + row + d_row, column + d_column, problem, remedy)

    is_corridor = cells == CORRIDOR
    other = np.where(neighbors >= 0, neighbors, 0)  # behind a wall: any cell will do
    refuse_first(
        (neighbors >= 0) & ~doors & is_corridor[:, None] & (cells[other] == ROOM),
        "a room opens on the corridor",
        "put a wall or a door there",
    )
    refuse_first(
        np.isin(regions, regions[is_corridor]) & (cells == GOAL),
        "a goal in the corridor",
        "move it into a room, or make its cells a room with walls and a door",
    )
    refuse_first(
        doors & (regions[:, None] == regions[other]),
        "the door joins a region to itself",
        "make it a wall, or close the walls of the region",
    )
    if not (cells == GOAL).any():
        raise ValueError("the map has no goal; put '*' in a cell of a room")
    part = components(neighbors)
    refuse_first(
        part != np.bincount(part).argmax(),
        "this region cannot be reached from the rest of the building",
        "put a door in one of its walls",
    )
