"""
A Sphinx extension that brings the scenes to the built book.

All scenes share one script and one style sheet, made of the files in
``abstransfer/scenes``; only pages that hold a scene load them.
"""

import gzip
from importlib.util import find_spec
from pathlib import Path

from sphinx.util import logging

from abstransfer.scenes import files as _scene_files

# The theme's scroll spy would read all links of a page, and fail at a link to a moment
# of a scene: it shall read those of the page's contents, as it means to.
SPY = """addEventListener("DOMContentLoaded", () => {
  document.body.dataset.bsTarget = "#pst-page-toc-nav";
});"""
LIMIT = 150_000  # bytes of script before compression
logger = logging.getLogger(__name__)


def write_files(app, exception):
    """Write the script and the style, and print what a page with scenes weighs."""
    if exception is not None or app.builder.format != "html":
        return
    folder = Path(app.outdir, "_static")
    files = {
        "scenes.js": _scene_files.page_script(),
        "scenes.css": _scene_files.style(),
    }
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
        packed = len(gzip.compress(text.encode(), mtime=0))
        logger.info(f"{name}: {len(text.encode()):,} bytes, {packed:,} compressed")
    if find_spec("minify") and len(files["scenes.js"].encode()) > LIMIT:
        logger.warning(f"scenes.js has more than {LIMIT:,} bytes")


def load_files(app, pagename, templatename, context, doctree):
    """Let a page that holds a scene load the script and the style."""
    if 'class="abstransfer-scene"' in context.get("body", ""):
        # Before MathJax, for which a reader of formulas can wait.
        app.add_js_file("scenes.js", loading_method="defer", priority=100)
        app.add_css_file("scenes.css")


def setup(app):
    app.add_js_file(None, body=SPY)
    app.connect("html-page-context", load_files)
    app.connect("build-finished", write_files)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
