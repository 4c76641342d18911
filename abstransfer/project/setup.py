"""
A project: a race in a building of one's own, with features of one's own.

The scene of page 11 runs the same races, to the last goal.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..abstraction import FEATURES
from ..builders import BUILDERS, abstract_policies
from ..driving import column
from ..experiments.arms import PAPER_STEPS
from ..maps import Map, read_map
from ..navigation import NavigationTasks, navigation_tasks
from ..policies import uniform_policy
from ..solvers import evaluate_policy
from .racing import Race, race

GUIDES = (*BUILDERS, "eager", "rand")
ADVICE = ("source", "target", "own")
PAPER_ENTRIES = 151_200  # of the table Q in the paper's target
PAPER_TAU = 3.5 / 30  # share of a life in which the paper's guide advises


class Setup(NamedTuple):
    """All that a race of a project depends on; its numbers follow."""

    map: Map  # where the robots learn
    features: tuple[str, ...] = FEATURES  # what they see
    guides: tuple[str, ...] = (*BUILDERS, "eager")
    advice: str = "source"  # building the pages come from; "own" is the map itself
    strategy: str = "hard"
    lives: int = 5


def scale(map_: Map) -> tuple[int, int]:
    """
    Return steps of a life and of advice, in the paper's proportions, rounded.

    >>> scale(read_map("source"))
    (2360000, 280000)
    """
    entries = len(map_.goals) * map_.n_cells * 8
    steps = PAPER_STEPS / PAPER_ENTRIES * entries
    unit = 10_000 if steps >= 100_000 else 100
    steps = unit * int(steps / unit + 0.5)
    return steps, unit * int(PAPER_TAU * steps / unit + 0.5)


def pages(setup: Setup, tasks: NavigationTasks) -> dict[str, np.ndarray]:
    """Return the abstract policies (Z, A) that advise in a project, by name."""
    chosen = tuple(name for name in GUIDES if name in setup.guides)
    origin = setup.map if setup.advice == "own" else read_map(setup.advice)
    built = tuple(name for name in chosen if name in BUILDERS)
    policies = dict(_written(origin, setup.features, built))
    policies["eager"] = uniform_policy(tasks.possible)
    policies["rand"] = uniform_policy(np.ones_like(tasks.possible))
    return {name: policies[name] for name in chosen}


def run(setup: Setup) -> Race:
    """Let the robots of a project live; the browser finds the same goals."""
    for name in ("advice", "strategy"):
        known = {"advice": ADVICE, "strategy": ("hard", "soft")}[name]
        if getattr(setup, name) not in known:
            value = getattr(setup, name)
            raise ValueError(f"{name} must be one of {known}, got {value!r}")
    tasks = navigation_tasks(setup.map, reward="goal", features=setup.features)
    steps, tau = scale(setup.map)
    options = {"strategy": setup.strategy, "n_runs": setup.lives}
    return race(tasks, pages(setup, tasks), steps=steps, tau=tau, **options)


def drives(setup: Setup, guides: Sequence[str] = GUIDES) -> dict[str, float]:
    """
    Return how well pages drive in the map of a project, as in Table 1.

    The last entry is the best driver's, "optimal".

    >>> {k: round(v) for k, v in drives(Setup(read_map("source")), ["nd"]).items()}
    {'nd': -44, 'optimal': -14}
    """
    road = navigation_tasks(setup.map, features=setup.features)
    found = pages(setup._replace(guides=tuple(guides)), road)
    values = {
        name: float(evaluate_policy(road.mdp, policy[road.rho]).mean())
        for name, policy in found.items()
    }
    return values | {"optimal": column(road, {})["optimal"]}


@lru_cache(maxsize=32)
def _written(origin: Map, features: tuple, builders: tuple) -> tuple:
    """Return abstract policies built from a map, by name, as pairs."""
    tasks = navigation_tasks(origin, features=features)
    return tuple(abstract_policies(tasks, builders).items())
