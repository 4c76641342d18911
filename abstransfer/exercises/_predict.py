"""A prediction that is sealed before a run, and compared after it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..project.prediction import DIRECTIONS, seal
from ._model import exercises_of, open_exercises_of, page_of

_sealed: dict[str, list[str]] = {}  # seals by exercise, since Python was started


@dataclass(frozen=True)
class Prediction:
    """What was predicted; it prints itself with its seal, which a notebook keeps."""

    key: str
    direction: str  # "+", "-" or "0"
    refuted_below: float  # the size, in the direction, that is too little
    number: int = 1  # which prediction for this exercise, since Python was started

    @property
    def seal(self) -> str:
        """Eight letters that follow from the prediction, and from nothing else."""
        text = f"{self.key} {self.direction} {self.refuted_below!r}"
        return seal(text)

    def compare(self, found: float) -> str:
        """
        Return in words what a result says to the prediction.

        >>> bet = predict("ex-10-4", direction="-", refuted_below=0.05)
        >>> bet.compare(-0.08).partition(". ")[0]
        'ex-10-4: as predicted'
        """
        size = {"+": found, "-": -found, "0": -abs(found)}[self.direction]
        if not math.isfinite(found):
            raise ValueError(f"found must be a finite number, got {found!r}")
        least = -self.refuted_below if self.direction == "0" else self.refuted_below
        word = "as predicted" if size >= least else "refuted"
        return (
            f"{self.key}: {word}. Sealed {self.seal}: {self._said()}; found {found:g}."
        )

    def _said(self) -> str:
        if self.direction == "0":
            return f"no effect above {self.refuted_below:g} either way"
        return f"direction {self.direction}, at least {self.refuted_below:g}"

    def __repr__(self) -> str:
        again = f" Prediction {self.number} for this." if self.number > 1 else ""
        return f"{self.key}: sealed {self.seal}, {self._said()}.{again}"


def predict(key: str, *, direction: str, refuted_below: float) -> Prediction:
    """
    Seal a prediction before a run.

    Parameters
    ----------
    key : str
        The id of an exercise, such as ``"ex-10-1"``.
    direction : {"+", "-", "0"}
        The sign of the effect; "0" says that there is none to speak of.
    refuted_below : float
        The smallest effect in this direction that does not refute it; for "0" the
        largest in either.

    Returns
    -------
    Prediction
        It prints itself with a short seal; where a cell ends with it, the notebook
        keeps that as output, and it can be written on the board.
        ``.compare(found)`` opens it after the run.  Whoever
        predicts again is told which prediction it is.

    Raises
    ------
    ValueError
        If there is no such exercise, direction or size.

    Examples
    --------
    >>> bet = predict("ex-10-1", direction="+", refuted_below=0.05)
    >>> bet
    ex-10-1: sealed 6412c89f, direction +, at least 0.05.
    >>> bet.compare(0.18)[:22]
    'ex-10-1: as predicted.'
    """
    page = page_of(key) if isinstance(key, str) else None
    known = {} if page is None else open_exercises_of(page) | exercises_of(page)
    if key not in known:
        raise ValueError(
            f'key must be the id of an exercise, as "ex-10-1", got {key!r}'
        )
    if direction not in DIRECTIONS:
        raise ValueError(f"direction must be one of {DIRECTIONS}, got {direction!r}")
    if not (isinstance(refuted_below, int | float) and 0 <= refuted_below < math.inf):
        words = "refuted_below must be a size from 0, such as 0.05"
        raise ValueError(f"{words}, got {refuted_below!r}")
    found = Prediction(key, direction, float(refuted_below))
    seals = _sealed.setdefault(key, [])
    if found.seal not in seals:
        seals.append(found.seal)
    return Prediction(key, direction, float(refuted_below), 1 + seals.index(found.seal))
