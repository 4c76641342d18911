"""Other machines: where nothing may be written, no HOME, two processes at once."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import abstransfer
from abstransfer.cli import doctor, main

LEARN = ("learn", "--steps", "2000", "--seed", "1", "--json")


@pytest.fixture(scope="module")
def sealed(tmp_path_factory):
    """A folder with the package, in which no loop can be kept, not even by root."""
    folder = tmp_path_factory.mktemp("sealed")
    package = Path(abstransfer.__file__).parent
    out = shutil.ignore_patterns("__pycache__")
    shutil.copytree(package, folder / "abstransfer", ignore=out)
    shutil.copytree(package.parent / "data", folder / "data")
    (folder / "abstransfer" / "learning" / "__pycache__").touch()  # is no folder
    (folder / "no-home").touch()
    return folder


def begin(sealed, *arguments, **variables):
    """Start a command of the sealed package, where no folder is a user's."""
    env = {key: os.environ[key] for key in ("PATH", "SYSTEMROOT") if key in os.environ}
    env |= {"PYTHONPATH": str(sealed), "PYTHONSAFEPATH": "1"}
    env |= dict.fromkeys(("HOME", "XDG_CACHE_HOME"), str(sealed / "no-home"))
    return subprocess.Popen(
        [sys.executable, "-m", "abstransfer", *arguments],
        env={**env, **{key: str(value) for key, value in variables.items()}},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )


def ended(process):
    """What a command said: goals of each window, or checks by name; and stderr."""
    out, err = process.communicate()
    told = json.loads(out)
    if isinstance(told, dict):
        assert process.returncode == 0
        return told["per_window"], err
    return {check["name"]: check for check in told}, err


def undisturbed(capsys):
    main(list(LEARN))
    return json.loads(capsys.readouterr().out)["per_window"]


def test_where_no_folder_can_be_written_it_learns_and_says_why_it_is_slow(
    sealed, capsys
):
    goals, said = ended(begin(sealed, *LEARN))
    checks, _ = ended(begin(sealed, "doctor", "--json"))

    assert goals == undisturbed(capsys)
    assert "at each start" in said
    assert "NUMBA_CACHE_DIR" in said
    assert not checks["compiled code"]["ok"]
    assert "NUMBA_CACHE_DIR" in checks["compiled code"]["remedy"]


@pytest.mark.parametrize("variable", ["HOME", "NUMBA_CACHE_DIR"])
def test_doctor_names_the_folder_that_is_made_for_what_is_compiled(
    sealed, variable, tmp_path
):
    there = {variable: tmp_path / "new"}
    if variable == "HOME":
        there["XDG_CACHE_HOME"] = tmp_path / "new"
    check = ended(begin(sealed, "doctor", "--json", **there))[0]["compiled code"]

    assert check["ok"]
    assert Path(check["found"]).is_relative_to(tmp_path / "new")


def test_two_processes_at_once_on_an_empty_cache_learn_the_same(
    sealed, tmp_path, capsys
):
    there = {"NUMBA_CACHE_DIR": tmp_path}
    both = [begin(sealed, *LEARN, **there) for _ in range(2)]
    wanted = undisturbed(capsys)

    for goals, said in map(ended, both):
        assert goals == wanted
        assert said.count("\n") <= 1, "one says that it compiles, or both"
    assert ended(begin(sealed, *LEARN, **there)) == (wanted, "")


def test_doctor_does_not_wait_for_ever():
    check = doctor.check_cache(patience=0)

    assert not check.ok
    assert check.remedy


def test_loops_that_are_told_not_to_compile_are_found(monkeypatch):
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    check = doctor.check_cache()

    assert not check.ok
    assert "NUMBA_DISABLE_JIT" in check.remedy
