"""The package as a whole: its public names, its layers, and what it loads."""

import ast
import inspect
import json
import subprocess
import sys
from functools import cache
from importlib import metadata
from pathlib import Path

import pytest

import abstransfer

PACKAGE = Path(abstransfer.__file__).parent
MODULES = sorted(path.stem for path in PACKAGE.glob("*.py"))

# A module may use those to its left, itself or through others (design 3).
ORDER = [
    "_paths",
    "maps",
    "mdp",
    "navigation",
    "solvers",
    "policies",
    "absprob_pi",
    "table1",
    "_rng",
    "learning",
    "learning",
    "stats",
    "experiment",
    "plotting",
    "widgets",
    "doctor",
    "cli",
    "__main__",
]
HEAVY = {"matplotlib", "ipywidgets", "anywidget", "numba", "IPython"}


@cache
def imported(module):
    """Return the modules of the package that a module imports, anywhere in it."""
    found = set()
    for node in ast.walk(ast.parse((PACKAGE / f"{module}.py").read_text())):
        if isinstance(node, ast.ImportFrom):
            base = (node.module or "").split(".")
            if node.level == 0 and base.pop(0) != "abstransfer":
                continue
            found |= set(base[:1]) or {alias.name for alias in node.names}
        elif isinstance(node, ast.Import):
            names = [alias.name.split(".") for alias in node.names]
            found |= {
                name[1] for name in names if name[0] == "abstransfer" and name[1:]
            }
    return found & set(MODULES)


def reached(module):
    """Return all modules that a module needs, directly or through others."""
    done, waiting = set(), [module]
    while waiting:
        for other in imported(waiting.pop()) - done:
            done.add(other)
            waiting.append(other)
    return done


# Public names


def test_public_names_are_named_once():
    names = abstransfer.__all__

    assert len(names) == len(set(names))


@pytest.mark.parametrize("room", abstransfer._ROOMS)
def test_a_room_has_the_names_that_it_lists(room):
    module = getattr(abstransfer, room)

    assert all(hasattr(module, name) for name in module.__all__)


def test_every_public_name_is_listed():
    public = {
        name
        for name, value in vars(abstransfer).items()
        if not name.startswith("_") and not inspect.ismodule(value)
    }

    assert public - {"annotations"} <= set(abstransfer.__all__)


@pytest.mark.parametrize("name", abstransfer.__all__)
def test_a_listed_name_exists_and_is_documented(name):
    value = getattr(abstransfer, name)

    if callable(value):
        first_line = inspect.getdoc(value).split("\n")[0]
        assert first_line.endswith((".", ":"))
        assert not first_line.startswith(f"{name}(")  # the signature of a record


def test_the_version_is_that_of_the_installed_package():
    assert abstransfer.__version__ == metadata.version("abstransfer")


# Layers


def test_the_imports_that_are_checked_are_found():
    assert imported("navigation") == {"abstraction", "maps", "mdp"}


@pytest.mark.parametrize("module", MODULES)
def test_no_module_needs_itself(module):
    assert module not in reached(module)


@pytest.mark.parametrize("module", [module for module in ORDER if module in MODULES])
def test_a_module_needs_only_modules_to_its_left(module):
    to_the_left = set(ORDER[: ORDER.index(module)])

    assert reached(module) & set(ORDER) <= to_the_left


@pytest.mark.parametrize(
    "module",
    sorted({"mdp", "solvers", "policies", "absprob_pi", "learning"} & set(MODULES)),
)
def test_solving_and_learning_know_nothing_of_buildings(module):
    assert not reached(module) & {"maps", "navigation"}


@pytest.mark.parametrize("module", MODULES)
def test_a_module_says_what_is_in_it(module):
    tree = ast.parse((PACKAGE / f"{module}.py").read_text())

    assert ast.get_docstring(tree)


# What is loaded


def loaded_after(code):
    """Return the names of the modules that a fresh Python has loaded after code."""
    program = f"{code}\nimport json, sys\nprint(json.dumps(list(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=True,
        cwd=PACKAGE.parent,
    )
    return set(json.loads(done.stdout.splitlines()[-1]))


def test_importing_the_package_loads_nothing_heavy():
    loaded = loaded_after("import abstransfer")

    assert {"abstransfer.driving", "numpy"} <= loaded
    assert not HEAVY & loaded


def test_table_1_needs_nothing_heavy():
    loaded = loaded_after(
        "from abstransfer import navigation_tasks, parse_map, table1\n"
        "table1(navigation_tasks(parse_map('+-+-+\\n|.d*|\\n+-+-+')))"
    )

    assert "abstransfer.builders.deduced" in loaded
    assert not HEAVY & loaded
