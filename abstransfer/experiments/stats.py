"""
Statistics of learning runs: how good, how sure, and how transfer is measured.

Data are goals per window, N runs x B windows, or one number per run, (N,).
Run i of every arm starts from the same seed, so runs are compared in pairs.
Everything that is uncertain comes as an :class:`Interval`; the resampling is
scipy's.  Pages 8 and 9 of the book teach this module.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy import stats

LEVEL = 0.95
RESAMPLES = 2000
FEWEST = 5  # runs for an interval: fewer hardly know how much they vary
BATCH = 250  # resamples held in memory at a time: 6 MB for 50 runs x 60 windows


class Interval(NamedTuple):
    """An estimate, and the ends of its bootstrap interval."""

    estimate: float | np.ndarray  #: the best guess
    low: float | np.ndarray  #: nan where a single run says nothing about others
    high: float | np.ndarray  #: the upper end


def bootstrap(statistic: Callable, *samples: np.ndarray, rng) -> Interval:
    """
    Return a statistic of N runs with its percentile bootstrap interval.

    Runs are drawn with replacement, the same runs from every sample.

    Parameters
    ----------
    statistic : callable
        ``statistic(*samples, axis)`` reduces the axis of runs.
    *samples : ndarray of float, shape (N, ...)
        All with the same runs.
    rng : int, SeedSequence or Generator

    Returns
    -------
    Interval
        Of floats, or of arrays for samples of more than one axis.

    Raises
    ------
    ValueError
        If samples are empty, not finite, or of different shapes.

    References
    ----------
    Efron & Tibshirani (1993), An Introduction to the Bootstrap, section 13.3.

    Examples
    --------
    >>> bootstrap(np.mean, np.array([7.0, 7.0, 7.0]), rng=0)
    Interval(estimate=7.0, low=7.0, high=7.0)
    """
    samples = tuple(np.asarray(sample, dtype=float) for sample in samples)
    for sample in samples:
        if not sample.size or sample.shape != samples[0].shape:
            shapes = ", ".join(str(s.shape) for s in samples)
            raise ValueError(f"samples must have one shape, none empty, got {shapes}")
        if not np.isfinite(sample).all():
            raise ValueError("samples must be finite, got nan or inf")
    estimate = np.asarray(statistic(*samples, axis=0), dtype=float)
    low = high = np.full_like(estimate, np.nan)
    if len(samples[0]) > 1:
        with warnings.catch_warnings(
            action="ignore", category=stats.DegenerateDataWarning
        ):  # its interval is nan, which says the same
            low, high = stats.bootstrap(
                samples,
                statistic,
                n_resamples=RESAMPLES,
                batch=BATCH,
                paired=len(samples) > 1,
                axis=0,
                vectorized=True,
                confidence_level=LEVEL,
                method="percentile",
                random_state=np.random.default_rng(rng),
            ).confidence_interval
    return Interval(*(x if x.ndim else float(x) for x in (estimate, low, high)))


def t_interval(x: np.ndarray, level: float = LEVEL) -> Interval:
    """
    Return the mean over runs of x (N,) or (N, B), with Student's interval.

    It holds its level for few runs, as the percentile bootstrap does not (of six
    runs that holds the mean 86 times in 100, not 95); nan under `FEWEST` runs.
    x may be a contrast, run by run: a difference, or a sum with weights.

    References
    ----------
    Student (1908), The probable error of a mean.

    >>> found = t_interval(np.array([1.0, 2.0, 3.0, 4.0, 5.0]))
    >>> [round(end, 3) for end in found]  # 3 +- 2.776 x 1.581 / 5^.5
    [3.0, 1.037, 4.963]
    >>> t_interval(np.array([1.0, 2.0]))
    Interval(estimate=1.5, low=nan, high=nan)
    """
    x = np.asarray(x, dtype=float)
    if not x.size or not np.isfinite(x).all():
        raise ValueError("x must hold finite numbers, at least one")
    mean, n = x.mean(axis=0), len(x)
    half = np.full_like(mean, np.nan)
    if n >= FEWEST:
        half = stats.t.ppf((1 + level) / 2, n - 1) * x.std(axis=0, ddof=1) / n**0.5
    ends = (mean, mean - half, mean + half)
    return Interval(*(float(end) if np.ndim(end) == 0 else end for end in ends))


def gain_interval(a: np.ndarray, b: np.ndarray, level: float = LEVEL) -> Interval:
    """
    Return mean(a) / mean(b) - 1, run i of a with run i of b, both (N,), positive.

    Student's interval of the log of the ratio: a run moves it by its share of its
    own mean, less that of its partner.

    >>> gain = gain_interval(np.array([6.0] * 5), np.array([5.0] * 5))
    >>> [round(x, 6) for x in gain]
    [0.2, 0.2, 0.2]
    """
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    if a.shape != b.shape or a.ndim != 1:
        raise ValueError(f"a and b must have one shape (N,), got {a.shape}, {b.shape}")
    if not (a.mean() > 0 and b.mean() > 0):
        return Interval(np.nan, np.nan, np.nan)
    log = np.log(a.mean() / b.mean()) + a / a.mean() - b / b.mean()
    return Interval(*(float(np.expm1(end)) for end in t_interval(log, level)))


def mean_interval(x: np.ndarray, *, rng) -> Interval:
    """
    Return the mean over runs of x (N,) or (N, B), with its interval.

    >>> mean_interval(np.array([[1.0, 5.0], [3.0, 5.0]]), rng=0).estimate
    array([2., 5.])
    """
    return bootstrap(np.mean, x, rng=rng)


def iqm_interval(x: np.ndarray, *, rng) -> Interval:
    """
    Return the interquartile mean over runs of x (N,), with its interval.

    The quarter of lowest and the quarter of highest runs are left out.

    References
    ----------
    Agarwal et al. (2021), Deep RL at the Edge of the Statistical Precipice.

    >>> iqm_interval(np.array([0.0, 4.0, 6.0, 99.0]), rng=0).estimate
    5.0
    """

    def iqm(x, axis):
        return stats.trim_mean(x, 0.25, axis=axis)

    return bootstrap(iqm, x, rng=rng)


def paired_difference(a: np.ndarray, b: np.ndarray, *, rng) -> Interval:
    """
    Return the mean of a - b, both (N,), run i against run i.

    >>> paired_difference(np.array([3.0, 5.0]), np.array([1.0, 3.0]), rng=0)
    Interval(estimate=2.0, low=2.0, high=2.0)
    """

    def difference(a, b, axis):
        return (a - b).mean(axis=axis)

    return bootstrap(difference, a, b, rng=rng)


def relative_gain(a: np.ndarray, b: np.ndarray, *, rng) -> Interval:
    """
    Return mean(a) / mean(b) - 1: by which share `a` exceeds `b`, both (N,).

    nan where b never reached a goal.

    >>> relative_gain(np.array([6.0, 6.0]), np.array([5.0, 5.0]), rng=0).estimate
    0.19999999999999996
    """

    def gain(a, b, axis):
        below = b.mean(axis=axis)
        return a.mean(axis=axis) / np.where(below == 0, np.nan, below) - 1

    return bootstrap(gain, a, b, rng=rng)


def probability_of_improvement(a: np.ndarray, b: np.ndarray, *, rng) -> Interval:
    """
    Return P(a run of a > a run of b), ties counting one half; both (N,).

    All N x N pairs of runs count: this is Mann and Whitney's U / N^2.

    References
    ----------
    Agarwal et al. (2021), Deep RL at the Edge of the Statistical Precipice.

    >>> a, b = np.array([2.0, 4.0]), np.array([1.0, 4.0])
    >>> probability_of_improvement(a, b, rng=0).estimate  # wins 1.5 + 1, of 4
    0.625
    """

    def share(a, b, axis):
        a, b = np.moveaxis(a, axis, -1)[..., None], np.moveaxis(b, axis, -1)
        b = b[..., None, :]
        return ((a > b) + 0.5 * (a == b)).mean(axis=(-1, -2))

    return bootstrap(share, a, b, rng=rng)
