"""
Exercises that check themselves.

``check("ex-3-1", answer)`` replies at once and in words.  The exercises of a page
are data in the module of that page; nothing here is loaded by
``import abstransfer``.  ``python -m abstransfer.exercises`` lists them all.
"""

from ._check import Reply, check
from ._model import Exercise, Wrong, all_exercises, exercises_of

__all__ = ["Exercise", "Reply", "Wrong", "all_exercises", "check", "exercises_of"]
