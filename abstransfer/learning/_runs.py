"""
Runs on their way: what the loops read and write, and which loop takes which step.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from multiprocessing import parent_process
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import _fast, loop
from ._rng import STAMP, STARTS, next_word, seed_state
from ._simd import WIDTH
from ._tables import FastGuide, Tables, make_guide, pack, pack_guide
from .settings import Settings


class Setup(NamedTuple):
    """What does not change, shared by all runs of a learner."""

    settings: Settings
    rule: loop.Rule
    world: loop.World
    guide: loop.Guide
    tables: Tables | None  #: None: too large a world for the fast loop
    fast_guide: FastGuide | None


def set_up(settings: Settings) -> Setup:
    """Return the tables that these settings ask for."""
    mdp = settings.mdp
    world, tables = pack(mdp, settings.start)
    policy = settings.guide
    if policy is None:  # any will do: without a guide, tau is 0
        policy = np.full((mdp.n_states, mdp.n_actions), 1 / mdp.n_actions)
    guide = make_guide(policy, mdp.terminal)
    rule = loop.Rule(
        settings.alpha,
        settings.gamma,
        settings.explore,
        settings.max_episode,
        settings.tau,
        settings.strategy == "hard",
    )
    return Setup(settings, rule, world, guide, tables, tables and pack_guide(guide))


class RunState:
    """One run: its values, its luck, and what it has counted so far."""

    def __init__(self, setup: Setup, rng, q0: np.ndarray):
        settings, mdp = setup.settings, setup.settings.mdp
        self.q = _aligned((mdp.n_states, WIDTH if setup.tables else mdp.n_actions))
        self.q[:, : mdp.n_actions] = q0
        state = seed_state(rng)
        start = settings.start[
            (int(next_word(state[STARTS])) * len(settings.start)) >> 32
        ]
        place = np.array([start, settings.max_episode])
        self.ended = np.zeros(2, np.int64)
        self.plain = loop.Run(self.q, state, place, self.ended)
        if setup.tables:
            sets = np.zeros((mdp.n_states, 2), np.uint8)
            sets[:, 1] = mdp.allowed @ (1 << np.arange(mdp.n_actions))
            target, words = np.zeros(mdp.n_states), np.zeros(2 * _fast.BLOCK, np.int64)
            self.fast = _fast.FastRun(
                self.q.ravel(), target, sets.ravel(), state, place, self.ended, words
            )
            _fast.refresh(mdp.terminal, setup.tables, setup.rule, self.fast)
        self.who = np.zeros((settings.trace, 4), np.int64)
        self.what = np.zeros((settings.trace, 3))
        self.counts = []  # [goals, cuts] of each window
        self.copies = []  # of Q at the checkpoints

    def note(self, first: int, last: int, settings: Settings) -> None:
        """Write down what steps `first` to `last` brought, all of one window."""
        if (first - 1) % settings.window == 0:
            self.counts.append(np.zeros(2, np.int64))
        self.counts[-1] += self.ended
        self.ended[:] = 0
        if last in settings.checkpoints:
            self.copies.append(self.q[:, : settings.mdp.n_actions].copy())


class Together:
    """Runs that are at the same step: one, or up to three that take turns."""

    def __init__(self, setup: Setup, runs):
        self.setup = setup
        self.runs = [RunState(setup, rng, q0) for rng, q0 in runs]
        self.turns = self.runs
        if setup.tables and len(runs) == 2:  # a third that nobody asked for is cheaper
            self.turns = [*self.runs, RunState(setup, 0, setup.settings.q0)]
        self.n_steps = 0

    def advance(self, last: int) -> int:
        """Go on towards step `last`, to the next stop; return the steps taken."""
        settings = self.setup.settings
        first, stop = self.n_steps + 1, settings.next_stop(self.n_steps, last)
        if self.setup.tables is None or first <= settings.trace:
            self._plainly(first, stop)
        else:
            self._fast(first, stop)
        self.n_steps = stop
        for run in self.runs:
            run.note(first, stop, settings)
        return (stop - first + 1) * len(self.runs)

    def _plainly(self, first: int, last: int) -> None:
        settings, rule, world, guide, tables, _ = self.setup
        for run in self.runs:
            record = run.who[first - 1 :], run.what[first - 1 :]
            loop.learn(first, last, world, guide, rule, run.plain, *record)
            if tables:
                _fast.refresh(settings.mdp.terminal, tables, rule, run.fast)

    def _fast(self, first: int, last: int) -> None:
        _, rule, _, _, tables, guide = self.setup
        tau = None if rule.hard else rule.tau
        if first > rule.tau:
            guide = tau = None
        advance = _fast.advance_one if len(self.turns) == 1 else _fast.advance_three
        turns = (run.fast for run in self.turns)
        advance(first, last, guide, tau, tables, rule, *turns)


@cache
def say_if_compiling() -> None:
    """
    Say on stderr that the first call takes longer, where no cache is found.

    Silent in a notebook, which shows that it works and stores words, and in worker
    processes, for which their parent speaks once.
    """
    if "ipykernel" in sys.modules or parent_process():
        return
    stats = getattr(_fast.advance_one, "stats", None)
    if stats is None:
        text = "numba is disabled: learning takes a thousand times as long"
    elif stats.cache_path is None:
        text = (
            "compiling the learning loops, at each start: no folder to keep them in"
            " can be written; set NUMBA_CACHE_DIR to one"
        )
    elif any(STAMP in path.read_bytes() for path in _kept(stats.cache_path)):
        return
    else:
        text = "compiling the learning loops, once; it takes some seconds"
    print(f"abstransfer: {text}", file=sys.stderr)


def _kept(folder: str) -> Iterator[Path]:
    """Return the files that say which of the fast loops are kept."""
    return Path(folder).glob("_fast.advance_*.nbi")


def _aligned(shape: tuple[int, int]) -> np.ndarray:
    """Return -inf in this shape, so that a row of eight is one line of the cache."""
    block = np.full(shape[0] * shape[1] + 8, -np.inf)
    skip = -block.ctypes.data % 64 // 8
    return block[skip : skip + shape[0] * shape[1]].reshape(shape)
