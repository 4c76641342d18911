"""
Who takes part: our loops, the C loop, plain Python, and other libraries.

A contestant has ``n_runs`` and either ``advance(first, last)``, which takes these
steps of its runs, or ``seconds(first, last)``, which says how long they took.
"""

from __future__ import annotations

import importlib.util
import os
import time
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from importlib import metadata
from multiprocessing import get_context

import peers
import yardstick

from abstransfer import navigation_tasks, parse_map, read_map, uniform_policy
from abstransfer.learning._runs import Together, set_up
from abstransfer.learning.settings import Settings

STEPS = 1_000_000  # a round of a compiled loop; thirty rounds are a run of the paper
SLOW_STEPS = 2_000  # a round of an interpreted one
SMALL = """
+---------+-----+
|. . . . .d    *|
|         |     |
|. . . . .|     |
|         |     |
|. . . . .|     |
|         |     |
|. . . . .|     |
+---------+-----+
"""  # 32 states: all that three runs read fits the nearest cache


def make_settings(strategy: str, n_steps: int, map_=None) -> Settings:
    """No guide, or the random policy, which guides through the whole run."""
    mdp = navigation_tasks(map_ or read_map("target"), reward="goal").mdp
    if strategy == "none":
        return Settings(mdp)
    guide = uniform_policy(mdp.allowed)
    return Settings(mdp, guide=guide, strategy=strategy, tau=n_steps)


class Fast:
    """The fast loop, with as many runs as take turns."""

    def __init__(self, settings, n_runs):
        self.n_runs = n_runs
        runs = [(seed, settings.q0) for seed in range(n_runs)]
        self.runs = Together(set_up(settings), runs)
        self.advance(1, 0)  # compiles

    def advance(self, first, last):
        self.runs._fast(first, last)


class Plain:
    """The readable loop, without what it does to let the fast one go on."""

    n_runs = 1

    def __init__(self, settings):
        setup = set_up(settings)._replace(tables=None)
        self.runs = Together(setup, [(0, settings.q0)])
        self.advance(1, 0)  # compiles

    def advance(self, first, last):
        self.runs._plainly(first, last)


class Interpreted:
    """The readable loop as plain Python: in a process where numba is switched off."""

    n_runs = 1

    def __init__(self, settings):
        os.environ["NUMBA_DISABLE_JIT"] = "1"
        self.pool = ProcessPoolExecutor(1, get_context("spawn"))
        self.pool.submit(_interpret, settings.strategy, settings.tau, 1, 0).result()
        del os.environ["NUMBA_DISABLE_JIT"]
        self.settings = settings

    def seconds(self, first, last):
        arguments = self.settings.strategy, self.settings.tau, first, last
        return self.pool.submit(_interpret, *arguments).result()


@cache
def _interpreted(strategy, tau):
    return Plain(make_settings(strategy if tau else "none", tau))


def _interpret(strategy, tau, first, last):
    return seconds(_interpreted(strategy, tau), first, last)


class InC:
    """The C loop."""

    n_runs = 1

    def __init__(self, settings, learn):
        self.learn = learn
        self.run, self._arrays = yardstick.new_run(settings, 1)

    def advance(self, first, last):
        self.learn(self.run, first, last)


class Peer:
    """A learner of another library."""

    n_runs = 1

    def __init__(self, settings, make):
        self.advance = make(settings, 1)


def seconds(contestant, first, last):
    """Return the CPU seconds of a contestant's steps `first` to `last`."""
    if hasattr(contestant, "seconds"):
        return contestant.seconds(first, last)
    began = time.process_time()
    contestant.advance(first, last)
    return time.process_time() - began


def contestants(strategy: str, n_steps: int) -> dict:
    """Return all that can run here, by name, with the steps each takes in a round."""
    settings, learn = make_settings(strategy, n_steps), yardstick.compiled_loop()
    found = {}
    if learn:
        found["C, straightforward"] = InC(settings, learn), STEPS
    found["abstransfer, 3 runs in turn"] = Fast(settings, 3), STEPS
    small = make_settings(strategy, n_steps, parse_map(SMALL.strip()))
    found["3 runs on 32 states, in cache"] = Fast(small, 3), STEPS
    found["abstransfer, 1 run"] = Fast(settings, 1), STEPS
    found["readable loop, compiled"] = Plain(settings), STEPS
    found["readable loop, plain Python"] = Interpreted(settings), SLOW_STEPS
    if strategy == "none":
        for name, make in (
            ("table-rl", peers.table_rl),
            ("simple_rl", peers.simple_rl),
        ):
            if importlib.util.find_spec(make.__name__):
                label = f"{name} {metadata.version(name)}"
                found[label] = Peer(settings, make), SLOW_STEPS
            else:
                print(f"{name} is not installed: left out (pip install .[peers])")
    return found
