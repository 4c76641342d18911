"""
Still pictures of buildings, small and the same every time.

They stand for a scene where its script does not run: before it does, in print,
and in a notebook that was not run.  Colours are the palette's, as variables that
the style of the scenes sets for both themes, with the light colour where there is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np

from ...maps import CORRIDOR, DOOR, OPEN, Map
from ...plotting.buildings import DOOR_SIDE
from ...plotting.style import COLOR
from ..files import EXTRA

CELL = 20  # units of the drawing
STAR = "M0-7L1.6-2.2 6.7-2.2 2.6.8 4.1 5.7 0 2.7-4.1 5.7-2.6.8-6.7-2.2-1.6-2.2Z"


def paint(name: str) -> str:
    """Return a colour of the palette as a variable, the light one by default."""
    return f"var(--ab-{name},{COLOR[name] if name in COLOR else EXTRA[name][0]})"


def building_svg(
    map_: Map,
    alt: str,
    *,
    values: np.ndarray | None = None,
    limits: tuple[float, float] = (0.0, 1.0),
    texts: Sequence[str] = (),
    robot: int | None = None,
    goal: int | None = None,
) -> str:
    """
    Return a building as SVG: rooms, walls, doors, goals, and what is over them.

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
    robot : int, optional
        Cell of the robot.
    goal : int, optional
        Cell of the one goal that counts; all by default.
    """
    height, width = map_.shape
    parts = [_path(_squares(map_, map_.cells != CORRIDOR), "room", "none", 0)]
    if values is not None:
        parts += _tints(map_, np.asarray(values, float), *limits)
    walls, doors = _edges(map_)
    parts += [
        _path(walls, "none", "ink", 2),
        _path(doors, "none", "door", 5),
        _path(doors, "none", "ground", 2.4),
    ]
    for cell in map_.goals:
        place = f"translate({_middle(map_, cell)})"
        if goal in (None, cell):
            parts.append(_path(STAR, "goal", "none", 0, place))
        else:
            parts.append(_path(STAR, "ground", "goal", 1.5, place))
    for cell, text in enumerate(texts):
        if text:
            x, y = _middle(map_, cell).split()
            parts.append(f'<text x="{x}" y="{y}" dy=".35em">{escape(text)}</text>')
    if robot is not None:
        x, y = _middle(map_, robot).split()
        style = f"fill:{paint('ground')};stroke:{paint('ink')};stroke-width:2"
        parts.append(f'<circle cx="{x}" cy="{y}" r="6" style="{style}"/>')
    box = f"-2 -2 {CELL * width + 4} {CELL * height + 4}"
    looks = f"font:6.5px sans-serif;text-anchor:middle;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="{box}" aria-label="{escape(alt)}" style="{looks}">'
        + "".join(part for part in parts if part)
        + "</svg>"
    )


def _path(d: str, fill: str, stroke: str, width: float, move: str = "") -> str:
    if not d:
        return ""
    style = f"fill:{fill if fill == 'none' else paint(fill)}"
    if stroke != "none":
        cap = ";stroke-linecap:square" if stroke == "ink" else ""
        style += f";stroke:{paint(stroke)};stroke-width:{width}{cap}"
    place = f' transform="{move}"' if move else ""
    return f'<path d="{d}" style="{style}"{place}/>'


def _middle(map_: Map, cell: int) -> str:
    row, column = divmod(int(cell), map_.shape[1])
    return f"{CELL * column + CELL // 2} {CELL * row + CELL // 2}"


def _squares(map_: Map, chosen: np.ndarray) -> str:
    """Return the chosen cells as one path, runs of a row in one piece."""
    grid = np.pad(chosen.reshape(map_.shape), ((0, 0), (1, 1))).astype(int)
    row, start = np.nonzero(np.diff(grid, axis=1) == 1)
    end = np.nonzero(np.diff(grid, axis=1) == -1)[1]
    return "".join(
        f"M{CELL * x} {CELL * y}h{CELL * (x_end - x)}v{CELL}H{CELL * x}z"
        for y, x, x_end in zip(row, start, end, strict=True)
    )


def _tints(map_: Map, values: np.ndarray, low: float, high: float) -> list[str]:
    """Return one path per tenth of the range of values."""
    level = np.full(len(values), -1)
    known = np.isfinite(values)
    share = (values[known] - low) / ((high - low) or 1.0)
    level[known] = np.clip(np.round(share * 10), 0, 10)
    return [
        f'<path d="{_squares(map_, level == step)}" '
        f'style="fill:{paint("high")};fill-opacity:{step / 10:g}"/>'
        for step in np.unique(level[level > 0])
    ]


def _edges(map_: Map) -> tuple[str, str]:
    """Return walls, doors included, and doors as paths."""
    walls = doors = ""
    gap = DOOR_SIDE * CELL
    for row, line in enumerate(map_.chars):
        for column in range((row + 1) % 2, len(line), 2):
            if line[column] == OPEN:
                continue
            flat = row % 2 == 0
            x, y = CELL * (column - flat) // 2, CELL * (row - (not flat)) // 2
            walls += f"M{x} {y}{'h' if flat else 'v'}{CELL}"
            if line[column] == DOOR:
                side = f"{CELL - 2 * gap:g}"
                doors += (
                    f"M{x + gap:g} {y}h{side}" if flat else f"M{x} {y + gap:g}v{side}"
                )
    return walls, doors
