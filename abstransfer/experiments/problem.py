"""
The learning problem: what the paper says of it, and what it leaves open.

Here a problem becomes tasks, and the advice that is carried to them.
Page 3 of the book teaches what the choices do.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, field, fields
from functools import lru_cache, partial

import numpy as np

from .._paths import DATA
from ..builders import BUILDERS, abstract_policies
from ..learning.settings import Settings, check
from ..maps import Map, read_map
from ..navigation import NavigationTasks, check_options, navigation_tasks

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
        ``"goal"``: 1 on reaching the goal, else 0; the convention under which
        the paper's figures come out.  ``"cost"``: -1 a step, the paper's rule.
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
    unavailable: str = "wait"
    success: float = 0.9
    q0: float = Settings.q0
    alpha: float = Settings.alpha
    epsilon: float = Settings.epsilon
    gamma: float = Settings.gamma
    max_episode: int = Settings.max_episode

    def __post_init__(self):
        check_options(
            success=self.success, reward=self.reward, unavailable=self.unavailable
        )
        for name in ("q0", "alpha", "epsilon", "gamma", "max_episode"):
            object.__setattr__(self, name, check(name, getattr(self, name)))

    def record(self) -> dict:
        """Return everything that makes this problem, for JSON."""
        numbers = {f.name: getattr(self, f.name) for f in fields(self)[2:]}
        maps = {"source": self.source, "target": self.target}
        return {name: _map_record(map_) for name, map_ in maps.items()} | numbers


@lru_cache(maxsize=8)
def target_tasks(problem: Problem) -> NavigationTasks:
    """Return the tasks to be learned; made once per problem and process."""
    return navigation_tasks(
        problem.target,
        success=problem.success,
        reward=problem.reward,
        unavailable=problem.unavailable,
    )


def build_guides(problem: Problem, names: Iterable[str]) -> dict[str, np.ndarray]:
    """
    Return the abstract policies (Z, A) of these names, built in the source.

    They are built, and driven, with discount 0.99 and a cost of 1 a step,
    whatever reward the learner gets.

    >>> build_guides(Problem(), ["rand"])["rand"][0]
    array([0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125])
    """
    names = list(names)
    source = navigation_tasks(
        problem.source, success=problem.success, unavailable=problem.unavailable
    )
    guides = abstract_policies(source, [name for name in names if name != "rand"])
    if "rand" in names:
        guides["rand"] = np.full(source.possible.shape, 1 / len(source.actions))
    return guides


def driving_tasks(problem: Problem) -> NavigationTasks:
    """Return the tasks in which a policy is driven: those of the target, at a cost."""
    return navigation_tasks(
        problem.target, success=problem.success, unavailable=problem.unavailable
    )


def digest(data: bytes) -> str:
    """Return a short fingerprint of bytes."""
    return hashlib.sha256(data).hexdigest()[:16]


def _map_record(map_: Map) -> dict:
    """Return the name of a map that comes with the package, and a fingerprint."""
    shipped = (path.stem for path in sorted((DATA / "maps").glob("*.txt")))
    name = next((name for name in shipped if read_map(name) == map_), "own map")
    return {"name": name, "sha256": digest(str(map_).encode())}
