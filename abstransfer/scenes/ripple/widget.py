"""The scene of page 2: values ripple out from the goal, sweep by sweep."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import traitlets

from ...maps import Map
from ...navigation import NavigationTasks, navigation_tasks
from ...solvers import optimal_actions, optimal_values, value_iteration
from ..base import MapTrait, Scene

RIGHT = 0.01  # a value is known when it is right to within this


class Ripple(Scene):
    """
    Value iteration: values ripple out from the goal, sweep by sweep.

    Parameters
    ----------
    map : Map, text or name, default "source"
    task : int
        Which of the map's goals, counted from 0.
    success : float
        Probability that a move succeeds, 0.5 to 1.
    k : int
        Sweeps so far; the last is the first after which every value is right to
        within a hundredth.
    cell : int
        The cell whose backup is shown.
    arrows : bool
        Whether the best actions are shown, as arrows, in place of the values.

    Examples
    --------
    >>> scene = Ripple(map="+---+\\n|  *|\\n+---+", success=1, k=1, cell=0)
    >>> [v.tolist() for v in scene.sweeps]
    [[-1.0, 0.0]]
    >>> scene.news.tolist()  # the sweep in which a cell hears of the goal
    [1, 0]
    """

    scene = "ripple"
    map = MapTrait("source")
    task = traitlets.Int(0, min=0).tag(sync=True)
    success = traitlets.Float(0.9, min=0.5, max=1.0).tag(sync=True)
    k = traitlets.Int(5, min=0).tag(sync=True)
    cell = traitlets.Int(78, min=0).tag(sync=True)
    arrows = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    ties = traitlets.Unicode("").tag(sync=True, local=True)

    @property
    def tasks(self) -> NavigationTasks:
        """The task of the scene; its states are the cells of the map."""
        return _tasks(self.map, self._task, self.success)

    @property
    def sweeps(self) -> tuple[np.ndarray, ...]:
        """The values (C,) after 0, 1, 2, ... sweeps, the last right to a hundredth."""
        return self._wave.sweeps

    @property
    def errors(self) -> np.ndarray:
        """The largest error of a cell after each number of sweeps."""
        return self._wave.errors

    @property
    def news(self) -> np.ndarray:
        """The sweep in which a cell hears of the goal, (C,): its steps to it."""
        return _steps(self.map, self.map.goals[self._task])

    @property
    def best_actions(self) -> np.ndarray:
        """Which actions are optimal, (C, A); none at the goal."""
        return self._wave.optimal

    @property
    def _task(self) -> int:
        return min(self.task, len(self.map.goals) - 1)

    @property
    def _wave(self) -> Wave:
        return wave_of(self.map, self._task, self.success)


class Wave(NamedTuple):
    """The sweeps of a task, their largest errors, and its best actions."""

    sweeps: tuple[np.ndarray, ...]
    errors: np.ndarray
    optimal: np.ndarray

    @property
    def n_ties(self) -> int:
        return int((self.optimal.sum(axis=1) > 1).sum())


@lru_cache(maxsize=64)
def _tasks(map_: Map, task: int, success: float) -> NavigationTasks:
    return navigation_tasks(map_, success=success, keep=[task])


@lru_cache(maxsize=64)
def wave_of(map_: Map, task: int, success: float) -> Wave:
    """Return the sweeps of a task, until every value is right to a hundredth."""
    mdp = _tasks(map_, task, success).mdp
    best = optimal_values(mdp)
    sweeps, errors = [], []
    for v in value_iteration(mdp):
        sweeps.append(v)
        errors.append(float(abs(v - best).max()))
        if errors[-1] < RIGHT:
            return Wave(tuple(sweeps), np.array(errors), optimal_actions(mdp, best))


def _steps(map_: Map, goal: int) -> np.ndarray:
    steps = np.full(map_.n_cells, -1)
    steps[goal] = 0
    edge = np.array([goal])
    while edge.size:
        around = np.unique(map_.neighbors[edge])
        n, edge = steps[edge[0]] + 1, around[(around >= 0) & (steps[around] < 0)]
        steps[edge] = n
    return steps
