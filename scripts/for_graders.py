"""
Write the pages as assignments for nbgrader or for Otter-Grader.

    python scripts/for_graders.py nbgrader OUT    a course folder: OUT/source/PAGE
    python scripts/for_graders.py otter OUT       a notebook a page, for `otter assign`

Both are made from the student edition, so that students meet the same text and blanks.
To it come what graders need: the solution behind each blank, a point for each question
that ``check`` judges, and cells for words that a person marks.  `check` is the only
judge: the machine that grades needs this package.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import nbformat
from nbformat.v4 import (
    new_code_cell,
    new_markdown_cell,
    new_notebook,
    new_output,
    new_raw_cell,
)
from plain_markdown import Course, read_course
from student_edition import BOOK, KNOWN, MARK, START, pieces, student_edition

from abstransfer.exercises import all_open_exercises

GOOD = {exercise.key: exercise.good for exercise in all_open_exercises()}
CHECK = re.compile(r'^check\("(ex-[\w-]+)", (.*)\)$', re.MULTILINE)
WORDS = re.compile(r"((?:# .*\n)+)\w+ = \.\.\.")
CONFIG = '''\
"""Blanks are in the cells already, as students of the book know them."""

c = get_config()
c.CourseDirectory.course_id = "abstransfer"
c.ClearSolutions.code_stub = {"python": "# Your code, in place of the dots."}
c.Execute.timeout = 600  # seconds of a cell: 30 are few on a busy machine
c.Execute.iopub_timeout = 60
'''


class Part(NamedTuple):
    """A part of an assignment: a cell as it is, or a blank, a check, or words."""

    kind: str  # "cell", "blank", "check" or "words"
    name: str = ""  # unique in its notebook
    text: str = ""  # what students see: a blank's code, a question; of a check its call
    answer: str = ""  # code that solves it; what a good answer holds
    cell: object = None


def parts_of(notebook, course: Course) -> Iterator[Part]:
    """Yield the parts of a page, in order."""
    solved = _solutions(notebook)
    for cell in student_edition(notebook, course).cells:
        if cell.id.startswith("words-"):
            text = WORDS.match(cell.source)[1].replace("\n# ", " ").strip("# \n")
            yield Part("words", cell.id, text, "Words that answer this question.")
            continue
        calls = CHECK.findall(cell.source) if cell.cell_type == "code" else []
        if cell.id in solved:
            code = CHECK.sub("", cell.source).strip()
            yield Part("blank", f"answer-{cell.id}", code, solved[cell.id])
        elif not calls:
            yield Part("cell", cell=cell)
        for key, given in calls:
            if key in KNOWN:
                yield Part("check", key, f'check("{key}", {given})')
            else:
                yield Part("words", key, "What you found, in words.", GOOD[key])


def _solutions(notebook) -> dict[str, str]:
    """Return by the id of a cell with a blank all code that solves it."""
    found, inside, code = {}, False, ""
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            if START.search(cell.source):
                code = ""
            *_, (_, inside, _) = pieces(cell.source, inside)
        elif inside:
            code += CHECK.sub("", MARK.sub("", cell.source)).strip() + "\n"
            if MARK.search(cell.source):
                found[cell.id], code = code.strip(), ""
    return found


def for_nbgrader(parts) -> Iterator:
    """Yield the cells of a source notebook of nbgrader."""
    for part in parts:
        if part.kind == "cell":
            yield part.cell
        elif part.kind == "blank":
            text = f"{part.text}\n{_region('### ', part.answer)}"
            yield _marked(new_code_cell(text), part.name, solution=True)
        elif part.kind == "check":
            text = f"reply = {part.text}\nprint(reply)\nassert reply"
            yield _marked(new_code_cell(text), part.name, grade=True, locked=True)
        else:
            text = f"*{part.text}*\n\n{_region('', part.answer)}"
            yield _marked(new_markdown_cell(text), part.name, grade=True, solution=True)


def _region(mark: str, text: str) -> str:
    return f"{mark}BEGIN SOLUTION\n{text}\n{mark}END SOLUTION"


def _marked(cell, name: str, **roles: bool):
    known = {"grade": False, "locked": False, "solution": False, "task": False} | roles
    points = {"points": 1} if known["grade"] else {}
    grader = {"grade_id": name, "schema_version": 3, **known, **points}
    cell.metadata["nbgrader"] = grader
    cell.id = name[:64]
    return cell


def for_otter(parts) -> Iterator:
    """Yield the cells of a notebook for ``otter assign``."""
    yield new_raw_cell("# ASSIGNMENT CONFIG\ninit_cell: true\nexport_cell: false")
    blanks = []  # those that the next check is about
    for part in parts:
        if part.kind == "cell":
            yield part.cell
            continue
        if part.kind == "blank":
            blanks.append(part)
            continue
        manual = "" if part.kind == "check" else "\nmanual: true"
        yield new_raw_cell(f"# BEGIN QUESTION\nname: {part.name}\npoints: 1{manual}")
        if manual:
            yield new_markdown_cell(f"*{part.text}*")
        mark = "# BEGIN SOLUTION NO PROMPT\n{}\n# END SOLUTION"  # the dots are there
        solved = [
            new_code_cell(f"{blank.text}\n{mark.format(blank.answer)}")
            for blank in blanks
        ]
        if manual:  # Otter puts a cell for words in its place
            solved.append(new_markdown_cell(part.answer))
        if solved:
            yield from _block("SOLUTION", solved)
        if not manual:
            test = new_code_cell(f"bool({part.text})")
            test.outputs = [new_output("execute_result", {"text/plain": "True"})]
            yield from _block("TESTS", [test])
        yield new_raw_cell("# END QUESTION")
        blanks = []


def _block(name: str, cells: list) -> list:
    return [new_raw_cell(f"# BEGIN {name}"), *cells, new_raw_cell(f"# END {name}")]


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("tool", choices=("nbgrader", "otter"))
    parser.add_argument("out", type=Path, help="folder to write to")
    options = parser.parse_args(arguments)
    course, out = read_course(BOOK), options.out
    for path in sorted(BOOK.glob("[0-9]*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        parts = parts_of(notebook, course)
        if options.tool == "nbgrader":
            cells, place = for_nbgrader(parts), out / "source" / path.stem
        else:
            cells, place = for_otter(parts), out
        place.mkdir(parents=True, exist_ok=True)
        made = new_notebook(cells=list(cells), metadata=notebook.metadata)
        nbformat.write(made, place / path.name)
    if options.tool == "nbgrader":
        (out / "nbgrader_config.py").write_text(CONFIG, encoding="utf-8")
    print(f"The assignments for {options.tool} are in {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
