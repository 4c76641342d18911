"""The built book in a browser, opened from files, with the network cut."""

from importlib.resources import files

import pytest
from conftest import toc_pages

PAGES = toc_pages()
AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
# What the theme itself does wrong: (rule, part of the element).
KNOWN = (
    ("region", "sidebar-primary-item"),
    ("aria-allowed-role", "doc-biblioentry"),
    ("aria-deprecated-role", "doc-biblioentry"),
    ("aria-required-children", "citation-list"),
)


@pytest.fixture(params=PAGES)
def name(request):
    return request.param


def test_a_page_needs_no_network_and_raises_no_error(visit, name):
    tab = visit()
    tab.open(name).wait_for_load_state("networkidle")

    assert tab.problems == []


def test_formulas_are_drawn(visit, name):
    page = visit().open(name)
    n_formulas = page.locator(".math").count()
    if n_formulas:
        page.wait_for_selector("mjx-container", timeout=10_000)
        page.evaluate("MathJax.startup.promise")

    assert page.locator("mjx-container").count() == n_formulas
    assert page.locator("mjx-merror, [data-mjx-error]").count() == 0


def test_letters_of_formulas_come_from_the_books_own_font(visit):
    page = visit().open("notation")
    page.wait_for_selector("mjx-container")
    page.evaluate("document.fonts.ready")
    loaded = page.evaluate(
        "[...document.fonts].filter(f => f.status == 'loaded').map(f => f.family)"
    )

    assert any(family.startswith("MJXTEX") for family in loaded)


def test_no_page_is_wider_than_a_phone(visit, name):
    page = visit(width=400).open(name)
    page.wait_for_load_state("networkidle")

    assert page.evaluate("document.documentElement.scrollWidth") <= 400


@pytest.mark.parametrize("color_scheme", ["light", "dark"])
def test_a_page_is_accessible(visit, name, color_scheme):
    page = visit(color_scheme=color_scheme).open(name)
    page.wait_for_load_state("networkidle")
    page.evaluate(AXE)
    result = page.evaluate("axe.run({resultTypes: ['violations']})")
    found = [
        (violation["id"], node["html"], node["failureSummary"])
        for violation in result["violations"]
        for node in violation["nodes"]
    ]

    assert [
        f for f in found if not any(r == f[0] and s in f[1] for r, s in KNOWN)
    ] == []


def test_the_search_finds_a_page(visit):
    tab = visit()
    page = tab.open("search", query="?q=discount")
    page.wait_for_selector("#search-results li")

    assert "Notation" in page.locator("#search-results").inner_text()
    assert tab.problems == []


def test_pictures_are_legible_in_the_dark(visit, name):
    """A figure stands on a light card, whatever the colour of the page."""
    page = visit(color_scheme="dark").open(name)
    looks = page.locator("article img").evaluate_all(
        "images => images.map(i => getComputedStyle(i))"
        ".map(style => style.backgroundColor + ' ' + style.filter)"
    )

    assert set(looks) <= {"rgb(255, 255, 255) none"}
