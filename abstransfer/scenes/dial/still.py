"""The still of the dial: the curve of driving, the curve of teaching, and both."""

from __future__ import annotations

import numpy as np

from ...plotting.style import number
from ..base import Still
from ..parts.betas import BETAS, DIAL, HEIGHT, driving_chart
from ..parts.charts import Axis, Curve, line_chart
from ..parts.svg import WIDTH, picture
from .widget import Dial

TRIED = (0.0, 0.5, 1.0, 8.0)  # of the second curve
DRIVES, TEACHES = "drives: mean value of a cell", "teaches: thousands of goals"


def draw(scene: Dial) -> Still:
    """Return two charts, and one below the other."""
    lines = {
        name: [(beta, scene.driving(beta, name)) for beta in BETAS]
        for name in ("source", "target")
    }
    teaches = [(beta, scene.teaching(beta)) for beta in TRIED]
    driver, driven = max(lines["target"], key=lambda point: point[1])
    teacher, goals = max(teaches, key=lambda point: point[1])
    curve = Curve(
        scene.strategy, [(beta, n / 1000) for beta, n in teaches], dash="", marks=1
    )
    most = float(50 * np.ceil(goals / 50_000))
    y = Axis(0, most, {0: "0", most: f"{most:g}"}, TEACHES)
    options = {"line": teacher, "note": f"peak {teacher:g}", "height": HEIGHT}
    drive = driving_chart(lines, driver, DRIVES)
    teach, below = (
        line_chart([curve], DIAL, y, top=top, **options) for top in (0, HEIGHT + 10)
    )
    caption = (
        f"One dial, two curves. In the target the policy drives best at \u03b2 = "
        f"{driver:g}, where a cell is worth {number(driven)}; of {len(TRIED)} "
        f"places tried it teaches best at \u03b2 = {teacher:g}: {goals:,} goals in "
        f"{scene.scale.steps / 1e6:g} million steps ({scene.strategy} advice until "
        f"step {scene.tau / 1e6:g} million, run {scene.luck})."
    )
    frames = [
        picture(drive, f"{DRIVES}: best at {driver:g}.", WIDTH, HEIGHT),
        picture(teach, f"{TEACHES}: best at {teacher:g}.", WIDTH, HEIGHT),
        picture([*drive, *below], caption, WIDTH, 2 * HEIGHT + 10),
    ]
    sides = ("source", "target")
    rows = [
        (f"{beta:g}", *(number(scene.driving(beta, s), 2) for s in sides), f"{n:,}")
        for beta, n in teaches
    ]
    head = ("\u03b2", "drives in the source", "in the target", "teaches: goals")
    return Still(frames, caption, head, rows)
