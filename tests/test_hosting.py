"""Files for places that run the book name what is there.  No place was tried."""

import json
import re
import shlex
import tomllib

import pytest
import yaml
from support import ROOT

WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
MAKEFILE = (ROOT / "Makefile").read_text("utf-8")
DEV = json.loads((ROOT / ".devcontainer" / "devcontainer.json").read_text("utf-8"))
BINDER = ROOT / ".binder"


def commands():
    """Return the commands of all these files that call make or a file of ours."""
    found = [DEV["postCreateCommand"]]
    for path in WORKFLOWS:
        for job in yaml.safe_load(path.read_text("utf-8"))["jobs"].values():
            found += [step["run"] for step in job["steps"] if "run" in step]
    found += (BINDER / "postBuild").read_text("utf-8").split("\n")
    return [shlex.split(command, comments=True) for command in found]


def test_what_is_made_has_a_rule_and_what_is_run_is_there():
    made = {words[1] for words in commands() if words[:1] == ["make"]}
    run = {word for words in commands() for word in words if re.match(r"\.?\w+/", word)}

    assert made == {"env", "book", "zip"}
    for target in made:
        assert re.search(rf"^{target}:", MAKEFILE, re.MULTILINE)
    for name in run - {word for word in run if "*" in word}:
        assert (ROOT / name).is_file()
    assert {".ci/run", "scripts/student_edition.py"} <= run


def test_what_is_published_is_what_make_writes():
    pages, release = (
        (ROOT / ".github" / "workflows" / f"{name}.yml").read_text("utf-8")
        for name in ("pages", "release")
    )

    (published,) = re.findall(r"path: (build/\S+?) \}", pages)
    assert f"$(HERE)/{published}/index.html" in MAKEFILE
    (released,) = re.findall(r"(build/\S+)\*", release)
    for kind in ("book", "student"):
        assert f"'{released.removeprefix('build/')}{kind}', " in MAKEFILE


def test_the_guide_installs_by_the_constraints_what_the_project_lists():
    guide = (ROOT / "book" / "lecturers_guide.md").read_text("utf-8")
    installs = re.findall(r"pip install ([^`]*)`", guide)
    extras = re.findall(r"\[([\w,]+)\]", " ".join(installs))

    assert {",".join(sorted(each.split(","))) for each in extras} == {
        "class",
        "class,lab",
    }
    assert set(",".join(extras).split(",")) <= set(PROJECT["optional-dependencies"])
    by_constraints = [words for words in installs if '".[' in words]
    assert len(by_constraints) == 3
    assert all(words.startswith("-c constraints.txt ") for words in by_constraints)


def test_the_notebook_server_installs_by_the_constraints_what_the_project_lists():
    [install] = [words for words in commands() if "install" in words]
    (extras,) = re.findall(r"\.\[(.*)\]", install[-1])

    assert install[install.index("-c") + 1] == "constraints.txt"
    assert set(extras.split(",")) <= set(PROJECT["optional-dependencies"])


@pytest.mark.parametrize(
    "text",
    [DEV["image"], (BINDER / "runtime.txt").read_text("utf-8")]
    + [path.read_text("utf-8") for path in WORKFLOWS],
)
def test_each_place_has_a_python_that_will_do(text):
    (minor,) = re.findall(r"\b3\.(\d+)", text)

    assert int(minor) >= int(PROJECT["requires-python"].removeprefix(">=3."))


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_may_write_only_what_it_says(path):
    workflow = yaml.safe_load(path.read_text("utf-8"))

    assert workflow["permissions"]["contents"] in ("read", "write")
    assert "untested" in path.read_text("utf-8").lower()
    assert (workflow["permissions"]["contents"] == "write") == (path.stem == "release")
