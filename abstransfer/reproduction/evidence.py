"""
Three readings of the learner against the evidence that the paper's text holds.

The paper's learner may choose among labels, and wait where one names nothing; or
among the labels that name something; or among four moves.  The evidence is nine
tau, five claims and ten numbers of Table 1; and what the group's files show.
Page 9 and the ledger show the table.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ..builders import BUILDERS
from ..driving import PAPER, ROWS, column
from ..experiments.problem import Problem, build_guides
from ..experiments.results import Results, read_results
from ..experiments.tuning import tune
from ..maps import read_map
from ..navigation import navigation_tasks
from .catalogue import TARGETS
from .readings import judge_reading
from .verdicts import HOLDS

CLOSE = 0.02  # of the paper's number


class Reading(NamedTuple):
    """A reading of the learner."""

    name: str  #: in words
    problem: Problem  #: what is learned
    folder: str  #: how the folders of its results begin
    files: str  #: whether the group's files show it


READINGS = (
    Reading("labels, waits", Problem(), "goal", "for advice only"),
    Reading("labels, masked", Problem(unavailable="masked"), "masked", "no"),
    Reading("compass", Problem(actions="compass"), "compass", "yes"),
)


def evidence_table(read: Callable[[str], Results] = read_results) -> list[dict]:
    """
    Return a row for each reading: what it meets of each kind of evidence.

    Claims are given by their numbers: those that hold in the target, then those
    that hold in all four buildings.  Of the ten numbers of Table 1, two chose the
    target building, under the first reading.  What is not stored was not run.
    """
    return [
        {
            "the learner": reading.name,
            "the paper's tau is among the best": _tau_inside(reading, read),
            "claims that hold, paper's tau": _held(reading, "", read),
            "claims that hold, own tau": _held(reading, "-tuned", read),
            "of 10 numbers of Table 1, within 2 %": _close(reading),
            "in the group's files": reading.files,
        }
        for reading in READINGS
    ]


def _stored(read, folder: str) -> Results | None:
    try:
        return read(folder)
    except FileNotFoundError:
        return None


def _tau_inside(reading: Reading, read) -> str:
    grid = _stored(read, f"{reading.folder}-target-tau")
    if grid is None:
        return "not run"
    tunings = tune(grid)
    return f"{sum(t.paper_inside for t in tunings)} of {len(tunings)}"


def _held(reading: Reading, ending: str, read) -> str:
    found = [_stored(read, f"{reading.folder}-{where}{ending}") for where in TARGETS]
    if found[0] is None:
        return "not run"
    held = [
        {e.claim.key for e in judge_reading(results) if e.verdict == HOLDS}
        for results in found
        if results is not None
    ]
    here, everywhere = (
        ", ".join(sorted(keys)) or "none" for keys in (held[0], set.intersection(*held))
    )
    missing = len(held) < len(TARGETS)
    return f"{here}; in all four: {'not run' if missing else everywhere}"


def _close(reading: Reading) -> int:
    """Return how many of the ten numbers come out, for advice built in the source."""
    problem, found = reading.problem, 0
    guides = build_guides(problem, BUILDERS)
    for where, paper in PAPER.items():
        tasks = navigation_tasks(
            read_map(where),
            success=problem.success,
            actions=problem.actions,
            unavailable=problem.unavailable,
        )
        here = column(tasks, guides)
        found += sum(abs(here[r] - paper[r]) <= CLOSE * abs(paper[r]) for r in ROWS)
    return int(found)
