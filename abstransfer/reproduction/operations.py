"""
Which operations on notes page 10 compares, by name.

Robots are advised, and leave notes.  An operation makes of what they left the
table from which one goes on alone; `interventions` runs them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..experiments.surgery import (
    Left,
    directions,
    drawn,
    erase,
    graft,
    noted,
    shuffle_actions,
    shuffle_states,
)
from .guides import TINY

#: What is asked of drawn buildings, where every run has its own.
MAIN = (
    "nd",
    "prob",
    "half",
    "eager",
    "wanderer",
    "grad",
    "nd-erased",
    "prob-grafted",
)
#: The robots that are advised, and the advice of each, by its name in the study.
ROBOTS = {
    "nd": "beta-0",
    "prob": "beta-1",
    "half": "nd-available-0.5",  # half ND, half eager
    "eager": "available",
    "wanderer": "all",
    "grad": "grad",
}


def _only_nd(left: Left) -> np.ndarray:
    """Return where ND has notes and Prob is blank, (S,)."""
    return noted(left.notes["nd"]) & ~noted(left.notes["prob"])


def _kept(notes: np.ndarray, where: np.ndarray) -> np.ndarray:
    return erase(notes, ~where)


def _thinned(left: Left, robot: str, like: str) -> np.ndarray:
    """Return a robot's notes, kept in as many states as another has, by chance."""
    notes = left.notes[robot]
    n = min(noted(left.notes[like]).sum(), noted(notes).sum())
    return _kept(notes, drawn(noted(notes), n, left.rng))


def _nearest(left: Left, n: int) -> np.ndarray:
    """Return ND's notes in the n of its states that lie nearest to the goal."""
    notes = left.notes["nd"]
    worth = np.where(noted(notes), left.best.max(axis=1), -1)
    return _kept(notes, np.argsort(np.argsort(-worth, kind="stable")) < n)


def _third(left: Left, third: int) -> np.ndarray:
    """Return Prob's notes and a third of ND's others; 0 is nearest to the goal."""
    states = np.flatnonzero(_only_nd(left))
    far = states[np.argsort(-left.best.max(axis=1)[states], kind="stable")]
    where = np.zeros(len(left.best), dtype=bool)
    where[np.array_split(far, 3)[third]] = True
    return graft(left.notes["prob"], left.notes["nd"], where)


def _level(notes: np.ndarray) -> np.ndarray:
    """Return notes that are all as large as the largest of their state."""
    return np.where(notes > 0, notes.max(axis=1, keepdims=True), notes)


def _blank(left: Left) -> np.ndarray:
    return erase(left.best, np.ones(len(left.best), dtype=bool))


def _perfect_where(left: Left, robot: str) -> np.ndarray:
    return _kept(left.best, noted(left.notes[robot]))


OPERATIONS: dict[str, Callable[[Left], np.ndarray]] = {
    # Nothing is changed.
    **{robot: lambda left, robot=robot: left.notes[robot] for robot in ROBOTS},
    "blank": _blank,
    "perfect": lambda left: left.best,
    # Where there are notes.
    "nd-erased": lambda left: erase(left.notes["nd"], _only_nd(left)),
    "prob-grafted": lambda left: graft(
        left.notes["prob"], left.notes["nd"], _only_nd(left)
    ),
    "nd-thinned": lambda left: _thinned(left, "nd", "prob"),
    "nd-nearest": lambda left: _nearest(left, int(noted(left.notes["prob"]).sum())),
    "half-thinned": lambda left: _thinned(left, "half", "nd"),
    "half-on-nd": lambda left: _kept(left.notes["half"], noted(left.notes["nd"])),
    "nd-large": lambda left: _kept(
        left.notes["nd"], left.notes["nd"].max(axis=1) >= TINY
    ),
    "prob-near": lambda left: _third(left, 0),
    "prob-middle": lambda left: _third(left, 1),
    "prob-far": lambda left: _third(left, 2),
    # How good they are.
    "perfect-on-prob": lambda left: _perfect_where(left, "prob"),
    "perfect-on-nd": lambda left: _perfect_where(left, "nd"),
    "nd-directions": lambda left: directions(left.notes["nd"]),
    "nd-level": lambda left: _level(left.notes["nd"]),
    "nd-thousandth": lambda left: left.notes["nd"] / 1000,
    "nd-wrong-way": lambda left: shuffle_actions(
        left.notes["nd"], left.available, left.rng
    ),
    "nd-elsewhere": lambda left: shuffle_states(left.notes["nd"], left.rng),
    # The same experience, thought through.
    **{
        f"{robot}-digested": lambda left, robot=robot: left.digested[robot]
        for robot in ROBOTS
    },
}
