"""Cells, walls and doors as matplotlib draws them, and as alt texts name them."""

from __future__ import annotations

import numpy as np

from ..maps import DOOR, WALLS, Map
from .style import COLOR, SMALL

DOOR_SIDE = 0.18  # of a cell's side, wall on either side of a door


def count(n: int, noun: str) -> str:
    """Return "1 door" or "2 doors"."""
    return f"{n} {noun}{'' if n == 1 else 's'}"


def place(map_: Map, cell: int, what: str) -> str:
    """Return where a cell is, rows and columns counted from 1."""
    row, column = divmod(int(cell), map_.shape[1])
    return f"{what} row {row + 1}, column {column + 1}"


def cell_array(x, map_: Map, name: str) -> np.ndarray:
    """Return x as floats (C,), at least one of them finite, or refuse it."""
    x = np.asarray(x, dtype=float)
    if x.shape != (map_.n_cells,) or not np.isfinite(x).any():
        raise ValueError(
            f"{name} must hold numbers in shape ({map_.n_cells},), got shape {x.shape}"
        )
    return x


def paint_cells(
    ax,
    map_: Map,
    chosen: np.ndarray,
    color,
    hatch: str | None = None,
    linewidth: float = 0,
):
    """Fill the chosen cells, (C,) bool, runs of a row in one piece."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    grid = np.pad(chosen.reshape(map_.shape), ((0, 0), (1, 1))).astype(int)
    row, start = np.nonzero(np.diff(grid, axis=1) == 1)
    end = np.nonzero(np.diff(grid, axis=1) == -1)[1]
    if not len(row):
        return
    corners = np.array(
        [[start, row], [end, row], [end, row + 1], [start, row + 1], [start, row]]
    )
    codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    path = Path(corners.transpose(2, 0, 1).reshape(-1, 2), codes * len(row))
    ax.add_patch(
        PathPatch(path, facecolor=color, edgecolor=color, linewidth=linewidth, zorder=0)
    )
    if hatch:
        lines = {"facecolor": "none", "edgecolor": COLOR["faint"], "hatch": hatch}
        ax.add_patch(PathPatch(path, linewidth=0, zorder=0, **lines))


def draw_edges(ax, map_: Map, thick: float):
    """Draw walls as lines, and doors as hollow bars in a gap of the wall."""
    lines = []  # of walls, of doors: each (n, 2, 2), and which of them to draw how
    for kind in ("wall", "door"):
        segments = [
            ends if horizontal else ends[:, ::-1]
            for horizontal, chars in (
                (1, map_.chars[::2, 1::2]),
                (0, map_.chars[1::2, ::2].T),
            )
            for ends in _segments(chars, kind)
        ]
        lines.append(_polyline(np.array(segments).reshape(-1, 2, 2)))
    walls, doors = lines
    ax.plot(
        *walls,
        color=COLOR["ink"],
        linewidth=thick,
        solid_capstyle="projecting",
        zorder=3,
    )
    for color, width in (("door", 2.4 * thick), ("ground", 1.2 * thick)):
        ax.plot(
            *doors, color=COLOR[color], linewidth=width, solid_capstyle="butt", zorder=4
        )


def _segments(chars: np.ndarray, kind: str):
    """Yield the (x, y) ends, (2, 2), of each wall or door along rows of edges."""
    for y, line in enumerate(chars):
        if kind == "door":
            for x in np.flatnonzero(line == DOOR):
                yield np.array([[x + DOOR_SIDE, y], [x + 1 - DOOR_SIDE, y]])
        else:
            solid = np.pad(np.isin(line, (*WALLS, DOOR)), 1).astype(int)
            change = np.flatnonzero(np.diff(solid))
            for start, end in change.reshape(-1, 2):
                yield np.array([[start, y], [end, y]], dtype=float)


def _polyline(segments: np.ndarray):
    """Return x and y of segments (n, 2, 2) as one line with gaps."""
    gap = np.full((len(segments), 1, 2), np.nan)
    return np.concatenate([segments, gap], axis=1).reshape(-1, 2).T


def print_in(ax, map_: Map, cell: int, text: str, color: str):
    row, column = divmod(int(cell), map_.shape[1])
    ax.text(
        column + 0.5,
        row + 0.52,
        text,
        color=color,
        fontsize=SMALL - 1,
        ha="center",
        va="center",
        zorder=7,
    )
