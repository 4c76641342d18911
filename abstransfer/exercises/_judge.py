"""Judging an answer: what it comes to, and whether two answers agree."""

from __future__ import annotations

import copy
import inspect
import warnings

import numpy as np

from ._model import Exercise
from ._read import Unreadable, same, shown


def outcomes(exercise: Exercise, answer) -> list:
    """Return what an answer comes to, one entry per case; one for a value."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        if exercise.cases is None:
            return [exercise.read(answer)]
        _check_function(exercise, answer)
        return [_try(exercise, answer, case) for case in _cases(exercise)]


def _cases(exercise: Exercise) -> list[tuple]:
    """Return the cases to try: random, and the same each time."""
    return list(exercise.cases(np.random.default_rng(2015)))


def _try(exercise: Exercise, answer, case: tuple):
    try:
        result = exercise.probe(answer, *copy.deepcopy(case))
    except Unreadable:
        raise
    except (Exception, SystemExit) as error:
        said = f"{type(error).__name__}: {error}".strip(": ")
        raise Unreadable(
            f"Your function stopped with `{said}`{_called(exercise, case)}"
        ) from None
    return exercise.read(result)


def _check_function(exercise: Exercise, answer) -> None:
    """Refuse what cannot be called as the solution can."""
    signature = f"{exercise.name}({', '.join(exercise.parameters)})"
    if not callable(answer):
        raise Unreadable(
            f"Give the function itself, without calling it: "
            f'`check("{exercise.key}", {exercise.name})`'
        )
    try:
        inspect.signature(answer).bind(*exercise.parameters)
    except TypeError:
        raise Unreadable(f"Your function must take what `{signature}` takes") from None
    except ValueError:  # a built-in function that does not say what it takes
        pass


def agree(exercise: Exercise, ours: list, theirs: list | None) -> bool:
    return theirs is not None and all(
        same(a, b, exercise.tolerance) for a, b in zip(ours, theirs, strict=True)
    )


def _called(exercise: Exercise, case: tuple) -> str:
    """Say with which arguments a function was called, if that is short."""
    pairs = zip(exercise.parameters, case, strict=False)
    text = ", ".join(f"{name}={shown(argument)}" for name, argument in pairs)
    return f", called with {text}" if len(text) <= 200 else ""


def counterexample(exercise: Exercise, outcome: list, right: list) -> str:
    """Show the shortest case in which an answer is wrong."""
    told = []
    for case, a, b in zip(_cases(exercise), outcome, right, strict=True):
        if not same(a, b, exercise.tolerance):
            told.append(
                f"Yours gives {shown(a)}, not {shown(b)}{_called(exercise, case)}."
            )
    shortest = min((t for t in told if "called with" in t), key=len, default="")
    return shortest if len(shortest) <= 300 else ""
