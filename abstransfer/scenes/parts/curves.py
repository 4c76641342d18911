"""Still pictures of learning curves, small and the same every time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from ...plotting.style import PALETTE, arm_style, spread
from .stills import paint

WIDTH, HEIGHT = 300, 200  # units of the drawing
LEFT, RIGHT, TOP, BOTTOM = 34, 66, 26, 34  # margins
LINE = 13  # height of a label
MARKS = {
    "circle": "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0",
    "cross": "M-4-2L-2-4 0-2 2-4 4-2 2 0 4 2 2 4 0 2-2 4-4 2-2 0Z",
    "square": "M-3.5-3.5h7v7h-7Z",
    "triangle": "M0-4.6L4 2.6H-4Z",
    "diamond": "M0-5L5 0 0 5-5 0Z",
    "plus": "M-1.2-4h2.4v2.8H4v2.4H1.2V4h-2.4V1.2H-4v-2.4h2.8Z",
}


def curves_svg(
    curves: Mapping[str, Sequence[float]],
    alt: str,
    *,
    names: Mapping[str, str],
    steps: int,
    mark: int | None = None,
) -> str:
    """
    Return learning curves as SVG, named at their ends.

    Parameters
    ----------
    curves : dict from arm to goals per window, (B,)
    alt : str
        What the picture shows.
    names : dict from arm to str
    steps : int
        Steps of a run.
    mark : int, optional
        Step at which a vertical line stands.
    """
    top = max(1.0, max(float(np.max(goals)) for goals in curves.values()))
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM

    def x(step):
        return LEFT + (right - LEFT) * step / steps

    def y(goals):
        return bottom - (bottom - TOP) * goals / top

    parts = [_line(f"M{LEFT} {TOP}V{bottom}H{right}", paint("faint"))]
    window = steps // len(next(iter(curves.values())))
    parts.append(_text(0, 10, f"goals reached in {window:,} steps", "start"))
    for step in np.linspace(0, steps, 4)[1:]:
        parts.append(_text(x(step), bottom + 13, f"{step / 1e6:g} M", "middle"))
    for goals in (0, top):
        parts.append(_text(LEFT - 4, y(goals) + 4, short(goals), "end"))
    parts.append(_text((LEFT + right) / 2, HEIGHT - 5, "steps", "middle"))
    if mark is not None:
        parts.append(_line(f"M{x(mark):.1f} {TOP}V{bottom}", paint("ink"), "4 3"))
    ends = spread(np.array([y(goals[-1]) for goals in curves.values()]), LINE)
    ends += max(0, TOP - ends.min())
    for (arm, goals), end in zip(curves.items(), ends, strict=True):
        n, style = len(goals), arm_style(arm)
        color = f"var(--ab-arm-{arm.split('-')[0]},{style.color})"
        points = [
            f"{x(steps * (i + 1) / n):.1f} {y(g):.1f}" for i, g in enumerate(goals)
        ]
        dash = " ".join(map(str, style.dash[1])) if style.dash != "solid" else ""
        parts.append(_line("M" + "L".join(points), color, dash, 2))
        fill = color if style.filled else paint("ground")
        look = f"fill:{fill};stroke:{color}"
        for place in points[n // 6 - 1 :: max(1, n // 6)]:
            mark_of = MARKS[PALETTE["arms"][arm.split("-")[0]]["marker"]]
            move = f'transform="translate({place})"'
            parts.append(f'<path d="{mark_of}" {move} style="{look}"/>')
        parts.append(_text(right + 7, end + 4, names[arm], "start", color))
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {HEIGHT}" aria-label="{escape(alt)}" '
        f'style="{looks}">{"".join(parts)}</svg>'
    )


def short(n: float) -> str:
    """
    Return a number of goals in few characters.

    >>> short(11_480), short(87)
    ('11.5k', '87')
    """
    return f"{n / 1000:.1f}k" if n >= 1000 else f"{n:.0f}"


def _line(d: str, color: str, dash: str = "", width: float = 1) -> str:
    dashes = f";stroke-dasharray:{dash}" if dash else ""
    style = f"fill:none;stroke:{color};stroke-width:{width}{dashes}"
    return f'<path d="{d}" style="{style}"/>'


def _text(x: float, y: float, text: str, anchor: str, color: str = "") -> str:
    fill = f";fill:{color}" if color else ""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" style="text-anchor:{anchor}{fill}">'
        f"{escape(text)}</text>"
    )
