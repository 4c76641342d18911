"""
Write the student edition of the notebooks: blanks instead of solutions.

    python scripts/student_edition.py OUT

One source serves both editions.  In a solution's code, a statement that ends with
``# blank`` is what a student writes; here ``...`` takes its place.  The rest of the
solution, its text and its cells without a blank, is left out.  An open exercise, of
which no cell would stay, gets an empty one that says so.
"""

from __future__ import annotations

import argparse
import ast
import copy
import re
import sys
from pathlib import Path

import nbformat

BOOK = Path(__file__).parents[1] / "book"
OPEN = """\
# An open exercise, without a check: your code.
# at.exercises.check("{key}") gives a hint."""
MARK = re.compile(r"#\s*blank\s*$", re.MULTILINE)
BARE_TWICE = re.compile(r"^( *)\.\.\.(?:\n\1\.\.\.)+$", re.MULTILINE)
START = re.compile(
    r"^(`{3,})\{solution-start\} *(\S*)[^\n]*\n(?::[^\n]*\n)*\1[^\S\n]*$", re.M
)
END = re.compile(r"^(`{3,})\{solution-end\}[^\S\n]*\n\1[^\S\n]*$", re.M)


def student_edition(notebook):
    """Return a copy of a notebook for students."""
    notebook = copy.deepcopy(notebook)
    cells, in_solution, has_blank, key = [], False, False, ""
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            if in_solution and not has_blank and END.search(cell.source):
                text = OPEN.format(key=key)
                cells.append(nbformat.v4.new_code_cell(text, id=f"open-{cell.id}"))
            for start in START.finditer(cell.source):
                key, has_blank = start[2], False
            cell.source, in_solution = without_solutions(cell.source, in_solution)
            keep = bool(cell.source)
        elif in_solution:
            keep = bool(MARK.search(cell.source))
            has_blank |= keep
            cell.source = stub(cell.source)
            cell.outputs, cell.execution_count = [], None
            cell.metadata.pop("jupyter", None)  # a solution is folded, a blank not
        else:
            keep = True
        if keep:
            cells.append(cell)
    if in_solution:
        raise ValueError("a solution starts and does not end")
    notebook.cells = cells
    return notebook


def without_solutions(text: str, inside: bool) -> tuple[str, bool]:
    """Return text without solutions, and whether one is still open at its end."""
    kept = ""
    while text:
        edge = (END if inside else START).search(text)
        if not inside:
            kept += text[: edge.start()] if edge else text
        if not edge:
            break
        inside, text = not inside, text[edge.end() :]
    return kept.strip(), inside


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
        names = [ast.get_source_segment(source, target) for target in node.targets]
        return " = ".join([*names, "..."])
    return "..."


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("out", type=Path, help="folder to write the notebooks to")
    out = parser.parse_args(arguments).out
    out.mkdir(parents=True, exist_ok=True)
    for path in sorted(BOOK.glob("*.ipynb")):
        notebook = student_edition(nbformat.read(path, as_version=4))
        nbformat.write(notebook, out / path.name)
    print(f"The student edition is in {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
