"""
What is whispered: first notes that say what the source teaches, at any size.

A table (Z, A) says for each view how good each label is; a state's first notes are
its view's row, times a size.  At a vanishing size the row only breaks ties, until
real news arrives.  Beside what the source teaches stand controls: tables that know
less, or know it wrongly.  No phase of advice is needed, and no tau.
"""

from __future__ import annotations

import numpy as np

from ..abstraction import LABELS, NO_LABEL, ORIENTATIONS
from ..experiments.problem import Problem
from ..experiments.surgery import best_notes
from ..maps import Map
from ..navigation import NavigationTasks, navigation_tasks
from .buildings import draw_building
from .guides import make_guides

#: Advice whose chances are whispered, by its name in `guides.ADVICE`.
POLICIES = {
    "prob": "beta-1",
    "nd": "beta-0",
    "grad": "grad",
    "half": "prob-available-0.5",  # half Prob, half eager
}
TEACH = (*POLICIES, "values")
EXISTS = "exists"  # knows what can be done, and no building
CEILING = "ceiling"  # Q* of the target itself: knows everything
OTHER = 300, (3, 6)  # seed and blocks of a building with as many rooms as the source
SIZES = (1, 1e-1, 1e-3, 1e-6, 1e-9, 1e-20, 1e-40)
#: Two of the smallest number above 0: one-step learning cannot make it smaller.
STEADY = 1e-323


def taught(problem: Problem | None = None) -> dict[str, np.ndarray]:
    """
    Return what can be whispered, tables (Z, A) by name; larger is better.

    ``prob``, ``nd``, ``grad`` and ``half`` are chances of advice, ``values`` the
    mean of Q* over the source's states of a view, in the learner's own game;
    ``exists`` is 1 for what can be done.  Of the values there are five changes:
    ``values-elsewhere`` has the row of another view, ``values-wrong`` takes towards
    the goal for away from it, ``values-dealt`` deals each row to other actions,
    ``values-other`` is learned in a drawn building, and ``values-best`` says which
    action is best (1), which can be done (1/2), and no more.

    What cannot be done has the lowest number of the table; what could be done and
    is not known has the mean of its row, or of the table.  Numbers are rounded, so
    that no machine breaks ties.

    >>> tables = taught()
    >>> sorted(tables)[:3]
    ['exists', 'grad', 'half']
    >>> bool((tables["nd"] <= tables["exists"]).all())
    True
    """
    problem = problem or Problem()
    possible = navigation_tasks(problem.source).possible
    rng = np.random.default_rng(2015)
    values = _values(problem, problem.source)
    seen = np.flatnonzero(~np.isnan(values).all(axis=1))
    elsewhere, dealt = values.copy(), values.copy()
    elsewhere[seen] = values[rng.permutation(seen)]
    for view in seen:
        there = np.flatnonzero(possible[view])
        dealt[view, there] = values[view, rng.permutation(there)]
    changed = {
        "values": values,
        "values-elsewhere": elsewhere,
        "values-wrong": np.roll(values, len(LABELS) // len(ORIENTATIONS), axis=1),
        "values-dealt": dealt,
        "values-other": _values(problem, draw_building(*OTHER)),
    }
    lowest = 0.0 if problem.reward == "goal" else -1 / (1 - problem.gamma)
    tables = {name: _filled(t, possible, lowest) for name, t in changed.items()}
    ranked = np.where(possible, tables["values"], -np.inf)
    best = ranked == ranked.max(axis=1, keepdims=True)
    tables["values-best"] = (possible + best.astype(float)) / 2
    tables[EXISTS] = possible.astype(float)
    advice = make_guides(POLICIES.values(), problem)
    tables |= {name: advice[guide] for name, guide in POLICIES.items()}
    return {name: np.round(table, 6) + 0.0 for name, table in tables.items()}


def first_notes(tasks: NavigationTasks, table: np.ndarray, size: float) -> np.ndarray:
    """
    Return a table (Z, A) as first notes (S, A): its view's row in each state.

    A robot with a compass takes for a move what is said of the label it carries;
    one that would run into a wall is as bad as the worst.
    """
    rows = table[tasks.rho]
    if tasks.actions != LABELS:
        rows = np.take_along_axis(rows, np.maximum(tasks.labels, 0), axis=1)
        rows = np.where(tasks.labels == NO_LABEL, table.min(), rows)
    return size * rows


def _values(problem: Problem, building: Map) -> np.ndarray:
    """Return the mean Q* of each view's labels, (Z, A); nan where there is none."""
    tasks = navigation_tasks(building, success=problem.success, reward=problem.reward)
    there = tasks.available & ~tasks.mdp.terminal[:, None]
    q = np.where(there, best_notes(tasks.mdp, problem.gamma), 0.0)
    total, n = np.zeros((2, tasks.n_abstract, len(LABELS)))
    np.add.at(total, tasks.rho, q)
    np.add.at(n, tasks.rho, there)
    return np.divide(total, n, out=np.full(n.shape, np.nan), where=n > 0)


def _filled(table: np.ndarray, possible: np.ndarray, lowest: float) -> np.ndarray:
    """Return a table without nan: see `taught`."""
    table = np.where(possible, table, np.nan)
    n = (~np.isnan(table)).sum(axis=1, keepdims=True)
    mean = np.nansum(table, axis=1, keepdims=True) / np.maximum(n, 1)
    mean = np.where(n > 0, mean, np.nanmean(table))
    return np.where(possible, np.where(np.isnan(table), mean, table), lowest)
