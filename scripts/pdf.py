"""
Print the built book to one PDF, with the browser that the tests use.

    python scripts/pdf.py              build/abstransfer.pdf, and a copy beside the book
    python scripts/pdf.py --check      only say whether there is a browser
    python scripts/pdf.py --out FILE PAGE ...

All pages become one, with their links: a scene is printed as its three frames, a
solution unfolded.  The first page of the book then links to the copy.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
import tempfile
from pathlib import Path

import yaml
from one_page import ROOT, one_page, parts

from abstransfer.cli.doctor import check_browser

HTML = ROOT / "build" / "_build" / "html"
OUT = ROOT / "build" / "abstransfer.pdf"
TOC = ROOT / "book" / "_toc.yml"
LINK = "abstransfer.pdf"  # the words on the first page that become a link
FLAGS = ("--no-sandbox", "--disable-gpu", "--disable-background-networking")
WIDTH = 658  # what A4 leaves for the text, in units of CSS: pdf.css sets the margins


def print_page(text: str, out: Path, browser: str) -> list[str]:
    """Print a page to a PDF; return what is too wide for the paper."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        page_file = Path(folder) / "book.html"
        page_file.write_text(text, encoding="utf-8")
        chromium = playwright.chromium.launch(executable_path=browser, args=list(FLAGS))
        tab = chromium.new_page(viewport={"width": WIDTH, "height": 1000})
        tab.set_default_timeout(300_000)
        tab.emulate_media(media="print", color_scheme="light")
        tab.goto(page_file.as_uri())
        say("drawing the formulas")
        tab.wait_for_function(DRAWN)
        wide = tab.evaluate(TOO_WIDE, WIDTH)
        # Twice: only the first print knows on which page a chapter begins.
        for n in (1, 2):
            say(f"printing, {n} of 2")
            tab.pdf(path=out, prefer_css_page_size=True, outline=True, **LOOKS)
            tab.evaluate(NUMBER, page_numbers(out.read_bytes()))
        chromium.close()
    out.write_bytes(mended(out.read_bytes()))
    return wide


# Not a promise of MathJax: where its script fails, that is never kept.
DRAWN = """() => document.fonts.status === "loaded" &&
  document.querySelectorAll(".math").length ===
  document.querySelectorAll("mjx-container").length"""
NUMBER = """numbers => {
  for (const link of document.querySelectorAll("header nav a"))
    link.nextSibling.textContent = numbers[link.hash.slice(1)];
}"""
LOOKS = {"print_background": True, "tagged": True}
TOO_WIDE = """width => [...document.querySelectorAll("main *")]
  .filter(e => e.getBoundingClientRect().right > width + 2)
  .filter(e => !e.closest("svg, mjx-container > *"))
  .filter((e, _, all) => !all.includes(e.parentElement))
  .map(e => `${e.closest(".chapter")?.id}: ${e.textContent.slice(0, 60)}`)"""


def link_first_page(html: Path) -> None:
    """Make the words that name the PDF on the book's first page a link to it."""
    path = html / "intro.html"
    text = path.read_text(encoding="utf-8")
    words = rf'(?<!<a href="{LINK}">)<code[^>]*>{LINK}</code>'
    linked = re.sub(words, rf'<a href="{LINK}">\g<0></a>', text)
    path.write_text(linked, encoding="utf-8", newline="\n")


def mended(pdf: bytes) -> bytes:
    r"""
    Return a PDF without doubled titles in its outline.

    Chromium writes the title of a heading that it moved to the next page twice.  The
    places of all objects in the file stay the same.

    >>> mended(b"/Title (One \\(1\\)One \\(1\\))")
    b'/Title (One \\(1\\))         '
    """
    return re.sub(
        rb"/Title \(((?:[^\\()]|\\.){4,})\1\)",
        lambda found: b"/Title (%s)%s" % (found[1], b" " * len(found[1])),
        pdf,
    )


def page_numbers(pdf: bytes) -> dict[str, int]:
    """Return the page on which each target of a link stands, in Chromium's PDF."""
    objects = re.findall(rb"(\d+) 0 obj\s*<<\s*/Type /Page\b", pdf)
    numbers = {place: number for number, place in enumerate(objects, 1)}
    places = re.findall(rb"/([\w-]+) \[(\d+) 0 R /XYZ", pdf)
    return {name.decode(): numbers[place] for name, place in places}


def count_pages(pdf: Path) -> int:
    """Return the number of pages of a PDF that Chromium wrote."""
    return len(re.findall(rb"/Type /Page\b", pdf.read_bytes()))


def say(words: str) -> None:
    print(f"pdf: {words} ...", flush=True)


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.strip().split("\n")[0])
    parser.add_argument("pages", nargs="*", help="default: all, in their order")
    parser.add_argument("--out", type=Path, default=OUT)
    parser.add_argument("--html", type=Path, default=HTML, help="the built book")
    parser.add_argument("--check", action="store_true", help="look for a browser only")
    options = parser.parse_args(arguments)
    browser = check_browser()
    if not browser.ok:
        print(
            "pdf: no browser found; a Chromium prints the book.\n"
            "Install Chromium or Chrome (Debian: apt-get install chromium), then say "
            "make pdf again.",
            file=sys.stderr,
        )
        return 2
    if options.check:
        return 0
    if not (options.html / "index.html").is_file():
        print("pdf: the book is not built; say: make pdf", file=sys.stderr)
        return 2
    pages = parts(yaml.safe_load(TOC.read_text(encoding="utf-8")))
    if options.pages:
        pages = [("", options.pages)]
    say(f"putting {sum(len(names) for _, names in pages)} pages together")
    text = one_page(options.html, pages)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    for wide in print_page(text, options.out, browser.found):
        print(f"pdf: wider than the paper: {wide}")
    if options.out == OUT:
        shutil.copyfile(OUT, options.html / LINK)
        link_first_page(options.html)
    size = f"{options.out.stat().st_size / 1e6:.1f} MB"
    print(f"{count_pages(options.out)} pages, {size}:\n  {options.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
