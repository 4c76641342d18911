"""The book as a PDF: all pages in order, links inside, nothing cut."""

import re
import subprocess
import sys

import one_page
import pdf
import pytest
import yaml
from bs4 import BeautifulSoup
from support import ROOT, toc_pages

from abstransfer.cli.doctor import Check

TOC = yaml.safe_load((ROOT / "book" / "_toc.yml").read_text(encoding="utf-8"))
TWO = [("", ["00_race", "notation"])]


def test_every_page_of_the_table_of_contents_is_printed_in_its_order():
    printed = [name for _, names in one_page.parts(TOC) for name in names]

    assert printed == toc_pages()


@pytest.mark.parametrize(
    ("href", "target"),
    [
        ("#quiz", "#00_race--quiz"),
        ("notation.html", "#notation"),
        ("notation.html#words", "#notation--words"),
        ("notation.html#race.t=0", "#notation"),
        ("https://example.org/a#b", "https://example.org/a#b"),
        ("_sources/00_race.ipynb", None),
        ("genindex.html", None),
    ],
)
def test_a_link_leads_to_its_place_in_the_one_page(href, target):
    assert one_page.link(href, "00_race", {"00_race", "notation"}) == target


def test_two_pages_as_one_keep_their_links_their_frames_and_their_solutions(html):
    soup = BeautifulSoup(one_page.one_page(html, TWO), "html.parser")
    # Exercises all have one id for their content: the extension's, not a target.
    ids = [tag["id"] for tag in soup.find_all(id=re.compile(r"(?<!-content)$"))]
    links = [tag["href"] for tag in soup.select("a[href]")]
    inside = [link[1:] for link in links if link.startswith("#")]

    assert len(set(ids)) == len(ids)
    assert len(inside) > 5
    assert set(inside) <= set(ids)
    assert all(link.startswith(("#", "http")) for link in links)
    assert len(soup.select(".ab-frames svg")) == 3
    assert not soup.select("details:not([open]), main script, details.hide")
    assert sum("mathjax" in tag.get("src", "") for tag in soup.select("script")) == 1


@pytest.mark.usefixtures("chromium")
def test_two_pages_are_printed_with_an_outline_and_page_numbers(html, tmp_path):
    out = tmp_path / "two.pdf"
    # A process of its own: the browser of the tests is open in this one.
    command = [sys.executable, pdf.__file__, "--html", html, "--out", out]
    told = subprocess.check_output([*command, "00_race", "notation"], encoding="utf-8")

    content = out.read_bytes()
    assert "wider than the paper" not in told
    assert f"{pdf.count_pages(out)} pages" in told
    assert str(out) in told
    assert pdf.count_pages(out) > 5
    titles = re.findall(rb"/Title \(((?:[^\\()]|\\.)*)\)", content)
    assert {b"The race", b"Notation", b"Quiz"} <= set(titles)
    assert len(re.findall(rb"/Dest\b", content)) > 10
    numbers = pdf.page_numbers(content)
    assert numbers["00_race"] == 3, "after the title and the contents"
    assert 5 < numbers["notation"] <= pdf.count_pages(out)
    assert not (html / "two.pdf").exists()


def test_what_is_too_wide_for_the_paper_is_reported(chromium, tmp_path):
    page = chromium.new_page(viewport={"width": pdf.WIDTH, "height": 500})
    page.set_content(
        "<main><section class='chapter' id='a'><p style='width:3000px'>long</p>"
        "<p>short</p></section></main>"
    )

    assert page.evaluate(pdf.TOO_WIDE, pdf.WIDTH) == ["a: long"]
    page.close()


def test_a_title_that_the_browser_doubles_is_mended_in_its_place():
    doubled = rb"/Title (One \(1\)One \(1\)) /Title (Two) /Title (papa)"
    mended = pdf.mended(doubled)

    assert mended.split() == rb"/Title (One \(1\)) /Title (Two) /Title (papa)".split()
    assert len(mended) == len(doubled), "the table of places in the file stays right"


def test_the_first_page_links_to_the_pdf_once_it_is_there(tmp_path):
    assert "`abstransfer.pdf`" in (ROOT / "book" / "intro.md").read_text("utf-8")
    page = tmp_path / "intro.html"
    words = '<code class="docutils">abstransfer.pdf</code>'
    page.write_text(f"<p>It is {words}.</p>", encoding="utf-8")
    for _ in range(2):
        pdf.link_first_page(tmp_path)

        linked = f'<p>It is <a href="abstransfer.pdf">{words}</a>.</p>'
        assert page.read_text(encoding="utf-8") == linked


def test_without_a_browser_it_says_how_to_get_one(monkeypatch, capsys):
    missing = Check("browser", False, "nothing", "install Chromium")
    monkeypatch.setattr(pdf, "check_browser", lambda: missing)

    assert pdf.main([]) == 2
    assert "apt-get install chromium" in capsys.readouterr().err


def test_without_a_built_book_it_says_so(monkeypatch, tmp_path, capsys):
    found = Check("browser", True, "chromium", "")
    monkeypatch.setattr(pdf, "check_browser", lambda: found)

    assert pdf.main(["--html", str(tmp_path)]) == 2
    assert "make pdf" in capsys.readouterr().err
