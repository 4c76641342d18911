"""
Exercises that check themselves.

``check("ex-3-1", answer)`` replies at once and in words.  The exercises of a page
are data in the module of that page; nothing here is loaded by
``import abstransfer``.  ``python -m abstransfer.exercises`` lists them all.
"""

from ._check import Reply, check
from ._model import (
    Exercise,
    Open,
    Wrong,
    all_exercises,
    all_open_exercises,
    exercises_of,
    open_exercises_of,
)
from ._predict import Prediction, predict

__all__ = [
    "Exercise",
    "Open",
    "Prediction",
    "Reply",
    "Wrong",
    "all_exercises",
    "all_open_exercises",
    "check",
    "exercises_of",
    "open_exercises_of",
    "predict",
]
