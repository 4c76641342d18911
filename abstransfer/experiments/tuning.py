"""
Tuning tau: which number of steps of advice is best, and how sure is that.

Read from the results of the grid, (arms x tau) x N runs with tuning seeds.
Page 8 of the book teaches this module.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .arms import ARMS, Arm
from .results import Results
from .stats import LEVEL, Interval, gain_interval, t_interval


class Tuning(NamedTuple):
    """What the grid says of one arm; tau in steps at paper scale."""

    name: str  #: of the arm
    taus: np.ndarray  #: (T,) ascending
    goals: Interval  #: (T,) mean goals of a run
    best: int  #: tau of the highest mean
    as_good: tuple[int, ...]  #: those that may be the best: 95 % sure to hold it
    paper: int | None  #: the paper's tau, None if its grid point is missing
    paper_gain: Interval | None  #: goals at the paper's tau over those at the best, - 1

    @property
    def paper_inside(self) -> bool:
        """Whether the paper's tau is one of those that may be the best."""
        return self.paper in self.as_good

    @property
    def at_edge(self) -> bool:
        """Whether the best is at an end of the grid, so that it may lie beyond."""
        return self.best in (self.taus[0], self.taus[-1])


def tune(results: Results) -> tuple[Tuning, ...]:
    """
    Return what a grid of tau says, arm by arm.

    Where the top is flat the luckiest of several equal tau looks better than it is.
    The set `as_good` allows for that: a tau leaves it if a paired t-test against
    the highest, one-sided and divided among all comparisons (Bonferroni), says that
    it is worse.

    Raises
    ------
    ValueError
        If an arm has one tau only.

    References
    ----------
    Gupta (1965), On some multiple decision (selection and ranking) rules.
    """
    names = dict.fromkeys(arm.name for arm in results.arms)
    return tuple(_tune_arm(results, name) for name in names)


def tuned_arms(tunings: tuple[Tuning, ...], arms: tuple[Arm, ...] = ARMS) -> tuple:
    """Return the arms with the best tau of the grid in the place of the paper's."""
    best = {tuning.name: tuning.best for tuning in tunings}
    return tuple(arm._replace(tau=best.get(arm.name, arm.tau)) for arm in arms)


def _tune_arm(results: Results, name: str) -> Tuning:
    taus = sorted(arm.tau for arm in results.arms if arm.name == name)
    if len(taus) < 2:
        raise ValueError(f"a grid must hold several tau of {name!r}, got {taus}")
    totals = {tau: results.totals(name, tau) for tau in taus}  # each (N,)
    goals = t_interval(np.column_stack(list(totals.values())))
    best = taus[goals.estimate.argmax()]
    chance = (1 - LEVEL) / (len(taus) - 1)
    as_good = tuple(
        tau for tau in taus if not _p_value(totals[best], totals[tau]) < chance
    )
    paper = next((arm.tau for arm in ARMS if arm.name == name), None)
    gain = None
    if paper in totals:
        gain = gain_interval(totals[paper], totals[best])
    return Tuning(
        name,
        np.array(taus),
        goals,
        best,
        as_good,
        paper if gain else None,
        gain,
    )


def _p_value(a: np.ndarray, b: np.ndarray) -> float:
    """Return the p-value of the paired t-test that a is no better than b, (N,)."""
    from scipy.special import stdtr  # slow to load

    difference = a - b
    if len(difference) < 2 or not difference.any():
        return 1.0
    with np.errstate(divide="ignore"):  # a difference that never varies is certain
        t = difference.mean() / (difference.std(ddof=1) / len(difference) ** 0.5)
    return float(stdtr(len(difference) - 1, -t))
