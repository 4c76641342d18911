"""The scene of page 7: Table 1 as a ladder whose rungs follow the map."""

from __future__ import annotations

from functools import lru_cache

import traitlets

from ...driving import table1
from ...maps import Map, read_map
from ...navigation import navigation_tasks
from ..base import MapTrait
from ..parts.drawn import DrawnScene

TOOLS = ("wall", "door", "room", "corridor", "goal")
SIDES = ("source", "target")
READING = ("success", "actions", "near", "almost_near")


class Ladder(DrawnScene):
    """
    Table 1 as two ladders: edit the source, and the rungs move in both buildings.

    Parameters
    ----------
    source : Map, text or name, default the source map
        Where the advice is made; later, the last legal one drawn.
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
    target = MapTrait("target").tag(local=True)  # Python's to change
    tool = traitlets.Enum(TOOLS, "wall").tag(sync=True)
    success = traitlets.CFloat(0.9, min=0.5, max=1.0).tag(sync=True)
    actions = traitlets.Enum(("relational", "compass"), "relational").tag(sync=True)
    near = traitlets.Int(5, min=0, max=20).tag(sync=True)
    almost_near = traitlets.Int(8, min=0, max=20).tag(sync=True)
    order = traitlets.Unicode("").tag(sync=True, local=True)
    gap = traitlets.Unicode("").tag(sync=True, local=True)

    @property
    def table(self) -> dict:
        """Table 1 of these buildings and options, as ``table1`` returns it."""
        near = max(self.near, self.almost_near)
        options = (self.success, self.actions, self.near, near)
        return _table(self.source, self.target, *options)

    def __repr__(self) -> str:
        return super().__repr__().replace("text=...", f"source={self.source!r}")


@lru_cache(maxsize=8)
def _table(source: Map, target: Map, success, actions, near, almost_near) -> dict:
    options = {"success": success, "actions": actions}
    options |= {"near": near, "almost_near": almost_near}
    return table1(*(navigation_tasks(map_, **options) for map_ in (source, target)))
