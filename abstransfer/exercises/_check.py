"""The reply to an answer, in words."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from functools import cache

from ._judge import agree, counterexample, outcomes
from ._model import Exercise, exercises_of, page_of
from ._read import Unreadable

NOT_GIVEN = object()
_times_tried: dict[str, int] = {}  # by exercise, since Python was started


@dataclass(frozen=True)
class Reply:
    """What is said to an answer; true if the answer is right."""

    key: str
    verdict: str  # "right", "not yet", "hint", "no answer yet" or "not checked"
    text: str

    def __bool__(self) -> bool:
        return self.verdict == "right"

    def __repr__(self) -> str:
        return textwrap.fill(f"{self.key}: {self.verdict}. {self.text}", 79)

    def _repr_markdown_(self) -> str:
        return f"**{self.key}: {self.verdict}.** {self.text}".strip()


def check(key: str, answer=NOT_GIVEN) -> Reply:
    """
    Judge an answer to an exercise, and reply in words.

    Parameters
    ----------
    key : str
        The id of the exercise, such as ``"ex-3-1"``.
    answer : number, array, str or function
        Without one, the next of three hints is given.

    Returns
    -------
    Reply
        It prints itself, and is true if the answer is right.  A usual wrong
        answer is named; another one gets the next hint.  Nothing is raised.

    Examples
    --------
    >>> check("ex-1-2", 100)
    ex-1-2: right.
    >>> bool(check("ex-1-2", 99))
    False
    """
    exercise = exercises_of(page_of(key) or 0).get(key) if page_of(key) else None
    if exercise is None:
        return Reply(str(key), "not checked", _unknown(page_of(key)))
    if answer is NOT_GIVEN:
        return Reply(key, "hint", _next_hint(exercise))
    try:
        outcome = outcomes(exercise, answer)
    except Unreadable as reason:
        return Reply(key, "no answer yet", f"{reason}.".replace("?.", "?"))
    right = _of_solution(key)
    if agree(exercise, outcome, right):
        n = len(right)
        return Reply(key, "right", f"It agrees on all {n} cases." if n > 1 else "")
    known = [
        agree(exercise, outcome, _of_wrong(key, i)) for i in range(len(exercise.wrong))
    ]
    if any(known):
        wrong = exercise.wrong[known.index(True)]
        named = f"This looks like: *{wrong.name}*. {wrong.hint}"
        again = key in _times_tried
        _times_tried.setdefault(key, 0)
        return Reply(
            key, "not yet", f"{named} {_next_hint(exercise)}" if again else named
        )
    words = _next_hint(exercise)
    if exercise.cases:
        words = f"{words} {counterexample(exercise, outcome, right)}".strip()
    return Reply(key, "not yet", words)


@cache
def _of_solution(key: str) -> list:
    exercise = exercises_of(page_of(key))[key]
    return outcomes(exercise, exercise.solution)


@cache
def _of_wrong(key: str, i: int) -> list | None:
    exercise = exercises_of(page_of(key))[key]
    return outcomes(exercise, exercise.wrong[i].answer)


def _next_hint(exercise: Exercise) -> str:
    tried = min(_times_tried.get(exercise.key, 0) + 1, len(exercise.hints))
    _times_tried[exercise.key] = tried
    return f"Hint {tried} of {len(exercise.hints)}: {exercise.hints[tried - 1]}"


def _unknown(page: int | None) -> str:
    known = ", ".join(exercises_of(page)) if page else ""
    if not known:
        return "There is no such exercise; `python -m abstransfer.exercises` lists all."
    return (
        "No answer is stored under this name. An open exercise has no check: compare "
        f"with its solution, or with a neighbor. Checked on this page: {known}."
    )
