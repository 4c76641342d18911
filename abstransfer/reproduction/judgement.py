"""
What is said of a hypothesis: parts with an effect and a verdict, and of all.

A part holds if the whole interval of its effect lies where the hypothesis has
it, and is refuted if the whole of it lies elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

import numpy as np

from ..experiments.results import Results
from ..experiments.stats import Interval, gain_interval, t_interval

Read = Callable[[str], Results]  # the results of a folder, by its name
HOLDS, REFUTED, UNDECIDED = "holds", "refuted", "undecided"
HOLDS_IN_PART, REFUTED_IN_PART = "holds in part", "refuted in part"


class Part(NamedTuple):
    """One effect in one place, and what it says."""

    where: str  #: a building, or "drawn"
    what: str  #: the effect is of
    effect: Interval  #: nan ends for what is exact, or of too few runs
    unit: str  #: "goals", "ratio" (0.1 is 10 %), "of 20", ...
    verdict: str  #: HOLDS, REFUTED or UNDECIDED
    share: float | None = None  #: of ND's lead over Prob that was asked about


class Judged(NamedTuple):
    """A hypothesis, judged."""

    key: str  #: as in data/hypotheses.md
    parts: tuple[Part, ...]  #: what it says, place by place
    verdict: str  #: of all parts together


def place(effect: Interval, low: float = -np.inf, high: float = np.inf) -> str:
    """
    Return whether an effect lies between two bounds, by its interval.

    >>> place(Interval(0.2, 0.1, 0.3), low=0)
    'holds'
    >>> place(Interval(0.2, 0.1, 0.3), low=-0.1, high=0.05)
    'refuted'
    >>> place(Interval(0.2, np.nan, np.nan), low=0)
    'undecided'
    """
    if effect.low > low and effect.high < high:
        return HOLDS
    if effect.high < low or effect.low > high:
        return REFUTED
    return UNDECIDED


def all_together(parts: Iterable[Part]) -> str:
    """
    Return the verdict on a hypothesis that says all of its parts at once.

    >>> [all_together(Part("", "", None, "", verdict) for verdict in verdicts)
    ...  for verdicts in (["holds"], ["holds", "refuted"], ["holds", "undecided"])]
    ['holds', 'refuted in part', 'holds in part']
    """
    found = {part.verdict for part in parts}
    if len(found) == 1:
        return found.pop()
    if REFUTED in found:
        return REFUTED_IN_PART if HOLDS in found else REFUTED
    return HOLDS_IN_PART


def of_mean(where, what, sample, unit="goals", share=None, **bounds) -> Part:
    """Return the part that the mean of a sample (N,) lies within bounds."""
    effect = t_interval(sample)
    bounds = bounds or {"low": 0}
    return Part(where, what, effect, unit, place(effect, **bounds), share)


def of_gain(where, what, a, b, **bounds) -> Part:
    """Return the part that a's gain over b, both (N,), lies within bounds."""
    effect = gain_interval(a, b)
    bounds = bounds or {"low": 0}
    return Part(where, what, effect, "ratio", place(effect, **bounds))


def of_count(where, what, true, least: int) -> Part:
    """
    Return the part that something is true (N,) at least so often: it is exact.

    >>> of_count("drawn", "ND leads", [True, True, False], 3).verdict
    'refuted'
    """
    n = int(np.sum(true))
    verdict = HOLDS if n >= least else REFUTED
    effect = Interval(float(n), np.nan, np.nan)
    return Part(where, what, effect, f"of {len(true)}", verdict)


def gains(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """
    Return numbers, run by run, whose mean is mean(a) / mean(b) - 1, all (N,).

    And which vary as that does from sample to sample, to the first order: for
    differences of gains.

    >>> gains(np.array([6.0, 6.0]), np.array([4.0, 6.0])).round(6).tolist()
    [0.44, -0.04]
    """
    ratio = a.mean() / b.mean()
    return (ratio - 1) + ratio * (a / a.mean() - b / b.mean())


def judge_by(
    rules: Mapping[str, Callable[[Read], Iterable[Part]]],
    keys: Iterable[str],
    read: Read,
) -> dict[str, Judged]:
    """Return the verdicts on hypotheses by these rules; ValueError if one has none."""
    judged = {}
    for key in keys:
        if key not in rules:
            raise ValueError(f"keys must be among {', '.join(rules)}, got {key!r}")
        parts = tuple(rules[key](read))
        judged[key] = Judged(key, parts, all_together(parts))
    return judged
