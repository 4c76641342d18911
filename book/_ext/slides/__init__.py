"""
A Sphinx extension that makes slides for the wall: one a scene, in ``slides.html``.

All that a slide says is said elsewhere, once: the scene, the moment to show and the
question come from a table of the lecturer's guide, the bet and the picture from the
page of the scene.  The picture is the first of its three, which spoils no bet.

nbconvert's slides need the network for reveal.js, require.js and MathJax; these are one
file with a script of a few lines, beside the pages that they lead to.
"""

import json
import re
from html import escape
from pathlib import Path
from typing import NamedTuple

from sphinx.util import logging

from abstransfer.scenes import KINDS

HERE = Path(__file__).parent
GUIDE = "lecturers_guide.md"
ROW = re.compile(
    r'^\| (?P<name>[^|]+) \| (?P<show><a class="disabled" '
    r'href="(?P<page>\w+)\.html#(?P<moment>(?P<scene>\w+)\.[^"]+)">[^|]+) '
    r"\| (?P<ask>[^|]+) \|$",
    re.MULTILINE,
)
BET = re.compile(
    r"^```\{admonition\} Bet\n:class: [^\n]*\basks-(\w+)-\S+\n:name: [^\n]*\n"
    r"(?P<question>.+?)\n\n(?P<options>(?:\* [^\n]+\n)+)```$",
    re.MULTILINE | re.DOTALL,
)
STILL = re.compile(r'data-scene="(\w+)".*?<div class="ab-frames"><div>(<svg.*?</svg>)')
MARKS = [
    (re.compile(r"\$\\(tau|beta)\$"), r"&\1;"),
    (re.compile(r"\*\*([^*]+)\*\*"), r"<strong>\1</strong>"),
    (re.compile(r"\*([^*]+)\*"), r"<em>\1</em>"),
]
logger = logging.getLogger(__name__)


class Bet(NamedTuple):
    """A question and its options, in HTML."""

    question: str
    options: list[str]


def as_html(words: str) -> str:
    r"""
    Return words of a page as HTML.

    >>> as_html("Which $\\tau$ is *best*?")
    'Which &tau; is <em>best</em>?'
    """
    found = escape(words, quote=False)
    for pattern, said in MARKS:
        found = pattern.sub(said, found)
    return found


def bet_of(scene: str, text: str) -> Bet | None:
    """Return the first bet on a scene: its page's, or that the scene itself asks."""
    for found in BET.finditer(text):
        if found[1] == scene:
            options = re.findall(r"^\* (.+)$", found["options"], re.MULTILINE)
            return Bet(as_html(found["question"]), [as_html(o) for o in options])
    for bet in KINDS[scene].constants.get("bets", {}).values():
        question = bet["question"].partition(": ")[2]
        options = [escape(option) for option in bet["options"].values()]
        return Bet(escape(question[0].upper() + question[1:]), options)
    return None


def picture_of(scene: str, cells: list) -> str:
    """Return the first picture of a scene, as the page's output holds it."""
    for cell in cells:
        for output in cell.get("outputs", ()):
            html = "".join(output.get("data", {}).get("text/html", ""))
            found = STILL.search(html)
            if found and found[1] == scene:
                return found[2]
    return ""


def slide(row: re.Match, book: Path) -> str:
    """Return the slide of a row of the guide."""
    scene, page, moment = row["scene"], row["page"], row["moment"]
    cells = json.loads((book / f"{page}.ipynb").read_text("utf-8"))["cells"]
    text = "\n".join(
        "".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"
    )
    bet, picture = bet_of(scene, text), picture_of(scene, cells)
    if not picture:
        logger.warning(f"slides: {page} shows no picture of {scene}")
    asked = ""
    if bet:
        options = "".join(f"<li>{option}</li>" for option in bet.options)
        asked = f"<p><b>Bet.</b> {bet.question}</p><ul>{options}</ul>"
    wall = f"{page}.html#{moment}&amp;{scene}.wall=1"
    show = re.sub(r"</?a[^>]*>", "", row["show"])
    return (
        f'<section id="{scene}" aria-labelledby="{scene}-title" tabindex="-1">'
        f'<h2 id="{scene}-title">{row["name"]}</h2>'
        f'<div class="columns"><div class="bet">{asked}</div>'
        f'<div class="abstransfer-scene ab-live picture">{picture}</div></div>'
        f'<p class="ask"><b>Then ask:</b> {as_html(row["ask"])}</p>'
        f'<p class="live"><a href="{wall}">Show it live</a>: {as_html(show)}</p>'
        "</section>"
    )


def slides(book: Path) -> str:
    """Return the page with all slides, in the order of the guide."""
    rows = [*ROW.finditer((book / GUIDE).read_text("utf-8"))]
    if left_out := sorted(set(KINDS) - {row["scene"] for row in rows}):
        logger.warning(f"slides: {GUIDE} has no moment of {', '.join(left_out)}")
    style = (HERE / "slides.css").read_text("utf-8")
    script = (HERE / "slides.js").read_text("utf-8")
    body = "\n".join(slide(row, book) for row in rows)
    return f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Advice for Robots: slides</title>
<link rel="stylesheet" href="_static/scenes/scenes.css">
<style>{style}</style></head>
<body><main><h1>Advice for Robots</h1>
{body}
</main>
<nav aria-label="Slides"><button type="button" value="-1">Back</button>
<output></output><button type="button" value="1">Next</button>
<a href="lecturers_guide.html">Guide</a></nav>
<script>{script}</script></body></html>
"""


def write(app, exception):
    """Write the slides beside the built pages."""
    book = Path(app.srcdir)
    if exception or app.builder.format != "html" or not (book / GUIDE).is_file():
        return  # a test builds a few pages without the guide
    path = Path(app.outdir, "slides.html")
    path.write_text(slides(book), encoding="utf-8", newline="\n")


def setup(app):
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
