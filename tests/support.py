"""What tests of many rooms use: folders, pages, a tab that reaches files only."""

import os
from concurrent.futures import Executor
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
HTML = ROOT / "build" / "_build" / "html"
FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


def toc_pages():
    """Return the names of the book's pages, in the order of its table of contents."""

    def files(entry):
        if isinstance(entry, dict):
            yield from (entry[key] for key in ("root", "file") if key in entry)
            entry = list(entry.values())
        for item in entry if isinstance(entry, list) else ():
            yield from files(item)

    return list(files(yaml.safe_load((ROOT / "book" / "_toc.yml").read_text())))


def unavailable(what):
    """Skip a test; but on a build server, where all must run, let it fail."""
    if os.environ.get("CI"):
        pytest.fail(what)
    pytest.skip(what)


class NoExecutor(Executor):
    """Fails if it is given work."""

    def submit(self, *arguments, **options):
        raise AssertionError("nothing was to be run")


class Visit:
    """A browser tab that reaches files only, and notes what goes wrong."""

    def __init__(self, context, folder):
        self.folder = folder
        self.problems = []  # requests that left the machine, errors of scripts
        context.route(lambda url: not url.startswith("file:"), self._refuse)
        self.page = context.new_page()
        self.page.on("pageerror", lambda error: self.problems.append(str(error)))
        self.page.on("console", self._note)

    def open(self, name, query=""):
        self.page.goto((self.folder / f"{name}.html").as_uri() + query)
        return self.page

    def _refuse(self, route):
        self.problems.append(f"asked the network for {route.request.url}")
        route.abort()

    def _note(self, message):
        if message.type == "error":
            self.problems.append(message.text)
