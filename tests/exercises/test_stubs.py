"""Stubs: every line that a page offers does what it is filed under."""

import json

import numpy as np
import pytest
from support import ROOT

from abstransfer.exercises import _check, all_exercises, check

CODING = {exercise.key: exercise for exercise in all_exercises() if exercise.cases}
OFFERED = [
    (key, blank, mistake)
    for key, exercise in CODING.items()
    for blank, lines in exercise.stub.blanks.items()
    for mistake in lines
]

# Where a page solves it in other words.
OTHERWISE = {
    ("ex-1-3", "told"): "`cell` is kept, so that it can be taken for the next one",
    ("ex-12-3", "advice"): "a row may be empty, after a wrong line before it",
    ("ex-5-2", "ever"): "the page adds up where an action was best, not its votes",
}


@pytest.fixture(autouse=True)
def new_session(monkeypatch):
    monkeypatch.setattr(_check, "_tries", {})


def made(exercise, **mistakes):
    """Return the function that a stub makes with these lines."""
    names = {"np": np}
    exec(exercise.stub.filled(**mistakes), names)
    return names[exercise.name]


@pytest.mark.parametrize(("key", "blank", "mistake"), OFFERED)
def test_a_line_is_right_or_the_mistake_that_it_is_filed_under(key, blank, mistake):
    reply = check(key, made(CODING[key], **{blank: mistake}))

    if mistake:
        hints = {wrong.name: wrong.hint for wrong in CODING[key].wrong}
        assert reply.text == f"This looks like: *{mistake}*. {hints[mistake]}"
    else:
        assert reply


@pytest.mark.parametrize("exercise", CODING.values(), ids=CODING)
def test_a_stub_offers_several_mistakes_and_no_line_twice(exercise):
    blanks = exercise.stub.blanks
    offered = [mistake for lines in blanks.values() for mistake in lines if mistake]

    assert len(offered) >= 4
    assert len(set(offered)) == len(offered)
    for name, lines in blanks.items():
        assert exercise.stub.code.count(f"{{{name}}}") == 1
        assert len(set(lines.values())) == len(lines) >= 2
        assert all("\n" not in line for line in lines.values())
    assert "{" not in exercise.stub.filled()


@pytest.mark.parametrize("exercise", CODING.values(), ids=CODING)
def test_the_right_lines_are_those_of_the_solution_on_the_page(exercise):
    page = int(exercise.key.split("-")[1])
    (path,) = (ROOT / "book").glob(f"{page:02d}_*.ipynb")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    code = [" ".join("".join(c["source"]).split()) for c in cells]

    for name, lines in exercise.stub.blanks.items():
        is_there = any(f"def {exercise.name}(" in c and lines[""] in c for c in code)
        assert is_there != ((exercise.key, name) in OTHERWISE), name
