"""
The learning problem: what the paper says of it, and what it leaves open.

Here a problem becomes tasks, and the advice that is carried to them.
Page 3 of the book teaches what the choices do.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace
from functools import cache, lru_cache, partial

import numpy as np

from .._paths import DATA
from ..abstraction import LABELS
from ..builders import (
    BUILDERS,
    abstract_policies,
    induce_nondeterministic,
    induce_probabilistic,
)
from ..learning.settings import Settings, check
from ..maps import Map, read_map
from ..navigation import NavigationTasks, check_options, navigation_tasks
from ..policies import break_ties, spoken
from ..solvers import optimal_actions, optimal_values

GUIDES = ("rand", *BUILDERS)


@dataclass(frozen=True)
class Problem:
    """
    The learning problem: what the paper says, and what it leaves open.

    Parameters
    ----------
    source, target : Map
        Where the policies come from, and where they give advice.
    reward : {"goal", "cost"}
        ``"goal"``: 1 on reaching the goal, else 0, as in the files of the paper's
        group.  ``"cost"``: -1 a step, which the paper states for building and
        evaluating policies; it states no reward for learning.
    actions : {"relational", "compass"}
        What the learner chooses from: the labels it sees, or N, E, S, W.  Advice
        speaks labels in both cases.
    unavailable, success
        As for :func:`~abstransfer.navigation.navigation_tasks`.
    q0, alpha, epsilon, gamma, max_episode
        As for :func:`~abstransfer.learning.q_learning`.

    Raises
    ------
    ValueError
        Naming what is out of range, before a step is run.

    Examples
    --------
    >>> Problem(epsilon=1.5)
    Traceback (most recent call last):
        ...
    ValueError: epsilon must be a number from 0 to 1, got 1.5
    """

    source: Map = field(default_factory=partial(read_map, "source"))
    target: Map = field(default_factory=partial(read_map, "target"))
    reward: str = "goal"
    actions: str = "relational"
    unavailable: str = "wait"
    success: float = 0.9
    q0: float = Settings.q0
    alpha: float = Settings.alpha
    epsilon: float = Settings.epsilon
    gamma: float = Settings.gamma
    max_episode: int = Settings.max_episode

    def __post_init__(self):
        check_options(
            success=self.success,
            reward=self.reward,
            actions=self.actions,
            unavailable=self.unavailable,
        )
        for name in ("q0", "alpha", "epsilon", "gamma", "max_episode"):
            object.__setattr__(self, name, check(name, getattr(self, name)))

    def record(self) -> dict:
        """Return everything that makes this problem, for JSON."""
        numbers = {f.name: getattr(self, f.name) for f in fields(self)[2:]}
        if self.actions == "relational":  # as in results from before there was a choice
            del numbers["actions"]
        maps = {"source": self.source, "target": self.target}
        return {name: _map_record(map_) for name, map_ in maps.items()} | numbers


@lru_cache(maxsize=8)
def target_tasks(problem: Problem) -> NavigationTasks:
    """Return the tasks to be learned; made once per problem and process."""
    return navigation_tasks(
        problem.target,
        success=problem.success,
        reward=problem.reward,
        actions=problem.actions,
        unavailable=problem.unavailable,
    )


def build_guides(problem: Problem, names: Iterable[str]) -> dict[str, np.ndarray]:
    """
    Return the abstract policies (Z, A) of these names, built in the source.

    They are built, and driven, with discount 0.99 and a cost of 1 a step,
    whatever reward the learner gets.  With a compass, a best move (one by chance, of
    several) votes for the label it carries, and "rand" draws from the four moves.

    >>> build_guides(Problem(), ["rand"])["rand"][0]
    array([0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125])
    """
    names = list(names)
    options = problem.success, problem.unavailable
    source = _source_tasks(problem.source, *options)
    guides = {
        name: _built(name, problem.source, *options).copy()
        for name in names
        if name != "rand"
    }
    moves = len(source.actions)
    if problem.actions == "compass":
        compass = _source_tasks(problem.source, *options, "compass")
        guides |= _voted_by_moves(compass, source.possible, guides)
        moves = len(compass.actions)
    if "rand" in names:
        guides["rand"] = np.full((source.n_abstract, moves), 1 / moves)
    return guides


@lru_cache(maxsize=8)
def _source_tasks(
    source: Map, success: float, unavailable: str, actions: str = "relational"
) -> NavigationTasks:
    return navigation_tasks(
        source, success=success, unavailable=unavailable, actions=actions
    )


@lru_cache(maxsize=24)  # Grad takes a second to build, and depends on no target
def _built(name: str, source: Map, success: float, unavailable: str) -> np.ndarray:
    """Return the abstract policy (Z, A) of a builder; not to be written to."""
    return abstract_policies(_source_tasks(source, success, unavailable), [name])[name]


def driving_tasks(problem: Problem) -> NavigationTasks:
    """Return the tasks in which a policy is driven: those of the target, at a cost."""
    return target_tasks(replace(problem, reward="cost"))


def _voted_by_moves(compass, possible, names) -> dict[str, np.ndarray]:
    """Return ND and Prob, where wanted, that the best moves of a compass vote for."""
    # Moves tie far more often than labels do.  One by chance is a policy such as
    # the paper's pi*, and Table 1 comes out; sharing makes ND broader than it is.
    optimal = optimal_actions(compass.mdp, optimal_values(compass.mdp))
    best = break_ties(optimal, "random", rng=0)
    votes = spoken(best, compass.labels, len(LABELS))
    induce = {"nd": induce_nondeterministic, "prob": induce_probabilistic}
    return {
        name: induce[name](votes, compass.rho, possible)
        for name in names
        if name in induce
    }


def digest(data: bytes) -> str:
    """Return a short fingerprint of bytes."""
    return hashlib.sha256(data).hexdigest()[:16]


def _map_record(map_: Map) -> dict:
    """Return the name of a map that comes with the package, and a fingerprint."""
    name = _shipped().get(map_, "own map")
    return {"name": name, "sha256": digest(str(map_).encode())}


@cache
def _shipped() -> dict[Map, str]:
    """Return the names of the maps that come with the package."""
    names = sorted(path.stem for path in (DATA / "maps").glob("*.txt"))
    return {read_map(name): name for name in names}
