"""
The first five claims under each reading of the learner, in each building.

The paper does not say whether its learner chooses among labels or moves, nor
what a label does that no move carries.  So each reading is judged by itself: at
the paper's tau, and at its own, which is tuned in the target only and carried to
the other buildings.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ..experiments.results import Results, read_results
from .catalogue import TARGETS
from .claims import CLAIMS, Entry, ledger

#: Folders of results by reading of the learner and by whose tau it has.
READINGS = {
    ("labels, waits where it is not there", "paper's"): "goal-{}",
    ("labels, waits where it is not there", "own, tuned in target"): "goal-{}-tuned",
    ("labels, only those that are there", "paper's"): "masked-{}",
    ("labels, only those that are there", "own, tuned in target"): "masked-{}-tuned",
    ("compass", "paper's"): "compass-{}",
    ("compass", "own, tuned in target"): "compass-{}-tuned",
}


def judge_reading(results: Results) -> tuple[Entry, ...]:
    """Return the first five claims, judged with Student's intervals."""
    return ledger(results, claims=CLAIMS[:5])


def judge_readings(
    read: Callable[[str], Results] = read_results,
) -> dict[tuple[str, str, str], tuple[Entry, ...]]:
    """Return the first five claims, judged by reading, tau and building."""
    return {
        (*reading, where): judge_reading(read(folder.format(where)))
        for reading, folder in READINGS.items()
        for where in TARGETS
    }


def readings_table(judged: Mapping[tuple[str, str, str], tuple[Entry, ...]]):
    """Return a row for each reading, tau and building: the verdicts on the claims."""
    return [
        {"learner": learner, "tau": tau, "building": where}
        | {f"claim {entry.claim.key}": entry.verdict for entry in entries}
        for (learner, tau, where), entries in judged.items()
    ]
