"""The still of the scene to copy: three moments of the share of heads."""

from __future__ import annotations

from ...plotting.style import count, number
from ..base import Still
from ..parts.charts import Axis, Curve, line_chart
from ..parts.svg import WIDTH, picture
from .widget import MOST, Template

HEIGHT = 200
X = Axis(1, MOST, {1: "1", MOST: str(MOST)}, "throws")
Y = Axis(0, 1, {0: "0", 0.5: "0.5", 1: "1"}, "share of heads")


def draw(scene: Template) -> Still:
    """Return the throws that are looked at, half of all, and all."""
    shares, last = scene.shares, scene.shares[-1]
    moments = (scene.n, MOST // 2, MOST)
    caption = (
        f"A coin is thrown: after {count(scene.n, 'throw')} the share of heads is "
        f"{number(shares[scene.n - 1], 2)}, after {MOST} it is {number(last, 2)} "
        f"(luck {scene.luck})."
    )
    rows = [(n, number(shares[n - 1], 3)) for n in sorted(set(moments))]
    frames = [_frame(shares[:n]) for n in moments]
    return Still(frames, caption, ("throws", "share of heads"), rows)


def _frame(shares) -> str:
    """Return the curve of some shares."""
    curve = Curve("heads", list(enumerate(shares, 1)))
    alt = f"The share of heads after 1 to {len(shares)} throws."
    return picture(line_chart([curve], X, Y, height=HEIGHT), alt, WIDTH, HEIGHT)
