"""Still pictures of curves over the dial beta, small and the same every time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import NamedTuple

from ...plotting.style import COLOR, number
from .curves import BOTTOM, LEFT, RIGHT, TOP, WIDTH, _line, _text
from .stills import paint

HEIGHT = 130  # of one panel
LAST = 8.0  # end of the dial


class Panel(NamedTuple):
    """One drawing: curves by name, dashed if not the last, and where one peaks."""

    title: str
    curves: Mapping[str, Sequence[tuple[float, float]]]
    low: float
    high: float
    peak: float

    def parts(self, top: int) -> list[str]:
        """Return the drawing, its upper end at `top`."""
        right, upper, lower = WIDTH - RIGHT, top + TOP + 14, top + HEIGHT - BOTTOM

        def place(point):
            share = (point[1] - self.low) / (self.high - self.low)
            x = LEFT + (right - LEFT) * point[0] / LAST
            return f"{x:.1f} {lower - (lower - upper) * share:.1f}"

        x_peak = place((self.peak, self.low)).split()[0]
        parts = [
            _text(LEFT, top + TOP, self.title, "start"),
            _line(f"M{LEFT} {upper}V{lower}H{right}", paint("faint")),
            _line(f"M{x_peak} {upper}V{lower}", paint("ink"), "4 3"),
            _text(float(x_peak) + 4, upper + 9, f"peak {self.peak:g}", "start"),
        ]
        for beta in (0, 2, 4, 6, 8):
            x = float(place((beta, 0.0)).split()[0])
            parts.append(_text(x, lower + 13, f"{beta}", "middle"))
        for value in (self.low, self.high):
            y = float(place((0, value)).split()[1])
            parts.append(_text(LEFT - 4, y + 4, number(value, 0), "end"))
        parts.append(_text((LEFT + right) / 2, lower + 25, "dial \u03b2", "middle"))
        color = f"var(--ab-arm-none,{COLOR['ink']})"
        for i, (name, points) in enumerate(self.curves.items()):
            places = [place(point) for point in points]
            dash = "5 2" if i < len(self.curves) - 1 else ""
            parts.append(_line("M" + "L".join(places), color, dash, 2))
            if len(points) < 9:
                dots = "".join(f"M{at}h.01" for at in places)
                parts.append(_line(dots, color, "", 6).replace("/>", _ROUND))
            end = float(places[-1].split()[1])
            parts.append(_text(right + 5, end + 4, name, "start", color))
        return parts


_ROUND = ' stroke-linecap="round"/>'


def panels_svg(panels: Sequence[Panel], alt: str) -> str:
    """Return panels, one below the other, as SVG."""
    parts = [part for i, panel in enumerate(panels) for part in panel.parts(i * HEIGHT)]
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {HEIGHT * len(panels)}" '
        f'aria-label="{escape(alt)}" style="{looks}">{"".join(parts)}</svg>'
    )
