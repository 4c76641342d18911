"""The built book where scripts must be files, and where nothing may be stored."""

import pytest
from support import PATIENCE, drawn, served

POLICY = "script-src 'self'; worker-src 'self'"
NO_STORAGE = """
for (const name of ["localStorage", "sessionStorage"])
    Object.defineProperty(Window.prototype, name, {
        configurable: true,
        get() { throw new DOMException("no storage here", "SecurityError"); },
    });
delete window.localStorage;
"""


@pytest.fixture
def strict(html, chromium):
    """Open a page of the book under the policy: a tab, and what went wrong in it."""
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    page = context.new_page()
    page.set_default_timeout(1000 * PATIENCE)
    page.problems = []
    page.on("pageerror", lambda error: page.problems.append(str(error)))
    page.on("console", lambda m: m.type == "error" and page.problems.append(m.text))
    with served(html, POLICY) as host:
        page.open = lambda name: drawn(page.goto(f"{host}/{name}.html") and page)
        yield page
    context.close()


def test_under_a_strict_policy_formulas_are_set_and_solutions_folded(strict):
    page = strict.open("02_solving")
    solution = page.locator(".admonition.dropdown").first

    assert page.locator("mjx-container").count() == page.locator(".math").count() > 5
    assert "toggle-hidden" in solution.get_attribute("class")
    assert page.evaluate("document.documentElement.dataset.theme") == "light"
    assert strict.problems == []


def test_without_storage_the_theme_can_still_be_chosen(strict):
    strict.add_init_script(NO_STORAGE)
    page = strict.open("how_to_cite")
    before = page.evaluate("document.documentElement.dataset.mode")
    page.locator("button.theme-switch-button").first.click()

    assert page.evaluate("document.documentElement.dataset.mode") != before
    assert strict.problems == []
