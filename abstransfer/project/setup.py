"""
A project: a race in a building of one's own, with features of one's own.

The scene of page 12 runs the same races, to the last goal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..abstraction import FEATURES
from ..builders import BUILDERS, abstract_policies
from ..driving import column
from ..experiments.arms import PAPER_STEPS
from ..experiments.plan import SEED
from ..learning.settings import STRATEGIES, choice
from ..maps import Map, read_map
from ..navigation import NavigationTasks, navigation_tasks
from ..policies import uniform_policy
from .racing import Race, race
from .student import seed_of

GUIDES = (*BUILDERS, "eager", "rand")
ADVICE = ("source", "target", "own")
PAPER_ENTRIES = 151_200  # of the table Q in the paper's target
PAPER_TAU = 3.5 / 30  # share of a run in which the paper's guide advises


class Setup(NamedTuple):
    """All that a race of a project depends on; its numbers follow."""

    map: Map  #: where the robots learn
    features: tuple[str, ...] = FEATURES  #: what they see
    guides: tuple[str, ...] = (*BUILDERS, "eager")  #: names of the advice
    advice: str = "source"  #: building the advice comes from; "own" is the map itself
    strategy: str = "hard"  #: "hard" or "soft"
    runs: int = 5  #: of each robot
    student: str = ""  #: whose work it is; the seed follows from it

    @property
    def seed(self) -> int:
        """The seed of all runs: the student's, or else the book's."""
        return seed_of(self.student) if self.student else SEED

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of the robots with advice, in the order in which they are told."""
        known = tuple(name for name in GUIDES if name in self.guides)
        return known + tuple(name for name in self.guides if name not in GUIDES)


def scale(map_: Map) -> tuple[int, int]:
    """
    Return steps of a run and of advice, in the paper's proportions, rounded.

    >>> scale(read_map("source"))
    (2360000, 280000)
    """
    entries = len(map_.goals) * map_.n_cells * 8
    steps = PAPER_STEPS / PAPER_ENTRIES * entries
    unit = 10_000 if steps >= 100_000 else 100
    steps = unit * int(steps / unit + 0.5)
    return steps, unit * int(PAPER_TAU * steps / unit + 0.5)


def policies(
    setup: Setup, tasks: NavigationTasks, own: Mapping[str, np.ndarray] | None = None
) -> dict[str, np.ndarray]:
    """Return the abstract policies (Z, A) that advise in a project, by name."""
    known = {
        "eager": uniform_policy(tasks.possible),
        "rand": uniform_policy(np.ones_like(tasks.possible)),
        **(own or {}),
    }
    origin = setup.map if setup.advice == "own" else read_map(setup.advice)
    built = tuple(name for name in setup.robots if name in BUILDERS)
    known |= dict(_built(origin, setup.features, built))
    return {name: known[name] for name in setup.robots}


def run(setup: Setup, own: Mapping[str, np.ndarray] | None = None) -> Race:
    """Let the robots of a project learn; the browser finds the same goals."""
    choice("advice", setup.advice, ADVICE)
    choice("strategy", setup.strategy, STRATEGIES)
    tasks = navigation_tasks(setup.map, reward="goal", features=setup.features)
    steps, tau = scale(setup.map)
    options = {"strategy": setup.strategy, "n_runs": setup.runs, "seed": setup.seed}
    return race(tasks, policies(setup, tasks, own), steps=steps, tau=tau, **options)


def column_of(setup: Setup, own: Mapping[str, np.ndarray] | None = None) -> dict:
    """Return the column of Table 1 that the map of a project and its advice make."""
    tasks = navigation_tasks(setup.map, features=setup.features)
    return column(tasks, policies(setup, tasks, own))


def drives(setup: Setup, names: Sequence[str] = GUIDES) -> dict[str, float]:
    """
    Return how well advice drives in the map of a project, as in Table 1.

    The last entry is the best driver's, "optimal".

    >>> {k: round(v) for k, v in drives(Setup(read_map("source")), ["nd"]).items()}
    {'nd': -44, 'optimal': -14}
    """
    setup = setup._replace(guides=tuple(names))
    found = column_of(setup)
    return {name: found[name] for name in (*setup.robots, "optimal")}


@lru_cache(maxsize=32)
def _built(origin: Map, features: tuple, builders: tuple) -> tuple:
    """Return abstract policies built from a map, by name, as pairs."""
    tasks = navigation_tasks(origin, features=features)
    return tuple(abstract_policies(tasks, builders).items())
