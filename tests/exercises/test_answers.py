"""Answers that students gave: right in any form is right, near a mistake is not it."""

import json
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from abstransfer.exercises import _check, all_exercises, check
from abstransfer.exercises._read import formula, numbers, shown, word

ALL = {exercise.key: exercise for exercise in all_exercises()}
CODING = {key: exercise for key, exercise in ALL.items() if exercise.cases}
NUMBERS = {
    key: float(exercise.solution)
    for key, exercise in ALL.items()
    if not exercise.cases and not isinstance(exercise.solution, str)
}
SHARES = [key for key, exercise in ALL.items() if exercise.share]


@pytest.fixture(autouse=True)
def new_session(monkeypatch):
    monkeypatch.setattr(_check, "_tries", {})


# ---- numbers

FORMS = {
    "text": str,
    "quoted": lambda x: f'"{x}"',
    "typographic quotes": lambda x: f"\u201c{x}\u201d",
    "in code": lambda x: f"`{x}`.",
    "a minus sign": lambda x: str(x).replace("-", "\u2212"),
    "an en dash": lambda x: str(x).replace("-", "\u2013"),
    "a comma": lambda x: str(x).replace(".", ","),
    "a unit": lambda x: f"{x} steps",
    "an equation": lambda x: f"x = {x}",
    "spaces": lambda x: f"\u00a0 {x}\n",
    "an array without axes": np.array,
    "an axis": lambda x: [x],
    "two axes": lambda x: np.array([[x]]),
    "a text in a list": lambda x: [str(x)],
    "a fraction": Fraction,
    "a decimal": Decimal,
    "a complex number": complex,
    "a generator": lambda x: (y for y in (x,)),
    "numpy's": np.float32,
}


@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)
def test_a_right_number_is_right_in_any_form(form):
    assert [key for key, x in NUMBERS.items() if not check(key, form(x))] == []


@pytest.mark.parametrize("key", NUMBERS)
def test_a_rounded_number_is_no_mistake(key):
    """Of two digits on, and as far as the page prints it; a whole one if it is one."""
    exact = NUMBERS[key]
    size = int(np.floor(np.log10(abs(exact)))) + 1

    for digits in range(max(2, size), 6):
        reply = check(key, round(exact, digits - size))
        assert reply.verdict in ("right", "nearly"), digits
        assert reply or digits < 4, digits


def test_a_number_that_is_rounded_too_far_is_nearly_right():
    for key, answer in (
        ("ex-7-2", -94),
        ("ex-7-3", -67),
        ("ex-6-3", 0.99),
        ("ex-1-1", -18),
        ("ex-1-1", "-18"),
        ("ex-5-3", 0.8),
    ):
        reply = check(key, answer)
        assert reply.verdict == "nearly"
        assert reply.text == "Right as far as it goes: give more digits."
        assert not reply


@pytest.mark.parametrize("key", SHARES)
def test_a_share_may_be_given_in_percent(key):
    share = ALL[key].solution

    assert check(key, 100 * share)
    assert check(key, f"{100 * share:.2f} %")
    assert check(key, f"{100 * share:.2f}".replace(".", ",") + " percent")


@pytest.mark.parametrize(
    ("key", "answer"),
    [
        ("ex-1-1", "-(1 - 0.99^20)/(1 - 0.99)"),
        ("ex-1-2", "1/(1-0.99)"),
        ("ex-1-2", "10**2"),
        ("ex-2-3", "-(1 + 0.99 + 0.99^2 + 0.99^3)*(1 + 0.99^4) = -7,73"),
        ("ex-3-4", "\u22121 \u00f7 (1 \u2212 0,95)"),
        ("ex-5-3", "36/46"),
        ("ex-7-2", "\u221293.88"),
        ("ex-8-1d", "3 million"),
        ("ex-2-3", "-1(1-0.99^8)/(1-0.99)"),
        ("ex-4-3", "6 (162)"),
        ("ex-4-3", "(2 * 3)(8 + 28 + 56 + 70)"),
        ("ex-8-1c", "5 %"),
        ("ex-9-1b", "0,2828"),
        ("ex-9-2b", "5/9"),
        ("ex-9-3b", "60 points"),
        ("ex-9-3b", "30,000,000/500,000"),
        ("ex-4-3", "972 views"),
    ],
)
def test_a_formula_in_a_text_is_read(key, answer):
    assert check(key, answer)


@pytest.mark.parametrize(
    ("key", "answer"),
    [
        ("ex-4-3", (972, 162)),
        ("ex-4-3", "972, 162"),
        ("ex-4-3", "(972, 162)"),
        ("ex-4-3", "972 and 162"),
        ("ex-5-3", (0.783, 6.6)),
        ("ex-5-3", [0.36 / 0.46, 7]),
        ("ex-7-2", (-93.88, 3.17)),
        ("ex-7-2", np.array([-93.88, 3.2])),
        ("ex-5-3", "0,783; 6,6"),
        ("ex-6-3", "0,987; 0,744"),
        ("ex-6-3", "0,987 and 0,744"),
        ("ex-6-3", "98.7 %, 74.4 %"),
        ("ex-6-3", "98,7 % and 74,4 %"),
    ],
)
def test_both_numbers_may_be_given_where_two_were_asked_for(key, answer):
    assert check(key, answer)


def test_of_two_numbers_the_right_one_is_told():
    assert "Number 1 of yours is right" in check("ex-4-3", (972, 161)).text
    assert "Number 2 of yours is right" in check("ex-4-3", (971, 162)).text
    assert "Number 1 of yours is right" in check("ex-7-2", (-93.88, 0.5)).text
    assert "of yours" not in check("ex-4-3", (162, 972)).text


@pytest.mark.parametrize(
    ("key", "answer", "words"),
    [
        ("ex-1-2", (100, 3, 5), "One number is asked for, not 3."),
        ("ex-4-3", (972, 3, 5), "2 numbers are asked for, not 3."),
        ("ex-9-1b", (0, 2828), "If a comma was to begin the decimals, write a point."),
        ("ex-1-2", "a hundred", "`a hundred` cannot be read as one"),
        ("ex-1-2", "9**9**9", "cannot be read as one"),
        ("ex-1-2", "(-8)^(1/3)", "cannot be read as one"),
        ("ex-1-2", "__import__('os')", "cannot be read as one"),
        ("ex-1-2", "(" * 5000, "cannot be read as one"),
        ("ex-1-2", "", "cannot be read as one"),
        ("ex-1-2", "True", "cannot be read as one"),
        ("ex-1-2", 100 + 1j, "A number or an array of numbers is asked for, not a "),
        ("ex-1-2", np.ma.masked, "asked for, not a MaskedConstant"),
        ("ex-1-2", {100}, "asked for, not a set"),
        ("ex-1-2", lambda: 100, "This is a function"),
        ("ex-7-4", "the order stays", 'Begin your answer with "yes" or "no".'),
        ("ex-7-4", 0, "A word in quotes is asked for, not a int"),
    ],
)
def test_what_cannot_be_read_is_told_with_the_reason(key, answer, words):
    reply = check(key, answer)

    assert not reply
    assert words in reply.text


# ---- words


@pytest.mark.parametrize(
    "answer",
    [
        "no", "No.", "NO!", "n", "'no'", "\u201cno\u201d", " no ", False, np.False_,
        "no, the order stays the same", "No: it stays",
    ],
)  # fmt: skip
def test_no_is_no_in_many_words(answer):
    assert check("ex-7-4", answer)


@pytest.mark.parametrize("answer", ["yes", "Yes, Prob overtakes ND", True, "y"])
def test_yes_is_told_from_no(answer):
    assert "the size for the order" in check("ex-7-4", answer).text


@pytest.mark.parametrize(
    "form",
    [
        "door",
        "Doors",
        '"door"',
        "the door",
        "The doors.",
        "a\u00a0door",
        "\u00abdoor\u00bb",
    ],
)
def test_a_word_may_be_quoted_in_the_plural_or_with_an_article(form):
    assert word(form) == word("door")


def test_different_words_stay_different():
    words = ["glass", "gla", "gas", "yes", "the", "head office", "office", "bus"]

    assert len({word(w) for w in words}) == len(words)


# ---- functions

RESHAPED = {
    "lists": lambda x: np.asarray(x).tolist(),
    "text": lambda x: np.asarray(x, float).astype(str).tolist(),
    "an axis before": lambda x: np.asarray(x)[None],
    "an axis behind": lambda x: np.asarray(x)[..., None],
    "floats": lambda x: np.asarray(x, float),
}


@pytest.mark.parametrize("key", CODING)
def test_a_right_function_may_return_its_result_in_any_form(key):
    solution = CODING[key].solution

    for name, form in RESHAPED.items():
        assert check(key, lambda *case, form=form: form(solution(*case))), name


def test_a_function_may_return_a_comma():
    soft = CODING["ex-8-1"].solution

    assert check("ex-8-1", lambda t, tau: str(soft(t, tau)).replace(".", ","))


def test_a_rounded_result_is_shown_with_all_its_digits():
    solve = CODING["ex-7-1"].solution

    text = check("ex-7-1", lambda P, r, gamma: solve(P, r, gamma).round(4)).text

    assert "Yours gives [1.1111, 1." not in text
    assert "(is it rounded?)" in text


# ---- mistakes


@pytest.mark.parametrize("key", NUMBERS | CODING)
def test_what_is_only_near_a_mistake_is_not_called_it(key):
    for wrong in ALL[key].wrong:
        if wrong.name == "luck of its own":  # half of it is as bad
            continue
        near = wrong.answer
        if key in NUMBERS:
            near = near * 1.0012345 + 0.0012345 if np.isfinite(near) else 1e300
        elif key == "ex-3-2":
            near = half_of_the_time(wrong.answer, ALL[key].solution)
        else:
            near = off_in_the_last_case(ALL[key], wrong.answer)

        assert f"*{wrong.name}*" not in check(key, near).text


def off_in_the_last_case(exercise, answer):
    left = len(list(exercise.cases(np.random.default_rng(2015))))

    def near(*case):
        nonlocal left
        left -= 1
        returned = np.asarray(answer(*case), float)
        return returned + 0.001 * (1 + abs(returned)) * (left == 0)

    return near


def half_of_the_time(answer, solution):
    def near(q_row, epsilon, rng):
        return (answer if rng.random() < 0.5 else solution)(q_row, epsilon, rng)

    return near


@pytest.mark.parametrize(
    ("key", "answer", "name"),
    [
        ("ex-1-1", -20, "no discount"),
        ("ex-1-1", 18.2, "the sign"),
        ("ex-1-2", "infinity", "a sum without end is infinite"),
        ("ex-2-3", -6.79, "one coin too few"),
        ("ex-2-3", -8, "no discount"),
        ("ex-4-3", 978, "no way open"),
        ("ex-5-3", "36 %", "not normalised"),
        ("ex-6-3", 0.9667, "shared out equally"),
        ("ex-7-2", -94.1, "goals left out"),
        ("ex-7-3", 66.7, "the sign"),
        ("ex-7-3", -84.0, "ND"),
        ("ex-7-3", -83.955786, "ND"),
        ("ex-9-2b", 0.44, "the other arm"),
    ],
)  # fmt: skip
def test_a_number_that_is_a_mistake_is_named(key, answer, name):
    assert check(key, answer).text.startswith(f"This looks like: *{name}*.")


@pytest.mark.parametrize("answer", [99.5, 95, 101])
def test_a_count_is_not_right_by_rounding(answer):
    assert check("ex-9-1", answer).verdict == "not yet"


def by_permutation(q_row, epsilon, rng):
    return np.argmax(q_row[rng.permutation(len(q_row))])


def hard_coded(share):
    right = CODING["ex-3-2"].solution
    return lambda q_row, epsilon, rng: right(q_row, share(epsilon), rng)


WRONG = {
    "ex-3-2: epsilon is 0.1": ("ex-3-2", hard_coded(lambda epsilon: 0.1)),
    "ex-3-2: epsilon is 0.05": ("ex-3-2", hard_coded(lambda epsilon: 0.05)),
    "ex-3-2: epsilon is 0.15": ("ex-3-2", hard_coded(lambda epsilon: 0.15)),
    "ex-3-2: epsilon is halved": ("ex-3-2", hard_coded(lambda epsilon: epsilon / 2)),
    "ex-3-2: argmax of a permuted row": ("ex-3-2", by_permutation),
    "ex-2-2: 1e-9 whatever the tolerance": (
        "ex-2-2",
        lambda q_row, tolerance: np.flatnonzero(q_row >= q_row.max() - 1e-9),
    ),
    "ex-6-1: nothing": ("ex-6-1", lambda f, x: 0 * x),
    "ex-4-3: without the goals": ("ex-4-3", 971),
}


@pytest.mark.parametrize(("key", "answer"), WRONG.values(), ids=WRONG)
def test_another_wrong_answer_is_refused_and_called_no_mistake(key, answer):
    reply = check(key, answer)

    assert reply.verdict == "not yet"
    assert "This looks like" not in reply.text


# ---- counterexamples


def test_only_actions_and_shares_are_shown_of_a_choice():
    text = check("ex-3-2", by_permutation).text

    assert "Yours draws the actions in the shares [" in text
    assert "rng=a generator" in text


def test_an_action_that_is_none_is_told_with_what_it_was():
    text = check("ex-3-2", lambda q_row, epsilon, rng: q_row.max() + 0.5).text

    assert text.startswith("An action is a whole number from 0 to 3 where q_row has 4")
    assert text.endswith("yours was 0.5.")


def test_truth_is_shown_as_truth():
    def near_goal(cell, goal, width, near):
        return abs(cell - goal) // 2

    assert "not True, called" in check("ex-4-2", near_goal).text


def test_a_small_case_of_votes_is_shown():
    text = check("ex-5-1", lambda policies, rhos, n: np.zeros((n, 2))).text

    assert "called with policies=[[[0. , 1. ], [0.5, 0.5], [0. , 0. ]]]" in text
    assert "n_abstract=2." in text


def test_a_list_of_sets_is_told_from_an_array():
    text = check("ex-5-2", lambda policies, rhos, n: [set() for _ in range(n)]).text

    assert "not a list of sets" in text


# ---- reading and data


def test_a_formula_is_read_by_the_rules_of_arithmetic():
    assert formula("2 + 3*4**2/8 - -1") == 9
    assert numbers("1; 2; 3").tolist() == [1, 2, 3]


def test_what_is_shown_does_not_depend_on_the_readers_print_options():
    with np.printoptions(precision=1, suppress=True, formatter={"all": lambda x: "?"}):
        assert shown(np.array([0.12345, 1e-9])) == shown(np.array([0.12345, 1e-9]))
        assert "?" not in shown(np.array([0.12345, 1e-9]))


@pytest.mark.parametrize("exercise", ALL.values(), ids=ALL)
def test_an_exercise_is_data_that_a_page_can_hold(exercise):
    data = json.loads(json.dumps(exercise.as_data(), allow_nan=False))

    assert data["id"] == exercise.key
    assert data["hints"] == list(exercise.hints)
    assert [w["hint"] for w in data["wrong"]] == [w.hint for w in exercise.wrong]
    if exercise.cases:
        assert data["kind"] == "lines"
        assert "solution" not in data
        for name, lines in data["blanks"].items():
            mistakes = ["" if i is None else exercise.wrong[i].name for _, i in lines]
            assert (
                dict(zip(mistakes, dict(lines), strict=True))
                == (exercise.stub.blanks[name])
            )
    else:
        assert data["kind"] in ("numbers", "size", "word", "letters")
        assert check(exercise.key, data["solution"])
        for wrong in data["wrong"]:
            answer = wrong["answer"]
            assert f"*{wrong['name']}*" in check(exercise.key, answer).text
