"""The scene of page 2: values ripple out from the goal, sweep by sweep."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import traitlets

from ...maps import Map
from ...navigation import NavigationTasks, navigation_tasks
from ...plotting.style import count, number
from ...solvers import optimal_actions, optimal_values, value_iteration
from ..base import MapTrait, Scene, Still
from ..parts.stills import building_svg

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
    bet = traitlets.Unicode("").tag(sync=True)
    ties = traitlets.Unicode("").tag(sync=True)

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
    def _wave(self) -> _Wave:
        return _wave(self.map, self._task, self.success)

    def still(self) -> Still:
        """Return the sweep that is looked at, a later one, and the last."""
        tasks = range(len(self.map.goals))
        waves = [_wave(self.map, task, self.success) for task in tasks]
        last, far = len(self.sweeps) - 1, int(self.news.max())
        cells = self.map.n_cells - 1
        moments = sorted({min(self.k, last), min((self.k + far) // 2, last), last})
        while len(moments) < 3:
            moments.insert(0, moments[0])
        caption = (
            f"Values ripple out from the goal: its news reaches the farthest cell, "
            f"{count(far, 'step')} away, in sweep {far}, and every value is right to "
            f"within a hundredth after {count(last, 'sweep')} (moves succeed with "
            f"probability {self.success:g}). More than one action is best in "
            f"{self._wave.n_ties} of {cells} cells. In all {count(len(waves), 'task')} "
            f"it takes at most {max(len(wave.sweeps) - 1 for wave in waves)} sweeps, "
            f"and {sum(wave.n_ties for wave in waves)} of {cells * len(waves)} cells "
            "have more than one best action."
        )
        rows = [
            (k, f"{(self.news <= k).sum()} of {cells + 1}", number(self.errors[k], 3))
            for k in sorted({0, *moments, min(far, last)})
        ]
        head = ("sweeps", "cells that have heard", "largest error")
        return Still([self._frame(k) for k in moments], caption, head, rows)

    def _frame(self, k: int) -> str:
        heard = self.news <= k
        values = np.where(heard, self.sweeps[k], np.nan)
        texts = [
            "" if n == 0 else _short(v) if n <= k else "\u00b7"
            for n, v in zip(self.news, self.sweeps[k], strict=True)
        ]
        alt = (
            f"Values after {count(k, 'sweep')}: {heard.sum()} of {len(heard)} cells "
            f"have heard of the goal; the largest error is {number(self.errors[k], 2)}."
        )
        return building_svg(
            self.map,
            alt,
            values=values,
            limits=(self.sweeps[-1].min(), 0.0),
            texts=texts,
            goal=self.map.goals[self._task],
        )


def _short(v: float) -> str:
    """Return a value as it fits into a cell."""
    return number(v, 1 if v > -10 else 0)


class _Wave(NamedTuple):
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
def _wave(map_: Map, task: int, success: float) -> _Wave:
    """Return the sweeps of a task, until every value is right to a hundredth."""
    mdp = _tasks(map_, task, success).mdp
    best = optimal_values(mdp)
    sweeps, errors = [], []
    for v in value_iteration(mdp):
        sweeps.append(v)
        errors.append(float(abs(v - best).max()))
        if errors[-1] < RIGHT:
            return _Wave(tuple(sweeps), np.array(errors), optimal_actions(mdp, best))


def _steps(map_: Map, goal: int) -> np.ndarray:
    steps = np.full(map_.n_cells, -1)
    steps[goal] = 0
    edge = np.array([goal])
    while edge.size:
        around = np.unique(map_.neighbors[edge])
        n, edge = steps[edge[0]] + 1, around[(around >= 0) & (steps[around] < 0)]
        steps[edge] = n
    return steps
