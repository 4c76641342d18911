"""
The paper's claims as data, and the ledger: each of them judged on results.

A claim has the paper's words, and its test in words and as findings.  How a
finding is measured and judged stands in ``verdicts``.  Page 9 of the book
teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ..driving import BUILDERS
from ..experiments.arms import STRATEGIES
from ..experiments.results import Results
from ..experiments.stats import LEVEL
from .verdicts import ABSTRACT, Finding, combine

MARGIN = 0.01  # "no better": by less than 1 %, about the spread between runs
COMPETES = 0.05  # "competes with the best": at most 5 % below
GUIDED = ("rand-hard", "rand-soft", *ABSTRACT)


class Claim(NamedTuple):
    """A claim as data."""

    key: str  #: its number
    title: str  #: in a few words
    quote: str  #: the paper's words
    test: str  #: in words
    findings: tuple[Finding, ...]  #: the same, not yet measured


class Entry(NamedTuple):
    """A claim, judged on one experiment."""

    claim: Claim  #: what is judged
    findings: tuple[Finding, ...]  #: its parts
    verdict: str  #: of all parts together


CLAIMS = (
    Claim(
        "1",
        "ND transfers best, though by value it drives worst",
        "Despite the policy pi_AbsND has shown the worst performance when executed "
        "in the environment [...], it proved better than the other policies when it "
        "was used for transfer learning",
        "ND reaches more goals than random, Prob and Grad, under either strategy; on "
        "condition that it drives worse than Prob and Grad.",
        (
            *(
                Finding("goals", f"nd-{strategy}", f"{other}-{strategy}")
                for strategy in STRATEGIES
                for other in ("rand", "prob", "grad")
            ),
            *(
                Finding("driving", other, "nd", main=False)
                for other in ("prob", "grad")
            ),
        ),
    ),
    Claim(
        "2",
        "Soft beats hard, but not for random",
        "among abstract policies, the soft strategy is better than the hard strategy; "
        "but not for random policy",
        "Soft reaches more goals than hard for ND, Prob and Grad; on condition that "
        "for random it does not reach 1 % more.",
        (
            *(Finding("goals", f"{p}-soft", f"{p}-hard") for p in BUILDERS),
            Finding("goals", "rand-soft", "rand-hard", MARGIN, above=False, main=False),
        ),
    ),
    Claim(
        "3",
        "A hard phase of exploration beats eps-greedy",
        "usually eps-greedy is considered a good strategy for the "
        "exploration-exploitation dilemma for learning, but our experiments show that "
        "the hard strategy was a better option",
        "Each hard arm, random first of all, reaches more goals than Q-learning, "
        "which is eps-greedy from the first step.",
        tuple(Finding("goals", f"{p}-hard", "none") for p in ("rand", *BUILDERS)),
    ),
    Claim(
        "4",
        "Grad and Prob transfer no better than random",
        "abstract policies pi_AbsGrad and pi_AbsProb did not prove to be better than "
        "random policy for transfer learning",
        "Neither, under either strategy, reaches 1 % more goals than random does "
        "under its better strategy, the hard one.",
        tuple(
            Finding("goals", f"{p}-{strategy}", "rand-hard", MARGIN, above=False)
            for p in ("grad", "prob")
            for strategy in STRATEGIES
        ),
    ),
    Claim(
        "5",
        "Every transfer beats Q-learning",
        "all of the policies transfered proved to be better than Q-Learning with "
        "fixed eps",
        "Each of the eight arms reaches more goals than Q-learning.",
        tuple(Finding("goals", arm, "none") for arm in GUIDED),
    ),
    Claim(
        "6a",
        "Every curve has a critical point",
        "All of the experiments show the same learning behavior: there is a critical "
        "point, when performance improves faster",
        "In each arm the steepest rise, found in half of the runs and measured in the "
        "others, is over twice that of a steady climb.",
        tuple(Finding("rise", arm) for arm in ("none", *GUIDED)),
    ),
    Claim(
        "6b",
        "The earlier the critical point, the better the end",
        "Excepting random policy, the earlier the critical point, the better the "
        "performance in the final steps of the experiment",
        "Over the seven arms without random, critical point and final level are "
        "negatively rank-correlated.",
        (Finding("order", above=False),),
    ),
    Claim(
        "6c",
        "Random is late, but competes in the end",
        "Even if the critical point occurs late when transferring random policy, the "
        "final performance competes with the best final performance",
        "Random ends at most 5 % below the abstract arm that ends best; on condition "
        "that its critical point is later than theirs under the same strategy.",
        (
            *(Finding("end", f"rand-{s}", threshold=-COMPETES) for s in STRATEGIES),
            *(
                Finding("delay", f"rand-{strategy}", f"{p}-{strategy}", main=False)
                for strategy in STRATEGIES
                for p in BUILDERS
            ),
        ),
    ),
)


def ledger(
    results: Results, *, claims: Iterable[Claim] = CLAIMS, level: float = LEVEL
) -> tuple[Entry, ...]:
    """
    Return all claims, judged on the results of the nine arms.

    Parameters
    ----------
    results : Results
        From :func:`~abstransfer.experiments.run.run_experiment` with ARMS, or with
        the same arms and other tau.
    claims : iterable of Claim
        By default all.
    level : float
        Of each interval; nearer to 1 where there are many.
    """
    entries = []
    for claim in claims:
        findings = tuple(finding.measured(results, level) for finding in claim.findings)
        entries.append(Entry(claim, findings, combine(findings)))
    return tuple(entries)
