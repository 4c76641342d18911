"""
A small book of scenes for tests, built once, as the book is.

Each scene has a page of its own, whatever the book's own pages hold: name what its
cells say in PAGES.
"""

import shutil
import subprocess
import sys
import time
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from scene_tab import UNPAINTED
from support import PATIENCE, ROOT

from abstransfer import scenes

METADATA = {"language_info": {"name": "python", "pygments_lexer": "ipython3"}}
PAGES = {
    "microscope": [
        "scenes.Microscope()",
        "scenes.Microscope(start='cost', t=20)",
        "scenes.Microscope(update=lambda q, s, a, r, s_next, alpha, gamma: r)",
    ],
    "two": ["scenes.Hill()", "scenes.Microscope()", "scenes.Hill(t=9)"],
}


def page_of(cells) -> nbformat.NotebookNode:
    """Return a notebook whose outputs are what these cells would show."""
    parts = [new_markdown_cell(f"# A page for tests\n\n<style>{UNPAINTED}</style>")]
    for number, code in enumerate(cells, 1):
        data = eval(code, {"scenes": scenes})._repr_mimebundle_()
        output = new_output("execute_result", data=data, execution_count=number)
        parts.append(new_markdown_cell(f"## Scene {number}"))
        parts.append(new_code_cell(code, outputs=[output], execution_count=number))
    return new_notebook(cells=parts, metadata=METADATA)


def build(folder: Path, html: Path) -> None:
    """Build the pages, with the book's own settings."""
    book = folder / "book"
    shutil.copytree(ROOT / "book" / "_assets", book / "_assets")
    shutil.copy(ROOT / "book" / "references.bib", book)
    for name, cells in PAGES.items():
        nbformat.write(page_of(cells), book / f"{name}.ipynb")
    first, *rest = PAGES
    chapters = "".join(f"\n- file: {name}" for name in rest)
    toc = f"format: jb-book\nroot: {first}" + (f"\nchapters:{chapters}" if rest else "")
    (book / "_toc.yml").write_text(toc + "\n", encoding="utf-8")
    paths = ["--config", ROOT / "_config.yml", "--path-output", html.parents[1]]
    tool = Path(sys.executable).with_name("jupyter-book")
    run = subprocess.run(
        [tool, "build", book, *paths, "-W", "-n", "--keep-going"],
        capture_output=True,
        encoding="utf-8",
        timeout=PATIENCE,
    )
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-3000:]


@pytest.fixture(scope="session")
def scene_pages(tmp_path_factory):
    """The folder of the built pages; workers share it."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if base.name.startswith("popen") else base) / "scene-pages"
    html, done = folder / "build" / "_build" / "html", folder / "done"
    try:
        folder.mkdir()
    except FileExistsError:  # another worker builds it
        for _ in range(10 * PATIENCE):
            if done.exists():
                return html
            time.sleep(0.1)
        pytest.fail("the pages were not built")
    try:
        build(folder, html)
    finally:
        done.touch()
    return html


@pytest.fixture
def at_scenes(scene_pages, tabs):
    """Open a page: ``at_scenes("race", query="#race.t=4", color_scheme="dark")``."""

    def open_page(name="microscope", query="", **looks):
        tab = tabs.lend(scene_pages, **looks)
        tab.open(name, query)
        tab.page.wait_for_selector(".ab-live")
        return tab

    return open_page
