"""Ctrl-C at any moment: one line, exit code 130, nothing left behind, no hang."""

import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from contextlib import suppress

import pytest
from support import PATIENCE

SMALL = ("--scale", "page", "--target", "source", "--jobs", "2")
COMMANDS = {  # and the seconds in which they are interrupted
    "table1": (("table1",), 3),
    "learn": (("learn", "--guide", "nd", "--steps", "2e9"), 6),
    "experiment": (("experiment", *SMALL, "--runs", "36"), 8),
    "tau-grid": (("experiment", *SMALL, "--tau-grid"), 8),
    "figures": (("figures",), 6),
    "doctor": (("doctor",), 1),
}
SAID = ("abstransfer: interrupted", "abstransfer: compiling")
LONG = "this may take about"  # said before
# A few at each check; in the night: make nightly
N = int(os.environ.get("DISTURBANCES", 6))


def interrupt(name, seconds, folder):
    """Interrupt a command after some seconds; return exit code and stderr."""
    arguments, _ = COMMANDS[name]
    if name in ("experiment", "tau-grid", "figures"):
        arguments = (*arguments, "--out", str(folder))
    process = subprocess.Popen(
        [sys.executable, "-m", "abstransfer", *arguments],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        start_new_session=True,
    )
    time.sleep(seconds)
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all of them
    _, err = process.communicate(
        timeout=PATIENCE
    )  # until all that write there have ended
    return process.returncode, err


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as on Unix")
@pytest.mark.timeout(60 * max(N, 10))
def test_ctrl_c_at_any_moment_ends_a_command_with_one_line(tmp_path):
    rng, seen, wrong = random.Random(N), Counter(), []
    for i in range(N):
        name = list(COMMANDS)[i % len(COMMANDS)]
        seconds = rng.uniform(0.05, COMMANDS[name][1])
        code, err = interrupt(name, seconds, tmp_path / name)
        lines = [line for line in err.splitlines() if LONG not in line]
        ended = code == 0 and not lines  # it was over before
        right = code == 130 and [line.startswith(SAID) for line in lines] == [True]
        # Python itself was starting: the command had not begun.
        early = lines[-1:] in ([], ["KeyboardInterrupt"]) and ", in main" not in err
        early = early and code != 0
        kind = "over" if ended else "too early" if early else "interrupted"
        seen[kind] += 1
        if not (ended or early or right):
            wrong.append((name, round(seconds, 3), code, err[-1500:]))

    print(dict(seen), *wrong, sep="\n")
    assert not wrong, f"{len(wrong)} of {N}"
    assert seen["interrupted"]


def test_a_command_begins_before_what_takes_time_is_imported():
    """Until then Ctrl-C is a traceback."""
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
