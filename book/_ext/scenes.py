"""
A Sphinx extension that brings the scenes to the built book.

A page loads the scripts of the scenes that it holds, and their style sheet.  In a page
without code cells the directive ``{scene} sights`` shows one.
"""

import gzip
import re
from pathlib import Path

from docutils import nodes
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

from abstransfer.scenes import KINDS, files

LIMIT = 80_000  # bytes of one script before compression
FOUND = re.compile(r'class="abstransfer-scene" data-scene="(\w+)"')
logger = logging.getLogger(__name__)


class SceneHere(SphinxDirective):
    """A scene in its first state, as a cell of a notebook shows it."""

    required_arguments = 1

    def run(self):
        html = KINDS[self.arguments[0]]().html()
        return [nodes.raw("", html, format="html")]


def write_files(app, exception):
    """Write the scripts and the style, and print what they weigh."""
    if exception is not None or app.builder.format != "html":
        return
    folder = Path(app.outdir, "_static", "scenes")
    folder.mkdir(exist_ok=True)
    texts = {
        f"{name}.js": files.page_script(name, kind.spec())
        for name, kind in KINDS.items()
    }
    texts["scenes.css"] = files.style()
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
        packed = len(gzip.compress(text.encode(), mtime=0))
        logger.info(f"{name}: {len(text.encode()):,} bytes, {packed:,} compressed")
        if len(text.encode()) > LIMIT:
            logger.warning(f"{name} has more than {LIMIT:,} bytes")


def load_files(app, pagename, templatename, context, doctree):
    """Let a page load the scripts of its scenes, and the style."""
    names = sorted(set(FOUND.findall(context.get("body", ""))))
    for name in names:
        # Before MathJax, for which a reader of formulas can wait.
        app.add_js_file(f"scenes/{name}.js", loading_method="defer", priority=100)
    if names:
        app.add_css_file("scenes/scenes.css")


def setup(app):
    app.add_directive("scene", SceneHere)
    app.connect("html-page-context", load_files)
    app.connect("build-finished", write_files)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
