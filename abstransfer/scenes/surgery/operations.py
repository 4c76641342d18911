"""What the reader may do to notes: as `operations.js` does it, luck included."""

from __future__ import annotations

import numpy as np

from ...experiments.surgery import erase, graft, noted

KINDS = ("none", "erase", "graft", "deal", "thin")


def operate(
    kind: str, mine: np.ndarray, other: np.ndarray, available: np.ndarray, luck: int
) -> np.ndarray:
    """
    Return the notes (S, A) of a robot after an operation; `other` are another's.

    >>> mine, other = np.array([[0.1], [0.2]]), np.array([[0.3], [0.0]])
    >>> operate("erase", mine, other, np.ones((2, 1), bool), 1).ravel().tolist()
    [0.1, 0.0]
    >>> operate("graft", other, mine, np.ones((2, 1), bool), 1).ravel().tolist()
    [0.3, 0.2]
    """
    if kind == "erase":
        return erase(mine, ~noted(other))
    if kind == "graft":
        return graft(mine, other, ~noted(mine))
    words = np.random.SeedSequence(luck).generate_state(mine.size).reshape(mine.shape)
    if kind == "deal":
        return np.where(noted(mine)[:, None], _dealt(mine, available, words), mine)
    if kind == "thin":  # the first bit of a state's first word: heads
        return erase(mine, words[:, 0] >> np.uint32(31) == 0)
    return mine


def _dealt(notes: np.ndarray, available: np.ndarray, words: np.ndarray) -> np.ndarray:
    """Return notes dealt anew, in each state, among its available actions."""
    last = np.uint64(2**32)  # what is not there comes last, and in its own order
    drawn = np.argsort(np.where(available, words, last), axis=1, kind="stable")
    place = np.argsort(~available, axis=1, kind="stable")
    dealt = np.empty_like(notes)
    rows = np.arange(len(notes))[:, None]
    dealt[rows, place] = notes[rows, drawn]
    return dealt
