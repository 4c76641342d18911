"""
Find numbers in prose that no checked cell of the page shows.

    python scripts/prose_numbers.py                   all pages
    python scripts/prose_numbers.py book/07_*.ipynb   some

A number with a decimal point or above 12 must be, rounded as the prose rounds it, in
an output of the page; or be a literal of its code, which runs; or belong to an
exercise that tests itself; or stand in book/constants.yml with its origin.  Code,
years, minutes and displayed formulas are not looked at, of a formula in a line only
what stands behind its last equals sign.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path
from typing import NamedTuple

import yaml

from abstransfer.exercises import exercises_of

BOOK = Path(__file__).parents[1] / "book"
NUMBER = re.compile(r"(?<![\w.,])\d[\d,]*(?:\.\d+)?(?:e-?\d+)?(?![\w])")
LITERAL = re.compile(r"(?<![\w.])\d[\d_]*(?:\.\d+)?(?:e-?\d+)?")
ANY = re.compile(r"(?<![\d.])\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?")  # in an output
NOT_PROSE = [
    # A block of code or a displayed formula; the options of a directive.
    re.compile(
        r"^(`{3,}|~{3,})(?:python|ipython3|bash|text|\{math\}).*?^\1[^\S\n]*$",
        re.M | re.S,
    ),
    re.compile(r"^\$\$.*?^\$\$", re.M | re.S),
    # What a reader should have seen: tests/book/seen.py computes these numbers.
    re.compile(
        r"^<details>\n<summary>What you should have seen.*?^</details>$", re.M | re.S
    ),
    re.compile(r"<a href=\"[^\"]*\">"),
    re.compile(r"^(?: {4}|:\w+:|%|\|?[-| :]+\|$).*$", re.M),
    re.compile(
        r"\{[\w:]+\}`[^`]*`|(`+)(?:(?!\1).)+\1|\]\([^)]*\)"
    ),  # roles, code, links
    re.compile(r"\b(?:1[6-9]|20)\d\d\b(?!,\d| [a-z]+s\b)"),  # years
    re.compile(r"\b\d+ (?:and|to|of) \d+ minutes?|\b\d+(?: |-)minutes?|\b\d+ of them"),
    re.compile(
        r"^(?:\d+\. |\*\*\d+\.\*\* .*$|`{3,}\{dropdown\}.*$)", re.M
    ),  # lists, quiz
]
# Of a drawn picture only its description tells numbers: marks of an axis are none.
DRAWN = re.compile(r"<svg[^>]*?(?: aria-label=\"([^\"]*)\"[^>]*)?>.*?</svg>", re.S)
TAG = re.compile(r"<[^>]*>")
LECTURER = re.compile(r"^(`{3,})\{admonition\} For the lecturer.*?^\1", re.M | re.S)
ABOUT = re.compile(r"\b(?:[Aa]bout|nearly|almost|roughly|some) $")  # within a twentieth
SCALES = {"million": 1e6, "thousand": 1e3}


class Orphan(NamedTuple):
    """A number that nothing on its page shows."""

    page: str
    number: str
    line: str  # where it stands

    def __str__(self) -> str:
        return f"{self.page}: {self.number} in: {self.line}"


def prose(text: str) -> str:
    """Return Markdown without what is no prose; results of formulas are kept."""
    text = LECTURER.sub(lambda box: re.sub(r"^\d+ ", "", box[0], flags=re.M), text)
    for pattern in NOT_PROSE[:-3]:
        text = pattern.sub("", text)
    text = re.sub(r"(?<!\$)\$([^$]+)\$", lambda formula: _result(formula[1]), text)
    for pattern in NOT_PROSE[-3:]:
        text = pattern.sub("", text)
    return text


def _result(formula: str) -> str:
    """Return what a formula comes to, if it computes something."""
    left, equals, right = formula.rpartition("=")
    computes = equals and re.search(r"\\cdot|[+/*^]|\\times|\\frac", left)
    return right if computes and re.fullmatch(r"[\s\d.,\\{}-]+", right) else ""


def numbers(text: str, pattern=NUMBER) -> list[tuple[str, float, float]]:
    """Return the numbers of a text as written, their values, and half a last digit."""
    found = []
    for match in pattern.finditer(text):
        written = match[0].rstrip(",")
        digits = written.replace(",", "").replace("_", "")
        whole, _, decimals = digits.partition(".")
        zeros = len(whole) - len(whole.rstrip("0")) if not decimals else -len(decimals)
        following = re.match(r"\s*([a-z]+)", text[match.end() :])
        scale = SCALES.get(following[1], 1) if following else 1
        value, half = float(digits) * scale, 0.5 * scale * 10.0**zeros
        if ABOUT.search(text[: match.start()]):
            half = max(half, 0.05 * value)
        found.append((written, value, half))
    return found


def shown_numbers(notebook: dict) -> list[float]:
    """Return all numbers in the outputs of a notebook and in its alt texts."""
    texts = []
    for cell in notebook["cells"]:
        for output in cell.get("outputs", ()):
            data = {k: v for k, v in output.get("data", {}).items() if "svg" not in k}
            parts = [output.get("text", ""), *data.values()]
            texts += ["".join(part) for part in parts if not isinstance(part, dict)]
        texts.append(json.dumps(cell["metadata"].get("mystnb", {})))
    texts = [TAG.sub(" ", DRAWN.sub(r" \1 ", text)).replace("−", "-") for text in texts]
    found = {value for text in texts for _, value, _ in numbers(text, ANY)}
    return sorted(found)


def orphans(path: Path) -> list[Orphan]:
    """Return the numbers in the prose of a page that nothing on it shows."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    code = "\n".join(
        "".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "code"
    )
    text = "\n".join(
        "".join(c["source"]) for c in notebook["cells"] if c["cell_type"] != "code"
    )
    page = path.stem[:2]
    exercises = exercises_of(int(page)).values() if page.isdigit() else ()
    given = [value for _, value, _ in numbers(code, LITERAL)]
    given += [
        c["number"] for c in constants() if path.stem in c.get("pages", [path.stem])
    ]
    for e in exercises:
        words = [e.task, *e.hints, *(wrong.hint for wrong in e.wrong)]
        given += [value for _, value, _ in numbers(" ".join(words))]
    shown = shown_numbers(notebook)
    found = []
    for line in prose(text).split("\n"):
        for written, value, half in numbers(line):
            if value <= 12 and "." not in written:
                continue
            if not (_exactly(value, given) or _rounded(value, half, shown)):
                found.append(Orphan(path.name, written, line.strip()[:100]))
    return found


def _exactly(value: float, given: list[float]) -> bool:
    return any(
        abs(value - scale * g) <= 1e-9 * value for g in given for scale in (1, 100, 1e6)
    )


def _rounded(value: float, half: float, shown: list[float]) -> bool:
    """Return whether a number shown rounds to `value`; also as percent or thousands."""
    return any(
        abs(value - scale * s) <= half * 1.000001
        for s in shown
        for scale in (1, 100, 0.01, 1e3, 1e6)
    )


def constants() -> list[dict]:
    """Return the constants of the book, each with what it is and its source."""
    return yaml.safe_load((BOOK / "constants.yml").read_text(encoding="utf-8"))


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("pages", nargs="*", type=Path, help="default: all pages")
    paths = parser.parse_args(arguments).pages or sorted(BOOK.glob("*.ipynb"))
    found = [orphan for path in paths for orphan in orphans(path)]
    print(*found, f"{len(found)} numbers that no cell shows", sep="\n")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
