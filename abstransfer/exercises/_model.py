"""What an exercise is: a task, a solution, three hints, and known wrong answers."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from ._read import numbers


class Wrong(NamedTuple):
    """A usual wrong answer: the misconception, an answer that has it, a reply."""

    name: str  # the misconception in a few words
    answer: Any  # the number or the function that a student would give
    hint: str


def call(function, *arguments):
    """Return what a function returns: the usual way to try one."""
    return function(*arguments)


@dataclass(frozen=True)
class Exercise:
    """An exercise as data; :func:`value` and :func:`function` make one."""

    key: str
    task: str  # what to do, for who writes the page
    solution: Any
    hints: tuple[str, str, str]  # general, closer, nearly the solution
    wrong: tuple[Wrong, ...]
    same: tuple = ()  # the solution in other forms; used by the tests
    cases: Callable | None = None  # Generator -> arguments to try; None: a value
    probe: Callable = call  # function, *arguments -> what is compared
    read: Callable = field(default=numbers)  # answer -> what can be compared
    tolerance: float = 1e-6

    @property
    def name(self) -> str:
        """The name of the function to write."""
        return self.solution.__name__

    @property
    def parameters(self) -> list[str]:
        """The names of its parameters."""
        return list(inspect.signature(self.solution).parameters)


def value(key, task, solution, *, hints, wrong, **options) -> Exercise:
    """Return an exercise that is answered by a number, an array or a word."""
    return Exercise(key, task, solution, tuple(hints), tuple(wrong), **options)


def function(key, task, solution, *, cases, hints, wrong, **options) -> Exercise:
    """Return an exercise that is answered by a function, tried on random cases."""
    return Exercise(
        key, task, solution, tuple(hints), tuple(wrong), cases=cases, **options
    )


def exercises_of(page: int) -> dict[str, Exercise]:
    """Return the exercises of a page by their ids; none where a page has none."""
    name = f"page{page:02d}"
    if not (Path(__file__).parent / f"{name}.py").is_file():
        return {}
    module = importlib.import_module(f".{name}", __package__)
    return {exercise.key: exercise for exercise in module.EXERCISES}


def page_of(key) -> int | None:
    """Return the page that an id such as ex-3-1 or ex-3-1b names, or None."""
    match = (
        re.fullmatch(r"ex-(\d{1,2})-\d+[b-z]?", key) if isinstance(key, str) else None
    )
    return int(match[1]) if match else None


def all_exercises() -> Iterator[Exercise]:
    """Yield the exercises of all pages, in order."""
    for page in range(12):
        yield from exercises_of(page).values()
