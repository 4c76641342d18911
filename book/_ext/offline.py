"""
A Sphinx extension that keeps the built book free of the network.

It takes MathJax from a Python package instead of a content network, and
drops what this book does not use but finds in every page: the scripts of Thebe
(live code on a remote server).
"""

from importlib.util import find_spec
from pathlib import Path

from sphinx.util.fileutil import copy_asset

PACKAGE = "sphinx-mathjax-offline"  # holds MathJax 3.2.2
# What a page can load; the bundles in the package are 20 MB of doubles, and the page
# would stand still while it reads one: so it loads these, after the first.
LOADED = ("core", "input/tex", "output/chtml", "a11y/assistive-mml", "ui/menu")
SCRIPTS = ("startup.js", *(f"{name}.js" for name in LOADED))
PARTS = (*SCRIPTS, "a11y", "input/tex/extensions", "output/chtml")


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


def setup(app):
    app.connect("config-inited", set_path)
    app.connect("html-page-context", drop_thebe, priority=900)
    app.connect("build-finished", copy_mathjax)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def set_path(app, config):
    config.mathjax_path = "mathjax/startup.js"
    config.mathjax3_config = {
        **(config.mathjax3_config or {}),
        "loader": {"load": list(LOADED)},
    }
