"""
Write the student edition of the notebooks: blanks instead of solutions.

    python scripts/student_edition.py OUT

One source serves both editions.  In a solution's code, a statement that ends with
``# blank`` is what a student writes; here ``...`` takes its place.  Of such a cell stay
definitions, what has a name, and ``check``: what prints or loops would tell the answer,
or fail on a blank.  The rest of the solution, its text and its cells without a blank,
is left out.  Each exercise ends with a ``check``; that of an open one takes words.
A question that no ``check`` judges has a blank of its own.

The text is plain Markdown (`plain_markdown`), and the first line of code says whose
work it is.  What a page comes to is folded: it answers some of the exercises.
A page without exercises has nothing to fill in, and is read in the book.
"""

from __future__ import annotations

import argparse
import ast
import copy
import re
import sys
import textwrap
from pathlib import Path

import nbformat
from plain_markdown import Course, plain, read_course

from abstransfer.exercises import all_exercises
from abstransfer.exercises._model import first_of

BOOK = Path(__file__).parents[1] / "book"
WHOSE = 'student = "..."  # your name'
IMPORT = "from abstransfer.exercises import check"
OPEN = """\
# What you found, in words; code in cells of its own, above.
answer = ...
check("{key}", answer)"""
KNOWN = {exercise.key: exercise for exercise in all_exercises()}
STATED = re.compile(
    r"^```\{exercise-start\}\n:label: (\S+)\n```\n(.*?)^```\{exercise-end\}",
    re.M | re.S,
)
CODE = re.compile(r"^```(?s:.*?)^```$|^    .*$|^\*\*.*\*\*$", re.M)  # or a title
TAKEAWAYS = re.compile(r"^## Takeaways\n\n(.*?)(?=\n\n#|\Z)", re.M | re.S)
FOLDED = """\
## Takeaways

<details>
<summary>After the exercises: what this page comes to</summary>

{}

</details>"""
MARK = re.compile(r"#\s*blank\s*$", re.MULTILINE)
BARE_TWICE = re.compile(r"^( *)\.\.\.(?:\n\1\.\.\.)+$", re.MULTILINE)
START = re.compile(
    r"^(`{3,})\{solution-start\} *(\S*)[^\n]*\n(?::[^\n]*\n)*\1[^\S\n]*$", re.M
)
END = re.compile(r"^(`{3,})\{solution-end\}[^\S\n]*\n\1[^\S\n]*$", re.M)


def student_edition(notebook, course: Course):
    """Return a copy of a notebook for students."""
    notebook = copy.deepcopy(notebook)
    cells, in_solution, key, asked, stated = [], False, "", "", {}
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            stated |= {
                k: plain(text, course) for k, text in STATED.findall(cell.source)
            }
            found = enumerate(pieces(cell.source, in_solution))
            for i, (text, in_solution, edge) in found:
                shown = "" if in_solution else plain(text, course)
                shown = TAKEAWAYS.sub(lambda told: FOLDED.format(told[1]), shown)
                if shown:
                    more = nbformat.v4.new_markdown_cell(shown, id=f"{cell.id}-{i}")
                    cells.append(more)
                if edge and not in_solution:
                    key, asked = edge[2], ""
                elif edge:
                    for n, question in enumerate(not_judged(key, stated.get(key, ""))):
                        text = f"{_comment(question)}\nin_words = ..."
                        more = nbformat.v4.new_code_cell(text, id=f"words-{key}-{n}")
                        cells.append(more)
                    if not _has(cells, name := f'check("{key}"'):
                        text = _line_with(name, asked) or OPEN.format(key=key)
                        more = nbformat.v4.new_code_cell(text, id=f"check-{key}")
                        cells.append(more)
        elif in_solution:
            asked += cell.source + "\n"
            if MARK.search(cell.source):
                cell.source = kept(stub(cell.source))
                cell.outputs, cell.execution_count = [], None
                cell.metadata.pop("jupyter", None)  # a solution is folded, a blank not
                cells.append(cell)
        else:
            cells.append(cell)
    if in_solution:
        raise ValueError("a solution starts and does not end")
    if key:
        text = WHOSE if _has(cells, IMPORT) else f"{WHOSE}\n\n{IMPORT}"
        cells.insert(1, nbformat.v4.new_code_cell(text, id="student"))
    notebook.cells = cells
    return notebook


def questions(text: str) -> list[str]:
    """
    Return the questions of an exercise, one a sentence.

    >>> questions("**Why?**\\nTake `x`. How large is it? And `y`?")
    ['How large is it?', 'And `y`?']
    """
    lines = CODE.sub("", text).split("\n")
    found = [part for line in lines for part in re.split(r"(?<=[.?!]) (?=[A-Z])", line)]
    return [part for part in found if part.endswith("?")]


def not_judged(key: str, text: str) -> list[str]:
    """Return the questions of an exercise that no ``check`` is about."""
    found = questions(text)
    judged = [exercise for name, exercise in KNOWN.items() if first_of(name) == key]
    if not judged:  # an open exercise ends with a cell for words anyway
        return found if found[1:] else []
    for exercise in judged:
        about = max(found, key=lambda q: _in_common(q, exercise.task), default="")
        least = 0.8 if exercise.cases else 0.0  # code need not be asked for by a "?"
        if about and _in_common(about, exercise.task) > least:
            found.remove(about)
    return found


def _in_common(question: str, task: str) -> float:
    """Return which share of the words of a question its task has, too."""
    words, others = (
        set(re.findall(r"[a-z]{3,}|[\d.,]*\d", t.lower())) for t in (question, task)
    )
    return len(words & others) / max(len(words), 1)


def _comment(text: str) -> str:
    """Return a text as a comment, without the marks of Markdown and formulas."""
    bare = re.sub(r"(?<!\w)\*(\w+)\*(?!\w)", r"\1", text.replace("$", ""))
    return textwrap.fill(bare, 79, initial_indent="# ", subsequent_indent="# ")


def _has(cells: list, code: str) -> bool:
    return any(cell.cell_type == "code" and code in cell.source for cell in cells)


def _line_with(start: str, text: str) -> str:
    """Return the first line that begins so, or nothing."""
    return next((line for line in text.split("\n") if line.startswith(start)), "")


def pieces(text: str, inside: bool):
    """Yield a text piece by piece: it, whether in a solution, the edge at its end."""
    while True:
        edge = (END if inside else START).search(text)
        yield (text[: edge.start()] if edge else text), inside, edge
        if not edge:
            return
        inside, text = not inside, text[edge.end() :]


def without_solutions(text: str, inside: bool) -> tuple[str, bool]:
    """Return text without solutions, and whether one is still open at its end."""
    found = list(pieces(text, inside))
    kept = "".join(piece for piece, is_solution, _ in found if not is_solution)
    return kept.strip(), found[-1][1]


def stub(source: str) -> str:
    """
    Return code in which ``...`` stands for each statement marked ``# blank``.

    >>> print(stub("def twice(x):\\n    y = 2 * x  # blank\\n    return y  # blank"))
    def twice(x):
        y = ...
        return ...
    """
    lines = source.split("\n")
    marked = {i for i, line in enumerate(lines, 1) if MARK.search(line)}
    for node in reversed(_blanks(ast.parse(source).body, marked)):
        text = " " * node.col_offset + _as_blank(node, source)
        lines[node.lineno - 1 : node.end_lineno] = [text]
    return BARE_TWICE.sub(r"\1...", "\n".join(lines))  # one blank for several


def kept(source: str) -> str:
    """
    Return a stub without what runs at once and is no ``check``.

    >>> print(kept("y = ...\\nprint(-y)\\ncheck('ex-1-1', y)"))
    y = ...
    check('ex-1-1', y)
    """
    lines = source.split("\n")
    for node in reversed(ast.parse(source).body):
        text = ast.get_source_segment(source, node)
        runs = isinstance(node, ast.Expr | ast.For | ast.While | ast.If | ast.With)
        if runs and text != "..." and not text.startswith("check("):
            blank = ["..."] if re.search(r"(?<!\.)\.\.\.(?!\.)", text) else []
            lines[node.lineno - 1 : node.end_lineno] = blank
    return re.sub(r"\n{4,}", "\n\n\n", "\n".join(lines)).strip()


def _blanks(body: list, marked: set[int]) -> list[ast.stmt]:
    """Return the marked statements in order; of an `if`, its first line counts."""
    found = []
    for node in body:
        inner = [
            child
            for name in ("body", "orelse", "finalbody", "handlers", "cases")
            for child in getattr(node, name, [])
        ]
        last = inner[0].lineno - 1 if inner else node.end_lineno
        if marked & set(range(node.lineno, last + 1)):
            found.append(node)
        else:
            found += _blanks(inner, marked)
    return found


def _as_blank(node: ast.stmt, source: str) -> str:
    """Return what a student sees in place of a statement."""
    if isinstance(node, ast.Return):
        return "return ..."
    if isinstance(node, ast.Assign):
        targets = [each for t in node.targets for each in getattr(t, "elts", [t])]
        names = [ast.get_source_segment(source, target) for target in targets]
        return " = ".join([*names, "..."])
    return "..."


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("out", type=Path, help="folder to write the notebooks to")
    out = parser.parse_args(arguments).out
    out.mkdir(parents=True, exist_ok=True)
    course = read_course(BOOK)
    for name in sorted(course.notebooks):
        page = nbformat.read(BOOK / f"{name}.ipynb", as_version=4)
        nbformat.write(student_edition(page, course), out / f"{name}.ipynb")
    print(f"The student edition is in {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
