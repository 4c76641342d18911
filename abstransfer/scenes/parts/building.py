"""The building as stills draw it: rooms, walls, doors, goals, and what is over them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...maps import CORRIDOR, Map
from ...plotting.buildings import edge_lines, strips
from .svg import at, group, path, picture, text, through

CELL = 20  # units of the drawing
STAR = "M0-7L1.6-2.2 6.7-2.2 2.6.8 4.1 5.7 0 2.7-4.1 5.7-2.6.8-6.7-2.2-1.6-2.2Z"
# North, east, south, west: a line as long as is written behind it, and its head.
ARROWS = (
    ("v-", "m-2 2 2-2 2 2"),
    ("h", "m-2-2 2 2-2 2"),
    ("v", "m-2-2 2 2 2-2"),
    ("h-", "m2-2-2 2 2 2"),
)
LEAST = 0.1  # likely: what has an arrow


def draw_building(
    map_: Map,
    alt: str,
    *,
    values: np.ndarray | None = None,
    limits: tuple[float, float] = (0.0, 1.0),
    texts: Sequence[str] = (),
    arrows: np.ndarray | None = None,
    robots: Mapping[int, str] | None = None,
    goal: int | None = None,
) -> str:
    """
    Return a building as SVG.

    Parameters
    ----------
    map_ : Map
    alt : str
        What the picture shows.
    values : ndarray of float, shape (C,), optional
        The higher, the stronger the tint of a cell; nan leaves it as it is.
    limits : (low, high)
        Values of no tint and of the strongest.
    texts : sequence of str, one per cell
        A goal that does not count gives way to its text.
    arrows : ndarray of float, shape (C, 4), optional
        How likely is north, east, south, west: as long as that, from the middle.
    robots : dict from cell to str, optional
        Names of those who stand there, larger than the cell; "" is a small robot.
    goal : int, optional
        Cell of the one goal that counts; all by default.
    """
    parts = [path(_squares(map_, map_.cells != CORRIDOR), fill="room")]
    if values is not None:
        parts += _tints(map_, np.asarray(values, dtype=float), *limits)
    walls, doors = (
        "".join(through(CELL * line) for line in edge_lines(map_, kind))
        for kind in ("wall", "door")
    )
    parts.append(path(walls, "ink", 2, more="stroke-linecap:square"))
    parts += [path(doors, "door", 5), path(doors, "ground", 2.4)]
    written = {cell: words for cell, words in enumerate(texts) if words}
    for cell in map(int, map_.goals):
        if goal in (None, cell):
            parts.append(path(STAR, fill="goal", move=_middle(map_, cell)))
        elif cell not in written:
            star = path(STAR, "goal", 1.5, fill="ground", move=_middle(map_, cell))
            parts.append(star)
    if arrows is not None:
        parts.append(path(_arrows(map_, arrows), "ink", 1.2))
    words = [_words(_middle(map_, cell), what, 6.5) for cell, what in written.items()]
    parts.append(group(words, "font-size:6.5px;text-anchor:middle"))
    for cell, name in (robots or {}).items():
        parts.append(_robot(_middle(map_, cell), name))
    height, width = map_.shape
    return picture(parts, alt, CELL * width, CELL * height, edge=2)


def _middle(map_: Map, cell: int) -> tuple[float, float]:
    row, column = divmod(int(cell), map_.shape[1])
    return CELL * (column + 0.5), CELL * (row + 0.5)


def _arrows(map_: Map, weights: np.ndarray) -> str:
    """Return arrows, those of less than LEAST left out."""
    drawn = []
    for cell, way in zip(*np.nonzero(np.asarray(weights) > LEAST), strict=True):
        length = round(CELL * (0.15 + 0.3 * weights[cell, way]))
        line, head = ARROWS[way]
        drawn.append(f"M{at(*_middle(map_, cell))}{line}{length}{head}")
    return "".join(drawn)


def _words(middle: tuple[float, float], words: str, size: float) -> str:
    return text(middle[0], middle[1] + 0.35 * size, words)


def _robot(middle: tuple[float, float], name: str) -> str:
    """Return a small robot, or by its name one that is seen in a large building."""
    high, half = (14, 9 + 6 * len(name)) if name else (6, 6)
    flat = 2 * (half - high)
    x, y = middle
    around = f"M{at(x - flat / 2, y - high)}h{flat}a{high} {high} 0 0 1 0 {2 * high}"
    around += f"h{-flat}a{high} {high} 0 0 1 0 {-2 * high}z"
    named = [_words(middle, name, 20)] if name else []
    look = "font-size:20px;text-anchor:middle"
    return path(around, "ink", 2, fill="ground") + group(named, look)


def _squares(map_: Map, chosen: np.ndarray) -> str:
    """Return the chosen cells as one path, runs of a row in one piece."""
    return "".join(
        f"M{CELL * x} {CELL * y}h{CELL * (end - x)}v{CELL}H{CELL * x}z"
        for y, x, end in zip(*strips(map_, chosen), strict=True)
    )


def _tints(map_: Map, values: np.ndarray, low: float, high: float) -> list[str]:
    """Return one path per tenth of the range of values."""
    share = (values - low) / ((high - low) or 1.0)
    tenths = np.nan_to_num(np.clip(np.round(share * 10), 0, 10)).astype(int)
    return [
        path(_squares(map_, tenths == n), fill="high", more=f"fill-opacity:{n / 10:g}")
        for n in np.unique(tenths[tenths > 0])
    ]
