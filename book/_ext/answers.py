"""
A Sphinx extension by which the exercises of the built book reply.

Boxes for answers, hints and what a good answer holds are made from the data in
``abstransfer.exercises``.  Each hint lies inside the one before it, so that nobody
reads the third before the first, with a script or without.
"""

import json
import re
from html import escape
from pathlib import Path

from docutils import nodes
from sphinx_exercise.nodes import is_exercise_node

from abstransfer.exercises import Open, all_exercises, all_open_exercises
from abstransfer.exercises._model import first_of
from abstransfer.scenes import files

KNOWN = {e.key: e for e in (*all_exercises(), *all_open_exercises())}
FOLDED = '<details class="ab-hint"><summary>'
MARKED = re.compile(r"`([^`]+)`|\*([^*`\s][^*`]*)\*")


def as_html(words: str) -> str:
    """
    Return words of an exercise, in which code and stress are marked, as HTML.

    >>> as_html("Is `a < b` *always*?")
    'Is <code>a &lt; b</code> <em>always</em>?'
    """

    def mark(found):
        code, stressed = found.groups()
        return f"<code>{code}</code>" if code else f"<em>{stressed}</em>"

    return MARKED.sub(mark, escape(words, quote=False))


def hints(words: tuple[str, ...]) -> str:
    """
    Return hints as foldings, each of which lies inside the one before it.

    >>> print(hints(("Look.", "Think.")))
    <details class="ab-hint"><summary>Hint 1 of 2</summary>
    <p>Look.</p>
    <details class="ab-hint"><summary>Hint 2 of 2</summary>
    <p>Think.</p>
    </details>
    </details>
    """
    inner = ""
    for number in range(len(words), 0, -1):
        title = f"{FOLDED}Hint {number} of {len(words)}</summary>"
        inner = f"{title}\n<p>{as_html(words[number - 1])}</p>\n{inner}</details>\n"
    return inner.rstrip()


def data(known: dict) -> str:
    """Return what the script makes the box of an exercise from."""
    text = json.dumps(known).replace("<", "\\u003c")
    script = f'<script type="application/json">{text}</script>'
    return f'<div class="ab-answer">{script}</div>'


def parts(key: str) -> str:
    """Return what belongs to an exercise: boxes, hints, a measure of an open one."""
    exercise = KNOWN[key]
    if isinstance(exercise, Open):
        good = f"<p>A good answer holds: {as_html(exercise.good)}.</p>"
        return "\n".join(
            (
                data({"id": key, "kind": "open"}),
                hints(exercise.hints),
                f"{FOLDED}What a good answer holds</summary>\n{good}</details>",
            )
        )
    found = [e for name, e in KNOWN.items() if first_of(name) == key]
    return "\n".join(data(e.as_data()) + "\n" + hints(e.hints) for e in found)


def add_answers(app, doctree):
    """Give each exercise of a page what belongs to it."""
    for node in doctree.findall(is_exercise_node):
        if node["label"] in KNOWN:
            node += nodes.raw("", parts(node["label"]), format="html")


def load_script(app, pagename, templatename, context, doctree):
    """Let a page with exercises load their script."""
    if 'class="ab-answer"' in context.get("body", ""):
        app.add_js_file("answers.js", loading_method="defer", priority=100)


def write_script(app, exception):
    """Write the script of the exercises."""
    if exception is None and app.builder.format == "html":
        path = Path(app.outdir, "_static", "answers.js")
        path.write_text(files.bundled("answers"), encoding="utf-8", newline="\n")


def setup(app):
    app.connect("doctree-read", add_answers)
    app.connect("html-page-context", load_script)
    app.connect("build-finished", write_script)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
