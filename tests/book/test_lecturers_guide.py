"""The lecturer's guide: its links lead to scenes, its answers are the pages' own."""

import json
import re

import pytest
from moments import check_moment
from support import ROOT

from abstransfer.exercises import all_exercises

BOOK = ROOT / "book"
GUIDE = (BOOK / "lecturers_guide.md").read_text(encoding="utf-8")
MOMENTS = re.findall(r'<a class="disabled" href="(\w+)\.html#([^"]+)">', GUIDE)
OPEN = dict(re.findall(r"^\| `(ex-[\w-]+)` \| ([^|]{20,}) \|$", GUIDE, re.MULTILINE))


def cells_of(page):
    return json.loads((BOOK / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]


def outputs_of(page):
    return " ".join(json.dumps(cell.get("outputs", "")) for cell in cells_of(page))


def page_of(key):
    (path,) = BOOK.glob(f"{int(key.split('-')[1]):02}_*.ipynb")
    return path.stem


def test_each_page_has_a_moment_to_show():
    pages = {path.stem for path in BOOK.glob("[0-9]*.ipynb")}

    assert {page for page, _ in MOMENTS} == pages


@pytest.mark.parametrize(("page", "moment"), MOMENTS)
def test_a_moment_is_a_state_of_the_scene_on_its_page(page, moment):
    check_moment(moment, outputs_of(page))


def test_the_guide_says_of_each_open_exercise_what_a_good_answer_holds():
    checked = {exercise.key for exercise in all_exercises()}
    asked = set()
    for path in BOOK.glob("[0-9]*.ipynb"):
        text = "".join("".join(cell["source"]) for cell in cells_of(path.stem))
        asked |= set(re.findall(r"\{exercise-start\}\n:label: (\S+)", text))

    assert set(OPEN) == asked - checked


@pytest.mark.parametrize("key", OPEN)
def test_a_number_of_a_good_answer_is_an_output_of_its_page(key):
    shown = outputs_of(page_of(key)).replace(",", "")

    for number in re.findall(r"\d[\d,]*(?:\.\d+)?", OPEN[key]):
        number = number.replace(",", "")
        if "." in number or int(number) > 12:
            assert re.search(rf"(?<![\d.]){re.escape(number)}(?!\d)", shown), number
