"""The built page says to an answer what `check` says, word by word."""

import json
import random
import subprocess
from pathlib import Path

import pytest

from abstransfer.exercises import _check, all_exercises, check
from abstransfer.exercises._run import Heard
from abstransfer.scenes import bundle

SCRIPT = Path(__file__).with_name("replies.js")
ALL = {exercise.key: exercise for exercise in all_exercises()}
VALUES = {key: exercise for key, exercise in ALL.items() if not exercise.cases}
CODING = {key: exercise for key, exercise in ALL.items() if exercise.cases}
MINUS = "\u2212"

KINDS = (
    "ex-1-1",
    "ex-1-2",
    "ex-5-3",
    "ex-6-3",
    "ex-7-2",
    "ex-7-4",
    "ex-8-2b",
)  # each is read otherwise

# What students typed, and its kinds.
TYPED = [
    *["-18.21", "-18,21", "\u221218.21", "-18.2", "-18", "18.2", "-20", "20"],
    *["-(1-0.99^20)/(1-0.99)", "-(1 - 0.99**20)/(1 - 0.99)", "1/(1-0.99)", "10**2"],
    *["infinity", "inf", "\u221e", "-inf", "-\u221e", "inf - inf", "inf/inf", "1/inf"],
    *["0,28", "0,2828", "5,000", "5 000", "5\u202f000", "5\u00a0000", "1,234.5"],
    *["88, 96", "(88, 96)", "88 and 96", "88; 96", "[88, 96]", "88, 95", "96, 88"],
    *["0.783, 6.6", "0.783; 6.6", "0,783; 6,6", "0.36/0.46 and 7", "78.3", "78 %"],
    *["0,987; 0,744", "0,987 and 0,744", "98.7 %, 74.4 %", "1,485; 18,900", "1,2; 3,4"],
    *["78,3 percent", "98.71", "98.7 per cent", "0.5 %", "36/46", "153/155", "5/9"],
    *["-94", "-93.9", "-93.88", "-94.05", "-94.1", "-97", "-82", "-81.6", "81.6"],
    *["0.99", "0.987", "0.9667", "0.97", "1", "1.0", "0", "-0", "0.0", "00", "007"],
    *["-93.88, 3.17", "-93.88; 0.5", "3.17", "3.2", "3.3 %", "0.0327", "73 %", "-3.17"],
    *["100", "100.0", "-100", "1e2", "1E2", "0x64", "0b11", "1_00", "1__0", "100."],
    *[".5", "100 coins", "100 Coins", "a hundred", "x = 100", "\u2248 100", "~100"],
    *["100!", "$100$", "`100`", '"100"', "\u201c100\u201d", "100.", " 100 ", "+100"],
    *["--100", "2(50)", "10 10", "9**9**9", "(-8)^(1/3)", "1/0", "0**-1", "2**-1"],
    *["-2**2", "2^3^2", "2*-3", "6/2/3", "10-3-2", "(1", "1)", "()", "5 % 3", "7//2"],
    *["1 # one", "True", "None", "nan", "1j", "__import__('os')", "(" * 150, "9" * 150],
    *["9" * 250, "no", "No.", "NO!", "n", "yes", "Yes, Prob overtakes ND", "y"],
    *["false", "true", "no, the order stays the same", "the order stays", "not at all"],
    *["nope", "maybe", "door", "the doors", "\u2013", "-", ".", ",", ";", "..."],
    *["1,2,3", "1;2;3"],
    *["3\u00d74", "3\u00b74", "6\u00f72", "1 \u2212 0,95", "1e400", "-1e400"],
    *["-1(1-0.99^8)", "-1 (1-0.99^8)/(1-0.99)", "(2)(3)", "2(3", "5("],
    *["2.(3)", "6/2(3)"],
    *["A and B", "a, b", "B A", "AB", "ba", "A", "A, B and C.", "all", "A and 2"],
    *["\u0131b", "a program: A", "A/B", "all four of them", "A & B (not C)"],
    "\u22121 \u00f7 (1 \u2212 0,95)",
]  # fmt: skip


def spellings(x):
    """Yield a number as readers write it."""
    text = repr(float(x))
    yield from (text, text.replace(".", ","), text.replace("-", MINUS), f"x = {text}")
    yield from (f"{x:.1f}", f"{x:.2f}", f"{x:.3f}", f"{x:.0f}", f"{100 * x:.2f} %")
    yield from (f"{x * 1.0012345 + 0.0012345!r}", f"{x:e}", f"({text})", f"1*{text}")


def typed(exercise):
    """Return what is known of an exercise, right and wrong, as readers write it."""
    wanted = (exercise.solution, *exercise.also)
    known = [*wanted, *(wrong.answer for wrong in exercise.wrong)]
    found = [t for x in known if not isinstance(x, str) for t in spellings(x)]
    found += [x for x in known if isinstance(x, str)]
    if exercise.also:
        found += [" and ".join(f"{x:.{n}f}" for x in wanted) for n in (0, 1, 2, 4)]
    return found


def in_turn(exercise):
    """Return answers of one reader: mistakes made again, right and wrong in turn."""
    rng = random.Random(exercise.key)
    pool = [str(wrong.answer) for wrong in exercise.wrong]
    pool += [str(exercise.solution), "0.123456", "words", "3, 4, 5, 6"]
    return [rng.choice(pool) for _ in range(12)]


def odd():
    """Return texts of the signs that numbers are written with, in any order."""
    rng = random.Random(1)
    signs = [
        *"0123456789",
        *"..,,;-+*/^()% ",
        "**",
        "e5",
        "inf",
        " and ",
        "=",
        "~",
        "#",
    ]
    signs += ["_", MINUS, "\u221e", "steps", "x", "\u00a0", "'", '"', "0x", "\u00f7"]
    return ["".join(rng.choices(signs, k=rng.randint(1, 9))) for _ in range(300)]


def chosen(exercise):
    """Return each wrong line among right ones, and what it is filed under."""
    blanks = exercise.stub.blanks
    right = {name: lines[""] for name, lines in blanks.items()}
    return [
        ({**right, name: line}, mistake)
        for name, lines in blanks.items()
        for mistake, line in lines.items()
    ]


def two_wrong():
    lines = ALL["ex-3-1"].stub.blanks
    return {
        "following": lines["following"]["a cut is a goal"],
        "value": lines["value"]["no discount"],
    }


# By test and exercise, the answers of one reader or of many.
TABLE = {("typed", key): [[a] for a in typed(e)] for key, e in VALUES.items()}
TABLE |= {("odd", key): [[a] for a in [*TYPED, *odd()]] for key in KINDS}
TABLE |= {("in turn", key): [in_turn(e)] for key, e in VALUES.items()}
TABLE |= {("lines", key): [[a] for a, _ in chosen(e)] for key, e in CODING.items()}
TABLE |= {("two", "ex-3-1"): [[two_wrong(), two_wrong(), {}]]}


@pytest.fixture(scope="module")
def said():
    """What the page says to the answers of the table."""
    tasks = {key: exercise.as_data() for key, exercise in ALL.items()}
    flat = [(name, given) for name, each in TABLE.items() for given in each]
    done = subprocess.run(
        [bundle.find_deno(), "run", "--quiet", SCRIPT],
        input=json.dumps([tasks, [[key, given] for (_, key), given in flat]]),
        capture_output=True,
        encoding="utf-8",
        env=bundle.environment(),
    )
    assert done.returncode == 0, done.stderr
    found = {}
    for (name, _), reply in zip(flat, json.loads(done.stdout), strict=True):
        found.setdefault(name, []).append(reply)
    return found


@pytest.mark.parametrize(
    "name", [name for name in TABLE if name[0] in ("typed", "in turn", "odd")], ids=str
)
def test_the_page_says_what_check_says(name, said, monkeypatch):
    # No answer here needs to be guarded, and a thread for each would take long.
    monkeypatch.setattr(_check, "run", lambda work: work(Heard()))
    for given, page in zip(TABLE[name], said[name], strict=True):
        monkeypatch.setattr(_check, "_tries", {})
        replies = [check(name[1], answer) for answer in given]

        assert page == [[r.verdict, r.text] for r in replies], given


@pytest.mark.parametrize("key", CODING)
def test_a_chosen_line_is_named_as_it_is_filed(key, said):
    """And as ``check`` names the function that has it: see test_stubs."""
    hints = {wrong.name: wrong.hint for wrong in CODING[key].wrong}

    for (_, mistake), (reply,) in zip(
        chosen(CODING[key]), said["lines", key], strict=True
    ):
        words = f"This looks like: *{mistake}*. {hints.get(mistake)}"
        right = ["right", "It agrees in every case."]
        assert reply == (["not yet", words] if mistake else right)


def test_of_two_wrong_lines_the_first_is_named_and_the_other_told(said):
    ((first, again, none),) = said["two", "ex-3-1"]

    assert first[1].startswith("This looks like: *a cut is a goal*. ")
    assert first[1].endswith(" Another line is not right either.")
    assert again[1].endswith(f" Hint 1 of 3: {ALL['ex-3-1'].hints[0]}")
    assert none == ["no answer yet", "Choose a line for each blank."]
