"""
The tests of the paper's claims: results of the nine arms in, findings out.

Differences are of runs with the same seed, gains are shares of the other
arm's goals.  Page 9 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..builders import BUILDERS
from ..experiments.arms import STRATEGIES
from ..experiments.curves import SMOOTH, asymptotic_level, critical_point, rises
from ..experiments.results import Results
from ..experiments.stats import (
    LEVEL,
    RESAMPLES,
    Interval,
    mean_interval,
    paired_difference,
    relative_gain,
)
from .verdicts import Finding, judge

MARGIN = 0.01  # "no better": by less than 1 %, about the spread between runs
COMPETES = 0.05  # "competes with the best": at most 5 % below
ABSTRACT = tuple(f"{policy}-{s}" for policy in BUILDERS for s in STRATEGIES)
GUIDED = ("rand-hard", "rand-soft", *ABSTRACT)


def _better(results, rng, a: str, b: str) -> Finding:
    """Arm a reaches more goals than arm b."""
    effect = relative_gain(results.totals(a), results.totals(b), rng=rng)
    return Finding(f"{a} over {b}", effect, "ratio", judge(effect, 0.0))


def _no_better(results, rng, a: str, b: str, main: bool = True) -> Finding:
    """Arm a reaches no more goals than arm b, but for MARGIN."""
    effect = relative_gain(results.totals(a), results.totals(b), rng=rng)
    verdict = judge(effect, MARGIN, above=False)
    return Finding(f"{a} no better than {b}", effect, "ratio", verdict, main)


def nd_is_best(results: Results, rng) -> Iterator[Finding]:
    """ND beats the other policies, strategy by strategy; it drives worse."""
    for strategy in STRATEGIES:
        for other in ("rand", "prob", "grad"):
            yield _better(results, rng, f"nd-{strategy}", f"{other}-{strategy}")
    value = results.record["executed"]  # exact, so the interval is a point
    for other in ("prob", "grad"):
        effect = Interval(*[value[other] - value["nd"]] * 3)
        text = f"{other} over nd, executed without learning"
        yield Finding(text, effect, "reward", judge(effect, 0.0), main=False)


def soft_beats_hard(results: Results, rng) -> Iterator[Finding]:
    """Soft beats hard for each abstract policy, but not for random."""
    for policy in BUILDERS:
        yield _better(results, rng, f"{policy}-soft", f"{policy}-hard")
    yield _no_better(results, rng, "rand-soft", "rand-hard", main=False)


def hard_beats_epsilon_greedy(results: Results, rng) -> Iterator[Finding]:
    """Every hard arm beats Q-learning."""
    for policy in ("rand", *BUILDERS):
        yield _better(results, rng, f"{policy}-hard", "none")


def no_better_than_random(results: Results, rng) -> Iterator[Finding]:
    """Grad and Prob are no better than random at its best, hard."""
    for policy in ("grad", "prob"):
        for strategy in STRATEGIES:
            yield _no_better(results, rng, f"{policy}-{strategy}", "rand-hard")


def all_beat_q_learning(results: Results, rng) -> Iterator[Finding]:
    """Each of the eight arms with a guide beats Q-learning."""
    for arm in GUIDED:
        yield _better(results, rng, arm, "none")


def critical_point_exists(results: Results, rng) -> Iterator[Finding]:
    """The steepest rise of each curve is twice a steady climb, or more."""
    for arm in ("none", *GUIDED):
        # Found in one half of the runs and measured in the other: the steepest
        # rise of noise would else look like one.
        curves = results.curves(arm)
        found, measured = curves[::2], curves[1::2]
        effect = Interval(np.nan, np.nan, np.nan)
        if len(measured):
            place = critical_point(found.mean(axis=0))
            rise = rises(measured)[:, place - SMOOTH]
            climb = asymptotic_level(measured) - measured[:, :SMOOTH].mean(axis=1)
            steady = climb * SMOOTH / (curves.shape[1] - SMOOTH)
            effect = paired_difference(rise, 2 * steady, rng=rng)
        yield Finding(arm, effect, "goals per window", judge(effect, 0.0))


def earlier_is_better(results: Results, rng) -> Iterator[Finding]:
    """Arms whose critical point is earlier end higher."""
    arms = ["none", *ABSTRACT]
    when = np.stack([critical_point(results.curves(arm)) for arm in arms])
    level = np.stack([asymptotic_level(results.curves(arm)) for arm in arms])
    n_runs = when.shape[1]
    drawn = rng.integers(0, n_runs, (RESAMPLES, n_runs))
    order = _concordance(when[:, drawn].mean(axis=2), level[:, drawn].mean(axis=2))
    ends = (np.nan, np.nan)
    if n_runs > 1:
        ends = np.quantile(order, [(1 - LEVEL) / 2, (1 + LEVEL) / 2]).tolist()
    all_runs = _concordance(when.mean(axis=1), level.mean(axis=1))
    effect = Interval(float(all_runs), *ends)
    text = "rank correlation of critical point and final level, 7 arms"
    yield Finding(text, effect, "", judge(effect, 0.0, above=False))


def _concordance(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return Kendall's tau-a of x and y over their first axis."""
    first, second = np.triu_indices(len(x), 1)
    signs = np.sign(x[first] - x[second]) * np.sign(y[first] - y[second])
    return signs.mean(axis=0)


def random_is_late_but_competes(results: Results, rng) -> Iterator[Finding]:
    """Random ends near the best, although it rises late."""
    level = {arm: asymptotic_level(results.curves(arm)) for arm in GUIDED}
    best = max(ABSTRACT, key=lambda arm: level[arm].mean())
    for strategy in STRATEGIES:
        arm = f"rand-{strategy}"
        effect = relative_gain(level[arm], level[best], rng=rng)
        text = f"{arm} over the abstract arm that ends best"
        yield Finding(text, effect, "ratio", judge(effect, -COMPETES))
    window = results.record["parameters"]["window"]
    for strategy in STRATEGIES:
        late = critical_point(results.curves(f"rand-{strategy}")) * window
        for policy in BUILDERS:
            arm = f"{policy}-{strategy}"
            other = critical_point(results.curves(arm)) * window
            effect = mean_interval(late - other, rng=rng)
            text = f"critical point of rand-{strategy} after {arm}"
            yield Finding(text, effect, "steps", judge(effect, 0.0), main=False)
