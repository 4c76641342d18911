"""No orphan number: what the prose states, a checked cell of the page shows."""

import copy
import json

import prose_numbers
import pytest
from prose_numbers import orphans, prose
from support import ROOT

PAGES = sorted((ROOT / "book").glob("*.ipynb"))


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_every_number_of_a_page_is_shown_by_it_or_is_a_constant(path):
    found = orphans(path)

    assert not found, "\n".join(map(str, found))


def test_every_constant_says_what_it_is_and_where_it_comes_from():
    for constant in prose_numbers.constants():
        assert constant["what"]
        if formula := constant.get("formula"):
            digits = 1 if isinstance(constant["number"], float) else 0
            assert round(eval(formula), digits) == constant["number"], constant
        else:
            assert constant["source"]


@pytest.fixture
def page(tmp_path):
    """Return the orphans of a page with this text, one output, and this code."""

    def found(text, output="", code=""):
        cells = [
            {"cell_type": "markdown", "metadata": {}, "source": text},
            {
                "cell_type": "code",
                "metadata": {},
                "source": code,
                "outputs": [{"output_type": "stream", "text": output}],
            },
        ]
        path = tmp_path / "page.ipynb"
        path.write_text(json.dumps({"cells": cells}), encoding="utf-8")
        return [orphan.number for orphan in orphans(path)]

    return found


@pytest.mark.parametrize(
    ("text", "output"),
    [
        ("It costs 23.5 steps.", "23.456 17"),
        ("It costs 23.5 steps.", "-23.456"),
        ("That is 41 %.", "share 0.412"),
        ("About 276 thousand goals.", "275,712"),
        ("About 276,000 goals.", "275712"),
        ("It takes about 75 sweeps.", "73"),
        ("After 4.5 million steps.", "4,500,000"),
        ("Twelve, 12, or 7 are small.", ""),
    ],
)
def test_a_number_that_an_output_rounds_to_is_shown(page, text, output):
    assert page(text, output) == []


@pytest.mark.parametrize(
    ("text", "output", "found"),
    [
        ("It costs 23.5 steps.", "23.56", ["23.5"]),
        ("It costs 23.5 steps.", "", ["23.5"]),
        ("It takes about 75 sweeps.", "70", ["75"]),
        ("It takes 75 sweeps.", "73", ["75"]),
        ("About 276 thousand goals.", "27,571", ["276"]),
        ("So $2 \\cdot 41 = 82$ it is.", "", ["82"]),
        ("So $12 + 71 = 82.5$ it is.", "82", ["82.5"]),
    ],
)
def test_a_number_that_nothing_shows_is_found(page, text, output, found):
    assert page(text, output) == found


@pytest.mark.parametrize(
    "text",
    [
        "```python\nx = 77\n```",
        "```{math}\n:label: eq-x\nx = 77 y\n```",
        "Take `x[77]`, {doc}`77_page`, [a link](https://x.org/77).",
        "Let $n = 77$ and $\\gamma^{77}$.",
        "In 1998 it was new.",
        "**2.** A robot reaches 70 goals. Why?\n\n```{dropdown} 99 goals\nNo.\n```",
        "*Time:* 77 minutes, 25 of them for the exercises.",
        "````{admonition} For the lecturer\n27 quiz\n````",
    ],
)
def test_what_is_no_claim_is_not_looked_at(page, text):
    assert page(text) == []


def test_a_literal_of_the_code_is_shown(page):
    assert page("After 77 million steps.", code="run(77_000_000)") == []


def test_the_numbers_of_a_lecturers_box_but_for_its_minutes_are_looked_at():
    box = "````{admonition} For the lecturer\n27 quiz, about 33 answers\n````"

    assert "33" in prose(box)
    assert "27" not in prose(box)


def test_a_wrong_number_on_a_real_page_is_found(tmp_path):
    path = ROOT / "book" / "07_driving_test.ipynb"
    page = json.loads(path.read_text(encoding="utf-8"))
    changed = copy.deepcopy(page)
    for cell in changed["cells"]:
        cell["source"] = [
            line.replace("which is about 63", "which is 59") for line in cell["source"]
        ]
    assert changed != page

    other = tmp_path / path.name
    other.write_text(json.dumps(changed), encoding="utf-8")
    assert [orphan.number for orphan in orphans(other)] == ["59"]


def test_the_script_says_where(capsys):
    path = ROOT / "book" / "07_driving_test.ipynb"

    assert prose_numbers.main([str(path)]) == 0
    assert "0 numbers that no cell shows" in capsys.readouterr().out
