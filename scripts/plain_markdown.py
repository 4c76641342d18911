"""
Write the Markdown of a page as any viewer of notebooks shows it.

The book's pages are MyST: directives, roles and labels, which only the built book and
one extension of JupyterLab know.  Here a box becomes a quotation, what folds becomes
``<details>``, an equation stands between ``$$`` with its number, and a role is words.
"""

from __future__ import annotations

import html
import re
from dataclasses import dataclass, field
from pathlib import Path

import nbformat
from pybtex.database import parse_file

DIRECTIVE = re.compile(
    r"^(?P<fence>`{3,}|:{3,})\{(?P<name>[\w:-]+)\}[ \t]*(?P<title>[^\n]*)\n"
    r"(?P<body>.*?)^(?P=fence)[ \t]*$",
    re.MULTILINE | re.DOTALL,
)
OPTION = re.compile(r"\A:([\w-]+):[ \t]*([^\n]*)\n")
ROLE = re.compile(r"\{([\w:-]+)\}`([^`<]*?)(?: *<([^`>]*)>)?`")
LABEL = re.compile(r"^\([\w-]+\)=\n", re.MULTILINE)
MOMENT = re.compile(r'<a [^>]*href="#[^>]*>(.*?)</a>', re.DOTALL)
ALONE = re.compile(r"^\$\$(.+)\$\$$", re.MULTILINE)
LETTER = re.compile(r"\$(\w)\$")  # in HTML not every viewer looks for formulas
HEADING = re.compile(r"^\(([\w-]+)\)=\n#+ (.*)$", re.MULTILINE)
NUMBERED = re.compile(r"\{math\}\n:label: *(\S+)")


@dataclass
class Course:
    """What the pages say of each other."""

    titles: dict[str, str] = field(default_factory=dict)  # by name of the page
    notebooks: set[str] = field(default_factory=set)  # those with exercises: linked to
    equations: dict[str, int] = field(default_factory=dict)  # numbers by label
    headings: dict[str, str] = field(default_factory=dict)  # by the label above
    works: dict[str, tuple[str, str]] = field(default_factory=dict)  # authors, year


def read_course(book: Path) -> Course:
    """Return what the pages of a book say of each other."""
    course = Course()
    texts = {path.stem: path.read_text("utf-8") for path in book.glob("*.md")}
    for path in sorted(book.glob("*.ipynb")):
        cells = nbformat.read(path, as_version=4).cells
        texts[path.stem] = "\n".join(
            cell.source for cell in cells if cell.cell_type == "markdown"
        )
        if "{exercise-start}" in texts[path.stem]:
            course.notebooks.add(path.stem)
        for label in NUMBERED.findall(texts[path.stem]):
            course.equations[label] = len(course.equations) + 1
    for name, text in texts.items():
        course.titles[name] = re.search(r"^# (.*)$", text, re.MULTILINE)[1]
        course.headings |= HEADING.findall(text)
    for key, entry in parse_file(book / "references.bib").entries.items():
        names = [
            " ".join([*person.prelast_names, *person.last_names])
            for person in entry.persons["author"]
        ]
        several = f"{names[0]} et al." if names[2:] else " and ".join(names)
        course.works[key] = (several, entry.fields["year"])
    return course


def plain(text: str, course: Course) -> str:
    r"""
    Return Markdown without a directive, a role or a label.

    >>> print(plain("```{dropdown} Why?\nBecause {math}`x`.\n```", Course()))
    <details>
    <summary>Why?</summary>
    <BLANKLINE>
    Because $x$.
    <BLANKLINE>
    </details>
    """
    text = LABEL.sub("", MOMENT.sub(r"\1", text))
    text = ALONE.sub(r"$$\n\1\n$$", text)
    text = DIRECTIVE.sub(lambda found: _box(found, course), text)
    text = ROLE.sub(lambda found: _words(*found.groups(), course), text)
    return re.sub(r"\n{3,}", "\n\n", text).strip()


def _box(found: re.Match, course: Course) -> str:
    name, title, body, options = found["name"], found["title"], found["body"], {}
    while option := OPTION.match(body):
        options[option[1]], body = option[2], body[option.end() :]
    if name == "math":
        number = course.equations.get(options.get("label"))
        tag = f"\n\\tag{{{number}}}" if number else ""
        return f"$$\n{body.strip()}{tag}\n$$"
    if name == "exercise-start":
        page, number = re.fullmatch(r"ex-(\d+)-(\d+)", options["label"]).groups()
        return f"### Exercise {page}.{number}"
    if name == "exercise-end" or title == "For the lecturer":
        return ""
    body = plain(body, course)
    if name == "dropdown" or options.get("name", "").startswith("reply-"):
        title = LETTER.sub(r"<i>\1</i>", html.escape(title, quote=False))
        head = f"<summary>{title}</summary>"
        return f"<details>\n{head}\n\n{body}\n\n</details>"
    if name in ("admonition", "prf:algorithm"):
        head = f"Algorithm {title}" if name != "admonition" else title
        lines = [f"**{head}**", "", *body.split("\n")]
        return "\n".join(f"> {line}".rstrip() for line in lines)
    raise ValueError(f"there is no plain form for the directive {{{name}}}")


def _words(role: str, text: str, target: str | None, course: Course) -> str:
    if role == "math":
        return f"${text}$"
    if role == "eq":
        return f"({course.equations[text]})"
    if role == "doc":
        page = target or text
        words = text if target else course.titles[page]
        return f"[{words}]({page}.ipynb)" if page in course.notebooks else f"*{words}*"
    if role in ("ref", "term") and (target or role == "term"):
        return text
    if role == "ref" and text in course.headings:
        return f"*{course.headings[text]}*"
    if role in ("func", "mod", "class"):
        return f"`{text.removeprefix('~')}`"
    if role in ("cite", "cite:t"):
        who, year = course.works[text]
        return f"({who}, {year})" if role == "cite" else f"{who} ({year})"
    raise ValueError(f"there is no plain form for the role {{{role}}}`{text}`")
