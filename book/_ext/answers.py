"""
A Sphinx extension that brings the hints to the exercises of the built book.

They are data in ``abstransfer.exercises``.  Each hint lies inside the one before it,
so that nobody reads the third before the first, with a script or without.
"""

import re
from html import escape

from docutils import nodes
from sphinx_exercise.nodes import is_exercise_node

from abstransfer.exercises import all_exercises, all_open_exercises

KNOWN = {e.key: e for e in (*all_exercises(), *all_open_exercises())}
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
        inner = (
            f'<details class="ab-hint"><summary>Hint {number} of {len(words)}'
            f"</summary>\n<p>{as_html(words[number - 1])}</p>\n{inner}</details>\n"
        )
    return inner.rstrip()


def add_answers(app, doctree):
    """Give each exercise of a page what belongs to it."""
    for node in doctree.findall(is_exercise_node):
        key = node["label"]
        if key in KNOWN:
            node += nodes.raw("", hints(KNOWN[key].hints), format="html")


def setup(app):
    app.connect("doctree-read", add_answers)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
