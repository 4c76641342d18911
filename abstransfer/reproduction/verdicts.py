"""
From intervals to verdicts: the only way in which the ledger decides.

Page 9 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ..experiments.stats import Interval

HOLDS, FAILS, UNDECIDED = "holds", "does not hold", "undecided"
IN_PART = "holds in part"


class Finding(NamedTuple):
    """One effect, and whether it is what the paper says."""

    text: str  # what the effect is of
    effect: Interval
    unit: str  # "ratio" (0.1 is 10 %), "goals per window", "steps", "reward", ""
    verdict: str  # HOLDS, FAILS or UNDECIDED
    main: bool = True  # else a condition: it can lower the verdict, not raise it


def judge(effect: Interval, threshold: float, above: bool = True) -> str:
    """
    Return whether an effect is above (or below) a threshold, by its interval.

    >>> judge(Interval(0.2, 0.1, 0.3), 0.0)
    'holds'
    >>> judge(Interval(0.2, -0.1, 0.3), 0.0)
    'undecided'
    """
    if effect.low > threshold:
        return HOLDS if above else FAILS
    if effect.high < threshold:
        return FAILS if above else HOLDS
    return UNDECIDED


def combine(findings: Iterable[Finding]) -> str:
    """
    Return the verdict on a claim that says all of its findings at once.

    Of the main findings: all hold - it holds; some hold and some fail - in
    part; some fail, none holds - it does not hold; else undecided.  A condition
    that does not hold makes "holds" into "holds in part".
    """
    findings = tuple(findings)
    main = [finding.verdict for finding in findings if finding.main]
    if main and all(verdict == HOLDS for verdict in main):
        conditions = [finding.verdict for finding in findings if not finding.main]
        return HOLDS if all(v == HOLDS for v in conditions) else IN_PART
    if FAILS in main:
        return IN_PART if HOLDS in main else FAILS
    return UNDECIDED
