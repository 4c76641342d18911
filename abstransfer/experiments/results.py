"""
Finished results: a table, and the record of what made it.

A folder holds ``goals.csv.gz`` (arm, tau, run, window, goals; byte-stable) and
``experiment.json``, which has the sha256 of the table and of itself.  What does
not fit is refused by its name.  ``store`` fills such folders.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import math
import os
import zlib
from collections.abc import Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .._paths import DATA
from .arms import MOST_WINDOWS, Arm

TABLE, RECORD, UNFINISHED = "goals.csv.gz", "experiment.json", "unfinished.jsonl"
HEADER = "arm,tau,run,window,goals"
OVERHEAD = 1000  # bytes that packing adds at most to a text that cannot be packed
LARGEST_RECORD = 50_000_000  # bytes
NO_ARCHIVE = EOFError, OSError, zlib.error  # what unpacking raises


class Results(NamedTuple):
    """Goals of every arm, run and window, and what made them."""

    arms: tuple[Arm, ...]  #: what was compared
    goals: np.ndarray  #: (arms, N runs, B windows) goals reached
    record: dict  #: parameters, versions, seconds: experiment.json

    def curves(self, name: str, tau: int | None = None) -> np.ndarray:
        """
        Return the goals of one arm, (N, B); `tau` where a name has several.

        Raises KeyError naming the arms there are.
        """
        found = [
            i
            for i, arm in enumerate(self.arms)
            if arm.name == name and tau in (None, arm.tau)
        ]
        if len(found) != 1:
            known = ", ".join(f"{arm.name} (tau {arm.tau})" for arm in self.arms)
            raise KeyError(f"{len(found)} arms are {name!r} with tau {tau}: {known}")
        return self.goals[found[0]]

    def totals(self, name: str, tau: int | None = None) -> np.ndarray:
        """Return the goals of each whole run of one arm, (N,)."""
        return self.curves(name, tau).sum(axis=1)


def load_results(folder: str | Path) -> Results:
    """
    Return the results in a folder.

    Raises
    ------
    FileNotFoundError
        If there are none, or the experiment has not finished.
    ValueError
        If table or record are not as they were written, or not one experiment's.
    """
    folder = Path(folder)
    if (folder / UNFINISHED).exists():
        raise FileNotFoundError(f"{folder}: the experiment has not finished; resume it")
    record, path = read_record(folder), folder / TABLE
    if record is None:
        raise FileNotFoundError(f"{folder}: no results here ({RECORD} is missing)")
    if not path.exists():
        raise ValueError(f"{path}: missing, though {RECORD} speaks of it")
    try:
        parts = _described(record)
    except (ArithmeticError, LookupError, TypeError, ValueError):
        raise ValueError(f"{folder / RECORD}: describes no table of goals") from None
    table = _read(path, _longest(*parts) + OVERHEAD)
    if _sha256(table) != record["sha256"][TABLE]:
        raise ValueError(
            f"{path}: not the table that {RECORD} speaks of, by its sha256"
        )
    try:
        return _parse(table, record, *parts)
    except (ArithmeticError, LookupError, TypeError, ValueError, *NO_ARCHIVE):
        message = f"{path}: not a table of goals as {RECORD} describes it"
        raise ValueError(message) from None


def read_results(name: str) -> Results:
    """
    Return the results that come with the package, by name.

    Raises FileNotFoundError naming those there are.

    >>> read_results("goal-target").goals.shape  # arms, runs, windows
    (9, 50, 60)
    """
    if name not in (names := stored_results()):
        raise FileNotFoundError(
            f"no results {name!r}; results that come with the package: "
            + (", ".join(names) or "none")
        )
    return load_results(DATA / "results" / name)


def stored_results() -> tuple[str, ...]:
    """Return the names of the results that come with the package."""
    tables = sorted((DATA / "results").glob(f"*/{TABLE}"))
    return tuple(path.parent.name for path in tables)


def save_results(folder: str | Path, results: Results) -> None:
    """Write table and record into a folder, which is made if need be."""
    folder, table = Path(folder), _table(results)
    folder.mkdir(parents=True, exist_ok=True)
    record = {k: v for k, v in results.record.items() if k != "sha256"}
    record["sha256"] = {TABLE: _sha256(table), RECORD: _sha256(_canonical(record))}
    _write(folder / TABLE, table)
    _write(folder / RECORD, (json.dumps(record, indent=1) + "\n").encode())


def read_record(folder: Path) -> dict | None:
    """Return the record of a folder, None if it has none; refuse a damaged one."""
    path = Path(folder) / RECORD
    try:
        data = _read(path, LARGEST_RECORD)
    except FileNotFoundError:
        return None
    try:
        record = json.loads(data)
    except (ValueError, RecursionError):
        raise ValueError(f"{path}: damaged, it is not JSON") from None
    sums = record.get("sha256") if isinstance(record, dict) else None
    if not isinstance(sums, dict) or not {TABLE, RECORD} <= set(sums):
        raise ValueError(f"{path}: not the record of a finished experiment (no sha256)")
    plain = {k: v for k, v in record.items() if k != "sha256"}
    if sums[RECORD] != _sha256(_canonical(plain)):
        raise ValueError(f"{path}: damaged or edited, by its sha256")
    return record


@contextmanager
def naming(path: Path):
    """Give errors of the system the name of the file that they speak of."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


def _read(path: Path, most: int) -> bytes:
    """Return the bytes of a file; refuse one that is too large, without reading it."""
    with open(path, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        if size > most:
            raise ValueError(f"{path}: {size:,} bytes, where at most {most:,} can be")
        return file.read(size)


def _described(record: Mapping) -> tuple[tuple[Arm, ...], tuple[int, int, int], int]:
    """Return what the table must hold: arms, shape and steps of a window."""
    parameters = record["parameters"]
    arms = tuple(
        Arm(**{f: a[f] for f in Arm._fields if f in a}) for a in parameters["arms"]
    )
    runs, window = parameters["runs"], parameters["window"]
    shape = len(arms), runs, parameters["steps"] // window
    if not 0 < math.prod(shape) <= MOST_WINDOWS:
        raise ValueError(f"arms, runs, windows must be few, got {shape}")
    return arms, shape, window


def _longest(arms, shape: tuple[int, int, int], window: int) -> int:
    """Return how many bytes a table has at most."""
    row = max(len(f"{arm.name},{arm.tau},{shape[1:]},{window}") for arm in arms)
    return len(HEADER) + math.prod(shape) * row


def _parse(table: bytes, record: Mapping, arms, shape, window: int) -> Results:
    """Return the results that a table holds; raise if it is not just as written."""
    # A small file can unpack to a very large one: read no more than there may be.
    with gzip.open(io.BytesIO(table)) as file:
        text = file.read(_longest(arms, shape, window) + 1).decode("ascii")
    values = [int(line.rpartition(",")[2]) for line in text.split("\n")[1:-1]]
    goals = np.array(values, dtype=np.int64).reshape(shape)
    if goals.min() < 0 or goals.max() > window:
        raise ValueError("more goals than steps, or fewer than none")
    if text != _text(arms, goals):
        raise ValueError("rows are not those of the experiment, one after another")
    return Results(arms, goals, {k: v for k, v in record.items() if k != "sha256"})


def _table(results: Results) -> bytes:
    """Return the compressed table: the same bytes for the same goals."""
    buffer = io.BytesIO()
    with gzip.GzipFile("", "wb", compresslevel=9, fileobj=buffer, mtime=0) as file:
        file.write(_text(results.arms, results.goals).encode("ascii"))
    return buffer.getvalue()


def _text(arms, goals: np.ndarray) -> str:
    """Return the table as text: a row for each arm, run and window."""
    lines = [HEADER]
    for arm, runs in zip(arms, goals.tolist(), strict=True):
        for run, windows in enumerate(runs):
            row = f"{arm.name},{arm.tau},{run}"
            lines += [f"{row},{window},{n}" for window, n in enumerate(windows)]
    return "\n".join([*lines, ""])


def _canonical(record: Mapping) -> bytes:
    return json.dumps(record, sort_keys=True).encode()


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _write(path: Path, data: bytes) -> None:
    """Write a file, down to the disk."""
    with naming(path), open(path, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
