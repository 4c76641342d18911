"""A folder of results is whole, can be resumed, or is refused by name."""

import errno
import gzip
import os
import re
import zlib
from concurrent.futures import Executor, Future
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import event, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from abstransfer import parse_map
from abstransfer.experiments import results, store
from abstransfer.experiments.arms import Arm, Scale
from abstransfer.experiments.plan import make_plan, parameters
from abstransfer.experiments.problem import Problem
from abstransfer.experiments.results import RECORD, TABLE, UNFINISHED, load_results
from abstransfer.experiments.run import run_experiment
from abstransfer.experiments.store import claim

ROOM = parse_map("+---+\n|.d*|\n+---+")
ARMS = (Arm("none", None, "hard", 0), Arm("led", "own", "hard", 30_000_000))
GUIDES = {"own": np.full((2048, 8), 1 / 8)}
SCALE, N_RUNS = Scale(90, 30), 7  # two jobs an arm
REWARDS = ("goal", "cost")  # of the two experiments
FILES = (TABLE, RECORD, UNFINISHED)


class AtOnce(Executor):
    """Does what it is given, in this process, when it is given."""

    def submit(self, function, job):
        future = Future()
        future.set_result(function(job))
        return future


def problem(reward):
    return Problem(ROOM, ROOM, reward=reward)


def start(folder, reward):
    options = {"scale": SCALE, "n_runs": N_RUNS, "guides": GUIDES, "out": folder}
    return run_experiment(ARMS, problem(reward), executor=AtOnce(), **options)


@cache
def plan(reward):
    return make_plan(ARMS, problem(reward), SCALE, N_RUNS, guides=GUIDES)


class Killed(BaseException):
    """A kill, seen from inside: from here on nothing reaches the disk."""


class Disk:
    """The disk below results and store: at the step `at` comes the `end`."""

    def __init__(self, at, end, cut=0.0):
        self.at, self.end, self.cut = at, end, cut

    def __enter__(self):
        self.patch = pytest.MonkeyPatch()
        for module in (results, store):  # found before the built-in one
            self.patch.setattr(module, "open", self.open, raising=False)
        unlink = Path.unlink
        self.patch.setattr(
            Path, "unlink", lambda path, **o: (self.step(path), unlink(path, **o))
        )
        return self

    def __exit__(self, *_):
        self.patch.undo()

    def step(self, path):
        """Count what is done to the disk: it ends for good."""
        self.at -= 1
        if self.at < 0:
            raise self.end(path)

    def open(self, path, mode):
        self.step(path)
        return File(self, open(path, mode))


class File:
    """A file on such a disk, whose last write may come halfway."""

    def __init__(self, disk, file):
        self.disk, self.file = disk, file

    def __getattr__(self, name):
        return getattr(self.file, name)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    def write(self, data):
        first = self.disk.at == 0
        try:
            self.disk.step(None)  # the system does not name the file
        except BaseException:
            self.file.write(data[: first * int(len(data) * self.disk.cut)])
            self.file.flush()
            raise
        self.file.write(data)


def full(path):
    return OSError(errno.ENOSPC, "No space left on device", path and str(path))


def denied(path):
    return PermissionError(errno.EACCES, "Permission denied", path and str(path))


def kill(path):
    return Killed()


@pytest.fixture(scope="module", autouse=True)
def undisturbed(tmp_path_factory):
    """Table and goals of both experiments, and their files at every stage."""
    global TABLES, DONORS
    TABLES, DONORS = {}, []
    for reward in REWARDS:
        folder = tmp_path_factory.mktemp(reward)
        start_half(folder / "half", reward)
        DONORS.append((UNFINISHED, (folder / "half" / UNFINISHED).read_bytes()))
        goals = start(folder / "whole", reward).goals
        TABLES[reward] = (folder / "whole" / TABLE).read_bytes(), goals
        for name in (TABLE, RECORD):
            DONORS.append((name, (folder / "whole" / name).read_bytes()))
    assert TABLES["goal"][0] != TABLES["cost"][0]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", lambda file: None)  # it is no power cut
        yield


def start_half(folder, reward):
    with Disk(4, full), pytest.raises(OSError, match="No space left"):
        start(folder, reward)


class Folder(RuleBasedStateMachine):
    """
    A folder of results, to which things happen that are nobody's fault.

    Whatever it is, the folder holds the table that its record names, to the byte,
    or is refused with a name.  And as long as nobody meddled with its files, a
    kill, a full disk or a second writer never make it refuse its own experiment.
    """

    def __init__(self):
        super().__init__()
        self.temporary = TemporaryDirectory()
        self.folder = Path(self.temporary.name) / "out"
        self.owner = None  # the reward of the experiment that was started first
        self.meddled = False

    def teardown(self):
        self.temporary.cleanup()

    def bytes(self):
        there = {name: self.folder / name for name in FILES}
        return {n: p.read_bytes() for n, p in there.items() if p.is_file()}

    def refused(self, error):
        """An error names a file, or the folder; no table or record was touched."""
        text = str(error)
        event("refused: " + re.sub(r"/\S+/|\d+", "", text)[:60])
        assert str(self.folder) in text, text
        assert isinstance(error, ValueError | OSError)

    def own(self, reward):
        """Whose the folder is, once something was done for an experiment."""
        there = self.bytes()
        if TABLE in there or there.get(UNFINISHED, b"").count(b"\n") > 1:
            self.owner = self.owner or reward

    # What people do

    @rule(reward=st.sampled_from(REWARDS))
    def start(self, reward):
        before = self.bytes()
        try:
            found = start(self.folder, reward)
        except (ValueError, OSError) as error:
            self.refused(error)
            found = None
        if found is None:
            assert self.meddled or self.owner not in (None, reward), "its own"
            for name in (TABLE, RECORD):
                assert self.bytes().get(name) == before.get(name)
            return
        assert self.meddled or self.owner in (None, reward)
        table, goals = TABLES[reward]
        np.testing.assert_array_equal(found.goals, goals)
        assert self.bytes()[TABLE] == table
        assert sorted(os.listdir(self.folder)) == sorted((TABLE, RECORD))
        event("started, or resumed, and finished")
        self.owner, self.meddled = reward, False

    @rule(
        reward=st.sampled_from(REWARDS),
        at=st.integers(0, 11),
        cut=st.floats(0, 1),
        end=st.sampled_from((kill, kill, full, denied)),
    )
    def start_and_not_finish(self, reward, at, cut, end):
        try:
            with Disk(at, end, cut):
                start(self.folder, reward)
        except Killed:
            event("killed")
        except (ValueError, OSError) as error:
            self.refused(error)
        self.own(reward)

    @rule(reward=st.sampled_from(REWARDS), second=st.sampled_from(REWARDS))
    def start_twice(self, reward, second):
        try:
            first = claim(self.folder, parameters(plan(reward)), plan(reward).shape)
        except (ValueError, OSError) as error:
            return self.refused(error)
        if first is not None:
            self.own(reward)
            with first, pytest.raises(BlockingIOError, match="another process") as said:
                start(self.folder, second)
            self.refused(said.value)

    @rule()
    def remove_all(self):
        for name in self.bytes():
            (self.folder / name).unlink()
        self.owner, self.meddled = None, False

    # What holds at any time

    @invariant()
    def it_is_the_experiment_that_its_record_names_or_refused(self):
        try:
            found = load_results(self.folder)
        except (ValueError, OSError) as error:
            return self.refused(error)
        reward = found.record["parameters"]["reading"]["reward"]
        assert found.record["parameters"] == parameters(plan(reward))
        np.testing.assert_array_equal(found.goals, TABLES[reward][1])


class Meddled(Folder):
    """A folder of results, with which people meddle as well."""

    def meddle(self, name, data):
        self.folder.mkdir(exist_ok=True)
        (self.folder / name).write_bytes(data)
        self.meddled = True

    @rule(i=st.integers(0, 5))
    def copy_in(self, i):
        self.meddle(*DONORS[i])

    @rule(i=st.sampled_from((0, 3)), line=st.integers(0, 2))
    def copy_in_a_part(self, i, line):
        lines = DONORS[i][1].splitlines(keepends=True)
        there = self.bytes().get(UNFINISHED, b"")
        self.meddle(UNFINISHED, there + lines[line % len(lines)])

    @rule(name=st.sampled_from(FILES), share=st.floats(0, 1))
    def cut(self, name, share):
        if data := self.bytes().get(name):
            self.meddle(name, data[: int(share * len(data))])

    @rule(name=st.sampled_from(FILES), place=st.floats(0, 0.999), bit=st.integers(0, 7))
    def flip_a_bit(self, name, place, bit):
        if data := bytearray(self.bytes().get(name, b"")):
            data[int(place * len(data))] ^= 1 << bit
            self.meddle(name, bytes(data))

    @rule(row=st.integers(1, 42), goals=st.sampled_from(["0", "7", "-1", "31", "1_0"]))
    def edit_a_row(self, row, goals):
        if data := self.bytes().get(TABLE):
            try:
                lines = gzip.decompress(data).decode().split("\n")
            except (OSError, EOFError, ValueError, zlib.error):
                return
            lines[row] = lines[row].rpartition(",")[0] + "," + goals
            self.meddle(TABLE, gzip.compress("\n".join(lines).encode(), mtime=0))

    @rule(name=st.sampled_from(FILES))
    def remove(self, name):
        if name in self.bytes():
            (self.folder / name).unlink()
            self.meddled = True


def test_a_table_is_never_replaced_without_asking(tmp_path):
    """One that lies beside an unfinished experiment may be another's."""
    start_half(tmp_path, "goal")
    (tmp_path / TABLE).write_bytes(b"years of work")
    with pytest.raises(ValueError, match=f"{TABLE} is there, .* move one of them away"):
        start(tmp_path, "goal")

    assert (tmp_path / TABLE).read_bytes() == b"years of work"


def test_where_nothing_was_done_another_experiment_may_begin(tmp_path):
    """Who stopped a command that asked for too much gives a smaller one."""
    with claim(tmp_path, parameters(plan("goal")), plan("goal").shape):
        pass

    np.testing.assert_array_equal(start(tmp_path, "cost").goals, TABLES["cost"][1])


# A share of what happens; in the night: make nightly
N = int(os.environ.get("DISTURBANCES", 0))
for machine in (Folder, Meddled):
    machine.TestCase.settings = settings(
        max_examples=N or 40, stateful_step_count=20, deadline=None, derandomize=not N
    )
TestFolder, TestMeddled = Folder.TestCase, Meddled.TestCase
