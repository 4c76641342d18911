"""Still pictures of a land over two knobs, small and the same every time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import NamedTuple

import numpy as np
from contourpy import FillType, contour_generator

from ...plotting.style import number
from ..parts.curves import _line, _text
from ..parts.stills import paint

LEVELS = (-20, -10, -7, -5, -4.5, -4, -3.5, -3, -2.5, -2.2)
LEFT, TOP, SIDE = 34, 22, 200  # of the drawing
WIDTH, HEIGHT = LEFT + SIDE + 16, TOP + SIDE + 36


class Landscape(NamedTuple):
    """Heights over the knobs, and the two pages that are sure of themselves."""

    heights: np.ndarray  # (n, n), q from below
    tops: Mapping[str, float]  # at the upper right, at the lower left


def hill_svg(
    land: Landscape,
    alt: str,
    ways: Sequence[Sequence[tuple[float, float]]],
    ends: np.ndarray | None = None,
) -> str:
    """
    Return a land with its contours, climbs on it, and starts by where they end.

    Parameters
    ----------
    land : Landscape
    alt : str
        What the picture shows.
    ways : sequence of climbs, each a sequence of (p, q)
    ends : ndarray of bool, shape (10, 10), optional
        Whether the climb from the middle of each square ends at the upper right.
    """
    box = f"M{LEFT} {TOP}h{SIDE}v{SIDE}h-{SIDE}z"
    parts = [*_levels(land.heights), _line(box, paint("faint"))]
    if ends is not None:
        for is_left, fill, shape in (
            (True, "faint", "m-3 2h6l-3-5z"),
            (False, "ground", "m-3-2h6l-3 5z"),
        ):
            places = (np.argwhere(ends == is_left)[:, ::-1] + 0.5) / 10
            d = "".join(f"M{_at(*place)}{shape}" for place in places)
            look = f"fill:{paint(fill)};stroke:{paint('faint')}"
            parts.append(f'<path d="{d}" style="{look}"/>')
    for way in ways:
        places = [_at(*knobs) for knobs in way]
        ink = paint("ink")
        dots = _line("".join(f"M{place}h.01" for place in places), ink, "", 4)
        parts += [
            _line("M" + "L".join(places), ink, "", 1.4),
            dots.replace("/>", ' stroke-linecap="round"/>'),
        ]
        x, y = places[0].split()
        look = f"fill:{paint('ground')};stroke:{ink}"
        parts.append(f'<circle cx="{x}" cy="{y}" r="4.5" style="{look}"/>')
    (first, high), (second, low) = land.tops.items()
    right, lower = LEFT + SIDE, TOP + SIDE
    parts += [
        _text(right, TOP - 7, f"{first} {number(high, 2)}", "end"),
        _text(LEFT, lower + 13, f"{second} {number(low, 2)}", "start"),
        _text(right, lower + 13, "1", "end"),
        _text(LEFT - 5, TOP + 9, "1", "end"),
        _text(LEFT + SIDE / 2, lower + 29, "p: left in the hall", "middle"),
        _text(LEFT - 22, TOP - 7, "q: up on a landing", "start"),
    ]
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {HEIGHT}" aria-label="{escape(alt)}" '
        f'style="{looks}">{"".join(parts)}</svg>'
    )


def _at(p: float, q: float) -> str:
    return f"{LEFT + SIDE * p:.1f} {TOP + SIDE * (1 - q):.1f}"


def _levels(heights: np.ndarray) -> list[str]:
    """Return one shape per level: where the land is at least as high."""
    knobs = np.linspace(0, 1, len(heights))
    land = contour_generator(knobs, knobs, heights, fill_type=FillType.OuterOffset)
    parts = []
    for level in LEVELS:
        d = ""
        for points, offsets in zip(*land.filled(level, np.inf), strict=True):
            rims = np.split(points, offsets[1:-1])
            d += "".join(f"M{'L'.join(_at(*knobs) for knobs in rim)}z" for rim in rims)
        style = f"fill:{paint('high')};fill-opacity:.13;stroke:{paint('faint')}"
        parts.append(f'<path d="{d}" style="{style};stroke-width:.5"/>')
    return parts
