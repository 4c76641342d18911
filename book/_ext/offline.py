"""
A Sphinx extension that keeps the built book free of the network.

It takes MathJax from a Python package instead of a content network, and
drops what this book does not use but finds in every page: the scripts of Thebe
(live code on a remote server), and 1.5 MB of icons as a script that the page waits
for, though its style sheet has the same icons as a font.
"""

import re
from importlib.util import find_spec
from pathlib import Path

from sphinx.util.fileutil import copy_asset

PACKAGE = "sphinx-mathjax-offline"  # holds MathJax 3.2.2
# What a page can load; the other bundles in the package are 20 MB of doubles.
PARTS = ("tex-chtml.js", "a11y", "input/tex/extensions", "output/chtml")
ICONS = re.compile(r'<script src="[^"]*/fontawesome\.js[^"]*"></script>')


def copy_mathjax(app, exception):
    """Copy the needed files of MathJax into the built book."""
    if exception is None and app.builder.format == "html":
        (origin,) = find_spec(PACKAGE).submodule_search_locations
        for part in PARTS:
            source = Path(origin, "static", "mathjax", part)
            goal = Path(app.outdir, "_static", "mathjax", part)
            copy_asset(str(source), str(goal if source.is_dir() else goal.parent))


def drop_thebe(app, pagename, templatename, context, doctree):
    """Take Thebe's script and settings out of a page."""
    context["script_files"] = [
        script
        for script in context["script_files"]
        if "thebe" not in str(getattr(script, "filename", script))
        and "THEBE" not in getattr(script, "attributes", {}).get("body", "")
    ]


def drop_icons(app, exception):
    """Take the script of icons out of the pages: it is a template's, not a file's."""
    if exception is not None or app.builder.format != "html":
        return
    for page in Path(app.outdir).rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        if (fewer := ICONS.sub("", text)) != text:
            page.write_text(fewer, encoding="utf-8", newline="\n")
    for file in Path(app.outdir, "_static", "scripts").glob("fontawesome.js*"):
        file.unlink()


def setup(app):
    app.connect("config-inited", set_path)
    app.connect("html-page-context", drop_thebe, priority=900)
    app.connect("build-finished", copy_mathjax)
    app.connect("build-finished", drop_icons)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def set_path(app, config):
    config.mathjax_path = "mathjax/tex-chtml.js"
