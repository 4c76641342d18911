"""Bets: each has options, a reply where its answer is known, and no spoiler before."""

import json
import re
from typing import NamedTuple

import pytest
import yaml
from support import ROOT

from abstransfer.scenes import KINDS

BOOK = ROOT / "book"
PAGES = sorted(BOOK.glob("[0-9]*.ipynb"))
BOX = re.compile(
    r"^```\{admonition\} (?P<title>[^\n]+)\n(?P<options>(?::[^\n]*\n)*)"
    r"(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
NAME = re.compile(r"^:name: (\S+)$", re.MULTILINE)
ASKS = re.compile(r"\basks-(\w+?)-(\S+)")
SHOWN = re.compile(r"data-scene=\\?\"(\w+)")
# Bets that only the scene asks: they are about what is done in it.
OF_SCENES = {
    (name, bet)
    for name, kind in KINDS.items()
    for bet in kind.constants.get("bets", ())
}
SMALL = {
    "one",
    "two",
    "three",
    "none",
    "all",
    "no",
    "yes",
    "nd",
    "prob",
    "grad",
    "nothing",
}


class Bet(NamedTuple):
    """A bet of a page, and what stands around it."""

    name: str
    question: str
    options: list
    asks: tuple  # of a scene: its name, and that of the bet; or ()
    before: str  # all text and all output above
    after: str  # all text below

    @property
    def reply(self):
        """The reply: what its admonition holds; "" if there is none below."""
        wanted = self.name.replace("bet-", "reply-")
        for box in BOX.finditer(self.after):
            if wanted in NAME.findall(box["options"]):
                return box["text"].strip()
        return ""

    @property
    def answer(self):
        """The option that is right: the first bold words of the reply."""
        found = re.match(r"\*\*(.+?)\.?\*\*", self.reply)
        return found[1] if found else ""


def plain(text):
    """Return words without marks, as they are compared."""
    return re.sub(r"\s+", " ", re.sub(r"[*`$\\]", "", text)).strip(" .").lower()


def source(cell):
    return "".join(cell["source"])


def whole(cell):
    """Return the text of a cell, and what it prints."""
    parts = [source(cell)]
    for output in cell.get("outputs", ()):
        data = output.get("data", {})
        parts += ["".join(output.get("text", "")), "".join(data.get("text/plain", ""))]
    return "\n".join(parts)


def bets_of(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    found = []
    for i, cell in enumerate(cells):
        for box in (
            BOX.finditer(source(cell)) if cell["cell_type"] == "markdown" else ()
        ):
            if box["title"] != "Bet":
                continue
            *question, options = re.split(r"\n\n(?=\* )", box["text"].strip())
            asks = ASKS.search(box["options"])
            found.append(
                Bet(
                    NAME.search(box["options"])[1],
                    "\n".join(question),
                    re.findall(r"^\* (.+)$", options, re.MULTILINE),
                    asks.groups() if asks else (),
                    "\n".join(map(whole, cells[:i])) + source(cell)[: box.start()],
                    source(cell)[box.end() :] + "\n".join(map(source, cells[i + 1 :])),
                )
            )
    return found


BETS = {path.stem: bets_of(path) for path in PAGES}
ALL = [pytest.param(path.stem, b, id=b.name) for path in PAGES for b in BETS[path.stem]]


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_a_page_has_a_bet(path):
    assert BETS[path.stem]


@pytest.mark.parametrize(("page", "bet"), ALL)
def test_a_bet_asks_one_question_and_has_options(page, bet):
    assert re.fullmatch(rf"bet-{int(page[:2])}-\w+", bet.name)
    assert plain(bet.question).endswith("?")
    assert 2 <= len(bet.options) <= 8
    assert len({plain(option) for option in bet.options}) == len(bet.options)


@pytest.mark.parametrize(("page", "bet"), ALL)
def test_a_bet_has_a_reply_below_that_names_an_option(page, bet):
    assert bet.reply, "there is no admonition with the name reply-..."
    assert plain(bet.answer) in map(plain, bet.options)


def headings(page):
    """Return what the navigation and the contents show beside a page."""
    toc = yaml.safe_load((BOOK / "_toc.yml").read_text(encoding="utf-8"))
    files = [c["file"] for part in toc["parts"] for c in part["chapters"]]
    found = []
    for name in [toc["root"], *files]:
        notebook = BOOK / f"{name}.ipynb"
        if notebook.exists():
            cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
            text = "\n".join(source(c) for c in cells if c["cell_type"] == "markdown")
        else:
            text = (BOOK / f"{name}.md").read_text(encoding="utf-8")
        marks = "#+" if name == page else "#"
        found += re.findall(rf"^{marks} (.+)$", text, re.MULTILINE)
    return found


def numbers(text):
    """Return the numbers of a text that say something: not the small ones."""
    found = re.findall(r"(?<![\w.,])\d[\d,]*(?:\.\d+)?", text)
    return {n.rstrip(",") for n in found if "." in n or int(n.replace(",", "")) > 12}


@pytest.mark.parametrize(("page", "bet"), ALL)
def test_nothing_before_a_bet_says_its_answer(page, bet):
    """
    The reply's numbers stand nowhere above, its words not in any heading.

    That is what can be compared: a paragraph that tells the answer in other words is
    for a reader to find.
    """
    intro = (BOOK / "intro.md").read_text(encoding="utf-8")
    beside = plain(" | ".join([*headings(page), intro]))
    news = numbers(bet.reply) - numbers(bet.question + " ".join(bet.options))
    told = news & (numbers(bet.before) | numbers(beside))

    assert not told
    words = plain(bet.answer)
    assert words in SMALL or not re.search(rf"\b{re.escape(words)}\b", beside)


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_no_bet_is_asked_twice(path):
    asked = [bet.asks for bet in BETS[path.stem] if bet.asks]
    scenes = set(SHOWN.findall(path.read_text(encoding="utf-8")))
    of_scenes = {
        (scene, name.replace("_", "-"))
        for scene in scenes
        for name in bet_fields(KINDS[scene])
    }

    assert len(set(asked)) == len(asked)
    assert set(asked) == of_scenes - OF_SCENES


def bet_fields(kind):
    """Return the names of a scene's bets: texts that no address holds."""
    fields = kind.spec()["fields"].items()
    return [
        name
        for name, field in fields
        if field["kind"] == "text" and field["isLocal"] and field["start"] == ""
        if name != "student"
    ]
