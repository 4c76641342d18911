"""The command line: what it prints, and how it refuses."""

import json
import subprocess
import sys

import pytest

from abstransfer.cli import main

COUNTS = {"cells": 135, "rooms": 11, "goals": 11, "abstract_states": 88}
VALUES = {"rand", "nd", "prob", "grad", "optimal", "uniform_available"}


def test_table1_prints_both_columns_beside_the_paper(capsys):
    code = main(["table1"])

    printed = capsys.readouterr().out
    assert code == 0
    row = next(line for line in printed.splitlines() if line.startswith("pi_AbsProb"))
    assert " ".join(row.split()[1:]) == "-36.25 -36.91 +1.8 % -70.23 -70.03 -0.3 %"
    assert "0.9 % of the target's states" in printed


def test_table1_json_has_the_promised_keys(capsys):
    main(["table1", "--json"])

    result = json.loads(capsys.readouterr().out)
    assert set(result) == {"source", "target", "unseen"}
    assert set(result["source"]) == set(result["target"]) == VALUES | set(COUNTS)
    assert {key: result["source"][key] for key in COUNTS} == COUNTS


def test_the_source_column_alone_needs_no_target(capsys):
    main(["table1", "--source-only", "--json", "--target", "no such map"])

    assert set(json.loads(capsys.readouterr().out)) == {"source"}


def test_options_reach_the_tasks(capsys):
    main(["table1", "--source-only", "--json", "--success", "1"])

    sure = json.loads(capsys.readouterr().out)["source"]["optimal"]
    assert sure == pytest.approx(-12.74, abs=0.01)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--source", "nowhere.txt"], "no map file 'nowhere.txt'"),
        (["--success", "1.5"], "success must satisfy 0 < success <= 1, got 1.5"),
        (["--near", "9"], "0 <= near <= almost_near must hold, got 9, 8"),
        (["--gamma", "1"], "gamma must satisfy 0 <= gamma < 1, got 1.0"),
    ],
)
def test_bad_input_ends_with_a_message_and_code_2(arguments, message, capsys):
    code = main(["table1", *arguments])

    captured = capsys.readouterr()
    assert code == 2
    assert message in captured.err
    assert captured.out == ""


def test_a_bad_map_is_refused_with_file_row_and_column(tmp_path, capsys):
    path = tmp_path / "hole.txt"
    path.write_text("+---+\n|  * \n+---+\n", encoding="utf-8")

    code = main(["table1", "--source", str(path)])

    assert code == 2
    message = capsys.readouterr().err
    assert f"{path}: row 2, column 5: the border has a hole" in message


def test_an_unknown_command_exits_with_2_and_no_traceback():
    run = [sys.executable, "-m", "abstransfer", "tabel1"]
    done = subprocess.run(run, capture_output=True, encoding="utf-8")

    assert done.returncode == 2
    assert "invalid choice: 'tabel1'" in done.stderr
    assert "Traceback" not in done.stderr


def test_output_cut_off_by_a_closed_pipe_is_no_error():
    run = f"{sys.executable} -m abstransfer table1 --source-only | head -n 1"
    done = subprocess.run(["sh", "-c", run], capture_output=True, encoding="utf-8")

    assert done.returncode == 0
    assert done.stderr == ""


def test_doctor_names_every_check_and_what_to_do(capsys):
    main(["doctor", "--json"])

    checks = json.loads(capsys.readouterr().out)
    assert {"python", "numpy"} <= {check["name"] for check in checks}
    assert all(check["ok"] or check["remedy"] for check in checks)
