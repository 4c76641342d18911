"""Still pictures of box plots, small and the same every time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from ...experiments.stats import Interval
from ...plotting.style import PALETTE, arm_style
from ..parts.curves import MARKS, _line, _text, short
from ..parts.stills import paint

WIDTH, ROW = 300, 26  # units of the drawing
LEFT, RIGHT, TOP = 98, 44, 16  # margins


def boxes_svg(
    goals: Mapping[str, np.ndarray],
    means: Mapping[str, Interval],
    ends: Sequence[float],
) -> str:
    """
    Return box plots of goals (n,) by arm, and below each its mean with its interval.

    `ends` are the ends of the axis.
    """
    low, high = ends
    n = len(next(iter(goals.values())))

    def x(goals):
        return f"{LEFT + (WIDTH - LEFT - RIGHT) * (goals - low) / (high - low):.1f}"

    bottom = TOP + ROW * len(goals)
    parts = [
        _text(0, 10, f"goals of a life, {n} lives", "start"),
        _line(f"M{LEFT} {bottom}H{WIDTH - RIGHT}", paint("faint")),
    ]
    for end in ends:
        parts.append(_text(float(x(end)), bottom + 13, short(end), "middle"))
    for i, (arm, runs) in enumerate(goals.items()):
        y, style = TOP + ROW * i + 10, arm_style(arm)
        builder = arm.split("-")[0]
        color = f"var(--ab-arm-{builder},{style.color})"
        face = f"fill:{color if style.filled else paint('ground')};stroke:{color}"
        mark = MARKS[PALETTE["arms"][builder]["marker"]]
        parts.append(f'<path d="{mark}" transform="translate(6 {y})" style="{face}"/>')
        parts.append(_text(15, y + 4, style.name, "start", color))
        least, first, middle, third, most = map(
            x, np.percentile(runs, range(0, 101, 25))
        )
        parts.append(_line(f"M{least} {y}H{most}", color))
        parts.append(f'<path d="M{first} {y - 5}H{third}v10H{first}Z" style="{face}"/>')
        line = paint("ground") if style.filled else color
        parts.append(_line(f"M{middle} {y - 5}v10", line, width=1.5))
        mean, *interval = map(x, means[arm])
        bar = f"M{interval[0]} {y + 10}H{interval[1]}M{mean} {y + 7}v6"
        parts.append(_line(bar, paint("ink"), width=1.5))
        end = short(float(means[arm].estimate))
        parts.append(_text(WIDTH, y + 4, end, "end"))
    best = max(means, key=lambda arm: means[arm].estimate)
    alt = (
        f"Box plots of the goals of {n} lives, nine arms, with the mean and its "
        f"interval. Best: {arm_style(best).name}, {short(means[best].estimate)}."
    )
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {bottom + 18}" '
        f'aria-label="{escape(alt)}" style="{looks}">{"".join(parts)}</svg>'
    )
