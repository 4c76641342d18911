"""
When would you sign?  Verdicts after each run, in several orders of the runs.

Who looks after every run and stops as soon as an interval leaves 0 looks often.
Claims are the first five, and "same": each arm against itself, its runs shuffled
twice, where nothing is to be found.  Page 9 of the book teaches this module.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..experiments.results import Results
from ..experiments.stats import LEVEL, RESAMPLES, Interval
from .claims import CLAIMS
from .verdicts import UNDECIDED, Finding, combine

FIRST_LOOK = 5  # as in exercise 3 of page 9: before, intervals are far too narrow
N_ORDERS = 5  # as run, and four shuffles
SAME = "same"
KEYS = (*(claim.key for claim in CLAIMS[:5]), SAME)


class Stops(NamedTuple):
    """What a reader who looks after each run does, in all orders."""

    verdict: str  #: of all runs
    settled: int  #: runs from which on no verdict changes, in any order
    stops: tuple[int | None, ...]  #: runs after which each track is signed, if it is
    wrong: int  #: how many of them are signed against all runs


def comparisons(results: Results, key: str) -> tuple[Finding, ...]:
    """
    Return what a claim rests on, (K,); `key` is one of `KEYS`.

    An effect that no run changes is measured, gains over runs are not yet.
    """
    if key not in KEYS:
        raise ValueError(f"key must be one of {', '.join(KEYS)}, got {key!r}")
    if key == SAME:
        return tuple(Finding("goals", arm.name, arm.name) for arm in results.arms)
    return tuple(
        finding if finding.kind == "goals" else finding.measured(results, None)
        for finding in CLAIMS[KEYS.index(key)].findings
    )


def orders(n_runs: int) -> tuple[np.ndarray, np.ndarray]:
    """
    Return the orders of the runs and of partners for "same", (5, N) each.

    Order 0 is as run; order k is shuffled with seed [k, 0], a partner with [k, 1].

    >>> orders(4)[0][0]
    array([0, 1, 2, 3])
    """

    order, partners = (
        [np.random.default_rng([k, j]).permutation(n_runs) for k in range(N_ORDERS)]
        for j in (0, 1)
    )
    return np.stack([np.arange(n_runs), *order[1:]]), np.stack(partners)


def running_gains(a: np.ndarray, b: np.ndarray) -> Interval:
    """
    Return by which share `a` exceeds `b`, both (N, K), after 2..N runs, (N - 1, K).

    Row n - 2 is what ``relative_gain(a[:n], b[:n], rng=0)`` gives, column by column.

    >>> x = np.array([[6.0], [6.0], [6.0]])
    >>> running_gains(x, x / 2).low.ravel()
    array([1., 1.])
    """
    rows = []
    for n in range(2, len(a) + 1):
        times = _times(n).astype(float)
        gain = (times @ a[:n]) / (times @ b[:n]) - 1
        ends = np.quantile(gain, [(1 - LEVEL) / 2, (1 + LEVEL) / 2], axis=0)
        rows.append((a[:n].mean(axis=0) / b[:n].mean(axis=0) - 1, *ends))
    return Interval(*np.array(rows).transpose(1, 0, 2))


@lru_cache(maxsize=64)
def _times(n: int) -> np.ndarray:
    """Return how often each run is in each resample of n, (RESAMPLES, n)."""
    drawn = np.random.default_rng(0).integers(0, n, (RESAMPLES, n))
    drawn += n * np.arange(RESAMPLES)[:, None]
    times = np.bincount(drawn.ravel(), minlength=n * RESAMPLES)
    return times.reshape(RESAMPLES, n).astype(np.uint8)


def tracks(results: Results, key: str) -> list[list[str]]:
    """Return verdicts after 2..N runs by order; for "same" by order and arm."""
    compared = comparisons(results, key)
    pairs = [finding for finding in compared if finding.kind == "goals"]
    exact = [finding for finding in compared if finding.kind != "goals"]
    order, partners = orders(results.goals.shape[1])
    found = []
    for first, second in zip(order, partners if key == SAME else order, strict=True):
        a = np.stack([results.totals(pair.a)[first] for pair in pairs], axis=1)
        b = np.stack([results.totals(pair.b)[second] for pair in pairs], axis=1)
        ends = np.stack(running_gains(a, b), axis=-1)  # (N - 1, K, 3)
        findings = [
            [p._replace(effect=Interval(*e)) for p, e in zip(pairs, row, strict=True)]
            for row in ends.tolist()
        ]
        if key == SAME:
            found += [[f.verdict for f in arm] for arm in zip(*findings, strict=True)]
        else:
            found.append([combine(row + exact) for row in findings])
    return found


def read_along(found: list[list[str]]) -> Stops:
    """
    Return what a reader does who looks from `FIRST_LOOK` runs on.

    >>> late, early = ["undecided"] * 6 + ["holds"], ["undecided"] * 3 + ["holds"] * 4
    >>> read_along([late, early])
    Stops(verdict='holds', settled=8, stops=(8, 5), wrong=0)
    """
    stops, settled, wrong = [], 2, 0
    for track in found:
        looks = enumerate(track[FIRST_LOOK - 2 :], FIRST_LOOK)
        stops.append(next((n for n, verdict in looks if verdict != UNDECIDED), None))
        wrong += bool(stops[-1]) and track[stops[-1] - 2] != track[-1]
        changes = (n for n, verdict in enumerate(track, 2) if verdict != track[-1])
        settled = max(settled, 1 + max(changes, default=1))
    return Stops(found[0][-1], settled, tuple(stops), wrong)
