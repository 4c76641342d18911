"""Judging a number or a word: right in any form, rounded, or a known mistake."""

from __future__ import annotations

from decimal import Decimal

import numpy as np

from ._model import Exercise, Verdict
from ._read import Unreadable, forms, same

EXACTLY = 1e-6  # apart, relatively, from the number that a mistake leads to


def readings(exercise: Exercise, answer) -> list:
    """Return what an answer may mean; a text with a comma may mean two numbers."""
    found, reason = [], None
    for form in forms(answer):
        try:
            found.append(exercise.read(form))
        except Unreadable as why:
            reason = why
    if not found:
        raise reason
    return found


def judge_value(exercise: Exercise, found: list) -> Verdict:
    """Return what an answer is, from what it may mean."""
    if isinstance(exercise.solution, str):
        return _judge_word(exercise, found[0])
    single = [float(array.item()) for array in found if array.size == 1]
    if not single:
        verdicts = [_judge_several(exercise, array.ravel()) for array in found]
        return next((v for v in verdicts if v.name == "right"), verdicts[0])
    if exercise.share:  # 78 percent is 0.78
        single += [number / 100 for number in single if number > 1]
    return _judge_number(exercise, single)


def _judge_word(exercise: Exercise, answer: str) -> Verdict:
    if answer == exercise.read(exercise.solution):
        return Verdict("right")
    for i, wrong in enumerate(exercise.wrong):
        if answer == exercise.read(wrong.answer):
            return Verdict("mistake", mistake=i)
    if exercise.solution in ("yes", "no"):
        raise Unreadable('Begin your answer with "yes" or "no"')
    return Verdict("not yet")


def _judge_several(exercise: Exercise, several: np.ndarray) -> Verdict:
    """Judge numbers, where the page asks for more than one."""
    wanted = [exercise.solution, *exercise.also]
    if len(wanted) == 1 or several.size != len(wanted):
        asked = "One number is" if len(wanted) == 1 else f"{len(wanted)} numbers are"
        words = f"{asked} asked for, not {several.size}"
        if several.size == 2 and (several == np.round(several)).all():
            words += ". If a comma was to begin the decimals, write a point"
        raise Unreadable(words)
    pairs = zip(several.tolist(), wanted, strict=True)
    fits = [b is None or _fits(exercise, a, b) for a, b in pairs]
    if all(fits):
        return Verdict("right")
    right = f"Number {1 + fits.index(True)} of yours is right." if any(fits) else ""
    return Verdict("not yet", right)


def _fits(exercise: Exercise, number: float, wanted: float) -> bool:
    number, wanted = _number(exercise, number), _number(exercise, wanted)
    is_percent = exercise.share and wanted <= 1 < number
    meant = [number, number / 100] if is_percent else [number]
    return any(same(x, wanted, exercise.tolerance) or rounds(x, wanted) for x in meant)


def _judge_number(exercise: Exercise, meant: list[float]) -> Verdict:
    right = _number(exercise, exercise.solution)
    mistakes = [_number(exercise, wrong.answer) for wrong in exercise.wrong]
    if any(same(number, right, exercise.tolerance) for number in meant):
        return Verdict("right")
    for number in meant:
        for i, mistake in enumerate(mistakes):
            if same(number, mistake, EXACTLY):
                return Verdict("mistake", mistake=i)
    for number in meant:
        if rounds(number, right):
            return Verdict("nearly", "Right as far as it goes: give more digits.")
        near = [i for i, mistake in enumerate(mistakes) if rounds(number, mistake)]
        if len(near) == 1 and digits(number) > 1:
            return Verdict("mistake", mistake=near[0])
    return Verdict("not yet")


def _number(exercise: Exercise, value) -> float:
    return float(exercise.read(value).item())


def places(number: float) -> int:
    """
    Return how many decimals a number is written with.

    >>> places(-93.9), places(100.0)
    (1, 0)
    """
    return max(0, -Decimal(repr(float(number))).normalize().as_tuple().exponent)


def digits(number: float) -> int:
    """
    Return how many digits a number is written with, but for zeros before them.

    >>> digits(0.048), digits(-94.0)
    (2, 2)
    """
    return len(f"{abs(number):.{places(number)}f}".replace(".", "").lstrip("0"))


def rounds(number: float, exact: float) -> bool:
    """
    Return whether a number is an exact one, rounded to the digits that it has.

    >>> rounds(-93.9, -93.88), rounds(-93.8, -93.88), rounds(-93.88, -93.9)
    (True, False, False)
    """
    if not np.isfinite(number) or number == 0:
        return False
    return abs(number - exact) <= 0.5 * 10.0 ** -places(number) * (1 + 1e-9)
