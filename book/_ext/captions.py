"""
A Sphinx extension that shows what a figure says to those who cannot see it.

The alt text of a picture that a cell drew states its finding, with numbers.  It becomes
the caption, too; a screen reader is told it once.
"""

from docutils import nodes


def caption_figures(app, doctree):
    """Put each described output picture into a figure, with its words below."""
    for output in doctree.findall(nodes.container):
        if output.get("nb_element") != "cell_code_output":
            continue
        for picture in list(output.findall(nodes.image)):
            alt = picture.get("alt", "")
            if alt and not isinstance(picture.parent, nodes.figure):
                words = f'<p class="ab-caption" aria-hidden="true">{_safe(alt)}</p>'
                below = nodes.raw("", words, format="html")
                picture.parent.insert(picture.parent.index(picture) + 1, below)


def _safe(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def setup(app):
    app.connect("doctree-read", caption_figures)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
