"""Still pictures of a project: bars of driving, dots of a race."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from ...plotting.style import PALETTE, arm_style, number
from ..ladder.still import SHAPES
from ..parts.curves import _line, _text
from ..parts.stills import paint

WIDTH, ROW = 300, 26  # units of the drawing
LEFT, RIGHT = 62, 50


def bars_svg(bars: Mapping[str, tuple[str, float]], alt: str) -> str:
    """Return values from -100 to 0 by name as bars; each with its arm."""
    parts = []
    for i, (name, (arm, value)) in enumerate(bars.items()):
        y, color = i * ROW + 4, _color(arm)
        right = WIDTH - RIGHT
        end = right + (right - LEFT) * value / 100  # as in the scene: a cost
        parts += [
            _text(0, y + 13, name, "start", color),
            f'<path d="M{right} {y + 3}H{end:.1f}v13H{right}z" style="fill:{color}"/>',
            _text(right + 6, y + 13, number(value), "start"),
        ]
    return _svg(parts, len(bars) * ROW + 4, alt)


def dots_svg(rows: Mapping[str, tuple[str, Sequence[float]]], alt: str) -> str:
    """Return differences by name, a hollow mark each, the mean filled."""
    every = np.array([0.0, *(x for _, more in rows.values() for x in more)])
    low, high = every.min(), max(every.max(), 1.0)

    def x(value):
        return LEFT + (WIDTH - LEFT - RIGHT) * (value - low) / (high - low)

    parts, tall = [], ROW + 14
    parts.append(_line(f"M{x(0):.1f} 0V{len(rows) * tall}", paint("ink"), "4 3"))
    for i, (name, (arm, more)) in enumerate(rows.items()):
        y, mean = i * tall + 6, float(np.mean(more))
        parts.append(_text(0, y + 16, name, "start", _color(arm)))
        for life, value in enumerate(more):
            parts.append(_mark(arm, x(value), y + 14 * life / len(more), False))
        parts.append(_mark(arm, x(mean), y + 24, True))
        words = f"{mean:+,.0f}".replace("-", "\u2212")
        parts.append(_text(WIDTH - RIGHT + 8, y + 28, words, "start"))
    bottom = len(rows) * tall + 16
    parts.append(_text(WIDTH / 2, bottom, "goals more than without advice", "middle"))
    return _svg(parts, bottom + 6, alt)


def _style(arm: str) -> str:
    return "uniform_available" if arm == "eager" else arm


def _color(arm: str) -> str:
    arm = _style(arm)
    return f"var(--ab-arm-{arm},{arm_style(arm).color})"


def _mark(arm: str, x: float, y: float, filled: bool) -> str:
    shape, color = SHAPES[PALETTE["arms"][_style(arm)]["marker"]], _color(arm)
    size = "" if filled else " scale(.7)"
    return (
        f'<path d="{shape}" transform="translate({x:.1f} {y:.1f}){size}" '
        f'style="fill:{color if filled else paint("ground")};stroke:{color}"/>'
    )


def _svg(parts: list[str], height: float, alt: str) -> str:
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {height}" aria-label="{escape(alt)}" '
        f'style="{looks}">{"".join(parts)}</svg>'
    )
