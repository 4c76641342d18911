"""The scene of page 7: Table 1 as a ladder whose rungs follow the map."""

from __future__ import annotations

from functools import lru_cache

import traitlets

from ...builders import BUILDERS
from ...driving import PAPER, ROWS, table1
from ...maps import Map, read_map
from ...navigation import navigation_tasks
from ...plotting.style import arm_style, count, number
from ..base import MapTrait, Still
from ..parts.drawn import DrawnScene
from ..parts.stills import building_svg
from .still import ladders_svg

TOOLS = ("wall", "door", "room", "corridor", "goal")
SIDES = ("source", "target")
READING = ("success", "actions", "near", "almost_near")


class Ladder(DrawnScene):
    """
    Table 1 as two ladders: edit the source, and the rungs move in both buildings.

    Parameters
    ----------
    source : Map, text or name, default the source map
        Where the pages of advice are written; later, the last legal one drawn.
    text : str
        The drawing of it, legal or not.
    target : Map, text or name, default the target map
    success : float, 0.5 to 1
        Probability that a move succeeds.
    actions : {"relational", "compass"}
    near, almost_near : int
        Largest distances of these features; no goal is almost near that is near.
    tool : {"wall", "door", "room", "corridor", "goal"}

    Examples
    --------
    >>> scene = Ladder(actions="compass")
    >>> scene
    Ladder(actions='compass')
    >>> round(scene.table["source"]["prob"], 1)  # as the browser finds it
    -81.6
    """

    scene = "ladder"
    drawn = "source"
    source = MapTrait("source").tag(sync=False)
    text = traitlets.Unicode(str(read_map("source"))).tag(sync=True)
    target = MapTrait("target")
    tool = traitlets.Enum(TOOLS, "wall").tag(sync=True)
    success = traitlets.CFloat(0.9, min=0.5, max=1.0).tag(sync=True)
    actions = traitlets.Enum(("relational", "compass"), "relational").tag(sync=True)
    near = traitlets.Int(5, min=0, max=20).tag(sync=True)
    almost_near = traitlets.Int(8, min=0, max=20).tag(sync=True)
    order = traitlets.Unicode("").tag(sync=True)
    gap = traitlets.Unicode("").tag(sync=True)

    @property
    def table(self) -> dict:
        """Table 1 of these buildings and options, as ``table1`` returns it."""
        near = max(self.near, self.almost_near)
        options = (self.success, self.actions, self.near, near)
        return _table(self.source, self.target, *options)

    def still(self) -> Still:
        """Return the source, its ladder, and both ladders."""
        table = {s: {row: self.table[s][row] for row in ROWS} for s in SIDES}
        is_papers = not set(self.changed) & {"text", "target", *READING}
        paper = PAPER if is_papers else {}
        best = max(BUILDERS, key=table["target"].get)
        optimal = table["target"]["optimal"]
        more = 100 * (optimal - table["target"][best]) / -optimal
        texts = {side: _listed(column) for side, column in table.items()}
        caption = (
            f"Table 1 as a ladder: the mean value of a cell. In the source, where the "
            f"pages are written: {texts['source']}. In the target: {texts['target']}. "
            f"The best page there, {arm_style(best).name}, pays {number(more, 0)} % "
            "more than the best driver."
        )
        map_ = self.source
        rooms, goals = count(map_.n_rooms, "room"), count(len(map_.goals), "goal")
        alt = f"The source: {rooms} and {goals}."
        only = {"source": table["source"]}
        frames = [
            building_svg(map_, alt),
            ladders_svg(only, paper, f"Source: {texts['source']}."),
            ladders_svg(table, paper, caption),
        ]
        rows = [
            (
                arm_style(row).name,
                *(
                    text
                    for side in SIDES
                    for text in (number(table[side][row], 2), _paper(paper, side, row))
                ),
            )
            for row in ROWS
        ]
        head = ("policy", "source", "the paper", "target", "the paper")
        return Still(frames, caption, head, rows)

    def __repr__(self) -> str:
        return super().__repr__().replace("text=...", f"source={self.source!r}")


def _listed(column: dict) -> str:
    order = sorted(column, key=column.get, reverse=True)
    return ", ".join(f"{arm_style(row).name} {number(column[row])}" for row in order)


def _paper(paper: dict, side: str, row: str) -> str:
    return number(paper[side][row], 2) if paper else "\u2013"


@lru_cache(maxsize=8)
def _table(source: Map, target: Map, success, actions, near, almost_near) -> dict:
    options = {"success": success, "actions": actions}
    options |= {"near": near, "almost_near": almost_near}
    return table1(*(navigation_tasks(map_, **options) for map_ in (source, target)))
