"""
Print the rooms of the package: what each holds, and its lines of code.

    python scripts/rooms.py

Blank lines, comments and docstrings are no code.  README and CONTRIBUTING show the
table; a test compares the counts.
"""

from __future__ import annotations

import ast
import io
import tokenize
from pathlib import Path
from typing import NamedTuple

PACKAGE = Path(__file__).parents[1] / "abstransfer"
# What a student reads in an hour, in this order.
CORE = (
    "maps.py",
    "mdp.py",
    "abstraction.py",
    "navigation.py",
    "solvers.py",
    "policies.py",
    "builders/",
    "driving.py",
    "learning/",
)
# What the core uses and nobody need read: text that others made, speed; and what needs
# the core, each only those before it.
ABOVE = (
    "foreign.py",
    "builders/_*.py",
    "learning/_*.py",
    "rivals/",
    "experiments/",
    "plotting/",
    "reproduction/",
    "project/",
    "gymnasium.py",
    "scenes/",
    "exercises/",
    "classroom/",
    "cli/",
)
SILENT = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENCODING,
    tokenize.ENDMARKER,
}


class Room(NamedTuple):
    """A module or a folder of modules."""

    name: str
    says: str  # the first sentence of its docstring
    lines: int  # of code


def rooms(names: tuple[str, ...] = CORE + ABOVE) -> list[Room]:
    """Return the rooms of these names, measured."""
    return [Room(name, _says(name), sum(map(lines_in, files(name)))) for name in names]


def files(name: str) -> list[Path]:
    """Return the modules of a room."""
    if not name.endswith("/"):
        found = sorted(PACKAGE.glob(name))
        return [path for path in found if path.stem != "__init__"]
    found = sorted((PACKAGE / name).rglob("*.py"))
    apart = {path for row in ABOVE if "*" in row for path in files(row)}
    return [path for path in found if path not in apart]


def lines_in(path: Path) -> int:
    """Return the lines of Python code in a file."""
    return len(code_lines(path.read_text(encoding="utf-8")))


def code_lines(source: str) -> set[int]:
    """
    Return the numbers of the lines that hold code.

    >>> sorted(code_lines('"What it is."\\n\\nx = 1  # why\\n# why\\ny = 2\\n'))
    [3, 5]
    """
    found = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in SILENT:
            found.update(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(ast.parse(source)):
        has_text = isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
        if has_text and ast.get_docstring(node) is not None:
            text = node.body[0]
            found.difference_update(range(text.lineno, text.end_lineno + 1))
    return found


def table(found: list[Room]) -> str:
    """Return rooms as a table in Markdown."""
    rows = [f"| `{room.name}` | {room.says} | {room.lines} |" for room in found]
    return "\n".join(["| room | what it holds | lines |", "|---|---|---|", *rows])


def _says(name: str) -> str:
    """Return the first sentence of a room's docstring."""
    if "*" in name:
        return "what makes this room fast, to the same bit"
    file = PACKAGE / name / "__init__.py" if name.endswith("/") else PACKAGE / name
    text = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8")))
    return text.split("\n\n")[0].replace("\n", " ").replace("``", "`")


def main() -> None:
    core, above = rooms(CORE), rooms(ABOVE)
    for found in (core, above):
        print(table(found))
        print(f"\n{sum(room.lines for room in found)} lines\n")


if __name__ == "__main__":
    main()
