"""The still of the ladder: both buildings, and Table 1 as rungs in each."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...builders import BUILDERS
from ...driving import PAPER, ROWS
from ...plotting.style import arm_style, count, number
from ..base import Still
from ..parts.building import draw_building
from ..parts.charts import Axis, Curve, line_chart
from ..parts.svg import WIDTH, picture
from .widget import READING, SIDES, Ladder

HEIGHT = 280  # of the ladders
CLOSE, ASIDE = 4, 0.07  # values of rungs of which one steps aside, and how far
X = Axis(0, 1, dict(enumerate(SIDES)), "hollow: the paper")
Y = Axis(-100, 0, {}, "mean value of a cell")


def draw(scene: Ladder) -> Still:
    """Return the buildings, and what policies are worth in both."""
    table = {side: {row: scene.table[side][row] for row in ROWS} for side in SIDES}
    is_papers = not set(scene.changed) & {"text", "target", *READING}
    paper = PAPER if is_papers else {}
    best = max(BUILDERS, key=table["target"].get)
    optimal = table["target"]["optimal"]
    more = 100 * (optimal - table["target"][best]) / -optimal
    texts = {side: _listed(column) for side, column in table.items()}
    caption = (
        f"Table 1 as a ladder: the mean value of a cell. In the source, where the "
        f"advice is made: {texts['source']}. In the target: {texts['target']}. "
        f"The best advice there, {arm_style(best).name}, pays {number(more, 0)} % "
        "more than the best driver."
    )
    frames = []
    for name, map_ in (("source", scene.source), ("target", scene.target)):
        rooms, goals = count(map_.n_rooms, "room"), count(len(map_.goals), "goal")
        frames.append(draw_building(map_, f"The {name}: {rooms} and {goals}."))
    frames.append(picture(_ladders(table, paper), caption, WIDTH, HEIGHT))
    rows = []
    for row in ROWS:
        cells = [
            number(of[side][row], 2) if of else "\u2013"
            for side in SIDES
            for of in (table, paper)
        ]
        rows.append((arm_style(row).name, *cells))
    head = ("policy", "source", "the paper", "target", "the paper")
    return Still(frames, caption, head, rows)


def _listed(column: Mapping[str, float]) -> str:
    order = sorted(column, key=column.get, reverse=True)
    return ", ".join(f"{arm_style(row).name} {number(column[row])}" for row in order)


def _ladders(table: Mapping, paper: Mapping) -> list[str]:
    """Return a rung of each policy in each building; the higher, the better."""
    ours, theirs = _rungs(table, 0), _rungs(paper, 0.11)
    curves = []
    for row, rungs in ours.items():
        first, last = (number(value) for _, value in rungs)
        name = f"{arm_style(row).name} {last}"
        curves.append(Curve(name, rungs, row, "", marks=1, start=first))
    curves += [Curve("", rungs, row, marks=1) for row, rungs in theirs.items()]
    options = {"height": HEIGHT, "left": 44, "right": 102}
    return line_chart(curves, X if paper else X._replace(name=""), Y, **options)


def _rungs(table: Mapping, inward: float) -> dict[str, list[tuple[float, float]]]:
    """Return (place, value) by policy in both buildings; close ones step aside."""
    rungs = {row: [] for row in ROWS if table}
    for i, side in enumerate(SIDES if table else ()):
        before, aside = -np.inf, 0.0
        for row in sorted(ROWS, key=table[side].get):
            value = table[side][row]
            aside = ASIDE if value - before < CLOSE and not aside else 0.0
            rungs[row].append((abs(i - inward - aside), value))
            before = value
    return rungs
