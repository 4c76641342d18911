"""
A small kit to draw stills with: SVG as text, the same bytes every time.

A still stands for a scene where its script does not run: before it does, in print,
and in a notebook that was not run.  Colours are the palette's, as variables that
the style of the scenes sets for both themes, with the light colour where there is none.
"""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import NamedTuple

from ...plotting.style import COLOR, PALETTE, arm_style
from ..files import EXTRA

WIDTH = 300  # of most drawings, in their own units
MARKS = {
    "circle": "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0",
    "cross": "M-4-2L-2-4 0-2 2-4 4-2 2 0 4 2 2 4 0 2-2 4-4 2-2 0Z",
    "square": "M-3.5-3.5h7v7h-7Z",
    "triangle": "M0-4.6L4 2.6H-4Z",
    "diamond": "M0-5L5 0 0 5-5 0Z",
    "plus": "M-1.2-4h2.4v2.8H4v2.4H1.2V4h-2.4V1.2H-4v-2.4h2.8Z",
    "star": "M0-5L1.5-1.5 5-1.5 2 1 3.2 5 0 2.6-3.2 5-2 1-5-1.5-1.5-1.5Z",
}

SAME = dict.fromkeys(("eager", "yours"), "uniform_available")  # in the palette


class Look(NamedTuple):
    """How an arm looks in a still."""

    name: str  # as written beside its mark
    color: str  # as `paint` takes it
    mark: str  # a path around its middle
    dash: str
    filled: bool  # whether its marks and boxes are

    @property
    def face(self) -> str:
        """Colour inside its marks and boxes."""
        return self.color if self.filled else "ground"


def look_of(arm: str) -> Look:
    """
    Return how an arm looks: a builder, with or without a strategy, or another robot.

    >>> look_of("nd-soft")._replace(mark="")
    Look(name='ND soft', color='arm-nd', mark='', dash='5 2', filled=False)
    """
    arm = SAME.get(arm, arm)
    style, builder = arm_style(arm), arm.split("-")[0]
    dash = "" if style.dash == "solid" else " ".join(map(str, style.dash[1]))
    mark = MARKS[PALETTE["arms"][builder]["marker"]]
    return Look(style.name, f"arm-{builder}", mark, dash, style.filled)


def paint(name: str) -> str:
    """
    Return a colour of the palette as a variable, the light one by default.

    >>> paint("arm-nd"), paint("none")
    ('var(--ab-arm-nd,#0072B2)', 'none')
    """
    if name == "none":
        return name
    if name.startswith("arm-"):
        light = PALETTE["arms"][name.removeprefix("arm-")]["light"]
    else:
        light = COLOR[name] if name in COLOR else EXTRA[name][0]
    return f"var(--ab-{name},{light})"


def picture(parts: Iterable[str], alt: str, width: float, height: float, edge=0) -> str:
    """Return a picture of its parts, `edge` wider on every side, with its alt text."""
    box = f"{-edge} {-edge} {at(width + 2 * edge, height + 2 * edge)}"
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="{box}" aria-label="{escape(alt)}" '
        f'style="{looks}">{"".join(parts)}</svg>'
    )


def path(
    d: str,
    stroke: str = "none",
    width: float = 1,
    *,
    fill: str = "none",
    dash: str = "",
    move: tuple[float, float] | None = None,
    more: str = "",
) -> str:
    """
    Return a path, moved by (x, y), or nothing where `d` is empty.

    `stroke` and `fill` are names of colours, `more` is further style.

    >>> path("M0 0h9", "ink")
    '<path d="M0 0h9" style="fill:none;stroke:var(--ab-ink,#1A1A1A)"/>'
    """
    if not d:
        return ""
    style = [f"fill:{paint(fill)}"]
    if stroke != "none":
        style.append(f"stroke:{paint(stroke)}")
        style += [f"stroke-width:{width}"] * (width != 1)
        style += [f"stroke-dasharray:{dash}"] * bool(dash)
    style += [more] * bool(more)
    place = f' transform="translate({at(*move)})"' if move else ""
    return f'<path d="{d}" style="{";".join(style)}"{place}/>'


def text(x: float, y: float, words: str, anchor: str = "", color: str = "") -> str:
    """
    Return a text on the line y; its anchor is that of what is around by default.

    >>> text(3, 9.04, "a < b", "end")
    '<text x="3" y="9" style="text-anchor:end">a &lt; b</text>'
    """
    if not words:
        return ""
    style = f"text-anchor:{anchor}" if anchor else ""
    style += f"{';' if style else ''}fill:{paint(color)}" if color else ""
    look = f' style="{style}"' if style else ""
    return f'<text x="{at(x)}" y="{at(y)}"{look}>{escape(words)}</text>'


def group(parts: Iterable[str], style: str) -> str:
    """Return parts with a common style, or nothing where there are none."""
    inside = "".join(parts)
    return f'<g style="{style}">{inside}</g>' if inside else ""


def mark(arm: str, x: float, y: float, *, filled: bool | None = None) -> str:
    """Return the mark of an arm, filled or hollow as the arm's are by default."""
    look = look_of(arm)
    filled = look.filled if filled is None else filled
    fill = look.color if filled else "ground"
    return path(look.mark, look.color, fill=fill, move=(x, y))


def dots(places: Iterable[tuple[float, float]], color: str, width: float) -> str:
    """Return round dots of a width."""
    d = "".join(f"M{at(*place)}h.01" for place in places)
    return path(d, color, width, more="stroke-linecap:round")


def through(places: Iterable[tuple[float, float]]) -> str:
    """
    Return the path through places.

    >>> through([(0, 1), (2.55, -0.01)])
    'M0 1L2.5 0'
    """
    return "M" + "L".join(at(*place) for place in places)


def at(*numbers: float) -> str:
    """
    Return numbers to a tenth, as a path holds them.

    >>> at(1.0, -0.04, 2.25)
    '1 0 2.2'
    """
    return " ".join(f"{round(float(n), 1) + 0.0:g}" for n in numbers)


def short(n: float) -> str:
    """
    Return a number of goals in few characters.

    >>> short(11_480), short(87)
    ('11.5k', '87')
    """
    return f"{n / 1000:.1f}k" if n >= 1000 else f"{n:.0f}"
