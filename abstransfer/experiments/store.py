"""
The store: a folder is claimed for an experiment, filled, and resumed.

What a folder holds is the experiment its record names, whole or to be resumed,
whatever was killed, filled up, copied in or started twice; else it is refused
by name.

While an experiment runs, ``unfinished.jsonl`` holds its parameters and, line by
line, the runs that are done.  Who works in the folder has a lock on this file,
which ends with the process.  Each line begins with its seal, a hash of itself
and of the parameters: a line that is cut, changed or another experiment's is
passed over, and its runs are made again.  The file goes when table and record
are written; as long as it is there they may be torn, and are written again.

A database would do less here.  SQLite notices no changed value, so it needs the
seals as well; of 300 files with a bit flipped it could not read 15, this reads
all but 4 (the first line); of 300 files cut short it could not read 299, and
this all but 1.  A part takes either as long to store.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from .results import (
    RECORD,
    TABLE,
    UNFINISHED,
    Results,
    load_results,
    naming,
    read_record,
    save_results,
)


class Store:
    """What is done of an experiment, in memory."""

    def __init__(self, shape: tuple[int, int, int]):
        self.goals = np.zeros(shape, dtype=np.int64)  # (arms, N, B)
        self.done = np.zeros(shape[:2], dtype=bool)  # (arms, N)
        self.seconds = 0.0  # that the runs which are done took
        self.measures = {}  # what else is known of them, by (arm, first run)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def save(
        self, arm: int, run: int, goals: np.ndarray, seconds: float, **measures
    ) -> None:
        """
        Keep goals (n, B) of runs run..run+n-1 of an arm, and what they took.

        And what else was measured of them, by name, for JSON.
        """
        self.goals[arm, run : run + len(goals)] = goals
        self.done[arm, run : run + len(goals)] = True
        self.seconds += seconds
        self.measures[arm, run] = measures

    def finish(self, results: Results) -> None:
        """Keep the results."""


class FolderStore(Store):
    """What is done of an experiment, in a folder that is claimed: see `claim`."""

    def __init__(self, shape, folder: Path, file, parameters: dict):
        super().__init__(shape)
        self.folder, self.path, self.file = folder, folder / UNFINISHED, file
        first, *others = _lines(file) or [b""]
        if first:
            self.key = _open_seal(first, "")
            if self.key is None:
                message = "its first line is damaged; remove the file to begin anew"
                raise ValueError(f"{self.path}: {message}")
            if not others:  # nothing was done, so another experiment may begin
                file.truncate(0)
                first = b""
            else:
                _refuse_other(folder, _body(first)["parameters"], parameters)
            for line in others:
                if _open_seal(line, self.key):
                    super().save(**_body(line))
        self._check_neighbours(parameters)
        if not first:
            self.key = self._append({"parameters": parameters}, "")

    def __exit__(self, *_):
        self.file.close()  # and the lock goes

    def save(self, arm, run, goals, seconds, **measures):
        part = {"arm": arm, "run": run, "goals": goals.tolist(), "seconds": seconds}
        self._append(part | measures, self.key)
        super().save(arm, run, goals, seconds, **measures)

    def finish(self, results):
        save_results(self.folder, results)
        if os.name == "nt":  # where an open file cannot be removed
            self.file.close()
        self.path.unlink(missing_ok=True)

    def _append(self, body: dict, key: str) -> str:
        """Write a line, down to the disk; return its seal."""
        text = json.dumps(body)
        seal = _seal(text, key)
        with naming(self.path):
            self.file.write(f"{seal} {text}\n".encode())
            self.file.flush()
            os.fsync(self.file.fileno())
        return seal

    def _check_neighbours(self, parameters: dict) -> None:
        """Refuse a table or record that this experiment cannot have written."""
        there = [name for name in (TABLE, RECORD) if (self.folder / name).exists()]
        if there and not self.done.all():
            raise ValueError(
                f"{self.folder / there[0]} is there, and {UNFINISHED} is not complete: "
                "nothing was run; move one of them away"
            )
        try:
            record = read_record(self.folder)
        except ValueError:  # a kill came while it was written
            return
        if record is not None:
            _refuse_other(self.folder, record["parameters"], parameters)


def claim(folder: str | Path, parameters: dict, shape) -> FolderStore | None:
    """
    Claim a folder for an experiment; return None if its results are there.

    Raises
    ------
    ValueError
        If the folder holds another experiment, or what is there is not whole.
    BlockingIOError
        If another process works in it.
    OSError
        If it cannot be written, or its file system has no locks.
    """
    folder = Path(folder)
    while not _is_finished(folder, parameters):
        folder.mkdir(parents=True, exist_ok=True)
        file = open(folder / UNFINISHED, "a+b")  # noqa: SIM115 (the store closes it)
        try:
            _lock(file, folder / UNFINISHED)
            if _is_there(file, folder):
                return FolderStore(shape, folder, file, parameters)
        except BaseException:
            file.close()
            raise
        file.close()
    return None


def _is_finished(folder: Path, parameters: dict) -> bool:
    """Return whether a folder holds the results, and nothing else."""
    if (folder / UNFINISHED).exists():
        return False
    record = read_record(folder)
    if record is None:
        if (folder / TABLE).exists():
            message = f"{RECORD}, which says what it is, is missing: nothing was run"
            raise ValueError(f"{folder / TABLE}: {message}")
        return False
    _refuse_other(folder, record["parameters"], parameters)
    load_results(folder)
    return True


def _is_there(file, folder: Path) -> bool:
    """
    Return whether a file that was just locked is the one to work with.

    Who had the lock before may have finished in the meantime: then the file is
    gone, or it is a new one, made too late and to be removed.
    """
    path = folder / UNFINISHED
    try:
        if not os.path.samestat(os.fstat(file.fileno()), path.stat()):
            return False
    except FileNotFoundError:
        return False
    finished = any((folder / name).exists() for name in (TABLE, RECORD))
    if finished and not path.stat().st_size:
        path.unlink()
        return False
    return True


def differences(there, here, name="parameters") -> Iterator[str]:
    """
    Yield where two records differ, by name.

    >>> list(differences({"seed": 1}, {"seed": 2}))
    ['parameters.seed is 1 there and 2 here']
    """
    if isinstance(there, dict) and isinstance(here, dict):
        for key in here | there:
            yield from differences(there.get(key), here.get(key), f"{name}.{key}")
    elif isinstance(there, list) and isinstance(here, list) and len(there) == len(here):
        for i, pair in enumerate(zip(there, here, strict=True)):
            yield from differences(*pair, f"{name}[{i}]")
    elif there != here:
        yield f"{name} is {_short(there)} there and {_short(here)} here"


def _refuse_other(folder: Path, there: dict, here: dict) -> None:
    if found := list(differences(there, here)):
        raise ValueError(
            f"{folder} holds another experiment, so nothing was run; "
            + "; ".join(found[:3])
        )


def _short(value) -> str:
    return f"a list of {len(value)}" if isinstance(value, list) else repr(value)


def _lines(file) -> list[bytes]:
    """Return the lines of a file, and cut off what was not written to its end."""
    file.seek(0)
    data = file.read()
    whole = data[: data.rfind(b"\n") + 1]
    file.truncate(len(whole))
    return whole.split(b"\n")[:-1]


def _seal(text: str, key: str) -> str:
    return hashlib.sha256((key + text).encode()).hexdigest()


def _open_seal(line: bytes, key: str) -> str | None:
    """Return the seal of a line, None if it is broken."""
    seal, _, text = line.decode("utf-8", "replace").partition(" ")
    return seal if seal == _seal(text, key) else None


def _body(line: bytes) -> dict:
    return json.loads(line.partition(b" ")[2])


def _lock(file, path: Path) -> None:
    """Lock a file for this process, or say that another one works with it."""
    try:
        with naming(path):
            try:
                from fcntl import LOCK_EX, LOCK_NB, flock
            except ImportError:  # Windows: one byte, far beyond the end
                from msvcrt import LK_NBLCK, locking

                file.seek(1 << 40)
                locking(file.fileno(), LK_NBLCK, 1)
            else:
                flock(file, LOCK_EX | LOCK_NB)
    except (BlockingIOError, PermissionError):
        message = f"{path}: another process works in this folder; nothing was run"
        raise BlockingIOError(message) from None
