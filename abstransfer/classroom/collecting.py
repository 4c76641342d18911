"""
Run all notebooks of a folder again, and write tables: a row a student.

Nothing that was handed in is changed.  What each notebook said is kept in a file beside
the table, so that a rerun goes on where it was stopped; a notebook that was handed in
anew is run anew.
"""

from __future__ import annotations

import csv
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path

from .._interrupts import ends_in_time, interrupts_noted
from ..exercises._model import all_exercises, first_of, page_of
from .handed_in import files_of

LAST = ("predictions", "cards", "same code as")
SHOWN = {"not checked": "answered", "no answer yet": "", "hint": ""}
PRIVATE = ("--user", "--map-root-user", "--net", "--pid", "--fork", "--kill-child")


def collect(
    folder: Path,
    table: Path,
    *,
    seconds: int = 600,
    cell_seconds: int = 120,
    megabytes: int = 4096,
    tell: Callable[[str], None] = lambda text: None,
) -> list[dict]:
    """
    Run the notebooks of a folder and write what their exercises said.

    Parameters
    ----------
    folder, table : Path
        What was handed in, at any depth; the CSV file to write.  Beside it are written
        the misconceptions (``_misconceptions.csv``) and what was run (``.jsonl``).
    seconds, cell_seconds : int
        How long a notebook, and a cell of it, may take.
    megabytes : int
        Memory of each process, where the system has such a limit.
    tell : function of str
        Is told each notebook as it is done.

    Returns
    -------
    list of dict
        What was said, by notebook, in the order of their names.

    Raises
    ------
    ValueError
        If there is no notebook in the folder.
    """
    folder, table = Path(folder), Path(table)
    paths = files_of(folder, "*.ipynb")
    if not paths:
        raise ValueError(f"{folder} holds no notebook")
    kept = table.with_suffix(".jsonl")
    known = {(said["file"], said["sha256"]): said for said in _lines(kept)}
    shut, found = shut_off(), []
    for path in paths:
        name = path.relative_to(folder).as_posix()
        key = name, hashlib.sha256(path.read_bytes()).hexdigest()
        if key not in known:
            said = _run(path, shut, seconds, cell_seconds, megabytes)
            known[key] = {"file": name, "sha256": key[1], **said}
            with kept.open("a", encoding="utf-8") as file:
                file.write(json.dumps(known[key]) + "\n")
        found.append(known[key])
        _write(table, _rows(found))  # each time: who stops it has what is known
        _write(second_of(table), _mistakes(found))
        tell(f"{name}: {_outcome(known[key])}")
    return found


def second_of(table: Path) -> Path:
    """Return the file of the second table, which counts misconceptions."""
    return table.with_name(f"{table.stem}_misconceptions.csv")


def shut_off() -> list[str]:
    """Return the words before a command that take the network from it, if any can."""
    words = ["unshare", *PRIVATE]
    if not shutil.which("unshare"):
        return []
    works = subprocess.run([*words, "true"], capture_output=True).returncode == 0
    return words if works else []


def _run(path, shut, seconds, cell_seconds, megabytes) -> dict:
    """Return what a notebook said, run in an empty folder that is thrown away."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
        out = Path(place, "said")
        copy = shutil.copy(path, Path(place, "handed_in.ipynb"))
        limits = [str(cell_seconds), str(megabytes)]
        package = str(Path(__file__).parents[2])
        others = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
        with interrupts_noted() as heard:
            process = subprocess.Popen(
                [*shut, sys.executable, "-m", f"{__package__}.worker", copy, out]
                + limits,
                cwd=place,
                env=os.environ
                | {"PYTHONPATH": os.pathsep.join(others), "MPLBACKEND": "agg"},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
            late = not ends_in_time(process, seconds, heard)
            _stop(process)
        said = [{"outcome": "could not be run"}, *_lines(out)][-1]
    if late:
        said["outcome"] = f"stopped after {seconds} s"
    elif process.returncode:
        said["outcome"] = f"{said['outcome']}, then broke off"
    return said


def _stop(process) -> None:
    """End a process and what it started."""
    if process.poll() is None:
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        process.kill()
        process.wait()


def _lines(path: Path) -> list[dict]:
    """Return the records of a file; a line that was cut off is none."""
    found = []
    for line in path.read_text("utf-8").splitlines() if path.exists() else ():
        try:
            found.append(json.loads(line))
        except ValueError:
            continue
    return found


def _order(key: str) -> tuple:
    _, page, number = first_of(key).split("-")
    return int(page), int(number), key


def _rows(found: list[dict]) -> Iterable[list]:
    """Yield the head of the table and a row for each notebook."""
    keys = {key for said in found for key in said.get("asked", ())}
    keys = sorted(
        keys | {key for s in found for key in s.get("replies", ())}, key=_order
    )
    yield ["student", "file", "outcome", "right answers", *keys, *LAST]
    first = {}  # by digest, the first file with this code
    for said in found:
        shown, asked, outcome = _shown(said), said.get("asked", ()), _outcome(said)
        is_empty = outcome == "empty"
        same = "" if is_empty else first.setdefault(said.get("digest"), said["file"])
        yield [
            said.get("student") or Path(said["file"]).stem,
            said["file"],
            outcome,
            sum(verdict == "right" for verdict in shown.values()),
            *(shown.get(key, "not run" if key in asked else "-") for key in keys),
            said.get("predictions", ""),
            said.get("cards", ""),
            same if same != said["file"] and said.get("digest") else "",
        ]


def _shown(said: dict) -> dict[str, str]:
    """Return what the table says of each exercise that a notebook checked."""
    return {
        key: SHOWN.get(verdict, verdict) + (f": {mistake}" if mistake else "")
        for key, (verdict, mistake) in said.get("replies", {}).items()
    }


def _outcome(said: dict) -> str:
    """Return how a notebook ran, or that no blank of it was filled."""
    is_empty = said["outcome"] == "ran" and not any(_shown(said).values())
    return "empty" if is_empty else said["outcome"]


def _mistakes(found: list[dict]) -> Iterable[list]:
    """Yield the head of the second table and its rows, the commonest mistake first."""
    counts = Counter(
        (key, mistake)
        for said in found
        for key, (_, mistake) in said.get("replies", {}).items()
        if mistake
    )
    tasks = {exercise.key: exercise.task for exercise in all_exercises()}
    yield ["exercise", "misconception", "students", "of", "reread", "what was asked"]
    for (key, mistake), n in sorted(
        counts.items(), key=lambda x: (-x[1], _order(x[0][0]))
    ):
        of = sum(key in said.get("asked", ()) for said in found)
        yield [key, mistake, n, of, f"page {page_of(key)}", tasks.get(key, "")]


def _write(path: Path, rows: Iterable[list]) -> None:
    """Write a table that a spreadsheet opens; a cell is never a formula."""
    new = path.with_name(f"{path.name}.new")
    with new.open("w", encoding="utf-8-sig", newline="") as file:
        csv.writer(file).writerows([_text(cell) for cell in row] for row in rows)
    new.replace(path)


def _text(cell) -> str:
    """
    Return a cell as text that no spreadsheet takes for a formula.

    >>> [_text(cell) for cell in ("=1+1", "-1", "-", "", 3)]
    ["'=1+1", "'-1", '-', '', '3']
    """
    text = str(cell)
    is_formula = text.startswith(("=", "+", "@", "-")) and text != "-"
    return f"'{text}" if is_formula else text
