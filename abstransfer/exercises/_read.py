"""Reading an answer, whatever it is, and kind words where it cannot be read."""

from __future__ import annotations

import numpy as np


class Unreadable(Exception):
    """Says in kind words why an answer cannot be judged."""


def blank(answer) -> None:
    """Refuse what is no answer yet."""
    if answer is ...:
        raise Unreadable("The blank `...` is still there; put your answer in its place")
    if answer is None:
        raise Unreadable(
            "There is no answer in it, only `None`. Is a `return` missing?"
        )


def numbers(answer) -> np.ndarray:
    """Return an answer as an array of floats."""
    blank(answer)
    if callable(answer):
        raise Unreadable("This is a function; what is asked for is a number or array")
    try:
        array = np.array(answer, dtype=float)
    except Exception:
        kind = type(answer).__name__
        raise Unreadable(
            f"A number or an array of numbers is asked for, not a {kind}"
        ) from None
    if np.isnan(array).any():
        raise Unreadable(
            "There is a `nan` in it, which comes from 0/0 or from inf - inf. "
            "Where could that happen?"
        )
    return array


def size(answer) -> np.ndarray:
    """Return numbers without their signs: a cost of 1 and a value of -1 agree."""
    return np.abs(numbers(answer))


def word(answer) -> str:
    """Return an answer as a word in lower case."""
    blank(answer)
    if not isinstance(answer, str):
        kind = type(answer).__name__
        raise Unreadable(f"A word in quotes is asked for, not a {kind}")
    return answer.strip(" .!").lower()


def numbers_of_actions(answer) -> np.ndarray:
    """Return a set of actions, sorted; a set, a list, an array or a mask will do."""
    blank(answer)
    if isinstance(answer, (set, frozenset)):
        answer = list(answer)
    array = np.atleast_1d(numbers(answer))
    if np.asarray(answer).dtype == bool:
        array = np.flatnonzero(array)
    return np.unique(array).astype(float)


def same(a, b, tolerance: float) -> bool:
    """Return whether two answers that were read agree."""
    if isinstance(a, str) or isinstance(b, str):
        return isinstance(a, str) and isinstance(b, str) and a == b
    if a.size == b.size == 1:
        a, b = a.ravel(), b.ravel()
    return a.shape == b.shape and np.allclose(a, b, rtol=tolerance, atol=tolerance)


def shown(thing) -> str:
    """Return a number, array or function as a short text, the same each time."""
    if callable(thing):
        return getattr(thing, "__name__", type(thing).__name__)
    if isinstance(thing, (list, tuple)):
        return f"[{', '.join(shown(part) for part in thing)}]"
    if isinstance(thing, (bool, np.bool_, str)):
        return repr(thing)
    try:
        text = np.array2string(np.asarray(thing), precision=4, separator=", ")
    except Exception:
        return type(thing).__name__
    return " ".join(text.split())
