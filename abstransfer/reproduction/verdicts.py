"""
From intervals to verdicts: the only way in which the ledger decides.

Page 9 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ..experiments.stats import Interval

HOLDS, FAILS, UNDECIDED = "holds", "does not hold", "undecided"
IN_PART = "fails in part"


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

    It holds if all of them do.  If one fails, the claim fails: in part, if one of
    the main findings holds.  Else it is undecided.

    >>> effect = Interval(0.0, 0.0, 0.0)
    >>> combine([Finding("", effect, "", HOLDS), Finding("", effect, "", FAILS)])
    'fails in part'
    """
    findings = tuple(findings)
    main = [finding.verdict for finding in findings if finding.main]
    verdicts = [finding.verdict for finding in findings]
    if FAILS in verdicts:
        return IN_PART if HOLDS in main else FAILS
    return HOLDS if main and set(verdicts) == {HOLDS} else UNDECIDED
