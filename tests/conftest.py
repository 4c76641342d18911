"""The built book and a browser without a network, for the tests that need them."""

import signal

import pytest
from support import FLAGS, HTML, Tabs, Visit, unavailable

from abstransfer.cli.doctor import check_browser


@pytest.fixture(autouse=True, scope="session")
def interruptible():
    """Python hears Ctrl-C, also where a shell started it in the background."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


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


@pytest.fixture(scope="session")
def all_tabs(chromium):
    """The tabs of the browser."""
    return Tabs(chromium)


@pytest.fixture
def tabs(all_tabs):
    """What lends a test its tabs: ``tabs.lend(folder, width=400)``."""
    yield all_tabs
    all_tabs.take_back()


@pytest.fixture
def visit(html, tabs):
    """Open a tab for the book: ``visit(width=400, color_scheme="dark")``."""

    def new(width=1440, color_scheme="light"):
        return tabs.lend(html, width, color_scheme=color_scheme)

    return new


@pytest.fixture(scope="module")
def tab(html, chromium):
    """A wide tab for the book, where nothing glides, for all tests of a module."""
    context = chromium.new_context(
        viewport={"width": 1440, "height": 900},
        color_scheme="light",
        reduced_motion="reduce",
    )
    visit = Visit(context)
    visit.folder = html
    yield visit
    context.close()
