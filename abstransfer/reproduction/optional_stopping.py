"""
When would you sign?  Verdicts after each run, in several orders of the runs.

Who looks after every run and stops as soon as an interval leaves 0 looks often.
Claims are the first five, and "same": one half of an arm's runs against the other
half, which had other luck, where nothing is to be found.  Page 9 of the book
teaches this module.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..experiments.results import Results
from ..experiments.stats import FEWEST, gain_interval
from .claims import CLAIMS
from .verdicts import UNDECIDED, Finding, combine

FIRST_LOOK = FEWEST  # before, there are no intervals
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
        finding if finding.kind == "goals" else finding.measured(results)
        for finding in CLAIMS[KEYS.index(key)].findings
    )


def orders(n_runs: int) -> np.ndarray:
    """
    Return the orders of the runs, (5, N): as run, and shuffled with seeds 1 to 4.

    >>> orders(4)[0]
    array([0, 1, 2, 3])
    """
    shuffled = [
        np.random.default_rng(k).permutation(n_runs) for k in range(1, N_ORDERS)
    ]
    return np.stack([np.arange(n_runs), *shuffled])


def tracks(results: Results, key: str) -> list[list[str]]:
    """
    Return verdicts after each run from `FIRST_LOOK` on, by order.

    For "same" by order and arm: run i of the first half against run i of the second.
    """
    compared, found = comparisons(results, key), []
    n_runs = results.goals.shape[1]
    half = n_runs // 2
    for order in orders(n_runs):
        pair = (order[:half], order[half:]) if key == SAME else (order, order)
        looks = [
            [_after(n, finding, results, pair) for finding in compared]
            for n in range(FIRST_LOOK, (half if key == SAME else n_runs) + 1)
        ]
        if key == SAME:
            found += [[f.verdict for f in arm] for arm in zip(*looks, strict=True)]
        else:
            found.append([combine(findings) for findings in looks])
    return found


def _after(n: int, finding: Finding, results: Results, pair) -> Finding:
    """Return a finding as the first n runs of each of a pair of orders show it."""
    if finding.kind != "goals":
        return finding
    arms = zip((finding.a, finding.b), pair, strict=True)
    runs = [results.totals(arm)[order[:n]] for arm, order in arms]
    return finding._replace(effect=gain_interval(*runs))


def read_along(found: list[list[str]]) -> Stops:
    """
    Return what a reader does who follows tracks, look by look.

    >>> late, early = ["undecided"] * 3 + ["holds"], ["holds"] * 4
    >>> read_along([late, early])
    Stops(verdict='holds', settled=8, stops=(8, 5), wrong=0)
    """
    stops, settled, wrong = [], FIRST_LOOK, 0
    for track in found:
        looks = list(enumerate(track, FIRST_LOOK))
        stops.append(next((n for n, verdict in looks if verdict != UNDECIDED), None))
        wrong += bool(stops[-1]) and track[stops[-1] - FIRST_LOOK] != track[-1]
        changes = (n for n, verdict in looks if verdict != track[-1])
        settled = max(settled, 1 + max(changes, default=0))
    return Stops(found[0][-1], settled, tuple(stops), wrong)
