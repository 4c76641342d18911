"""The pages as assignments: what nbgrader and Otter-Grader take, and mark rightly."""

import copy
import csv
import json
import os
import subprocess
from pathlib import Path

import for_graders
import nbformat
import pytest
from for_graders import for_nbgrader, for_otter, parts_of
from plain_markdown import read_course
from support import ROOT

from abstransfer.exercises import all_exercises, all_open_exercises

PAGES = sorted((ROOT / "book").glob("[0-9]*.ipynb"))
COURSE = read_course(ROOT / "book")
KEYS = [exercise.key for exercise in (*all_exercises(), *all_open_exercises())]
TOOLS = os.environ.get("GRADERS")  # the folder of their commands
PAGE = "02_solving"


@pytest.fixture(params=PAGES, ids=lambda path: path.stem)
def page(request):
    return nbformat.read(request.param, as_version=4)


def test_each_exercise_is_worth_a_point_by_a_check_or_by_a_person(page):
    parts = list(parts_of(page, COURSE))
    judged = [part.name for part in parts if part.kind == "check"]
    read = [part.name for part in parts if part.name in KEYS and part.kind == "words"]
    number = judged[0].split("-")[1] if judged else read[0].split("-")[1]

    assert sorted(judged + read) == sorted(k for k in KEYS if k.split("-")[1] == number)


def test_a_cell_of_nbgrader_has_a_name_of_its_own_and_its_role(page):
    cells = [
        c for c in for_nbgrader(parts_of(page, COURSE)) if "nbgrader" in c.metadata
    ]
    names = [cell.metadata["nbgrader"]["grade_id"] for cell in cells]

    assert len(set(names)) == len(names)
    for cell in cells:
        role = cell.metadata["nbgrader"]
        assert role["solution"] == ("BEGIN SOLUTION" in cell.source)
        assert role["solution"] or (role["locked"] and "assert reply" in cell.source)


def test_students_of_nbgrader_see_the_blanks_of_the_student_edition(page):
    for part, cell in _with_cells(page, for_nbgrader):
        if part.kind == "blank":
            shown = cell.source.split("### BEGIN SOLUTION")[0]
            assert shown == part.text + "\n"
            assert "..." in shown
            assert "..." not in part.answer.replace("...)", "")


def _with_cells(page, form):
    parts = list(parts_of(page, COURSE))
    return zip(parts, form(parts), strict=True)


def test_the_blocks_of_otter_are_nested_as_it_wants_them(page):
    open_blocks = []
    for cell in for_otter(parts_of(page, COURSE)):
        if cell.cell_type == "raw" and "ASSIGNMENT" not in cell.source:
            word, name = cell.source.split("\n")[0].removeprefix("# ").split()
            if word == "BEGIN":
                assert bool(open_blocks) != (name == "QUESTION")
                open_blocks.append(name)
            else:
                assert open_blocks.pop() == name
    assert open_blocks == []


# ---- their own tools

tried = pytest.mark.skipif(not TOOLS, reason="make nightly tries the graders' tools")


def call(folder, *words):
    path = os.pathsep.join((TOOLS, os.environ["PATH"]))
    places = {"PATH": path, "PYTHONPATH": str(ROOT)}
    command = [str(Path(TOOLS, words[0])), *map(str, words[1:])]
    done = subprocess.run(
        command,
        cwd=folder,
        env=os.environ | places,
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout + done.stderr


RIGHT = {  # as a student of page 2 solves it
    "def backup": "reward + gamma * max(expected)",
    "def greedy_set": "[a for a, q in enumerate(q_row) if q >= largest - tolerance]",
}


def solved(notebook, *, last="-(1 - 0.99**8) / (1 - 0.99)"):
    """Return what a student hands in who fills the blanks of page 2."""
    notebook = copy.deepcopy(notebook)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            for name, line in RIGHT.items():
                if name in cell.source:
                    cell.source = cell.source.replace("return ...", f"return {line}")
            cell.source = cell.source.replace("answer = ...", f"answer = {last}")
    return notebook


def nothing_is_told(page, handed_out):
    """No code that answers stands in a notebook for students."""
    code = nbformat.read(handed_out, as_version=4).cells
    told = "\n".join(cell.source for cell in code)
    for part in parts_of(nbformat.read(page, as_version=4), COURSE):
        if part.kind == "blank":
            assert part.answer not in told, part.name
            assert part.text in told, part.name


@tried
@pytest.mark.timeout(7200)  # every page is handed out
def test_nbgrader_hands_out_and_marks_what_it_is_given(tmp_path):
    assert for_graders.main(["nbgrader", str(tmp_path)]) == 0
    source = tmp_path / "source" / PAGE / f"{PAGE}.ipynb"
    assert "Success" in call(tmp_path, "nbgrader", "validate", source)
    for path in PAGES:
        call(tmp_path, "nbgrader", "generate_assignment", "--create", path.stem)
        nothing_is_told(path, tmp_path / "release" / path.stem / path.name)
    released = tmp_path / "release" / PAGE / f"{PAGE}.ipynb"
    handed_out = nbformat.read(released, as_version=4)
    for name, notebook in (
        ("empty", handed_out),
        ("right", solved(handed_out)),
        ("wrong", solved(handed_out, last="-8")),
    ):
        folder = tmp_path / "submitted" / name / PAGE
        folder.mkdir(parents=True)
        nbformat.write(notebook, folder / f"{PAGE}.ipynb")

    call(tmp_path, "nbgrader", "autograde", PAGE)
    call(tmp_path, "nbgrader", "export", "--to", "grades.csv")

    with (tmp_path / "grades.csv").open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["assignment"] == PAGE]
    scores = {row["student_id"]: float(row["score"]) for row in rows}
    assert scores == {"empty": 0, "right": 3, "wrong": 2}


@tried
@pytest.mark.timeout(7200)  # every page is handed out
def test_otter_assigns_and_marks_what_it_is_given(tmp_path):
    assert for_graders.main(["otter", str(tmp_path)]) == 0
    said = call(tmp_path, "otter", "assign", "-v", f"{PAGE}.ipynb", "tried")
    assert "All autograder tests passed" in said
    for path in PAGES:
        words = (path.name, path.stem, "--no-run-tests")
        call(tmp_path, "otter", "assign", *words)
        nothing_is_told(path, tmp_path / path.stem / "student" / path.name)
    student = tmp_path / PAGE / "student" / f"{PAGE}.ipynb"
    handed_out = nbformat.read(student, as_version=4)
    [autograder] = (tmp_path / PAGE / "autograder").glob("*.zip")
    folder = tmp_path / "handed_in"  # with the name that it was handed out with
    folder.mkdir()
    for notebook, right in ((handed_out, 0), (solved(handed_out, last="-8"), 2)):
        nbformat.write(notebook, folder / student.name)
        call(tmp_path, "otter", "run", "-a", autograder, folder / student.name)

        found = json.loads((tmp_path / "results.json").read_text("utf-8"))
        marks = [t["score"] for t in found["tests"] if t["name"].startswith("ex-2-")]
        assert sum(marks[:3]) == right
