"""
From effects to verdicts: the only way in which the ledger decides.

A finding is data: an effect of one arm over another, and the side of a
threshold on which the paper sees it.  Its verdict follows from the interval of
the effect alone.  Differences are of runs with the same seed, gains are shares
of the other arm's goals.  Page 9 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from ..driving import BUILDERS
from ..experiments.arms import STRATEGIES
from ..experiments.curves import SMOOTH, asymptotic_level, critical_point, rises
from ..experiments.results import Results
from ..experiments.stats import (
    FEWEST,
    LEVEL,
    Interval,
    gain_interval,
    rank_interval,
    t_interval,
)

HOLDS, FAILS, UNDECIDED = "holds", "does not hold", "undecided"
IN_PART = "fails in part"
ABSTRACT = tuple(f"{policy}-{s}" for policy in BUILDERS for s in STRATEGIES)
UNKNOWN = Interval(np.nan, np.nan, np.nan)


class Finding(NamedTuple):
    """One effect, and whether it is what the paper says."""

    kind: str  #: of the effect: a name in KINDS
    a: str = ""  #: an arm, or a policy
    b: str = ""  #: what it is compared with
    threshold: float = 0.0  #: what the effect is compared with
    above: bool = True  #: the side of the threshold on which the paper sees the effect
    main: bool = True  #: else a condition: it can lower the verdict, not raise it
    effect: Interval = UNKNOWN  #: the interval that was found

    @property
    def text(self) -> str:
        """
        What the effect is of, in words.

        >>> Finding("goals", "rand-soft", "rand-hard", 0.01, above=False).text
        'rand-soft no better than rand-hard'
        """
        over = "over" if self.above else "no better than"
        b = "itself" if self.b == self.a else self.b
        return KINDS[self.kind].words.format(a=self.a, b=b, over=over)

    @property
    def unit(self) -> str:
        """Unit of the effect: "ratio" (0.1 is 10 %), "steps", ..., or ""."""
        return KINDS[self.kind].unit

    @property
    def verdict(self) -> str:
        """HOLDS, FAILS or UNDECIDED."""
        return judge(self.effect, self.threshold, self.above)

    def measured(self, results: Results, level: float = LEVEL) -> Finding:
        """Return the finding with the effect that results show, at a level."""
        measure = KINDS[self.kind].effect
        return self._replace(effect=measure(results, self.a, self.b, level))


class Kind(NamedTuple):
    """A kind of effect."""

    words: str  #: how its text is made
    unit: str  #: of its effect
    #: how it is computed
    effect: Callable[[Results, str, str, float], Interval] | None


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

    >>> more, less = Interval(0.2, 0.1, 0.3), Interval(-0.2, -0.3, -0.1)
    >>> combine(Finding("goals", effect=effect) for effect in (more, less))
    'fails in part'
    """
    findings = tuple(findings)
    main = [finding.verdict for finding in findings if finding.main]
    verdicts = [finding.verdict for finding in findings]
    if FAILS in verdicts:
        return IN_PART if HOLDS in main else FAILS
    return HOLDS if main and set(verdicts) == {HOLDS} else UNDECIDED


def _goals(results, a, b, level) -> Interval:
    return gain_interval(results.totals(a), results.totals(b), level)


def _executed(results, a, b, level) -> Interval:
    value = results.record["executed"]  # exact, so the interval is a point
    return Interval(*[value[a] - value[b]] * 3)


def _rise(results, arm, _, level) -> Interval:
    """By how much the steepest rise exceeds twice that of a steady climb."""
    # Found in one half of the runs and measured in the other: the steepest
    # rise of noise would else look like one.
    curves = results.curves(arm)
    found, measured = curves[::2], curves[1::2]
    if not len(measured):
        return UNKNOWN
    place = critical_point(found.mean(axis=0))
    rise = rises(measured)[:, place - SMOOTH]
    climb = asymptotic_level(measured) - measured[:, :SMOOTH].mean(axis=1)
    return t_interval(rise - 2 * climb * SMOOTH / (curves.shape[1] - SMOOTH), level)


def _order(results, _, __, level) -> Interval:
    """Return Kendall's tau-a of critical point and final level over the arms."""
    curves = [results.curves(arm) for arm in ("none", *ABSTRACT)]
    when, end = (
        np.array([measure(of).mean() for of in curves])
        for measure in (critical_point, asymptotic_level)
    )
    order = _concordance(when, end)
    if len(curves[0]) < FEWEST:
        return UNKNOWN._replace(estimate=order)
    # The question is about arms, so they are what there are n of, not runs.
    return rank_interval(order, len(curves), level)


def _concordance(x: np.ndarray, y: np.ndarray) -> float:
    """Return Kendall's tau-a of x and y, both (n,)."""
    first, second = np.triu_indices(len(x), 1)
    signs = np.sign(x[first] - x[second]) * np.sign(y[first] - y[second])
    return float(signs.mean())


def _end(results, arm, _, level) -> Interval:
    ends = {name: asymptotic_level(results.curves(name)) for name in (arm, *ABSTRACT)}
    best = max(ABSTRACT, key=lambda name: ends[name].mean())
    return gain_interval(ends[arm], ends[best], level)


def _delay(results, a, b, level) -> Interval:
    window = results.record["parameters"]["window"]
    when, before = (critical_point(results.curves(arm)) * window for arm in (a, b))
    return t_interval(when - before, level)


KINDS = {
    "goals": Kind("{a} {over} {b}", "ratio", _goals),
    "driving": Kind("{a} over {b}, executed without learning", "reward", _executed),
    "rise": Kind("{a}", "goals per window", _rise),
    "order": Kind(
        "rank correlation of critical point and final level, n = 7 arms", "", _order
    ),
    "end": Kind("{a} over the abstract arm that ends best", "ratio", _end),
    "delay": Kind("critical point of {a} after {b}", "steps", _delay),
}
