"""
Measures of transfer: numbers read off learning curves.

A curve is goals per window, (B,); curves are N runs of it, (N, B).  Each
function reduces the last axis, so it takes one curve or many.
Pages 8 and 9 of the book teach this module.

References
----------
Taylor & Stone (2009), Transfer Learning for Reinforcement Learning Domains:
A Survey, section 2.1: jumpstart, asymptotic performance, time to threshold.
"""

from __future__ import annotations

import numpy as np

SMOOTH = 3  # windows that are averaged: 1.5 million steps at paper scale


def jumpstart(curves: np.ndarray, baseline: np.ndarray, n: int = SMOOTH) -> np.ndarray:
    """
    Return how many goals per window more than `baseline` come at the start.

    The start is the first n windows; run i is compared with run i.

    >>> jumpstart(np.array([[5, 7, 9, 50]]), np.array([[1, 1, 4, 50]]))
    array([5.])
    """
    _check(curves, n)
    _check(baseline, n)
    first = np.asarray(curves)[..., :n].mean(axis=-1)
    return first - np.asarray(baseline)[..., :n].mean(axis=-1)


def asymptotic_level(curves: np.ndarray, n: int = SMOOTH) -> np.ndarray:
    """
    Return the goals per window at the end, the mean of the last n windows.

    >>> asymptotic_level(np.array([[0, 4, 5, 6]]))
    array([5.])
    """
    _check(curves, n)
    return np.asarray(curves)[..., -n:].mean(axis=-1)


def time_to_threshold(
    curves: np.ndarray, threshold: float, *, window: int
) -> np.ndarray:
    """
    Return the steps until a window first has `threshold` goals; inf if none has.

    The time is that of the end of the window, for then its goals are known.

    >>> time_to_threshold(np.array([[1, 5, 9], [0, 1, 2]]), 5, window=100)
    array([200.,  inf])
    """
    if not threshold >= 0:
        raise ValueError(f"threshold must be at least 0, got {threshold}")
    reached = np.asarray(curves) >= threshold
    steps = (reached.argmax(axis=-1) + 1.0) * window
    return np.where(reached.any(axis=-1), steps, np.inf)


def critical_point(curves: np.ndarray, n: int = SMOOTH) -> np.ndarray:
    """
    Return the critical point, in windows from the start: the steepest rise.

    The paper's "critical point, when performance improves faster" is read as
    the boundary between two windows where the mean of the next n windows
    exceeds the mean of the n windows before by most; the first, if several do.
    It needs no fit and no threshold, averages the noise of single windows, and
    finds a jump exactly.  It lies in n..B-n.

    >>> int(critical_point(np.array([2, 2, 2, 2, 2, 9, 9, 9, 9])))
    5
    """
    return rises(curves, n).argmax(axis=-1) + n


def rises(curves: np.ndarray, n: int = SMOOTH) -> np.ndarray:
    """
    Return the rise at boundaries n..B-n: next n windows minus last n, in the mean.

    >>> rises(np.array([0, 0, 6, 6]), n=1)
    array([0., 6., 0.])
    """
    _check(curves, 2 * n)
    curves = np.asarray(curves, dtype=float)
    total = np.concatenate(
        [np.zeros((*curves.shape[:-1], 1)), curves.cumsum(axis=-1)], axis=-1
    )
    sums = (total[..., n:] - total[..., :-n]) / n
    return sums[..., n:] - sums[..., :-n]


def _check(curves: np.ndarray, n: int) -> None:
    if np.ndim(curves) < 1 or not 1 <= n <= np.shape(curves)[-1]:
        raise ValueError(
            f"curves must have at least {n} windows, got shape {np.shape(curves)}"
        )
