"""What tests of many rooms use: folders, pages, a tab that reaches files only."""

import os
import re
from concurrent.futures import Executor
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest
import yaml

ROOT = Path(__file__).parents[1]
ELSEWHERE = re.compile("^(?!file:)")  # addresses that are no files
HTML = ROOT / "build" / "_build" / "html"
PATIENCE = 240  # seconds until what a page does must be there, on a busy machine too
# Scenes live, letters are there, nothing glides, and it was painted.
DRAWN = """async () => {
    const pictures = async (n) => {
        while (n--) await new Promise(requestAnimationFrame);
    };
    await document.fonts.ready;
    const waiting = ".abstransfer-scene:not(.ab-live)";
    while (document.querySelector(waiting)) await pictures(1);
    await pictures(2);
    while (document.getAnimations().some((each) => each.playState === "running"))
        await pictures(1);
    await pictures(2);
}"""
FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--js-flags=--single-threaded",  # three at once leave its helpers no processor
)


def toc_pages():
    """Return the names of the book's pages, in the order of its table of contents."""

    def files(entry):
        if isinstance(entry, dict):
            yield from (entry[key] for key in ("root", "file") if key in entry)
            entry = list(entry.values())
        for item in entry if isinstance(entry, list) else ():
            yield from files(item)

    return list(
        files(yaml.safe_load((ROOT / "book" / "_toc.yml").read_text(encoding="utf-8")))
    )


def spoken_by_files(folder):
    """Return settings of a kernel: a port found free may be another's a moment later.

    The folder's name must be short, as that of a socket is, which is in it.
    """
    if os.name == "nt":
        return {}
    return {"transport": "ipc", "connection_file": str(Path(folder, "kernel.json"))}


def unavailable(what):
    """Skip a test; but on a build server, where all must run, let it fail."""
    if os.environ.get("CI"):
        pytest.fail(what)
    pytest.skip(what)


@contextmanager
def served(folder, policy=""):
    """Serve a folder on this machine, under a policy; the value is its address."""

    class Handler(SimpleHTTPRequestHandler):
        def end_headers(self):
            if policy:
                self.send_header("Content-Security-Policy", policy)
            super().end_headers()

        def log_message(self, *_):
            pass

    handler = partial(Handler, directory=folder)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()


def drawn(page):
    """Wait until formulas, letters and scenes are there, and no colour glides."""
    if page.locator(".math").count():
        # One that is folded away is never seen: it is enough that it is made.
        page.wait_for_selector("mjx-container", state="attached")
        page.evaluate("MathJax.startup.promise")
    page.evaluate(DRAWN)
    return page


class NoExecutor(Executor):
    """Fails if it is given work."""

    def submit(self, *arguments, **options):
        raise AssertionError("nothing was to be run")


class Visit:
    """A browser tab that reaches files only, and notes what goes wrong."""

    def __init__(self, context):
        self.folder = None  # where its pages are
        self.problems = []  # requests that left the machine, errors of scripts
        context.route(ELSEWHERE, self._refuse)
        self.page = context.new_page()
        self.page.set_default_timeout(1000 * PATIENCE)
        # Asked at each picture, as is usual, a page draws all the time, and what it
        # waits for has less of the processor.
        self.page.wait_for_function = partial(self.page.wait_for_function, polling=40)
        self.page.on("pageerror", lambda error: self.problems.append(str(error)))
        self.page.on("console", self._note)

    def open(self, name, query=""):
        self.page.goto((self.folder / f"{name}.html").as_uri() + query)
        return self.page

    def is_idle(self, seconds=60):
        """Whether no worker is left; a tab hears of their end a little later."""
        for _ in range(20 * seconds):
            if not self.page.workers:
                return True
            self.page.wait_for_timeout(50)
        return False

    def _refuse(self, route):
        self.problems.append(f"asked the network for {route.request.url}")
        route.abort()

    def _note(self, message):
        if message.type == "error":
            self.problems.append(message.text)


class Tabs:
    """
    Tabs of one browser, lent to test after test.

    A page in a new tab takes three times the processor time of one in a tab that is
    there.  Tabs of other looks (width, theme, motion, touch) are other tabs.
    """

    def __init__(self, browser):
        self.browser = browser
        self.idle = {}  # by their looks
        self.lent = []

    def lend(self, folder, width=1440, **looks):
        """Return a tab that no other test has, for the pages of a folder."""
        looks["viewport"] = {"width": width, "height": 900}
        kept = self.idle.setdefault(repr(sorted(looks.items())), [])
        visit = kept.pop() if kept else Visit(self.browser.new_context(**looks))
        visit.folder, visit.problems = folder, []
        self.lent.append((visit, looks["viewport"], kept))
        return visit

    def take_back(self):
        """End what runs in the tabs that are lent, and forget what they stored."""
        while self.lent:
            visit, viewport, kept = self.lent.pop()
            if self._is_as_new(visit.page, viewport):
                kept.append(visit)
            else:
                visit.page.context.close()

    @staticmethod
    def _is_as_new(page, viewport):
        if page.is_closed() or page.viewport_size != viewport:
            return False
        if not page.url.startswith("file:"):  # what it stored is out of reach
            return False
        page.evaluate("sessionStorage.clear(), localStorage.clear()")
        page.goto("about:blank")
        return not page.workers  # of their end a tab hears later
