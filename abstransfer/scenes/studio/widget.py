"""The scene of page 1: draw a building, and see what becomes of it as you draw."""

from __future__ import annotations

import traitlets

from ...builders import BUILDERS, abstract_policies
from ...driving import PAPER, ROWS, column
from ...maps import Map, read_map
from ...navigation import NavigationTasks, navigation_tasks
from ...plotting.style import arm_style, count, number
from ...solvers import evaluate_policy, optimal_values
from ..base import MapTrait, Still
from ..parts.drawn import DrawnScene, read_drawing
from ..parts.stills import building_svg

TOOLS = ("walk", "wall", "door", "room", "corridor", "goal")
SHOWN = ("plain", "states", "nd", "prob", "grad", "optimal")
MANY = 2000  # states: from here on, Python would be slow to climb to Grad


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
        Where it was sent: letters N, E, S, W.  One move in ten fails.

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
    map = MapTrait("source").tag(sync=False)
    text = traitlets.Unicode(str(read_map("source"))).tag(sync=True)
    tool = traitlets.Enum(TOOLS, "walk").tag(sync=True)
    show = traitlets.Enum(SHOWN, "plain").tag(sync=True)
    task = traitlets.Int(7, min=0).tag(sync=True)
    start = traitlets.Int(80, min=0).tag(sync=True)
    walk = traitlets.Unicode("EENNW").tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True)

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

    def still(self) -> Still:
        """Return the building, its task under ND, and under the best policy."""
        map_, tasks = self.map, self.tasks
        small = tasks.mdp.n_states < MANY
        policies = abstract_policies(tasks, BUILDERS if small else BUILDERS[:2])
        row = column(tasks, policies)
        task = min(self.task, len(map_.goals) - 1)
        one = navigation_tasks(map_, keep=[task])
        nd = evaluate_policy(one.mdp, policies["nd"][one.rho])
        goal, start = int(map_.goals[task]), min(self.start, map_.n_cells - 1)
        size = (
            f"{count(map_.n_cells, 'cell')}, {count(map_.n_rooms, 'room')}, "
            f"{count(map_.n_doors, 'door')} and {count(len(map_.goals), 'goal')}"
        )
        best = optimal_values(one.mdp)
        looks = {"robot": start, "goal": goal}
        frames = [building_svg(map_, f"A building with {size}.", **looks)]
        for name, v in (("ND", nd), ("the best policy", best)):
            alt = f"Values of {name}, from {number(v.min())} to 0 at the goal."
            frames.append(building_svg(map_, alt, values=v, limits=(-100, 0), **looks))
        names = {name: arm_style(name).name for name in ROWS}
        values = ", ".join(
            f"{names[name]} {number(row[name])}" for name in ROWS if name in row
        )
        caption = (
            f"Map Studio: a building with {size}, which makes "
            f"{count(tasks.mdp.n_states, 'state')} and "
            f"{count(row['abstract_states'], 'abstract state')}. What a cell is worth, "
            f"on average, to policies built in it: {values}."
        )
        paper = PAPER["source"] if _is_source(map_) else {}
        rows = [
            (names[name], _rounded(row.get(name)), _rounded(paper.get(name)))
            for name in ROWS
        ]
        return Still(frames, caption, ("policy", "here", "the paper"), rows)

    def __repr__(self) -> str:
        return super().__repr__().replace("text=...", f"map={self.map!r}")


def _is_source(map_: Map) -> bool:
    return (map_.n_cells, map_.n_rooms, len(map_.goals)) == (135, 11, 11)


def _rounded(x: float | None) -> str:
    return "\u2013" if x is None else number(x, 2)
