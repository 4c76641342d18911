"""
Statistics of learning runs: how good, how sure, and how transfer is measured.

Data are goals per window, N runs x B windows, or one number per run, (N,).
Run i of every arm starts from the same seed, so runs are compared in pairs.
Everything that is uncertain comes as an :class:`Interval`, by Student's law: it
holds its level also for few runs, and there is none for fewer than `FEWEST`.
Pages 8 and 9 of the book teach this module.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

LEVEL = 0.95
FEWEST = 5  # runs for an interval: fewer hardly know how much they vary


class Interval(NamedTuple):
    """An estimate, and the ends of its interval."""

    estimate: float | np.ndarray  #: the best guess
    low: float | np.ndarray  #: nan where a few runs say nothing about others
    high: float | np.ndarray  #: the upper end


def t_interval(x: np.ndarray, level: float = LEVEL) -> Interval:
    """
    Return the mean over runs of x (N,) or (N, B), with Student's interval.

    It holds its level for few runs, as a percentile bootstrap does not (of six
    runs that holds the mean 86 times in 100, not 95); nan under `FEWEST` runs.
    x may be a contrast, run by run: a difference, or a sum with weights.

    Raises
    ------
    ValueError
        If x is empty or not finite.

    References
    ----------
    Student (1908), The probable error of a mean.

    >>> found = t_interval(np.array([1.0, 2.0, 3.0, 4.0, 5.0]))
    >>> [round(end, 3) for end in found]  # 3 +- 2.776 x 1.581 / 5^.5
    [3.0, 1.037, 4.963]
    >>> t_interval(np.array([1.0, 2.0]))
    Interval(estimate=1.5, low=nan, high=nan)
    """
    x = _finite(x)
    mean, n = x.mean(axis=0), len(x)
    half = np.full_like(mean, np.nan)
    if n >= FEWEST:
        half = _half(x.std(axis=0, ddof=1) / n**0.5, n, level)
    ends = (mean, mean - half, mean + half)
    return Interval(*(float(end) if np.ndim(end) == 0 else end for end in ends))


def gain_interval(a: np.ndarray, b: np.ndarray, level: float = LEVEL) -> Interval:
    """
    Return mean(a) / mean(b) - 1, run i of a with run i of b, both (N,).

    Student's interval of the log of the ratio: a run moves it by its share of its
    own mean, less that of its partner.  nan unless both means are above 0.

    >>> gain = gain_interval(np.array([6.0] * 5), np.array([5.0] * 5))
    >>> [round(x, 6) for x in gain]
    [0.2, 0.2, 0.2]
    """
    a, b = _finite(a), _finite(b)
    if a.shape != b.shape or a.ndim != 1:
        raise ValueError(f"a and b must have one shape (N,), got {a.shape}, {b.shape}")
    if not (a.mean() > 0 and b.mean() > 0):
        return Interval(np.nan, np.nan, np.nan)
    log = np.log(a.mean() / b.mean()) + a / a.mean() - b / b.mean()
    return Interval(*(float(np.expm1(end)) for end in t_interval(log, level)))


def iqm_interval(x: np.ndarray, level: float = LEVEL) -> Interval:
    """
    Return the interquartile mean over runs of x (N,), with its interval.

    The quarter of lowest and the quarter of highest runs are left out; for the
    spread they count as the nearest run that is not.

    References
    ----------
    Tukey & McLaughlin (1963), Less vulnerable confidence and significance
    procedures for location based on a single sample.

    >>> iqm_interval(np.array([0.0, 4.0, 6.0, 99.0])).estimate
    5.0
    """
    x = np.sort(_finite(x))
    n, out = len(x), len(x) // 4
    inside = x[out : n - out]
    mean, half, m = inside.mean(), np.nan, len(inside)
    if n >= FEWEST:
        spread = np.clip(x, inside[0], inside[-1]).std(ddof=1)
        half = _half(spread * ((n - 1) / (m * (m - 1))) ** 0.5, m, level)
    return Interval(float(mean), float(mean - half), float(mean + half))


def rank_interval(order: float, n: int, level: float = LEVEL) -> Interval:
    """
    Return Kendall's rank correlation of n things, with its interval.

    References
    ----------
    Fieller, Hartley & Pearson (1957), Tests for rank correlation coefficients:
    its inverse hyperbolic tangent varies by (0.437 / (n - 4))^.5.  Their quantile
    is that of the normal law; for a few things Student's holds the level.

    >>> [round(end, 2) for end in rank_interval(-13 / 21, 7)]
    [-0.62, -0.93, 0.21]
    """
    if n < FEWEST:
        return Interval(order, np.nan, np.nan)
    most = 1 - 2 / (n * (n - 1))  # half a pair short of all in order
    place = np.arctanh(np.clip(order, -most, most))
    half = _half((0.437 / (n - 4)) ** 0.5, n, level)
    low, high = np.tanh([place - half, place + half]).tolist()
    ends = (-1.0 if order < -most else low, 1.0 if order > most else high)
    return Interval(order, *ends)


def probability_of_improvement(a: np.ndarray, b: np.ndarray) -> float:
    """
    Return P(a run of a > a run of b), ties counting one half; both (N,).

    All N x N pairs of runs count: this is Mann and Whitney's U / N^2.

    References
    ----------
    Agarwal et al. (2021), Deep RL at the Edge of the Statistical Precipice.

    >>> a, b = np.array([2.0, 4.0]), np.array([1.0, 4.0])
    >>> probability_of_improvement(a, b)  # wins 1.5 + 1, of 4
    0.625
    """
    a, b = _finite(a)[:, None], _finite(b)
    return float(((a > b) + 0.5 * (a == b)).mean())


@lru_cache(maxsize=1024)
def quantile(n: int, level: float = LEVEL) -> float:
    """
    Return how many standard errors of a mean of n runs its interval reaches.

    >>> round(quantile(5), 3)
    2.776
    """
    from scipy.special import stdtrit  # slow to load

    return float(stdtrit(n - 1, (1 + level) / 2))


def _finite(x: np.ndarray) -> np.ndarray:
    x = np.asarray(x, dtype=float)
    if not x.size or not np.isfinite(x).all():
        raise ValueError("runs must be finite numbers, at least one")
    return x


def _half(error, n: int, level: float):
    """Return half of Student's interval for a mean of n with this standard error."""
    return quantile(n, level) * error
