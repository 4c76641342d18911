"""The bibliography: every entry is cited, and every citation has an entry."""

import re

from support import ROOT

BOOK = ROOT / "book"
CITED = re.compile(r"\{cite(?::\w+)?\}`([^`]+)`")


def test_every_entry_is_cited_and_every_citation_has_an_entry():
    bibliography = (BOOK / "references.bib").read_text(encoding="utf-8")
    entries = re.findall(r"^@\w+\{(\w+),$", bibliography, re.MULTILINE)
    pages = [*BOOK.glob("*.md"), *BOOK.glob("*.ipynb")]
    keys = [
        key.strip()
        for page in pages
        for group in CITED.findall(page.read_text(encoding="utf-8"))
        for key in group.split(",")
    ]

    assert len(entries) == len(set(entries))
    assert set(entries) == set(keys)
