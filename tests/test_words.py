"""One word for each thing: advice, run, eager, wanderer; the names of robots."""

import json
import re

import pytest
from support import ROOT

from abstransfer.plotting.style import PALETTE
from abstransfer.scenes.parts.runs import NAMES as RACERS
from abstransfer.scenes.project.widget import NAMES as ROBOTS

# A page is a page of this book.  What a robot is handed is advice.
PAGE = re.compile(
    r"\bpages?\s+of\s+advice|'s\s+page\b|\b(best|eager|blank|such\s+a)\s+page\b"
    r"|\bpages\s+(are|were)\s+written|\b(wholePage|pageOf|PAGES)\b"
)
# A run is no life; but on a result card, and where a story is told.
LIFE = re.compile(
    r"\b(goals\s+of\s+(a|each)\s+life|(after|of)\s+\d+\s+lives|[Ll]ives of)"
)
CARD = ("project/card.py", "project/race.js")
BOOK = sorted((ROOT / "book").glob("*.ipynb")) + sorted((ROOT / "book").glob("*.md"))
CODE = [
    path
    for kind in ("py", "js")
    for path in sorted((ROOT / "abstransfer").rglob(f"*.{kind}"))
    if "_bundles" not in path.parts
]


def text_of(path):
    """Return what an author wrote: of a notebook its cells without their outputs."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        text = "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"])
    # A sentence may run on in the next line: of a page, a comment, or a string.
    return re.sub(r"\s*\n\s*(//|#|\*)?\s*|[\"'`]\s*\+?\s*\n\s*f?[\"'`]", " ", text)


def found(pattern, path):
    return [match.group() for match in pattern.finditer(text_of(path))]


@pytest.mark.parametrize("path", BOOK, ids=lambda path: path.name)
def test_a_page_calls_advice_advice(path):
    assert found(PAGE, path) == []


def test_the_code_calls_advice_advice():
    assert {path.name: words for path in CODE if (words := found(PAGE, path))} == {}


def test_the_code_calls_a_run_a_run():
    texts = [path for path in CODE if not path.as_posix().endswith(CARD)]

    assert {path.name: words for path in texts if (words := found(LIFE, path))} == {}


@pytest.mark.parametrize(
    "text",
    [
        "ND's page drives worse.",
        "A page of\nadvice has a row for each view.",
        "// the pages of\n// advice drive",
        '"Bet on the best "\n    "page of all"',
    ],
)
def test_the_old_word_is_found_across_lines(text, tmp_path):
    (tmp_path / "text.md").write_text(text, encoding="utf-8")

    assert found(PAGE, tmp_path / "text.md")


def test_robots_are_called_what_the_palette_calls_them():
    """One home: figures, stills and scenes take their names from there."""
    names = {key: look["name"] for key, look in PALETTE["arms"].items()}

    assert (names["rand"], names["uniform_available"]) == ("wanderer", "eager")
    assert {key: RACERS[key] for key in names if key in RACERS}.items() <= names.items()
    assert {key: ROBOTS[key] for key in names if key in ROBOTS}.items() <= names.items()
    assert ROBOTS["eager"] == names["uniform_available"]
