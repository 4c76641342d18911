"""The built book and a browser without a network, for the tests that need them."""

import pytest
from support import FLAGS, HTML, Visit, unavailable

from abstransfer.cli.doctor import check_browser


@pytest.fixture(scope="session")
def html():
    """The folder of the built book."""
    if not (HTML / "index.html").is_file():
        unavailable("the book is not built; run: make book")
    return HTML


@pytest.fixture(scope="session")
def chromium():
    """A browser."""
    found = check_browser()
    if not found.ok:
        unavailable(found.remedy)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=found.found, args=list(FLAGS)
        )
        yield browser
        browser.close()


@pytest.fixture
def visit(html, chromium):
    """Open a page of the book: ``visit(width=400, color_scheme="dark")``."""
    contexts = []

    def new(width=1440, color_scheme="light"):
        contexts.append(
            chromium.new_context(
                viewport={"width": width, "height": 900}, color_scheme=color_scheme
            )
        )
        return Visit(contexts[-1], html)

    yield new
    for context in contexts:
        context.close()
