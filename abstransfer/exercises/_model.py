"""What an exercise is: a task, a solution, three hints, and known wrong answers."""

from __future__ import annotations

import importlib
import inspect
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ._read import numbers


class Wrong(NamedTuple):
    """A usual wrong answer: the misconception, an answer that has it, a reply."""

    name: str  # the misconception in a few words
    answer: Any  # the number or the function that a student would give
    hint: str


class Stub(NamedTuple):
    """A function with blanks, for who chooses lines instead of writing them."""

    code: str  # where a blank is, its name stands in braces
    blanks: dict[str, dict[str, str]]  # by blank, the line of each mistake; "": right

    def filled(self, **mistakes: str) -> str:
        """
        Return the code with the right lines, but for the mistakes, by blank.

        >>> twice = stub("return {it}", it=("2 * x", {"a square": "x * x"}))
        >>> twice.filled(), twice.filled(it="a square")
        ('return 2 * x', 'return x * x')
        """
        code = self.code
        for name, lines in self.blanks.items():
            code = code.replace(f"{{{name}}}", lines[mistakes.get(name, "")])
        return code


def stub(code: str, **blanks: tuple[str, dict[str, str]]) -> Stub:
    """Return a stub; of each blank the right line, and those of mistakes by name."""
    lines = {name: {"": right, **wrong} for name, (right, wrong) in blanks.items()}
    return Stub(code, lines)


class Verdict(NamedTuple):
    """What an answer is: "right", "nearly", "mistake" or "not yet"."""

    name: str
    text: str = ""
    mistake: int | None = None  # its place in `Exercise.wrong`
    printed: str = ""


def call(function, *arguments):
    """Return what a function returns: the usual way to try one."""
    return function(*arguments)


@dataclass(frozen=True, eq=False)
class Exercise:
    """An exercise as data; :func:`value` and :func:`function` make one."""

    key: str
    task: str  # what to do, for who writes the page
    solution: Any
    hints: tuple[str, str, str]  # general, closer, nearly the solution
    wrong: tuple[Wrong, ...]
    same: tuple = ()  # the solution in other forms; used by the tests
    read: Callable = field(default=numbers)  # answer -> what can be compared
    tolerance: float = 1e-6
    # Of a value:
    also: tuple = ()  # what else the page asks for; None is not judged
    share: bool = False  # the answer may be given in percent
    # Of a function:
    cases: Callable | None = None  # Generator -> arguments to try; None: a value
    probe: Callable = call  # function, *arguments -> what is compared
    exact: Callable | None = None  # *arguments -> what the solution comes to; or tried
    tell: Callable | None = None  # two outcomes -> in words how they differ
    alike: float = 1e-6  # the tolerance within which an answer is a known mistake
    stub: Stub | None = None

    @property
    def name(self) -> str:
        """The name of the function to write."""
        return self.solution.__name__

    @property
    def parameters(self) -> list[str]:
        """The names of its parameters."""
        return list(inspect.signature(self.solution).parameters)

    def as_data(self) -> dict:
        """
        Return what a page needs to ask, to judge a value and to reply, for JSON.

        Functions cannot be judged without Python: instead of one, lines are chosen.  Of
        each line there is the place of its mistake in `wrong`, null if it is right.
        Infinity is the text "inf".
        """
        data = {
            "id": self.key,
            "task": self.task,
            "hints": list(self.hints),
            "wrong": [{"name": w.name, "hint": w.hint} for w in self.wrong],
        }
        if self.cases:
            blanks = {name: self._offered(name) for name in self.stub.blanks}
            return data | {"kind": "lines", "code": self.stub.code, "blanks": blanks}
        for entry, wrong in zip(data["wrong"], self.wrong, strict=True):
            entry["answer"] = _plain(wrong.answer)
        return data | {
            "kind": self.read.__name__,  # "numbers", "size", "word" or "letters"
            "solution": _plain(self.solution),
            "also": [_plain(value) for value in self.also],
            "share": self.share,
            "tolerance": self.tolerance,
        }

    def _offered(self, blank: str) -> list[tuple[str, int | None]]:
        """Return the lines for a blank, in an order that tells nothing."""
        names = [wrong.name for wrong in self.wrong]
        lines = [
            (line, names.index(mistake) if mistake else None)
            for mistake, line in self.stub.blanks[blank].items()
        ]
        random.Random(f"{self.key} {blank}").shuffle(lines)
        return lines


def _plain(value) -> float | str | None:
    if value is None or isinstance(value, str):
        return value
    return float(value) if np.isfinite(value) else str(float(value))


class Open(NamedTuple):
    """An open exercise: nothing can judge it, but hints and a measure can be given."""

    key: str
    hints: tuple[str, ...]  # general, closer, ...
    good: str  # what a good answer holds


def value(key, task, solution, *, hints, wrong, **options) -> Exercise:
    """Return an exercise that is answered by a number or a word."""
    return Exercise(key, task, solution, tuple(hints), tuple(wrong), **options)


def function(key, task, solution, *, cases, hints, wrong, **options) -> Exercise:
    """Return an exercise that is answered by a function, tried on random cases."""
    return Exercise(
        key, task, solution, tuple(hints), tuple(wrong), cases=cases, **options
    )


def exercises_of(page: int) -> dict[str, Exercise]:
    """Return the exercises of a page by their ids; none where a page has none."""
    return _listed(page, "EXERCISES")


def open_exercises_of(page: int) -> dict[str, Open]:
    """Return the open exercises of a page by their ids."""
    return _listed(page, "OPEN")


def _listed(page: int, name: str) -> dict:
    module = f"page{page:02d}"
    if not (Path(__file__).parent / f"{module}.py").is_file():
        return {}
    found = getattr(importlib.import_module(f".{module}", __package__), name, ())
    return {exercise.key: exercise for exercise in found}


def page_of(key: str) -> int | None:
    """Return the page that an id such as ex-3-1 or ex-3-1b names, or None."""
    match = re.fullmatch(r"ex-(\d{1,2})-\d+[b-z]?", key, re.ASCII)
    return int(match[1]) if match else None


def first_of(key: str) -> str:
    """
    Return the id of the first question of an exercise.

    >>> first_of("ex-8-1c"), first_of("ex-8-1")
    ('ex-8-1', 'ex-8-1')
    """
    return key.rstrip("bcdefghijklmnopqrstuvwxyz")


def all_exercises() -> Iterator[Exercise]:
    """Yield the exercises of all pages, in order."""
    for page in range(13):
        yield from exercises_of(page).values()


def all_open_exercises() -> Iterator[Open]:
    """Yield the open exercises of all pages, in order."""
    for page in range(13):
        yield from open_exercises_of(page).values()
