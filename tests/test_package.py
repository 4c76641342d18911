"""The package as a whole: its public names, and what it loads."""

import inspect
import json
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import abstransfer

PACKAGE = Path(abstransfer.__file__).parent
HEAVY = {"scipy", "numba", "matplotlib", "ipywidgets", "anywidget", "IPython"}


# Public names


def test_public_names_are_named_once():
    names = abstransfer.__all__

    assert len(names) == len(set(names))


@pytest.mark.parametrize("module", abstransfer._CORE)
def test_a_module_of_the_core_is_there_before_a_name_of_it_is_used(module):
    code = f"import abstransfer as at; at.{module}.__doc__.strip()"

    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


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


# What is loaded


def loaded_after(code):
    """Return the names of the modules that a fresh Python has loaded after code."""
    program = f"{code}\nimport json, sys\nprint(json.dumps(list(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        encoding="utf-8",
        check=True,
        cwd=PACKAGE.parent,
    )
    return set(json.loads(done.stdout.splitlines()[-1]))


def test_importing_the_package_loads_nothing_that_takes_time():
    loaded = loaded_after("import abstransfer")

    assert "abstransfer" in loaded
    assert not (HEAVY | {"numpy"}) & loaded


def test_the_scenes_load_no_compiler_and_no_laws_of_chance():
    loaded = loaded_after("import abstransfer\nabstransfer.scenes.Race")

    assert "abstransfer.scenes.race.widget" in loaded
    heavy = {"numba", "matplotlib", "scipy.optimize", "scipy.stats"}
    assert not heavy & loaded


def test_table_1_needs_scipy_and_nothing_else_that_is_heavy():
    loaded = loaded_after(
        "from abstransfer import navigation_tasks, parse_map, table1\n"
        "table1(navigation_tasks(parse_map('+-+-+\\n|.d*|\\n+-+-+')))"
    )

    assert "abstransfer.builders.deduced" in loaded
    assert HEAVY & loaded <= {"scipy"}
