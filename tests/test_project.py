"""What the project says of itself: its needs, its address, how it is checked."""

import ast
import re
import shlex
import subprocess
import sys
import tomllib
from importlib.metadata import packages_distributions

import pytest
import yaml
from support import ROOT

from abstransfer.cli import _parser

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))[
    "project"
]
EXTRAS = PROJECT["optional-dependencies"]
# What comes with something that is declared, and is no package of its own for us.
COMES_WITH = {
    "distributed": "dask",
    "docutils": "jupyter-book",
    "jupyter-client": "nbval",
    "nbclient": "jupyter-book",
    "nbformat": "jupyter-book",
    "pybtex": "jupyter-book",
    "pyyaml": "jupyter-book",
    "sphinx": "jupyter-book",
    "sphinx-design": "jupyter-book",
}


def declared(*extras):
    """Return the names of what the package needs, and of what the extras add."""
    needs = [
        *PROJECT["dependencies"],
        *(need for name in extras for need in EXTRAS[name]),
    ]
    return {re.match(r"[\w-]+", need)[0].lower().replace("_", "-") for need in needs}


def imported(folder):
    """Yield the distributions whose modules the files of a folder import."""
    known = packages_distributions()
    for path in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module]
            for name in {name.partition(".")[0] for name in names}:
                if name not in sys.stdlib_module_names:
                    yield from (
                        each.lower().replace("_", "-") for each in known.get(name, ())
                    )


@pytest.mark.parametrize(
    ("folder", "extras"),
    [
        ("abstransfer", ("gymnasium", "book", "class")),
        ("tests", ("book", "test", "dask", "gymnasium")),
        ("scripts", ("book", "test")),
        ("book", ("book",)),
        ("benchmarks", ("peers", "test")),
    ],
)
def test_what_is_imported_is_declared(folder, extras):
    names = declared(*extras)
    came_with = {name for name, source in COMES_WITH.items() if {source, name} & names}

    assert set(imported(folder)) - names - came_with <= {"abstransfer"}


def test_every_pin_is_of_something_that_is_needed_and_every_need_is_pinned():
    text = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    pins = re.findall(r"^([\w.-]+)==[\w.]+(?: *#.*)?$", text, re.MULTILINE)

    assert len(pins) == len(set(pins))
    assert declared(*EXTRAS) - {"abstransfer"} <= {
        pin.lower().replace("_", "-") for pin in pins
    }


def git(*arguments):
    """Return what git says of the repository."""
    said = subprocess.run(
        ["git", *arguments], cwd=ROOT, capture_output=True, encoding="utf-8"
    )
    if said.returncode > 1:
        pytest.skip("this is no git repository")
    return said.stdout


def test_the_address_of_the_repository_stands_in_one_place():
    (address,) = PROJECT["urls"].values()

    assert git("grep", "-lF", address).split() == ["pyproject.toml"]


def test_a_text_has_the_same_bytes_wherever_it_is_checked_out():
    """Git for Windows ends lines otherwise, and page 9 prints what identifies files."""
    path = "data/hypotheses.md"

    assert git("check-attr", "eol", path) == f"{path}: eol: lf\n"


# How a stranger checks it

CHECK = yaml.safe_load((ROOT / "codecheck.yml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("output", CHECK["manifest"], ids=lambda output: output["file"])
def test_an_output_to_check_is_there_and_its_command_is_understood(output):
    (command,) = re.findall(r"`abstransfer ([^`]+)`", output["comment"])

    assert (ROOT / output["file"]).is_file()
    assert _parser().parse_args(shlex.split(command)).run


def test_the_title_is_that_of_the_citation():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))

    assert CHECK["paper"]["title"] == citation["title"]
    assert CHECK["paper"]["authors"] == citation["authors"]
