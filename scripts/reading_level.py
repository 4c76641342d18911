"""
Say how hard each page is to read: words, words per sentence, and school grade.

    python scripts/reading_level.py                   all pages
    python scripts/reading_level.py book/07_*.ipynb   some

The grade is the automated readability index, about the years of school in English
that a text asks for.  It is reported, not judged: names such as pi_AbsProb count as
long words.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path

from prose_numbers import BOOK, prose


def words_and_sentences(text: str) -> tuple[list[str], int]:
    """Return the words of a text, and how many sentences it has."""
    text = re.sub(r"^[`:|#].*$", "", text, flags=re.MULTILINE)
    words = re.findall(r"[A-Za-z][A-Za-z'-]*", text)
    return words, max(1, len(re.findall(r"[.!?:](?:\s|$)", text)))


def grade(text: str) -> float:
    """Return the automated readability index of a text."""
    words, sentences = words_and_sentences(text)
    letters = sum(map(len, words))
    return 4.71 * letters / len(words) + 0.5 * len(words) / sentences - 21.43


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("pages", nargs="*", type=Path, help="default: all pages")
    print(f"{'page':20} {'words':>6} {'per sentence':>13} {'grade':>6}")
    for path in parser.parse_args(arguments).pages or sorted(BOOK.glob("*.ipynb")):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        markdown = ["".join(c["source"]) for c in cells if c["cell_type"] == "markdown"]
        text = prose("\n".join(markdown))
        words, sentences = words_and_sentences(text)
        mean = len(words) / sentences
        print(f"{path.stem:20} {len(words):6} {mean:13.1f} {grade(text):6.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
