"""
Prob's traps, and advice with rows exchanged there or elsewhere.

It is the control of page 10 that needs no early cut: a few views hold nearly all
robots that walk in circles, and only what is said there is changed.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..experiments.diagnosis import stuck
from ..experiments.problem import Problem, target_tasks

EXCHANGED = (
    "prob-nd-in-traps",
    "nd-prob-in-traps",
    "prob-eager-in-traps",
    "prob-eager-elsewhere",
)


def trap_views(problem: Problem, advice: np.ndarray, share: float = 0.9) -> np.ndarray:
    """
    Return the abstract states that hold most of those who do not arrive, (Z,) bool.

    The fewest that hold at least `share` of the episodes which advice (Z, A) leaves
    on the way when they are cut.
    """
    tasks = target_tasks(problem)
    late = stuck(tasks.mdp, advice[tasks.rho], problem.max_episode)
    by_view = np.bincount(tasks.rho, late, minlength=len(advice))
    order = np.argsort(-by_view, kind="stable")
    n = int(np.searchsorted(by_view[order].cumsum(), share * by_view.sum())) + 1
    views = np.zeros(len(advice), dtype=bool)
    views[order[:n]] = True
    return views


def exchange_rows(
    problem: Problem, nd: np.ndarray, prob: np.ndarray, eager: np.ndarray
) -> Mapping[str, np.ndarray]:
    """
    Return advice (Z, A) made of these three, by the names in `EXCHANGED`.

    A name says whose advice it is, and whose rows were put where; the eager
    robot's make up half of a row.
    """
    traps = trap_views(problem, prob)[:, None]
    half = (prob + eager) / 2
    made = (
        np.where(traps, nd, prob),
        np.where(traps, prob, nd),
        np.where(traps, half, prob),
        np.where(traps, prob, half),
    )
    return dict(zip(EXCHANGED, made, strict=True))
