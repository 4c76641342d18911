"""The built book in a browser, opened from files, with the network cut."""

from importlib.resources import files

import pytest
from support import toc_pages

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


def drawn(page):
    """Wait until formulas, letters and scenes are there."""
    if page.locator(".math").count():
        page.wait_for_selector("mjx-container", timeout=10_000)
        page.evaluate("MathJax.startup.promise")
    page.evaluate("document.fonts.ready")
    page.wait_for_timeout(500)
    return page


def test_a_page_opens_without_a_network_and_fits_a_phone(visit, name):
    tab = visit()
    page = drawn(tab.open(name))
    n_formulas = page.locator(".math").count()

    assert page.locator("mjx-container").count() == n_formulas
    assert page.locator("mjx-merror, [data-mjx-error]").count() == 0

    page.set_viewport_size({"width": 400, "height": 900})
    page.wait_for_timeout(200)
    assert page.evaluate("document.documentElement.scrollWidth") <= 400
    assert tab.problems == []


def test_letters_of_formulas_come_from_the_books_own_font(visit):
    page = visit().open("notation")
    page.wait_for_selector("mjx-container")
    page.evaluate("document.fonts.ready")
    loaded = page.evaluate(
        "[...document.fonts].filter(f => f.status == 'loaded').map(f => f.family)"
    )

    assert any(family.startswith("MJXTEX") for family in loaded)


def faults(page, options):
    """Return what axe finds on a page, but for what is known of the theme."""
    result = page.evaluate(f"axe.run({{resultTypes: ['violations'], {options}}})")
    found = [
        (violation["id"], node["html"], node["failureSummary"])
        for violation in result["violations"]
        for node in violation["nodes"]
    ]
    return [f for f in found if not any(r == f[0] and s in f[1] for r, s in KNOWN)]


def test_a_page_is_accessible_and_its_pictures_are_legible_in_the_dark(visit, name):
    page = drawn(visit().open(name))
    page.evaluate(AXE)
    assert faults(page, "") == []

    page.emulate_media(color_scheme="dark")
    page.wait_for_function("document.documentElement.dataset.theme == 'dark'")
    page.wait_for_timeout(400)  # colours glide
    assert faults(page, "runOnly: ['color-contrast']") == []
    pictures = page.locator("article img").evaluate_all(
        "images => images.map(i => getComputedStyle(i))"
        ".map(style => style.backgroundColor + ' ' + style.filter)"
    )
    assert set(pictures) <= {"rgb(255, 255, 255) none"}, "they stand on a light card"


def test_the_search_finds_a_page(visit):
    tab = visit()
    page = tab.open("search", query="?q=discount")
    page.wait_for_selector("#search-results li")

    assert "Notation" in page.locator("#search-results").inner_text()
    assert tab.problems == []
