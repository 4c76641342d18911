"""Every text that is read or written names its encoding: no machine's own is used."""

import ast

from support import ROOT

FOLDERS = ("abstransfer", "benchmarks", "scripts", "tests")
PROGRAMS = [*ROOT.glob("*.py")]
PROGRAMS += [path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py")]


def constant(node):
    return node.value if isinstance(node, ast.Constant) else None


def is_vague(call):
    """Whether a call handles text in an encoding that depends on the machine."""
    given = {keyword.arg: constant(keyword.value) for keyword in call.keywords}
    if {"encoding", None} & set(given):
        return False
    name = getattr(call.func, "attr", getattr(call.func, "id", None))
    if name in ("read_text", "write_text"):
        return len(call.args) < (1 if name == "read_text" else 2)
    if name == "open":
        place = int(isinstance(call.func, ast.Name))  # of the mode
        if place or call.args:
            mode = call.args[place] if call.args[place:] else ast.Constant("r")
            mode = given.get("mode", constant(mode))
            return isinstance(mode, str) and not set(mode) - set("rwaxt+")
    return given.get("text") is True or given.get("universal_newlines") is True


def vague(source):
    """Return the lines of a program where an encoding is missing."""
    nodes = ast.walk(ast.parse(source))
    return [n.lineno for n in nodes if isinstance(n, ast.Call) and is_vague(n)]


def test_every_text_names_its_encoding():
    found = {
        str(path.relative_to(ROOT)): lines
        for path in PROGRAMS
        if (lines := vague(path.read_text(encoding="utf-8")))
    }

    assert found == {}
    assert len(PROGRAMS) > 100


def test_a_missing_encoding_is_found():
    wrong = """
path.read_text()
path.write_text(words)
path.open("w")
open(path)
open(path, "a", newline="")
run(command, text=True)
"""
    right = """
path.read_text("utf-8")
path.write_text(words, encoding="utf-8")
path.open("rb")
page.open("index")
os.open(path, os.O_RDWR)
open(path, "ab")
open(path, mode)
run(command, encoding="utf-8")
run(command, **options)
"""

    assert vague(wrong) == [2, 3, 4, 5, 6, 7]
    assert vague(right) == []
