"""The scene of the intro and of page 1: what a robot sees, and advice as arrows."""

from __future__ import annotations

from functools import cache

import numpy as np
import traitlets

from ...builders import abstract_policies
from ...maps import read_map
from ...navigation import NavigationTasks, navigation_tasks
from ..base import Scene

MAPS = {"small": "source", "large": "target"}
STEPS = 200  # of a walk, at most


@cache
def prob() -> np.ndarray:
    """Return pi_AbsProb (Z, 8) of the small building."""
    return abstract_policies(navigation_tasks(read_map("source")), ["prob"])["prob"]


class Sights(Scene):
    """
    A robot in two buildings: what it sees from a cell, and where its advice leads.

    Parameters
    ----------
    size : {"small", "large"}
        Which building.
    task : int
        Which goal of the building, counted from 0.
    cell : int
        Where the robot starts.
    advice : bool
        Whether the advice of the small building, Prob, is drawn and obeyed.
    t : int, 0 to 200
        Steps that the robot has walked.

    Examples
    --------
    >>> scene = Sights(cell=78)
    >>> scene.seen
    {'N': 'see_door_far_head_to_goal', 'E': 'see_empty_space_opposite_to_goal'}
    >>> scene.arrows[78].tolist()  # of north, east, south and west
    [1.0, 0.0, 0.0, 0.0]
    """

    scene = "sights"
    size = traitlets.Enum(tuple(MAPS), "small").tag(sync=True)
    task = traitlets.Int(0, min=0).tag(sync=True)
    cell = traitlets.Int(105, min=0).tag(sync=True)
    advice = traitlets.Bool(True).tag(sync=True)
    t = traitlets.Int(0, min=0, max=STEPS).tag(sync=True)

    @classmethod
    def spec(cls) -> dict:
        """Return what the script reads; the rows of the advice that differ."""
        tasks = navigation_tasks(read_map("source"))
        seen = np.unique(tasks.rho[~tasks.mdp.terminal])
        rows = {int(z): prob()[z].round(6).tolist() for z in seen}
        return {**super().spec(), "advice": rows}

    @property
    def tasks(self) -> NavigationTasks:
        """The one task that is shown."""
        map_ = read_map(MAPS[self.size])
        return navigation_tasks(map_, keep=[min(self.task, len(map_.goals) - 1)])

    @property
    def seen(self) -> dict[str, str]:
        """The label of each open way from the cell, by direction."""
        labels = self.tasks.labels[self.cell]
        names = self.tasks.actions
        return {
            way: names[label]
            for way, label in zip("NESW", labels, strict=True)
            if label >= 0
        }

    @property
    def arrows(self) -> np.ndarray:
        """How likely advice heads north, east, south, west from each cell, (C, 4)."""
        tasks = self.tasks
        labels, rows = tasks.labels, prob()[tasks.rho]
        ways = np.array([np.bincount(row[row >= 0], minlength=8) for row in labels])
        share = rows / np.maximum(ways, 1)
        heads = np.take_along_axis(share, np.maximum(labels, 0), axis=1)
        return np.where((labels >= 0) & ~tasks.mdp.terminal[:, None], heads, 0.0)
