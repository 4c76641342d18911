"""Judging a function: tried case by case, and compared with what is known."""

from __future__ import annotations

import copy
import inspect
import warnings
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ._model import Exercise, Verdict
from ._read import Unreadable, same, shown
from ._run import Stopped, described


class Outcome(NamedTuple):
    """What a function comes to in one case."""

    values: Any  # what is compared
    shown: str  # what it returned, in short
    printed: str


def outcomes(exercise: Exercise, answer, heard=None) -> list[Outcome]:
    """Return what an answer comes to in each case."""
    return [_try(exercise, answer, case, heard) for case in _cases(exercise)]


def judge_function(exercise: Exercise, found: list[Outcome]) -> Verdict:
    """Return what a function is, from what it came to."""
    values = [outcome.values for outcome in found]
    printed = next((outcome.printed for outcome in found if outcome.printed), "")
    right = solution_of(exercise)
    if agree(values, [outcome.values for outcome in right], exercise.tolerance):
        return Verdict("right", "It agrees in every case.", printed=printed)
    for i in range(len(exercise.wrong)):
        if agree(values, mistake_of(exercise, i), exercise.alike):
            return Verdict("mistake", mistake=i, printed=printed)
    text, here = _counterexample(exercise, found, right)
    return Verdict("not yet", text, printed=here or printed)


def must_be_callable(exercise: Exercise, answer) -> None:
    """Refuse what cannot be called as the solution can."""
    signature = f"{exercise.name}({', '.join(exercise.parameters)})"
    if not callable(answer):
        raise Unreadable(
            f"Give the function itself, without calling it: "
            f'`check("{exercise.key}", {exercise.name})`'
        )
    try:
        taken = inspect.signature(answer)
        taken.bind(*exercise.parameters)
    except TypeError:
        raise Unreadable(f"Your function must take what `{signature}` takes") from None
    except ValueError:  # a built-in function that does not say what it takes
        return
    names = list(taken.parameters)
    if names != exercise.parameters and sorted(names) == sorted(exercise.parameters):
        raise Unreadable(f"Take the arguments in the order of `{signature}`")


@cache
def solution_of(exercise: Exercise) -> list[Outcome]:
    """Return what the solution comes to."""
    found = _quietly(exercise, exercise.solution)
    if exercise.exact is None:
        return found
    exact = [exercise.exact(*case) for case in _cases(exercise)]
    return [o._replace(values=v) for o, v in zip(found, exact, strict=True)]


@cache
def mistake_of(exercise: Exercise, i: int) -> list:
    """Return the values that a usual mistake leads to."""
    found = _quietly(exercise, exercise.wrong[i].answer)
    return [outcome.values for outcome in found]


def agree(ours: list, theirs: list, tolerance: float) -> bool:
    """Return whether two answers come to the same in every case."""
    return all(same(a, b, tolerance) for a, b in zip(ours, theirs, strict=True))


def _cases(exercise: Exercise) -> list[tuple]:
    """Return the cases to try: random, and the same each time."""
    return list(exercise.cases(np.random.default_rng(2015)))


def _quietly(exercise: Exercise, function) -> list[Outcome]:
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        return outcomes(exercise, function)


def _try(exercise: Exercise, answer, case: tuple, heard=None) -> Outcome:
    before = len(heard.text) if heard else 0
    try:
        result = exercise.probe(answer, *copy.deepcopy(case))
    except (Unreadable, Stopped):
        raise
    except BaseException as error:
        stop = described(error)
    else:
        values = exercise.read(result)
        return Outcome(values, shown(result), heard.text[before:] if heard else "")
    raise Unreadable(f"Your function stopped with {stop}{_called(exercise, case)}")


def _called(exercise: Exercise, case: tuple) -> str:
    """Say with which arguments a function was called, if that is short."""
    pairs = zip(exercise.parameters, case, strict=True)
    text = ", ".join(f"{name}={shown(argument)}" for name, argument in pairs)
    return f", called with {text}" if len(text) <= 250 else ""


def _counterexample(exercise: Exercise, found: list, right: list) -> tuple[str, str]:
    """Show the shortest case in which an answer is wrong, and what it printed there."""
    tell, told = exercise.tell or _differs, []
    for case, a, b in zip(_cases(exercise), found, right, strict=True):
        called = _called(exercise, case)
        if called and not same(a.values, b.values, exercise.tolerance):
            told.append((f"{tell(a, b)}{called}.", a.printed))
    text, printed = min(told, key=lambda pair: len(pair[0]), default=("", ""))
    return (text, printed) if len(text) <= 400 else ("", "")


def _differs(ours: Outcome, right: Outcome) -> str:
    if ours.shown != right.shown:
        return f"Yours gives {ours.shown}, not {right.shown}"
    a, b = (shown(outcome.values, 12) for outcome in (ours, right))
    return f"Yours gives {a}, not {b} (is it rounded?)"
