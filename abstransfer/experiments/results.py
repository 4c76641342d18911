"""
Results on disk: a table, the record of what made it, and parts on the way.

A folder holds ``goals.csv.gz`` (arm, tau, run, window, goals; byte-stable) and
``experiment.json``.  While an experiment runs, ``parts/`` holds what is done.
Every file is written under another name first and then put in its place, so a
kill at any moment leaves whole files only.
"""

from __future__ import annotations

import gzip
import io
import json
import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .._paths import DATA
from .arms import Arm

TABLE, RECORD, PARTS = "goals.csv.gz", "experiment.json", "parts"
HEADER = "arm,tau,run,window,goals"


class Results(NamedTuple):
    """Goals of every arm, run and window, and what made them."""

    arms: tuple[Arm, ...]
    goals: np.ndarray  # (arms, N runs, B windows) goals reached
    record: dict  # parameters, versions, seconds: experiment.json

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


def save_results(folder: str | Path, results: Results) -> None:
    """Write table and record into a folder, which is made if need be."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    _write(folder / TABLE, _table(results))
    write_record(folder, results.record)


def load_results(folder: str | Path) -> Results:
    """
    Return the results in a folder.

    Raises
    ------
    FileNotFoundError
        If there are none, or the experiment has not finished.
    ValueError
        If the table is not the one that the record speaks of.
    """
    folder = Path(folder)
    record = read_record(folder)
    if record is None:
        raise FileNotFoundError(f"{folder}: no results here ({RECORD} is missing)")
    if not (folder / TABLE).is_file():
        raise FileNotFoundError(f"{folder}: the experiment has not finished; resume it")
    parameters = record["parameters"]
    arms = tuple(
        Arm(**{f: a[f] for f in Arm._fields if f in a}) for a in parameters["arms"]
    )
    n_windows = parameters["steps"] // parameters["window"]
    shape = len(arms), parameters["runs"], n_windows
    with gzip.open(folder / TABLE, "rt", encoding="ascii") as file:
        lines = file.read().split("\n")
    keys = _keys(arms, shape)
    rows = [line.rpartition(",") for line in lines[1:-1]]
    if lines[0] != HEADER or [key for key, _, _ in rows] != keys:
        raise ValueError(f"{folder / TABLE}: not the table that {RECORD} speaks of")
    goals = np.array([int(value) for _, _, value in rows]).reshape(shape)
    return Results(arms, goals, record)


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


def read_record(folder: Path) -> dict | None:
    """Return the record of a folder, None if it has none."""
    try:
        return json.loads((Path(folder) / RECORD).read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except ValueError as error:
        raise ValueError(f"{Path(folder) / RECORD}: not JSON ({error})") from None


def write_record(folder: Path, record: Mapping) -> None:
    """Write the record of a folder, which is made if need be."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    _write(Path(folder) / RECORD, (json.dumps(record, indent=1) + "\n").encode())


def save_part(folder: Path, arm: int, run: int, goals: np.ndarray, seconds: float):
    """Store goals (n, B) of runs run..run+n-1 of an arm, and the seconds they took."""
    (Path(folder) / PARTS).mkdir(exist_ok=True)
    buffer = io.BytesIO()
    np.savez(buffer, goals=goals, seconds=seconds)
    name = f"{arm:03d}-{run:04d}-{len(goals):04d}.npz"
    _write(Path(folder) / PARTS / name, buffer.getvalue())


def load_parts(folder: Path, goals: np.ndarray) -> tuple[np.ndarray, float]:
    """
    Fill goals (arms, N, B) with the parts there are.

    Returns which runs are done, (arms, N) bool, and the seconds they took.
    """
    done, total = np.zeros(goals.shape[:2], dtype=bool), 0.0
    for path in sorted((Path(folder) / PARTS).glob("*.npz")):
        if re.fullmatch(r"\d{3}-\d{4,}-\d{4,}", path.stem):
            arm, run, n = map(int, path.stem.split("-"))
            with np.load(path) as part:
                goals[arm, run : run + n] = part["goals"]
                total += float(part["seconds"])
            done[arm, run : run + n] = True
    return done, total


def remove_parts(folder: Path) -> None:
    """Remove the parts, once the table holds them."""
    shutil.rmtree(Path(folder) / PARTS, ignore_errors=True)


def _table(results: Results) -> bytes:
    """Return the compressed table: the same bytes for the same goals."""
    keys = _keys(results.arms, results.goals.shape)
    values = results.goals.ravel().tolist()
    rows = [f"{key},{value}" for key, value in zip(keys, values, strict=True)]
    text = "\n".join([HEADER, *rows, ""])
    buffer = io.BytesIO()
    with gzip.GzipFile("", "wb", compresslevel=9, fileobj=buffer, mtime=0) as file:
        file.write(text.encode("ascii"))
    return buffer.getvalue()


def _keys(arms, shape) -> list[str]:
    """Return all columns but the last, for each row of the table."""
    _, n_runs, n_windows = shape
    return [
        f"{arm.name},{arm.tau},{run},{window}"
        for arm in arms
        for run in range(n_runs)
        for window in range(n_windows)
    ]


def _write(path: Path, data: bytes) -> None:
    """Put data into a file: all of it, or nothing."""
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with open(draft, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)
