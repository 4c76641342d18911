"""The reply to an answer, in words."""

from __future__ import annotations

import difflib
import re
import textwrap
from dataclasses import dataclass, field
from functools import partial

from ._functions import judge_function, must_be_callable, outcomes, solution_of
from ._model import (
    Exercise,
    Open,
    Verdict,
    all_exercises,
    all_open_exercises,
    exercises_of,
    open_exercises_of,
    page_of,
)
from ._read import SIGNS, Unreadable, blank, short
from ._run import Heard, run
from ._values import judge_value, readings

NOT_GIVEN = object()


@dataclass
class Tries:
    """What a reader has seen of an exercise."""

    hints: int = 0
    mistakes: set[int] = field(default_factory=set)


_tries: dict[str, Tries] = {}  # by exercise, since Python was started


@dataclass(frozen=True)
class Reply:
    """What is said to an answer; true if the answer is right."""

    key: str
    verdict: str  # see check
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
        Without one, the next hint is given, also of an open exercise.

    Returns
    -------
    Reply
        It prints itself, and is true if the answer is right.  Its `verdict` is
        "right", "nearly" (right, but rounded too far), "not yet", "hint", "no answer
        yet" (it cannot be judged) or "not checked" (it is open, or there is no such
        exercise).  A usual wrong answer is named; another one gets the next hint.

    Raises
    ------
    ValueError
        If `key` is no text.
    KeyboardInterrupt
        If the reader interrupts, so that no further cell runs.

    Notes
    -----
    Whatever an answer does, it is told in words, and nothing of it stays: what it
    prints is told shortly; numpy's and Python's luck, print options, warnings, the
    environment, the folder and the arguments are as they were.  After ten seconds of
    work, or thirty of waiting, an answer is stopped; a single call into compiled code
    cannot be stopped.

    Examples
    --------
    >>> check("ex-1-2", 100)
    ex-1-2: right.
    >>> bool(check("ex-1-2", 99))
    False
    """
    if not isinstance(key, str):
        raise ValueError(
            'key must be the id of an exercise, a text such as "ex-3-1"; '
            f"it was of type {type(key).__name__}"
        )
    page = page_of(key)
    known = {} if page is None else open_exercises_of(page) | exercises_of(page)
    exercise = known.get(key)
    if exercise is None:
        return Reply(short(key, 40), "not checked", _unknown(key))
    if answer is NOT_GIVEN:
        return Reply(key, "hint", _next_hint(exercise))
    try:
        if isinstance(exercise, Open):
            blank(None if answer == "" else answer)
            words = "An open exercise has no check. A good answer holds: "
            return Reply(key, "not checked", f"{words}{exercise.good}.")
        verdict = _judge(exercise, answer)
    except Unreadable as reason:
        words = f"{reason}.".replace("?.", "?")
        return Reply(key, "no answer yet", words + _told(reason.printed))
    return _reply(exercise, verdict)


def _judge(exercise: Exercise, answer) -> Verdict:
    """Let the answer show what it comes to, under guard; then compare."""
    if exercise.cases is None:
        return judge_value(exercise, run(lambda heard: readings(exercise, answer)))
    solution_of(exercise)  # first, so that it takes none of the answer's time
    return judge_function(exercise, run(partial(_tried, exercise, answer)))


def _tried(exercise: Exercise, answer, heard: Heard) -> list:
    must_be_callable(exercise, answer)
    return outcomes(exercise, answer, heard)


def _reply(exercise: Exercise, verdict: Verdict) -> Reply:
    name, words = verdict.name, verdict.text
    if name == "not yet":
        words = f"{_next_hint(exercise)} {words}"
    elif name == "mistake":
        name, wrong = "not yet", exercise.wrong[verdict.mistake]
        words = f"This looks like: *{wrong.name}*. {wrong.hint}"
        tries = _tries.setdefault(exercise.key, Tries())
        if verdict.mistake in tries.mistakes:
            words = f"{words} {_next_hint(exercise)}"
        tries.mistakes.add(verdict.mistake)
    return Reply(exercise.key, name, (words + _told(verdict.printed)).strip())


def _told(printed: str) -> str:
    return f" It printed: `{short(printed)}`" if printed.strip() else ""


def _next_hint(exercise: Exercise | Open) -> str:
    tries = _tries.setdefault(exercise.key, Tries())
    tries.hints = min(tries.hints + 1, len(exercise.hints))
    hint = exercise.hints[tries.hints - 1]
    return f"Hint {tries.hints} of {len(exercise.hints)}: {hint}"


def _unknown(key: str) -> str:
    words = "There is no such exercise"
    meant = re.sub(r"[\s._-]+", "-", key[:40].strip().translate(SIGNS).lower())
    known = [e.key for e in (*all_exercises(), *all_open_exercises())]
    nearest = difflib.get_close_matches(meant, known, n=1)
    if nearest:
        words += f'. Did you mean "{nearest[0]}"?'
    return f"{words}; `python -m abstransfer.exercises` lists all.".replace("?;", "? ")
