"""
Try a whole class: hand a page out, let students answer, mark what comes back, pool.

    python scripts/class_trial.py OUT [--students 60] [--cards 8]

The students are made up.  Of each ten, three are right, three make mistakes that
`check` knows, and the others hand in a blank page, one that hangs, one that raises or
a copy, a file cut off, and no notebook.  The marking is killed once and goes on.  The
script fails if a row of the table is not what the student did, and prints the tables.
"""

from __future__ import annotations

import argparse
import copy
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_output
from plain_markdown import read_course
from student_edition import BOOK, KNOWN, student_edition

from abstransfer.project import Setup, building_of, card_text, run

PAGE = "02_solving"
KINDS = (
    *("right", "mistake", "right", "mistake", "right", "mistake"),
    *("empty", "hangs", "raises or copied", "cut off or no notebook"),
)
CHECK = re.compile(r'^check\("(ex-[\w-]+)", (\w+)\)$', re.MULTILINE)
BET = """\
from abstransfer.exercises import predict

bet = predict("ex-2-4", direction="0", refuted_below=0.01)
bet"""


def answered(handed_out, student: str, mistake: int | None):
    """Return a notebook with answers: right, or each with one of its known mistakes."""
    notebook = copy.deepcopy(handed_out)
    for cell in notebook.cells:
        if cell.cell_type != "code":
            continue
        cell.source = cell.source.replace('student = "..."', f'student = "{student}"')
        for key, name in CHECK.findall(cell.source):
            if key in KNOWN:
                code = _answer(KNOWN[key], name, mistake)
                cell.source = f'{code}\n\ncheck("{key}", {name})'
            else:
                text = "answer = 'They are all as good, for a tie says so.'"
                cell.source = cell.source.replace("answer = ...", text)
    return notebook


def _answer(exercise, name: str, mistake: int | None) -> str:
    if exercise.cases is None:
        wrong = exercise.wrong
        value = exercise.solution
        if mistake is not None:
            value = wrong[mistake % len(wrong)].answer
        return f"{name} = {value!r}"
    chosen = {}
    if mistake is not None:
        blank, lines = list(exercise.stub.blanks.items())[-1]
        names = [line for line in lines if line]
        chosen = {blank: names[mistake % len(names)]}
    return exercise.stub.filled(**chosen)


def hand_in(folder: Path, students: int, handed_out) -> dict[str, str]:
    """Write what a class hands in; return by file what its row must say."""
    wanted = {}
    for i in range(students):
        kind, student = KINDS[i % len(KINDS)], f"Student {i + 1:02}"
        turn = i // len(KINDS)
        mistake = i // 2 if kind == "mistake" else None
        notebook = answered(handed_out, student, mistake)
        if kind == "right":
            notebook.cells.append(new_code_cell(BET))
            notebook.cells.append(new_code_cell("bet.compare(0.0)"))
            notebook.cells.append(new_code_cell(f"my_number = {i}"))
        path = folder / f"{i + 1:02}.ipynb"
        wanted[path.name] = "ran"
        if kind == "empty":
            notebook, wanted[path.name] = handed_out, "empty"
        elif kind == "hangs":
            notebook.cells.insert(1, new_code_cell("while True:\n    pass"))
            wanted[path.name] = "hung in code cell"
        elif kind == "raises or copied" and turn % 2:
            notebook.cells.append(new_code_cell("print(no_such_name)"))
            wanted[path.name] = "raised NameError"
        elif kind == "raises or copied":
            of = folder / f"{i + 1 - 8:02}.ipynb"
            text = of.read_text("utf-8").replace(f"Student {i + 1 - 8:02}", student)
            path.write_text(text, encoding="utf-8")
            continue
        elif kind == "cut off or no notebook":
            text = nbformat.writes(notebook)
            text = text[: len(text) // 2] if turn % 2 else "%PDF-1.7 my answers"
            path.write_text(text, encoding="utf-8")
            wanted[path.name] = "no notebook"
            continue
        nbformat.write(notebook, path)
    return wanted


def hand_in_cards(folder: Path, cards: int) -> None:
    """Write result cards, each of a student's own building; the last one is forged."""
    for i in range(cards):
        student = f"Student {i + 1:02}"
        setup = Setup(building_of(student), guides=("nd",), runs=1, student=student)
        text = card_text(setup, run(setup).goals)
        if i == cards - 1:
            head, goals = re.search(r"(\| nd \| \S+ \| )(\d+)", text).groups()
            text = text.replace(head + goals, f"{head}{int(goals) + 1}")
        cell = new_code_cell("print(card)", outputs=[new_output("stream", text=text)])
        notebook = nbformat.v4.new_notebook(cells=[cell])
        nbformat.write(notebook, folder / f"{i + 1:02}.ipynb")


def call(*words, killed_after: Path | None = None) -> float:
    """Run the command; return its processor time in seconds, children's included."""
    before = os.times()
    command = [sys.executable, "-m", "abstransfer", "class", *map(str, words)]
    process = subprocess.Popen(command, start_new_session=True)
    while killed_after and process.poll() is None:
        lines = killed_after.read_text("utf-8") if killed_after.exists() else ""
        if lines.count("\n") >= 5:
            os.killpg(process.pid, signal.SIGKILL)
            break
        time.sleep(0.2)
    if process.wait() and not killed_after:
        raise SystemExit(f"failed: {words}")
    after = os.times()
    both = ("children_user", "children_system")
    return sum(getattr(after, x) - getattr(before, x) for x in both)


def rows_of(path: Path) -> list[dict]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("out", type=Path, help="folder to write to; it is emptied")
    parser.add_argument("--students", type=int, default=60)
    parser.add_argument("--cards", type=int, default=8)
    options = parser.parse_args(arguments)
    folder, table = options.out / "handed_in", options.out / "marks.csv"
    cards = options.out / "cards"
    shutil.rmtree(options.out, ignore_errors=True)
    folder.mkdir(parents=True)
    cards.mkdir()

    page = nbformat.read(BOOK / f"{PAGE}.ipynb", as_version=4)
    wanted = hand_in(folder, options.students, student_edition(page, read_course(BOOK)))
    kept = table.with_suffix(".jsonl")
    mark = ("collect", folder, "--csv", table)
    started = time.monotonic()
    used = call(*mark, killed_after=kept)
    done = len(kept.read_text("utf-8").splitlines())
    used += call(*mark)
    minutes = (time.monotonic() - started) / 60
    names = [json.loads(line)["file"] for line in kept.read_text("utf-8").splitlines()]

    rows = rows_of(table)
    failed = [
        (row["file"], row["outcome"], wanted[row["file"]])
        for row in rows
        if not row["outcome"].startswith(wanted[row["file"]])
    ]
    assert len(names) == len(set(names)) == len(rows) == options.students, names
    print("\nOutcomes:")
    outcomes = Counter(re.sub(r" in code.*", "", row["outcome"]) for row in rows)
    for outcome, n in outcomes.most_common():
        print(f"  {n:3}  {outcome}")
    copied = sum(bool(row["same code as"]) for row in rows)
    print(f"  {copied:3}  with the code of another")
    print(
        f"  {sum(bool(row['predictions']) for row in rows):3}  with a sealed prediction"
    )
    print("\nRight answers: ", Counter(int(row["right answers"]) for row in rows))
    print("\nThe commonest mistakes:")
    for row in rows_of(table.with_name("marks_misconceptions.csv"))[:10]:
        print(
            "  {students} of {of}  {exercise}: {misconception} ({reread})".format(**row)
        )
    print(f"\nKilled after {done} of {len(rows)}; none was run twice.")
    print(f"Marking: {minutes:.1f} min; {used / 60:.1f} min of processor time")

    hand_in_cards(cards, options.cards)
    wall = options.out / "wall.svg"
    claim = ("--robot", "nd", "--over", "none", "--figure", wall)
    started = time.monotonic()
    command = [sys.executable, "-m", "abstransfer", "class", "pool", cards, *claim]
    said = subprocess.check_output(command, encoding="utf-8")
    print(f"{said}Pooling: {(time.monotonic() - started) / 60:.1f} min")
    if said.count("left out") != 1:
        failed.append(("the forged card", "is not the one that is", "left out"))
    for each in failed:
        print("not as it should be:", *each, file=sys.stderr)
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
