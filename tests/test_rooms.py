"""The rooms of the package: their order, what a module may import, what it says."""

import ast
import importlib
from functools import cache
from pathlib import Path

import pytest

import abstransfer

PACKAGE = Path(abstransfer.__file__).parent
# A module imports from its own room and from rooms before it.  Pictures come before the
# reproduction, because that draws figures.
ORDER = ["_paths", "_interrupts", "foreign", "maps", "mdp", "abstraction"]
ORDER += ["navigation", "solvers", "policies", "builders", "driving", "learning"]
ORDER += ["rivals", "experiments", "plotting"]
ORDER += ["reproduction", "project", "gymnasium", "scenes", "exercises"]
ORDER += ["classroom", "cli"]
ORDER += ["__main__", "__init__"]


def name_of(path):
    """Return the name of a file's module; of the package itself, "__init__"."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[1:] and parts[-1] == "__init__" else parts)


PATHS = {name_of(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def absolute(module, node):
    """Return the name within the package that a module imports from, or None."""
    base = (node.module or "").split(".") if node.module else []
    if node.level == 0:
        return ".".join(base[1:]) if base[0] == "abstransfer" else None
    here = [] if module == "__init__" else module.split(".")
    is_folder = PATHS[module].stem == "__init__"
    up = node.level - 1 if is_folder else node.level
    assert up <= len(here), f"{module} reaches out of the package"
    return ".".join(here[: len(here) - up] + base)


def imports(module, source):
    """Yield the modules of the package that a source names, at any place in it."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                first, _, rest = alias.name.partition(".")
                if first == "abstransfer":
                    yield rest or "__init__"
        elif isinstance(node, ast.ImportFrom):
            base = absolute(module, node)
            if base is None:
                continue
            for alias in node.names:
                inside = f"{base}.{alias.name}".strip(".")
                yield inside if inside in PATHS else base or "__init__"


@cache
def imported(module):
    return set(imports(module, PATHS[module].read_text("utf-8"))) - {module}


def reached(module):
    """Return all modules that a module needs, directly or through others."""
    done, waiting = set(), [module]
    while waiting:
        for other in imported(waiting.pop()) - done:
            done.add(other)
            waiting.append(other)
    return done


def room(module):
    return module.split(".")[0]


def test_imports_are_found_however_they_are_written():
    source = """
import numpy, abstransfer, abstransfer.mdp
from abstransfer import maps, MDP
from ..solvers import evaluate_policy
from .. import policies
def later():
    from .stats import paired_difference
    from . import arms
"""
    found = set(imports("experiments.curves", source))
    assert found == {
        *("__init__", "mdp", "maps", "solvers", "policies"),
        *("experiments.stats", "experiments.arms"),
    }
    assert set(imports("experiments", "from . import arms")) == {"experiments.arms"}
    assert set(imports("experiments", "from ..mdp import MDP")) == {"mdp"}
    assert imported("mdp") == set()
    assert {"maps", "abstraction", "mdp"} <= imported("navigation")
    assert "_paths" in reached("navigation")


def test_every_room_has_its_place():
    assert {room(module) for module in PATHS} == set(ORDER)


@pytest.mark.parametrize("module", PATHS)
def test_a_module_imports_from_its_own_room_and_those_before_it(module):
    place = ORDER.index(room(module))
    too_high = {other for other in imported(module) if ORDER.index(room(other)) > place}

    assert not too_high


@pytest.mark.parametrize("module", PATHS)
def test_no_module_needs_itself(module):
    assert module not in reached(module)


# Rooms, and modules of a room that builds from buildings.
BELOW = {
    "mdp",
    "solvers",
    "policies",
    "builders.induced",
    "builders.deduced",
    "learning",
}


@pytest.mark.parametrize("module", [m for m in PATHS if {m, room(m)} & BELOW])
def test_solving_and_learning_know_nothing_of_buildings(module):
    rooms = {room(other) for other in reached(module)}

    assert not rooms & {"maps", "abstraction", "navigation"}


@pytest.mark.parametrize("module", PATHS)
def test_a_module_says_what_is_in_it(module):
    said = ast.get_docstring(ast.parse(PATHS[module].read_text("utf-8")))

    assert said
    assert len(said.split()) > 2


@pytest.mark.parametrize("module", PATHS)
def test_no_function_has_the_name_of_its_module(module):
    """Or ``from abstransfer.stats import stats`` would hide the module."""
    tree = ast.parse(PATHS[module].read_text("utf-8"))
    defined = {getattr(node, "name", None) for node in tree.body}

    assert module.split(".")[-1] not in defined


@pytest.mark.parametrize("module", [m for m in PATHS if not m.endswith("__main__")])
def test_no_public_name_hides_a_module(module):
    """``at.driving`` is the module, and so in every room."""
    parent, _, name = module.rpartition(".")
    there = importlib.import_module(f"abstransfer.{parent}".strip("."))
    if module != "__init__":
        found = importlib.import_module(f"abstransfer.{module}")
        assert getattr(there, name) is found
