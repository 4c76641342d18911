"""
The hypotheses of page 10, judged: ``data/hypotheses.md`` says them in words.

They, their rules and the numbers of runs were written before the runs.  A
hypothesis is a contrast: arms with weights, run by run, that is above 0 if it is
right.  Its interval is Student's, over runs, or over buildings where each run
has its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ..experiments.results import Results
from ..experiments.stats import t_interval
from .verdicts import Finding

ND, PROB = "nd", "prob"


class Hypothesis(NamedTuple):
    """A claim, and the contrast that is above 0 if it is right."""

    key: str  #: as in data/hypotheses.md
    text: str  #: what is predicted
    weights: Mapping[str, float]  #: by arm


def _beyond(share: float, gained: Mapping[str, float]) -> dict[str, float]:
    """Return the weights of a gain, less a share of ND's lead over Prob."""
    weights = {ND: -share, PROB: share}
    for arm, weight in gained.items():
        weights[arm] = weights.get(arm, 0.0) + weight
    return weights


OPERATED = (
    Hypothesis("N1", "necessary", _beyond(0.5, {ND: 1, "nd-erased": -1})),
    Hypothesis("N2", "sufficient", _beyond(0.5, {"prob-grafted": 1, PROB: -1})),
    Hypothesis(
        "N3",
        "how good hardly matters",
        _beyond(-0.25, {"perfect-on-prob": -1, PROB: 1}),
    ),
    Hypothesis(
        "N4", "directions alone do", _beyond(0.75, {"nd-directions": 1, PROB: -1})
    ),
    Hypothesis(
        "N5", "wrong directions keep some", _beyond(0.25, {"nd-wrong-way": 1, PROB: -1})
    ),
    Hypothesis("N6", "elsewhere keeps less", {"nd-wrong-way": 1, "nd-elsewhere": -1}),
    Hypothesis(
        "N7",
        "the nearest are the least useful",
        {"prob-middle": 0.5, "prob-far": 0.5, "prob-near": -1},
    ),
    Hypothesis("N8a", "number is not enough", {ND: 1, "half-thinned": -1}),
    Hypothesis("N8b", "on ND's own states it is", {"half-on-nd": 1, ND: -1}),
    Hypothesis("N9", "tiny notes count", {ND: 1, "nd-large": -1}),
    Hypothesis("N10", "the wanderer digests", {"wanderer-digested": 1, ND: -1}),
    Hypothesis(
        "N11",
        "digestion shrinks the lead",
        _beyond(-1, {"nd-digested": -1, "prob-digested": 1}),
    ),
)


def contrast(results: Results, weights: Mapping[str, float]) -> np.ndarray:
    """
    Return the weighted sum of the goals of arms, run by run, (N,).

    Raises KeyError naming the arms there are.
    """
    return sum(weight * results.totals(arm) for arm, weight in weights.items())


def judge_operations(results: Results) -> tuple[Finding, ...]:
    """Return what operations say of each hypothesis whose arms they hold."""
    there = {arm.name for arm in results.arms}
    findings = []
    for hypothesis in OPERATED:
        if hypothesis.weights.keys() <= there:
            effect = t_interval(contrast(results, hypothesis.weights))
            words = hypothesis.key, hypothesis.text
            findings.append(Finding("contrast", *words, effect=effect))
    return tuple(findings)


def share_of_lead(results: Results, arm: str, start: str = PROB) -> float:
    """Return which share of ND's lead over Prob lies between `start` and an arm."""
    lead = contrast(results, {ND: 1, PROB: -1}).mean()
    return float(contrast(results, {arm: 1, start: -1}).mean() / lead)
