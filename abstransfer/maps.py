"""
Buildings as text: read, check, print and edit maps.

A map of H x W cells is a picture of (2H+1) x (2W+1) characters.  Cells stand
at the odd rows and columns (counted from 0), the edges between them::

    +---+-+       .  cell of a corridor       - |    wall
    |. .| |       *  cell of a room, a goal   d      door
    |   + +    blank cell of a room           blank  no wall
    |. .d*|       +  corner, drawn from the edges around it
    +---+-+

Error messages count rows and columns of the text from 1, as an editor does;
functions take cells as (row, column) counted from 0.
Page 1 of the book teaches this module.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from . import foreign
from ._paths import DATA

CORRIDOR, ROOM, GOAL = ".", " ", "*"
WALLS = ("-", "|")
DOOR, OPEN = "d", " "
STEP = np.array([[-1, 0], [0, 1], [1, 0], [0, -1]])  # (4, 2): row, column
DIRECTIONS = ("N", "E", "S", "W")
# What may stand in the text, by row % 2 and column % 2, and what an error says of it.
KNOWN = (("+-| ", "-d "), ("|d ", ". *"))
CORNER = "a corner: '+', '-', '|' or ' '"
CELL = "a cell: '.' of a corridor, ' ' of a room, '*' a goal"
EDGE = "an edge: {!r} for a wall, 'd' for a door, ' ' for neither"
SAID = ((CORNER, EDGE.format("-")), (EDGE.format("|"), CELL))


@dataclass(frozen=True)
class Map:
    """
    A building whose text was checked; :func:`parse_map` makes one.

    Maps are equal when their texts are; ``str(map)`` is the text.
    The C = H * W cells are numbered row by row; all arrays are read-only.

    Examples
    --------
    A corridor of one cell, and a room whose goal is behind a door.

    >>> building = parse_map("+---+\\n|.d*|\\n+---+")
    >>> building
    Map(1 x 2 cells, 1 room, 1 goal)
    >>> building.neighbors  # N, E, S, W
    array([[-1,  1, -1, -1],
           [-1, -1, -1,  0]])
    """

    text: str

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        height, width = self.shape
        rooms = f"{self.n_rooms} room{'s' * (self.n_rooms != 1)}"
        goals = f"{len(self.goals)} goal{'s' * (len(self.goals) != 1)}"
        return f"Map({height} x {width} cells, {rooms}, {goals})"

    @cached_property
    def chars(self) -> np.ndarray:
        """The text as characters, shape (2H+1, 2W+1)."""
        return _frozen(np.array([list(line) for line in self.text.split("\n")]))

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells, (H, W)."""
        rows, columns = self.chars.shape
        return rows // 2, columns // 2

    @property
    def n_cells(self) -> int:
        """Number of cells C."""
        return self.shape[0] * self.shape[1]

    @cached_property
    def cells(self) -> np.ndarray:
        """Kind of each cell, shape (C,): CORRIDOR, ROOM or GOAL."""
        return _frozen(self.chars[1::2, 1::2].ravel())

    @cached_property
    def goals(self) -> np.ndarray:
        """Cells that hold a goal, shape (N,)."""
        return _frozen(np.flatnonzero(self.cells == GOAL))

    @cached_property
    def edges(self) -> np.ndarray:
        """Character of each cell's edge to N, E, S, W, shape (C, 4)."""
        rows, columns = np.indices(self.shape).reshape(2, -1, 1) * 2 + 1
        return _frozen(self.chars[rows + STEP[:, 0], columns + STEP[:, 1]])

    @cached_property
    def doors(self) -> np.ndarray:
        """Whether the edge to N, E, S, W is a door, shape (C, 4)."""
        return _frozen(self.edges == DOOR)

    @cached_property
    def neighbors(self) -> np.ndarray:
        """Cell next to each cell to N, E, S, W, shape (C, 4); -1 behind a wall."""
        reached = np.arange(self.n_cells)[:, None] + STEP @ [self.shape[1], 1]
        return _frozen(np.where(np.isin(self.edges, WALLS), -1, reached))

    @cached_property
    def regions(self) -> np.ndarray:
        """Region of each cell, shape (C,): cells joined without a door."""
        return _frozen(_components(np.where(self.doors, -1, self.neighbors)))

    @property
    def n_rooms(self) -> int:
        """Number of regions that are rooms."""
        return len(np.unique(self.regions[self.cells != CORRIDOR]))

    @property
    def n_doors(self) -> int:
        """Number of doors; each belongs to two cells."""
        return int(self.doors.sum()) // 2

    def set_edge(self, cell: tuple[int, int], direction: str, kind: str) -> Map:
        """
        Return the map with one edge made a ``"wall"``, a ``"door"`` or ``"open"``.

        Raises ValueError, with row and column of the text, where the building
        would not be legal any more.

        >>> room = parse_map("+---+\\n|  *|\\n+---+")
        >>> room.set_edge((0, 0), "E", "door").n_rooms
        2
        """
        height, width = self.shape
        if tuple(np.ravel(cell)) not in np.ndindex(height, width):
            raise ValueError(f"cell must lie within {height} x {width}, got {cell}")
        wall = "-" if direction in ("N", "S") else "|"
        char = {"wall": wall, "door": DOOR, "open": OPEN}
        known = {"direction": DIRECTIONS, "kind": tuple(char)}
        for name, value in (("direction", direction), ("kind", kind)):
            if value not in known[name]:
                raise ValueError(f"{name} must be one of {known[name]}, got {value!r}")
        chars = self.chars.copy()
        row, column = 2 * np.array(cell) + 1 + STEP[DIRECTIONS.index(direction)]
        chars[row, column] = char[kind]
        return parse_map(_to_text(chars))

    def add_door(self, cell: tuple[int, int], direction: str) -> Map:
        """Return the map with a door in the given edge of a cell."""
        return self.set_edge(cell, direction, "door")


def parse_map(text: str) -> Map:
    """
    Return the map that a text draws; the inverse of ``str``.

    Corners carry no information and are redrawn.  Module ``foreign`` says which
    differences are forgiven, and which drawings with larger cells are read.

    Raises
    ------
    ValueError
        Naming row, column and remedy: lines of different length, an unknown
        character, a hole in the border, a room that opens on the corridor
        without a door, a goal in the corridor, a door within one region, no
        goal, a region that cannot be reached.

    Examples
    --------
    >>> parse_map("+---+\\n|  *|\\n+-- +")
    Traceback (most recent call last):
        ...
    ValueError: row 3, column 4: the border has a hole; put a wall there
    """
    if not isinstance(text, str):
        raise ValueError(f"text of a map must be a str, got {type(text).__name__}")
    try:
        picture = foreign.find_picture(text, KNOWN)
        map_ = Map(_to_text(_characters(picture)))
        _check_building(map_, picture)
    except ValueError as error:
        raise ValueError(foreign.named(text) or str(error)) from None
    return map_


def read_map(source: str | Path) -> Map:
    """
    Return the map in a file, or one that comes with the package, by its name.

    Raises FileNotFoundError where there is no such file or name, and
    ValueError, naming the file, for anything :func:`parse_map` refuses.

    >>> read_map("source")
    Map(9 x 15 cells, 11 rooms, 11 goals)
    """
    shipped = {path.stem: path for path in sorted((DATA / "maps").glob("*.txt"))}
    path = shipped.get(str(source), Path(source))
    if not path.is_file():
        raise FileNotFoundError(
            f"no map file {str(source)!r}; maps that come with the package: "
            + ", ".join(shipped)
        )
    try:
        return parse_map(foreign.decoded(path.read_bytes()))
    except UnicodeDecodeError as error:
        problem = f"no text in UTF-8 or UTF-16 (byte {error.start})"
        raise ValueError(f"{path}: {problem}") from None
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _frozen(array: np.ndarray) -> np.ndarray:
    array.flags.writeable = False
    return array


def _components(neighbors: np.ndarray) -> np.ndarray:
    """Return the connected component of each cell, (C,), for neighbors (C, 4)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    start, direction = np.nonzero(neighbors >= 0)
    size = len(neighbors)
    links = (np.ones(len(start)), (start, neighbors[start, direction]))
    return connected_components(coo_array(links, shape=(size, size)))[1]


def _to_text(chars: np.ndarray) -> str:
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


def _characters(picture: foreign.Picture) -> np.ndarray:
    """Return the characters of a picture, or refuse one that draws no cells."""
    lines = picture.lines
    if not lines:
        raise ValueError("the map is empty; draw at least two cells, one a goal")
    rows, columns = len(lines), len(lines[0])
    for row, line in enumerate(lines):
        if len(line) != columns:
            problem = f"this line has {len(line)} characters, the first {columns}"
            place = min(len(line), columns)
            picture.refuse(row, place, problem, "make all lines equally long")
    even = rows % 2 == 0 or columns % 2 == 0
    if even or min(rows, columns) < 3 or rows * columns < 15:
        raise ValueError(
            "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or "
            f"more; got {rows} rows and {columns} columns"
        )
    for i, j in ((0, 0), (1, 1), (0, 1), (1, 0)):
        for row, line in enumerate(lines[i::2]):
            for column, char in enumerate(line[j::2]):
                if char not in KNOWN[i][j]:
                    place = 2 * row + i, 2 * column + j
                    problem = f"unknown character {char!r}"
                    picture.refuse(*place, problem, f"here stands {SAID[i][j]}")
    chars = np.array([list(line) for line in lines])
    border = np.ones(chars.shape, bool)
    border[1:-1, 1:-1] = False
    border[::2, ::2] = False  # corners carry no information
    holes = np.argwhere(border & np.isin(chars, (OPEN, DOOR)))
    if len(holes):
        picture.refuse(*holes[0], "the border has a hole", "put a wall there")
    return chars


def _check_building(map_, picture: foreign.Picture) -> None:
    """Refuse a drawing that is no building a robot can learn in."""
    cells, regions = map_.cells, map_.regions
    neighbors, doors = map_.neighbors, map_.doors

    def refuse_first(bad, problem, remedy):
        """Refuse the first True of bad, (C,) for cells or (C, 4) for edges."""
        places = np.argwhere(bad)
        if len(places):
            cell, *direction = places[0]
            place = np.array(divmod(cell, map_.shape[1])) * 2 + 1
            place += STEP[direction[0]] if direction else 0
            picture.refuse(*place, problem, remedy)

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
    part = _components(neighbors)
    refuse_first(
        part != np.bincount(part).argmax(),
        "this region cannot be reached from the rest of the building",
        "put a door in one of its walls",
    )
