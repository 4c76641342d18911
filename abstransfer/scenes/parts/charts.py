"""The charts of stills: curves named at their ends, and rows over one axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ...plotting.style import number, spread
from .svg import WIDTH, look_of, mark, path, picture, short, text, through

LEFT, RIGHT, TOP, BOTTOM = 34, 66, 28, 34  # margins of curves
LINE = 13  # height of a name
NAMES, NUMBERS, TITLE = 98, 54, 18  # margins of rows


class Axis(NamedTuple):
    """The ends of an axis, its ticks with their words, and its name."""

    low: float
    high: float
    ticks: Mapping[float, str]
    name: str

    def share(self, value) -> float:
        """Return how far from the low to the high end a value is, 0 to 1."""
        return (value - self.low) / (self.high - self.low)


class Curve(NamedTuple):
    """Points (x, y), named at the end; without a name, hollow marks and no line."""

    name: str
    points: Sequence[tuple[float, float]]
    arm: str = "none"
    dash: str | None = None  # instead of the arm's
    marks: int = 0  # points from mark to mark; 0: no marks
    start: str = ""  # words to the left of the first point


class Row(NamedTuple):
    """A name, words at the other end, and what is drawn between them."""

    name: str
    words: str = ""
    arm: str = ""
    bar: float | None = None  # from 0
    box: Sequence[float] = ()  # of which extremes, quartiles and median are drawn
    dots: Sequence[float] = ()
    mean: Sequence[float] = ()  # with the ends of its interval, if there is one


def line_chart(
    curves: Sequence[Curve],
    x: Axis,
    y: Axis,
    *,
    line: float | None = None,
    note: str = "",
    top: float = 0,
    height: float = 200,
    left: float = LEFT,
    right: float = RIGHT,
) -> list[str]:
    """
    Return the parts of a chart that is `height` high, its upper end at `top`.

    At `line`, a value of the x axis, stands a vertical line with a note.  Words
    beside the curves have margins of `left` and `right`.
    """
    end, upper, lower = WIDTH - right, top + TOP, top + height - BOTTOM

    def place(x_value, y_value):
        across, up = x.share(x_value), y.share(y_value)
        return left + (end - left) * across, lower - (lower - upper) * up

    parts = [
        text(0, top + 10, y.name),
        text((left + end) / 2, lower + 29, x.name, "middle"),
        path(f"M{left} {upper}V{lower}H{end}", "faint"),
    ]
    for value, words in x.ticks.items():
        parts.append(text(place(value, y.low)[0], lower + 13, words, "middle"))
    for value, words in y.ticks.items():
        parts.append(text(left - 4, place(x.low, value)[1] + 4, words, "end"))
    if line is not None:
        ends = [place(line, value) for value in (y.low, y.high)]
        parts.append(path(through(ends), "ink", dash="4 3"))
        parts.append(text(ends[1][0], upper - 4, note))
    named = [curve for curve in curves if curve.name]
    firsts, lasts = (
        _apart([place(*curve.points[i])[1] for curve in named], upper) for i in (0, -1)
    )
    for curve, first, last in zip(named, firsts, lasts, strict=True):
        look = look_of(curve.arm)
        dash = look.dash if curve.dash is None else curve.dash
        way = through(place(*point) for point in curve.points)
        parts += [
            path(way, look.color, 2, dash=dash),
            text(left - 7, first + 4, curve.start, "end", look.color),
            text(end + 7, last + 4, curve.name, color=look.color),
        ]
    for curve in curves:
        filled = look_of(curve.arm).filled and bool(curve.name)
        marked = curve.points[curve.marks - 1 :: curve.marks] if curve.marks else []
        parts += [mark(curve.arm, *place(*at), filled=filled) for at in marked]
    return parts


def _apart(heights: Sequence[float], least: float) -> np.ndarray:
    """Return heights of names near those of their curves, none above the least."""
    names = spread(np.array(heights), LINE)
    return names + max(0, least - names.min())


def learning_curves(
    runs: Mapping[str, tuple[str, np.ndarray]],
    alt: str,
    *,
    steps: int,
    line: int | None = None,
) -> str:
    """
    Return the curves of runs as SVG; each by its name: an arm, goals (B,) by window.

    A run has `steps` steps; at step `line` stands a vertical line.
    """
    n = len(next(iter(runs.values()))[1])
    top = max(1.0, max(float(np.max(goals)) for _, goals in runs.values()))
    millions = {step: f"{step / 1e6:g} M" for step in np.linspace(0, steps, 4)[1:]}
    ends = steps * np.arange(1, n + 1) / n
    curves = [
        Curve(name, [*zip(ends, goals, strict=True)], arm, marks=n // 6)
        for name, (arm, goals) in runs.items()
    ]
    x = Axis(0, steps, millions, "steps")
    ticks = {0: "0", top: short(top)}
    y = Axis(0, top, ticks, f"goals reached in {steps // n:,} steps")
    return picture(line_chart(curves, x, y, line=line), alt, WIDTH, 200)


def row_chart(rows: Sequence[Row], x: Axis, alt: str, tall: float = 26) -> str:
    """Return rows over one axis as SVG, each `tall` high."""
    bottom = TITLE + tall * len(rows)
    parts = [text(0, 10, x.name)]

    def place(value):
        return round(NAMES + (WIDTH - NAMES - NUMBERS) * x.share(value), 1)

    for value, words in x.ticks.items():
        parts.append(path(f"M{place(value):g} {TITLE}V{bottom}", "faint"))
        parts.append(text(place(value), bottom + 13, words, "middle"))
    for i, row in enumerate(rows):
        y, look = TITLE + tall * i + 10, look_of(row.arm or "none")
        color = look.color if row.arm else "ink"
        parts.append(mark(row.arm, 6, y) if row.arm else "")
        parts.append(text(15 if row.arm else 0, y + 4, row.name, color=color))
        parts.append(text(WIDTH, y + 4, row.words, "end"))
        if row.bar is not None:
            bar = f"M{place(0):g} {y}H{place(row.bar):g}"
            parts.append(path(bar, color, 10))
        if len(row.box):
            quarters = map(place, np.percentile(row.box, range(0, 101, 25)))
            least, first, middle, third, most = (f"{x:g}" for x in quarters)
            box = f"M{first} {y - 5}H{third}v10H{first}z"
            parts += [
                path(f"M{least} {y}H{most}", color),
                path(box, color, fill=look.face),
                path(f"M{middle} {y - 5}v10", "ground" if look.filled else color, 1.5),
            ]
        for j, value in enumerate(row.dots):
            y_dot = y - 5 + 10 * j / len(row.dots)
            parts.append(mark(row.arm, place(value), y_dot, filled=False))
        if len(row.mean):
            mean, *interval = (f"{place(value):g}" for value in row.mean)
            ends = "M{} {y}H{}".format(*interval, y=y + 10) if interval else ""
            parts.append(path(f"{ends}M{mean} {y + 7}v6", "ink", 1.5))
    return picture(parts, alt, WIDTH, bottom + 18)


def tens(values: Sequence[float], name: str) -> Axis:
    """
    Return an axis from a ten below to a ten above all values.

    >>> tens([-81.03, -34.8], "value").ticks
    {-90.0: '−90', -30.0: '−30'}
    """
    low, high = 10 * np.floor(min(values) / 10), 10 * np.ceil(max(values) / 10)
    ends = (float(low), float(high))
    return Axis(*ends, {end: number(end, 0) for end in ends}, name)
