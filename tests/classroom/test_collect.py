"""What a class handed in is run again, and comes out as two tables."""

import csv
import json

import pytest
from nbformat import write
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from abstransfer import parse_map
from abstransfer.classroom import collecting
from abstransfer.classroom.collecting import collect
from abstransfer.classroom.handed_in import (
    asked_in,
    cards_said,
    digest,
    predictions_said,
    replies_in,
    student_of,
    texts_of,
)
from abstransfer.exercises import Prediction, check
from abstransfer.project.card import card_text
from abstransfer.project.prediction import Prediction as Bet
from abstransfer.project.setup import Setup, run

SMALL = parse_map("+---+---+\n|. .d*  |\n+---+---+")
IMPORT = "from abstransfer.exercises import check"


def notebook(*code):
    return new_notebook(cells=[new_code_cell(source) for source in code])


def hand_in(folder, name, *code):
    write(notebook(*code), folder / f"{name}.ipynb")


def rows_of(path):
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


# Reading


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ('student = "Ann Lee"  # your name', "Ann Lee"),
        ("student='  Zoë  B '", "Zoë B"),
        ('student = "..."', ""),
        ("student = open('x')", ""),
        ('students = "Ann"', ""),
        ("student = 'Ann", ""),
    ],
)
def test_the_name_is_read_without_running_anything(line, name):
    assert student_of(notebook("import os", line)) == name


@pytest.mark.parametrize("key", ["ex-2-3", "ex-1-1"])
def test_a_reply_is_read_as_it_was_given_in_each_form(key):
    for answer in (..., 99, 1e9):
        reply = check(key, answer)
        for text in (repr(reply), reply._repr_markdown_()):
            (verdict, _) = replies_in(text)[key]
            assert verdict == reply.verdict


def test_the_name_of_a_mistake_is_read_across_lines():
    reply = check("ex-1-2", 99)

    assert "This looks like: *without the first payment*" in reply.text
    for text in (repr(reply), reply._repr_markdown_()):
        assert replies_in(text) == {"ex-1-2": ("not yet", "without the first payment")}


def test_what_a_cell_says_is_its_text_or_its_outputs():
    cell = new_code_cell("1")
    data = {"text/plain": "plain", "text/markdown": "**marked**"}
    cell.outputs = [new_output("stream", text="printed")]
    cell.outputs += [new_output("execute_result", data=data)]

    assert list(texts_of(cell)) == ["printed", "**marked**"]
    assert list(texts_of(new_markdown_cell("words"))) == ["words"]


def test_asked_is_what_code_checks_and_a_digest_forgets_the_name():
    one = notebook('student = "A"', 'check("ex-1-2", 1)\ncheck( "ex-1-2b")')
    two = notebook('student = "B"', 'check("ex-1-2", 1)\ncheck( "ex-1-2b")')
    other = notebook('student = "B"', 'check("ex-1-2", 2)\ncheck( "ex-1-2b")')

    assert asked_in(one) == ["ex-1-2", "ex-1-2b"]
    assert digest(one) == digest(two) != digest(other)


# Predictions


def predicted(direction, size, number=1):
    bet = Prediction("ex-10-1", direction, size, number)
    return repr(bet), bet


@pytest.mark.parametrize("form", [str, repr])
def test_a_prediction_and_what_came_of_it_are_read(form):
    said, bet = predicted("+", 0.05)

    assert predictions_said([said], [said, form(bet.compare(0.183))]) == (
        f"ex-10-1 {bet.seal}, direction +, at least 0.05: as predicted"
    )
    assert predictions_said([said], [said, form(bet.compare(-1))]).endswith(": refuted")


def test_the_last_of_several_predictions_counts_and_their_number_is_told():
    (first, _), (second, bet) = predicted("+", 1.0), predicted("0", 0.5, 2)

    assert predictions_said([], [first, second]) == (
        f"ex-10-1 {bet.seal}, no effect above 0.5 either way, the last of 2"
    )


def test_a_prediction_that_was_changed_after_the_run_is_told():
    (before, bet), (now, other) = predicted("+", 0.05), predicted("-", 0.05)

    assert predictions_said([before], [now]) == (
        f"ex-10-1 {other.seal}, direction -, at least 0.05, "
        f"but {bet.seal} was handed in"
    )
    assert predictions_said([before], []) == (
        f"ex-10-1 {bet.seal}, direction +, at least 0.05, not made again"
    )


def test_a_card_tells_what_was_predicted_on_it():
    setup = Setup(SMALL, guides=("eager", "rand"), runs=1, student="Ann")
    goals = run(setup).goals
    bet = Bet(2, "rand", "+", 5)

    assert cards_said([card_text(setup, goals)]) == "confirmed"
    assert cards_said([card_text(setup, goals, prediction=bet)]) == (
        f"confirmed, race 2, predicted rand +: {bet.compare(goals)}"
    )


# Running


def test_a_class_is_run_and_each_notebook_has_a_row_with_a_word(tmp_path):
    folder, table = tmp_path / "in", tmp_path / "out.csv"
    folder.mkdir()
    right = (IMPORT, 'answer = 100\ncheck("ex-1-2", answer)')
    bet = 'bet = predict("ex-10-1", direction="+", refuted_below=0.05)\nbet'
    bets = ("from abstransfer.exercises import predict", bet, "bet.compare(0.1)")
    hand_in(folder, "1_ann", 'student = "Ann"', *right, *bets)
    hand_in(folder, "2_bob", 'student = "Bob"', *right)
    hand_in(folder, "2_bob_copied", 'student = "Bea"', *right)
    wrong = ("nothing", IMPORT, 'check("ex-1-2", 99)', "import os\nos._exit(3)")
    hand_in(folder, "3_cy", 'student = "=Cy"', *wrong)
    hand_in(folder, "4_di", IMPORT, 'check("ex-1-2", ...)', "1 / 0")
    (folder / "5_torn.ipynb").write_text('{"cells": [', encoding="utf-8")
    (folder / "6_word.ipynb").write_bytes(b"PK\x03\x04\xff\xfe")
    before = {path: path.read_bytes() for path in folder.iterdir()}

    collect(folder, table)

    rows = rows_of(table)
    assert [row["student"] for row in rows] == [
        *("Ann", "Bob", "Bea", "'=Cy", "4_di", "5_torn", "6_word")
    ]
    assert [row["outcome"] for row in rows] == [
        "ran",
        "ran",
        "ran",
        "the kernel died",
        "raised ZeroDivisionError in code cell 3",
        "no notebook",
        "no notebook",
    ]
    wanted = [
        "right",
        "right",
        "right",
        "not yet: without the first payment",
        "",
        "-",
        "-",
    ]
    assert [row["ex-1-2"] for row in rows] == wanted
    assert [row["right answers"] for row in rows] == ["1", "1", "1", "0", "0", "0", "0"]
    sealed = "ex-10-1 6412c89f, direction +, at least 0.05: as predicted"
    assert [row["predictions"] for row in rows] == [sealed, *[""] * 6]
    assert [row["same code as"] for row in rows] == ["", "", "2_bob.ipynb", *[""] * 4]
    assert rows_of(tmp_path / "out_misconceptions.csv") == [
        {
            "exercise": "ex-1-2",
            "misconception": "without the first payment",
            "students": "1",
            "of": "5",
            "reread": "page 1",
            "what was asked": "With discount 0.99 and a cost of 1 per step, what does "
            "a robot pay that never arrives?",
        }
    ]
    assert before == {path: path.read_bytes() for path in folder.iterdir()}


def test_a_cell_that_hangs_is_interrupted_and_named(tmp_path):
    hand_in(tmp_path, "a", "import time\nwhile True:\n    time.sleep(0.1)")

    [said] = collect(tmp_path, tmp_path / "out.csv", cell_seconds=5)

    assert said["outcome"] == "hung in code cell 1"


def test_a_notebook_that_cannot_be_interrupted_is_stopped(tmp_path):
    deaf = "while True:\n    try:\n        while True:\n            pass\n"
    hand_in(tmp_path, "a", f"{deaf}    except BaseException:\n        pass", "1")

    [said] = collect(tmp_path, tmp_path / "out.csv", cell_seconds=1000, seconds=20)

    assert said["outcome"] == "stopped after 20 s"


def test_a_notebook_is_run_without_the_network_where_that_can_be(tmp_path):
    if not collecting.shut_off():
        pytest.skip("this system cannot shut off the network")
    folder, table = tmp_path / "in", tmp_path / "out.csv"
    folder.mkdir()
    reach = "import socket\nsocket.create_connection(('127.0.0.1', 9), 5)"
    route = "\nprint(sum(1 for _ in open('/proc/net/route')) - 1, 'ways out')"
    hand_in(
        folder, "a", f"import socket{route}\nassert len(socket.if_nameindex()) == 1"
    )
    hand_in(folder, "b", reach)

    [first, second] = collect(folder, table, cell_seconds=90)

    assert first["outcome"] == "ran"
    assert second["outcome"] == "raised OSError in code cell 1"


# Going on


@pytest.fixture
def runs(monkeypatch):
    """The names of notebooks that were run, without running them."""
    names = []

    def fake(path, *limits):
        names.append(path.stem)
        if path.stem == "stop":
            raise KeyboardInterrupt
        replies = {"ex-2-3": ["right", ""], "ex-10-1": ["not checked", ""]}
        said = {"student": path.stem, "digest": path.stem, "outcome": "ran"}
        return said | {"replies": replies, "asked": ["ex-2-3", "ex-10-1", "ex-2-1"]}

    monkeypatch.setattr(collecting, "_run", fake)
    return names


def test_a_rerun_goes_on_where_it_was_stopped(tmp_path, runs):
    folder, table = tmp_path / "in", tmp_path / "out.csv"
    folder.mkdir()
    for name in ("a", "b", "stop"):
        hand_in(folder, name, name)
    with pytest.raises(KeyboardInterrupt):
        collect(folder, table)
    assert [row["student"] for row in rows_of(table)] == ["a", "b"]
    kept = table.with_suffix(".jsonl")
    kept.write_text(kept.read_text("utf-8") + '{"file": "st', "utf-8")  # cut off
    (folder / "stop.ipynb").rename(folder / "z.ipynb")
    hand_in(folder, "a", "anew")

    collect(folder, table)

    assert runs == ["a", "b", "stop", "a", "z"]
    assert [row["student"] for row in rows_of(table)] == ["a", "b", "z"]


def test_columns_are_the_exercises_in_order_and_say_what_was_not_run(tmp_path, runs):
    folder, table = tmp_path / "in", tmp_path / "out.csv"
    (folder / ".ipynb_checkpoints").mkdir(parents=True)
    hand_in(folder, "a", "1")
    hand_in(folder / ".ipynb_checkpoints", "a", "1")

    collect(folder, table)

    [row] = rows_of(table)
    assert list(row)[4:7] == ["ex-2-1", "ex-2-3", "ex-10-1"]
    assert list(row.values())[3:7] == ["1", "not run", "right", "answered"]
    assert (
        json.loads(table.with_suffix(".jsonl").read_text("utf-8"))["file"] == "a.ipynb"
    )


def test_an_empty_folder_is_refused_by_name(tmp_path):
    with pytest.raises(ValueError, match=f"{tmp_path.name} holds no notebook"):
        collect(tmp_path, tmp_path / "out.csv")
