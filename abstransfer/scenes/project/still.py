"""The still of the project: the building, how advice drives in it, and the race."""

from __future__ import annotations

from ...plotting.style import arm_style, count, number
from ...project.setup import drives
from ..base import Still
from ..parts.building import draw_building
from ..parts.charts import Axis, Row, row_chart
from .widget import NAMES, Project

FROM = {"source": "the source", "target": "the target", "own": "it"}


def draw(scene: Project) -> Still:
    """Return the building, bars of driving, and dots of runs."""
    setup, goals = scene.setup, scene.run().goals
    none, values = goals["none"], drives(setup)
    race = {name: goals[name] - none for name in setup.guides}
    words, rows = [], [(arm_style("none").name, "", f"{none.mean():,.0f}", "")]
    for name, more in race.items():
        hurts = more.sum() < 0
        n = int((more < 0).sum() if hurts else (more > 0).sum())
        share = _signed(100 * more.sum() / max(none.sum(), 1), 1)
        words.append(
            f"{NAMES[name]} {'hurt' if hurts else 'helped'} in {n} ({share} %)"
        )
        drive, mean = number(values[name], 2), f"{goals[name].mean():,.0f}"
        rows.append((NAMES[name], drive, mean, _signed(more.mean())))
    runs = count(scene.lives, "run")
    map_ = scene.map
    rooms = f"{count(map_.n_rooms, 'room')} and {count(len(map_.goals), 'goal')}"
    caption = (
        f"A race in a building with {rooms}; the advice was made in "
        f"{FROM[scene.advice]}. A run without advice reaches {none.mean():,.0f} "
        f"goals. Of {runs} with the same luck, {', '.join(words)}: "
        f"{scene.strategy} advice."
    )
    best = max(setup.guides, key=values.get, default="optimal")
    told = f"How advice drives: {NAMES[best]} best, {number(values[best])}."
    bars = [Row(NAMES[name], number(v), name, bar=v) for name, v in values.items()]
    dots = [
        Row(NAMES[name], _signed(more.mean()), name, dots=more, mean=[more.mean()])
        for name, more in race.items()
    ]
    ends = [0.0, 1.0, *(x for more in race.values() for x in more)]
    axis = Axis(min(ends), max(ends), {0: "0"}, "goals more than without advice")
    frames = [
        draw_building(map_, f"A building with {rooms}."),
        row_chart(bars, Axis(-100, 0, {0: "0"}, "mean value of a cell"), told),
        row_chart(dots, axis, caption, tall=34),
    ]
    head = ("robot", "drives", "goals of a run", "more than without advice")
    return Still(frames, caption, head, rows)


def _signed(x: float, digits: int = 0) -> str:
    return f"{x:+,.{digits}f}".replace("-", "\u2212")
