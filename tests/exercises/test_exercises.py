"""Exercises: right is right in any form, each usual mistake has its own reply."""

import re
import subprocess
import sys

import numpy as np
import pytest
from support import ROOT

from abstransfer.exercises import (
    _check,
    all_exercises,
    all_open_exercises,
    check,
    exercises_of,
)

ALL = {exercise.key: exercise for exercise in all_exercises()}
OPEN = {exercise.key: exercise for exercise in all_open_exercises()}
CODING = {key: exercise for key, exercise in ALL.items() if exercise.cases}


@pytest.fixture(autouse=True)
def new_session(monkeypatch):
    monkeypatch.setattr(_check, "_tries", {})


class Odd:
    def __array__(self, *args, **kwargs):
        raise RuntimeError("no")


ODD_VALUES = [None, ..., "words", np.nan, [np.nan, 1], [[1], [2, 3]], {}, {"a": 1}, 1j]
ODD_VALUES += [np.zeros((3, 4, 5)), [], set(), Odd(), print, type, True, b"x", -1e300]


def stops(*arguments):
    raise ZeroDivisionError("division by zero")


def leaves(*arguments):
    sys.exit()


def calls_itself(*arguments):
    return calls_itself(*arguments)


def warns(*arguments):
    return np.array([0.0]) / np.array([0.0])


def spoils(*arguments):
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            argument[...] = 0


ODD_FUNCTIONS = [stops, leaves, calls_itself, warns, spoils, lambda: 0, lambda x: x]
ODD_FUNCTIONS += [lambda *a, value=value: value for value in ODD_VALUES]


def test_each_page_from_1_to_10_has_exercises():
    assert all(exercises_of(page) for page in range(1, 11))


@pytest.mark.parametrize("exercise", ALL.values(), ids=ALL)
def test_an_exercise_is_whole(exercise):
    page = int(exercise.key.split("-")[1])
    names = [wrong.name for wrong in exercise.wrong]

    assert exercise.key in exercises_of(page)
    assert len(set(exercise.hints)) == 3
    assert len(set(names)) == len(names)
    assert len(names) >= (4 if exercise.cases else 1)
    for words in (exercise.task, *exercise.hints, *(w.hint for w in exercise.wrong)):
        assert "  " not in words, "two spaces where two strings meet"


@pytest.mark.parametrize("exercise", ALL.values(), ids=ALL)
def test_the_solution_is_right(exercise):
    reply = check(exercise.key, exercise.solution)

    assert reply
    assert str(reply).startswith(f"{exercise.key}: right.")
    assert reply._repr_markdown_().startswith(f"**{exercise.key}: right.**")


@pytest.mark.parametrize("exercise", CODING.values(), ids=CODING)
def test_a_solution_in_another_form_is_right(exercise):
    assert exercise.same

    for other in exercise.same:
        assert check(exercise.key, other), other


@pytest.mark.parametrize("key", ALL)
def test_each_usual_mistake_gets_its_own_reply(key):
    for wrong in ALL[key].wrong:
        reply = check(key, wrong.answer)

        assert reply.verdict == "not yet", wrong.name
        assert reply.text == f"This looks like: *{wrong.name}*. {wrong.hint}"


@pytest.mark.parametrize("exercise", ALL.values(), ids=ALL)
def test_hints_come_in_three_steps(exercise):
    """An unknown wrong answer gets the first hint, then the next; the last stays."""
    strange = (lambda *a: 0.123456) if exercise.cases else 0.123456
    if exercise.key == "ex-7-4":  # all answers to yes or no are known
        strange = _check.NOT_GIVEN
    if exercise.key == "ex-8-2b":
        strange = "D"
    if exercise.key == "ex-3-2":  # its actions are whole numbers
        strange = lambda q_row, epsilon, rng: 1  # noqa: E731

    texts = [check(exercise.key, strange).text for _ in range(4)]

    for text, number in zip(texts, (1, 2, 3, 3), strict=True):
        assert text.startswith(f"Hint {number} of 3: {exercise.hints[number - 1]}")


def test_a_mistake_made_again_gets_a_hint_as_well():
    wrong = ALL["ex-1-2"].wrong[0]

    assert "Hint" not in check("ex-1-2", wrong.answer).text
    assert "Hint 1 of 3" in check("ex-1-2", wrong.answer).text
    assert wrong.hint in check("ex-1-2", wrong.answer).text


def test_another_mistake_is_named_without_a_hint():
    first, second = ALL["ex-1-2"].wrong[:2]
    check("ex-1-2", first.answer)

    assert "Hint" not in check("ex-1-2", second.answer).text


def test_a_hint_can_be_asked_for():
    reply = check("ex-1-2")

    assert reply.verdict == "hint"
    assert reply.text == f"Hint 1 of 3: {ALL['ex-1-2'].hints[0]}"


@pytest.mark.parametrize("exercise", ALL.values(), ids=ALL)
def test_odd_answers_get_kind_words(exercise):
    odd = [*ODD_VALUES, *(ODD_FUNCTIONS if exercise.cases else ())]
    if exercise.key == "ex-3-2":  # slow: each answer is called thousands of times
        odd = odd[:8] + ODD_FUNCTIONS[:7]

    for answer in odd:
        reply = check(exercise.key, answer)
        assert not reply or answer is True, answer
        assert reply.text, answer
        assert "0x" not in str(reply), "an address differs from run to run"


def test_an_error_in_the_function_is_told_with_its_arguments():
    reply = check("ex-8-1", lambda t, tau: t / 0)

    assert reply.verdict == "no answer yet"
    assert "ZeroDivisionError" in reply.text
    assert "called with t=" in reply.text


def test_a_blank_is_seen():
    assert "blank" in check("ex-8-1", lambda t, tau: ...).text
    assert "`return` missing" in check("ex-8-1", lambda t, tau: None).text


def test_other_parameters_are_told():
    assert "`advice_probability(t, tau)`" in check("ex-8-1", lambda t: 1).text


def test_another_order_of_parameters_is_told():
    text = check("ex-8-1", lambda tau, t: max(0, 1 - t / tau)).text

    assert text == "Take the arguments in the order of `advice_probability(t, tau)`."


def test_a_wrong_answer_is_shown_beside_the_right_one():
    text = check("ex-8-1", lambda t, tau: 0.5).text

    assert "Yours gives 0.5, not 0" in text


def test_an_open_exercise_gets_its_hints_in_turn_and_what_a_good_answer_holds():
    for key, exercise in OPEN.items():
        texts = [check(key).text for _ in range(4)]
        told = check(key, "my thoughts")

        last = f"Hint {len(exercise.hints)} of {len(exercise.hints)}:"
        assert texts[0].startswith(f"Hint 1 of {len(exercise.hints)}: ")
        assert texts[-1] == f"{last} {exercise.hints[-1]}"
        assert not told
        assert told.verdict == "not checked"
        assert told.text.startswith("An open exercise has no check.")
        for blank in (..., None, ""):
            assert check(exercise.key, blank).verdict == "no answer yet"
        assert exercise.good in told.text


def test_the_lecturers_guide_says_what_a_good_answer_holds_in_the_same_words():
    guide = (ROOT / "book" / "lecturers_guide.md").read_text(encoding="utf-8")
    told = dict(re.findall(r"^\| `(ex-\S+)` \| (.*) \|$", guide, re.MULTILINE))

    assert told == {key: exercise.good for key, exercise in OPEN.items()}


@pytest.mark.parametrize("key", ["ex-99-1", "nonsense", "", "`" * 500, "ex-\u0661-1"])
def test_an_unknown_exercise_is_told(key):
    reply = check(key, 1)

    assert not reply
    assert "no such exercise" in reply.text.lower()
    assert len(str(reply)) < 300


@pytest.mark.parametrize(
    "key", ["EX-1-2", "ex_1_2", "1.2", "ex-1\u20112", " ex-1-2 ", "ex 1 2", "ex1-2"]
)
def test_the_nearest_exercise_is_suggested_for_a_mistyped_id(key):
    assert 'Did you mean "ex-1-2"?' in check(key, 100).text


@pytest.mark.parametrize(
    ("key", "kind"), [(None, "NoneType"), (3, "int"), ([], "list"), (check, "function")]
)
def test_an_id_that_is_no_text_is_an_error_that_says_what_it_must_be(key, kind):
    words = f'must be the id of an exercise, a text such as "ex-3-1"; it .*{kind}$'
    with pytest.raises(ValueError, match=words):
        check(key, 1)


def test_the_answer_is_not_changed_and_not_asked_twice_the_same_way():
    """A function that spoils its arguments does not spoil the next case."""
    right = ALL["ex-7-1"].solution

    def spoiling(P, r, gamma):
        v = right(P, r, gamma)
        P[:], r[:] = 0, 0
        return v

    assert check("ex-7-1", spoiling)


def test_the_list_of_exercises_names_them_all():
    done = subprocess.run(
        [sys.executable, "-m", "abstransfer.exercises"],
        capture_output=True,
        encoding="utf-8",
        check=True,
        cwd=ROOT,
    )

    assert all(key in done.stdout for key in ALL)


def test_the_lecturers_guide_holds_the_answers():
    """Of each exercise that is answered by a number or a word, and no others."""
    guide = (ROOT / "book" / "lecturers_guide.md").read_text(encoding="utf-8")
    told = dict(re.findall(r"^\| (ex-\S+) \| (.*) \|$", guide, re.MULTILINE))
    values = {key for key, exercise in ALL.items() if not exercise.cases}

    assert set(told) == values
    for key, answer in told.items():
        if not isinstance(ALL[key].solution, str):
            answer = float(answer.replace(",", ""))
            assert answer == pytest.approx(ALL[key].solution, rel=1e-3)
        else:
            assert answer == ALL[key].solution
