"""The scene of page 1: draw a building, and see what becomes of it as you draw."""

from __future__ import annotations

import traitlets

from ...builders import abstract_policies
from ...driving import ROWS, column
from ...maps import read_map
from ...navigation import NavigationTasks, navigation_tasks
from ..base import MapTrait
from ..parts.drawn import DrawnScene, read_drawing
from ..parts.svg import look_of

TOOLS = ("walk", "wall", "door", "room", "corridor", "goal")
BET = {
    "question": "Bet first, then edit: which row moves most when the building changes?",
    "options": {row: look_of(row).name for row in ROWS},
}
SHOWN = ("plain", "states", "nd", "prob", "grad", "optimal")


class Studio(DrawnScene):
    """
    Map Studio: draw walls, doors, rooms and goals; walk a robot; watch Table 1.

    Parameters
    ----------
    map : Map, text or name, default the source map
        The building; afterwards, the last legal one that was drawn.
    text : str
        The drawing, legal or not.
    tool : {"walk", "wall", "door", "room", "corridor", "goal"}
    show : {"plain", "states", "nd", "prob", "grad", "optimal"}
        What lies over the cells: abstract states, or a policy and its values.
    task : int
        Which of the map's goals, counted from 0.
    start : int
        Cell that the robot starts in.
    walk : str
        Where it was sent: letters N, E, S, W steer it; the number of an action is what
        a robot can say, and chance takes a way.  One move in ten fails.

    Examples
    --------
    >>> scene = Studio(map="target")
    >>> scene
    Studio(map=Map(18 x 30 cells, 35 rooms, 35 goals))
    >>> scene.text = "+---+\\n|  .|\\n+---+"
    >>> scene.problem
    'row 2, column 3: a room opens on the corridor; put a wall or a door there'
    >>> scene.map  # still the last legal one
    Map(18 x 30 cells, 35 rooms, 35 goals)
    >>> scene.map = "source"  # the browser shows it
    >>> round(scene.row["nd"], 2)  # the row of Table 1, as the browser finds it
    -44.06
    """

    scene = "studio"
    constants = {"bets": {"bet": BET}}
    map = MapTrait("source").tag(sync=False)
    text = traitlets.Unicode(str(read_map("source"))).tag(sync=True)
    tool = traitlets.Enum(TOOLS, "walk").tag(sync=True)
    show = traitlets.Enum(SHOWN, "plain").tag(sync=True)
    task = traitlets.Int(7, min=0).tag(sync=True)
    start = traitlets.Int(80, min=0).tag(sync=True)
    walk = traitlets.Unicode("EENNW").tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)

    @property
    def problem(self) -> str:
        """Why the drawing is no legal building yet; empty if it is one."""
        return read_drawing(self.text)[1]

    @property
    def tasks(self) -> NavigationTasks:
        """The tasks of the map, one per goal."""
        return navigation_tasks(self.map)

    @property
    def row(self) -> dict:
        """The counts of the map, and its column of Table 1, built and driven in it."""
        return column(self.tasks, abstract_policies(self.tasks))

    def __repr__(self) -> str:
        return super().__repr__().replace("text=...", f"map={self.map!r}")
