"""
A Sphinx extension that leads from the first use of a word to the glossary.

On each page the first use of a word of the glossary becomes a link to what it means:
in running text, not in a heading, a link, code, or where it is set in bold or italics,
because there the page says itself what it means; nor in the title of a folding or an
option of a bet, because what is pressed as a whole may hold no link.  Words that
English uses in another sense as well ("run", "cut") are not looked for; they are linked
by hand, {term}`cut`.
"""

import re

from docutils import nodes
from sphinx import addnodes
from sphinx_design.dropdown import dropdown_title

PAGE = "notation"  # where the glossary is
EVERYDAY = {  # also a word of every day, or of this book in another sense
    *("action", "arm", "bootstrap", "cell", "cut", "dial", "discount"),
    *("feature", "finding", "greedy", "guide", "hard", "interval", "label", "luck"),
    *("map", "model", "notes", "return", "reward", "run", "soft", "source", "state"),
    *("support", "target", "task", "tie", "transfer", "union", "value", "window"),
    "policy",
}
NOT_PROSE = (
    nodes.title,
    nodes.reference,
    nodes.literal,
    nodes.literal_block,
    nodes.strong,
    nodes.emphasis,
    nodes.raw,
    nodes.math,
    nodes.math_block,
    nodes.term,
    addnodes.pending_xref,
    dropdown_title,
)


def pattern(term):
    """
    Return what finds a word in a text, in the singular and the plural.

    >>> [bool(pattern("sweep").search(words)) for words in ("All sweeps", "swept")]
    [True, False]
    """
    words = re.escape(term).replace(r"\\ ", r"\\s+").replace(r"\-", "[- ]")
    return re.compile(rf"\b{words}(?:s|es)?\b", re.IGNORECASE)


def looked_for(env):
    """Return the terms that are linked by themselves: name, pattern, anchor."""
    objects = env.get_domain("std").objects
    found = {
        name: anchor
        for (kind, name), (page, anchor) in objects.items()
        if kind == "term" and page == PAGE and name.lower() not in EVERYDAY
    }
    # The longest first: an abstract state is not a state.
    names = sorted(found, key=len, reverse=True)
    return [(name, pattern(name), found[name]) for name in names]


def is_prose(text):
    """Return whether a text may hold a link: no heading, link, code, or button."""
    parent = text.parent
    while parent is not None:
        if isinstance(parent, NOT_PROSE) or is_options(parent):
            return False
        parent = parent.parent
    return True


def is_options(node):
    """Return whether a node is the list of options of a bet."""
    if not isinstance(node, nodes.bullet_list):
        return False
    return any(name.startswith("bet-") for name in node.parent.get("ids", ()))


def is_defined(doctree, found, before):
    """Return whether the page itself says the word in bold or italics before."""
    for node in doctree.findall():
        if node is before:
            return False
        is_set_off = isinstance(node, nodes.strong | nodes.emphasis)
        if is_set_off and found.fullmatch(node.astext().strip()):
            return True
    return False


def link_first_uses(app, doctree, docname):
    """Link the first use of each word on a page."""
    if docname == PAGE or docname.startswith("api"):
        return
    for _, found, anchor in looked_for(app.env):
        for text in doctree.findall(nodes.Text):
            match = found.search(text.astext()) if is_prose(text) else None
            if not match:
                continue
            if not is_defined(doctree, found, text):
                uri = app.builder.get_relative_uri(docname, PAGE)
                link = nodes.reference("", match[0], internal=True)
                link["refuri"] = f"{uri}#{anchor}"
                link["classes"] = ["ab-word"]
                whole = text.astext()
                parts = whole[: match.start()], link, whole[match.end() :]
                text.parent.replace(
                    text,
                    [nodes.Text(p) if isinstance(p, str) else p for p in parts if p],
                )
            break


def setup(app):
    app.connect("doctree-resolved", link_first_uses)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
