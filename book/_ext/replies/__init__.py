"""
A Sphinx extension that lets a page reply: to bets, to its quiz, to links to moments.

What is written is Markdown that reads as it stands (see CONTRIBUTING.md); the script
binds to what it finds.
"""

import re
from pathlib import Path

from abstransfer.scenes import bundle

HERE = Path(__file__).parent
# What a page holds that can reply.
HOLDS = re.compile(
    r'id="bet-|<section id="quiz">|<a href="#\w+\.\w+=|class="reset-book"'
)


def load(app, pagename, templatename, context, doctree):
    """Let a page load the script and the style if it holds what can reply."""
    if HOLDS.search(context.get("body", "")):
        # Before the scenes, which ask for the bets of the page.
        app.add_js_file("replies.js", loading_method="defer", priority=90)
        app.add_css_file("replies.css")


def write(app, exception):
    """Write the script, bundled, and the style."""
    if exception is None and app.builder.format == "html":
        files = {"replies.js": bundle.bundle_one(HERE / "replies.js")}
        files["replies.css"] = (HERE / "replies.css").read_text("utf-8")
        for name, text in files.items():
            path = Path(app.outdir, "_static", name)
            path.write_text(text, encoding="utf-8", newline="\n")


def setup(app):
    app.connect("html-page-context", load)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
