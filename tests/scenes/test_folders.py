"""The folders of the scenes: one knows itself and what all share, no other."""

import ast

import pytest
from support import ROOT

SCENES = ROOT / "abstransfer" / "scenes"
SHARED = {"base", "files", "parts"}
FILES = sorted(path.relative_to(SCENES) for path in SCENES.glob("*/*.py"))


def folders_used(path):
    """Return the folders and files of the scenes that a file imports from."""
    found = set()
    package = ("abstransfer", "scenes", *path.parts[:-1])
    for node in ast.walk(ast.parse((SCENES / path).read_text("utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = list(package[: len(package) + 1 - node.level]) if node.level else []
            base += (node.module or "").split(".") if node.module else []
            names = [[*base, alias.name] for alias in node.names]
        else:
            continue
        found |= {x[2] for x in names if x[:2] == ["abstransfer", "scenes"] and x[2:]}
    return found


def test_the_imports_that_are_checked_are_found():
    assert folders_used(FILES[0].parent.parent / "ladder" / "still.py") == {
        "base",
        "ladder",
        "parts",
    }


@pytest.mark.parametrize("path", FILES, ids=str)
def test_no_scene_imports_another(path):
    own = path.parts[0]

    assert folders_used(path) <= SHARED | {own}


@pytest.mark.parametrize("path", FILES, ids=str)
def test_nothing_private_is_taken_from_another_file(path):
    tree = ast.parse((SCENES / path).read_text("utf-8"))
    taken = [
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        and (node.level < 3 or "scenes" in (node.module or ""))
        for alias in node.names
    ]

    assert [name for name in taken if name.startswith("_")] == []


def test_each_scene_has_a_widget_and_one_still():
    folders = {path.parent for path in FILES if path.name == "widget.py"}

    assert folders == {path.parent for path in FILES if path.name == "still.py"}
    assert len(folders) >= 12
