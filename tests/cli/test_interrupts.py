"""Ctrl-C at any moment: one line, exit code 130, nothing left behind, no hang."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

import pytest
from support import PATIENCE, ROOT

SMALL = ("--scale", "page", "--target", "source", "--jobs", "2")
# When they are interrupted, at the latest: in times that Python takes to start, for
# these grow with what else the machine does.
COMMANDS = {
    "table1": (("table1",), 20),
    "learn": (("learn", "--guide", "nd", "--steps", "2e9"), 40),
    "experiment": (("experiment", *SMALL, "--runs", "36", "--out", "out"), 40),
    "tau-grid": (("experiment", *SMALL, "--tau-grid", "--out", "out"), 40),
    "figures": (("figures", "--out", "out"), 40),
    "doctor": (("doctor",), 10),
    "class": (("class", "collect", "handed-in", "--csv", "table.csv"), 40),
}
# Before a command begins Python itself starts, where no program can answer.
TELL = """
import os
from abstransfer import cli
begin = cli._open_streams

def tell():
    os.write(1, b"begun")
    begin()

cli._open_streams = tell
cli.program()
"""
INTERRUPTED = "abstransfer: interrupted"
BEFORE = ("abstransfer: compiling", "this may take about")  # may be said before
# For each command at each check; in the night: make nightly
N = int(os.environ.get("INTERRUPTS", 1))


def interrupt(arguments, when, folder):
    """Interrupt a command that has begun; return exit code and stderr."""
    began = time.monotonic()
    process = subprocess.Popen(
        [sys.executable, "-c", TELL, *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(folder)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    assert os.read(process.stdout.fileno(), 5) == b"begun"
    with suppress(subprocess.TimeoutExpired):
        process.wait(when * (time.monotonic() - began))
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all of them
    try:
        # Until all that write there have ended.
        _, err = process.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return None, process.communicate()[1].decode()
    return process.returncode, err.decode()


def left_in(folder):
    """Return the processes at work in a folder, after a while at most; on Linux."""
    for _ in range(PATIENCE):
        left = []
        for place in Path("/proc").glob("[0-9]*/cwd"):
            with suppress(OSError):  # it has ended
                if os.readlink(place).startswith(str(folder)):
                    left.append(place.parent.name)
        if not left:
            break
        time.sleep(0.1)
    return left


def kind_of(code, err):
    """Return what became of a command that was interrupted."""
    lines = [line for line in err.splitlines() if not any(w in line for w in BEFORE)]
    if code == 130 and len(lines) == 1 and lines[0].startswith(INTERRUPTED):
        return "one line and 130"
    if code == 0 and not lines:
        return "over before"
    return "wrong"


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as on Unix")
@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.timeout(60 * max(N, 10))
def test_ctrl_c_at_any_moment_ends_a_command_with_one_line(tmp_path, name):
    arguments, latest = COMMANDS[name]
    (tmp_path / "handed-in").mkdir()
    shutil.copy(ROOT / "book" / "12_your_turn.ipynb", tmp_path / "handed-in")
    rng, seen, wrong = random.Random(f"{name}{N}"), Counter(), []
    for _ in range(N):
        when = rng.uniform(0, latest)
        code, err = interrupt(arguments, when, tmp_path)
        left = left_in(tmp_path)
        kind = "wrong" if left else kind_of(code, err)
        seen[kind] += 1
        if kind == "wrong":
            wrong.append((round(when, 3), code, left, err[-1500:]))

    print(name, dict(seen), *wrong)
    assert not wrong, f"{len(wrong)} of {N}"


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as on Unix")
def test_ctrl_c_is_heard_where_an_exception_would_be_dropped():
    """As in what ends an object: Python prints an exception there, and goes on."""
    interrupted_there = """
import os, signal
from abstransfer import cli

class Fleeting:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)

cli._open_streams = lambda: Fleeting() and None
cli.program()
"""
    command = [sys.executable, "-c", interrupted_there, "doctor"]
    done = subprocess.run(command, capture_output=True, encoding="utf-8")

    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr == f"{INTERRUPTED}\n"


def test_a_command_begins_before_what_takes_time_is_imported():
    """Until then Ctrl-C is a traceback of Python's."""
    look = (
        "import sys; import abstransfer; before = set(sys.modules);"
        "import abstransfer.cli; print(*(set(sys.modules) - before))"
    )
    told = subprocess.check_output([sys.executable, "-c", look], encoding="utf-8")
    signals = {"signal", "enum", "functools", "collections", "operator", "types"}

    assert {name for name in told.split() if "_" not in name} - signals <= {
        "abstransfer.cli",
        "itertools",
        "keyword",
        "reprlib",
    }
