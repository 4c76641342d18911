"""Still pictures of Table 1 as ladders, small and the same every time."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

import numpy as np

from ...plotting.style import PALETTE, arm_style, number, spread
from ..parts.curves import MARKS, _line, _text
from ..parts.stills import paint

WIDTH, HEIGHT = 320, 300  # units of the drawing
TOP, BOTTOM, SIDE, LINE, STEP = 30, 12, 112, 14, 10
SHAPES = MARKS | {"star": "M0-5L1.5-1.5 5-1.5 2 1 3.2 5 0 2.6-3.2 5-2 1-5-1.5-1.5-1.5Z"}


def ladders_svg(
    columns: Mapping[str, Mapping[str, float]],
    paper: Mapping[str, Mapping[str, float]],
    alt: str,
) -> str:
    """
    Return ladders side by side as SVG, the higher a rung, the better it drives.

    Parameters
    ----------
    columns : dict from building to dict from policy to mean value
    paper : the same, or empty
        Numbers of the paper, as hollow marks.
    alt : str
        What the picture shows.
    """
    parts = []
    for tick in range(0, -101, -20):
        parts += [
            _line(f"M26 {_y(tick):g}H{WIDTH - 2}", paint("grid")),
            _text(0, _y(tick) + 4, number(tick, 0), "start"),
        ]
    for side, (name, column) in enumerate(columns.items()):
        x, out = (WIDTH - SIDE, 1) if side else (SIDE, -1)
        parts.append(_line(f"M{x} {_y(0):g}V{_y(-100):g}", paint("faint")))
        parts.append(_text(x, TOP - 16, name, "middle"))
        heights = np.array([_y(value) for value in column.values()])
        labels = spread(heights, LINE)
        theirs = {row: _y(v) for row, v in paper.get(name, {}).items() if row in column}
        for row, shift in zip(theirs, _asides([*theirs.values()]), strict=True):
            place = x - (14 + shift) * out, theirs[row]
            parts.append(_mark(row, *place, paint("ground")))
        asides = _asides(heights)
        for row, height, label, aside in zip(
            column, heights, labels, asides, strict=True
        ):
            color = f"var(--ab-arm-{row},{arm_style(row).color})"
            end = x + 22 * out
            at = x + aside * out
            parts.append(_line(f"M{at} {height:.1f}L{end} {label:.1f}", color))
            words = f"{arm_style(row).name} {number(column[row])}"
            anchor = "start" if side else "end"
            parts.append(_text(end + 3 * out, label + 4, words, anchor, color))
            parts.append(_mark(row, at, height, color))
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {HEIGHT}" aria-label="{escape(alt)}" '
        f'style="{looks}">{"".join(parts)}</svg>'
    )


def _asides(heights) -> list[int]:
    """Return how far marks step aside: every second one of those that are close."""
    aside, before = [0] * len(heights), None
    for i in np.argsort(heights):
        close = before is not None and heights[i] - heights[before] < STEP
        aside[i] = STEP if close and not aside[before] else 0
        before = i
    return aside


def _y(value: float) -> float:
    return TOP - (HEIGHT - TOP - BOTTOM) * value / 100


def _mark(row: str, x: float, y: float, fill: str) -> str:
    look = PALETTE["arms"][row]
    color = f"var(--ab-arm-{row},{look['light']})"
    return (
        f'<path d="{SHAPES[look["marker"]]}" transform="translate({x} {y:.1f})" '
        f'style="fill:{fill};stroke:{color}"/>'
    )
