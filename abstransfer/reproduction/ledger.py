"""
The ledger: every claim of the paper, judged on stored results.

A verdict follows from intervals alone (``verdicts``), an effect from a pure
function of the results (``claims``).  Page 9 of the book teaches this module.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..experiments.results import Results
from .claims import CLAIMS, Claim
from .verdicts import Finding, combine


class Entry(NamedTuple):
    """A claim, judged on one experiment."""

    claim: Claim
    findings: tuple[Finding, ...]
    verdict: str


def ledger(results: Results, *, rng=0) -> tuple[Entry, ...]:
    """
    Return all claims, judged on the results of the nine arms.

    Parameters
    ----------
    results : Results
        From :func:`~abstransfer.experiments.run.run_experiment` with ARMS, or with
        the same arms and other tau.
    rng : int, SeedSequence or Generator
        Draws the resamples of the intervals.
    """
    rng = np.random.default_rng(rng)
    entries = []
    for claim in CLAIMS:
        findings = tuple(claim.findings(results, rng))
        entries.append(Entry(claim, findings, combine(findings)))
    return tuple(entries)
