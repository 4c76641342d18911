"""
A race: robots with and without advice learn in any building, features or tasks.

It is the experiment of page 9 for a building of your own; page 12 of the book
teaches this module.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ..experiments.plan import SEED
from ..experiments.stats import Interval, gain_interval
from ..learning import q_learning_runs
from ..learning.settings import exact_seed, whole
from ..mdp import check_rows
from ..navigation import NavigationTasks
from ..policies import restrict_policy


class Race(NamedTuple):
    """What was run, and the goals of each run."""

    tasks: NavigationTasks  #: where the robots learned
    guides: dict[str, np.ndarray]  #: abstract policies (Z, A)
    goals: dict[str, np.ndarray]  #: (N,) goals of each run; "none" is Q-learning
    steps: int  #: of a run
    tau: int  #: last step in which advice has a say
    strategy: str  #: "hard" or "soft"
    seed: int  #: of all runs

    def gains(self) -> dict[str, Interval]:
        """Return by which share each robot exceeds "none": 0.1 is 10 % more goals."""
        none = self.goals["none"]
        return {name: gain_interval(self.goals[name], none) for name in self.guides}


def race(
    tasks: NavigationTasks,
    guides: Mapping[str, np.ndarray],
    *,
    steps: int,
    tau: int,
    strategy: str = "hard",
    n_runs: int = 20,
    seed: int = SEED,
) -> Race:
    """
    Let robots with each of the guides, and one without, learn in a building.

    Parameters
    ----------
    tasks : NavigationTasks
        Made with ``reward="goal"``, unless it is the reward that you study.
    guides : dict from name to ndarray (Z, A)
        Abstract policies over the abstract states of `tasks`.
    steps, tau, strategy
        As for :func:`~abstransfer.learning.q_learning`.
    n_runs, seed
        Run i of every robot draws from ``SeedSequence(seed, spawn_key=(0, i))``.

    Examples
    --------
    >>> from abstransfer import navigation_tasks, parse_map, uniform_policy
    >>> tasks = navigation_tasks(parse_map("+---+\\n|.d*|\\n+---+"), reward="goal")
    >>> go = {"eager": uniform_policy(tasks.possible)}
    >>> race(tasks, go, steps=100, tau=100, n_runs=1).goals["eager"] > 80
    array([ True])
    """
    if not isinstance(tasks, NavigationTasks):
        raise ValueError(f"tasks must be NavigationTasks, got {type(tasks).__name__}")
    for name in {"none", "optimal"} & set(guides):
        raise ValueError(f"no guide may be called {name!r}: that robot has none")
    steps, tau = whole("steps", steps, 1), whole("tau", tau)
    n_runs, seed = whole("n_runs", n_runs, 1), exact_seed("seed", seed)
    shape, goals = tasks.possible.shape, {}
    for name, guide in {"none": None, **guides}.items():
        options = {}
        if guide is not None:
            if np.shape(guide) != shape:
                raise ValueError(
                    f"guide {name!r} must have shape {shape}, got {np.shape(guide)}"
                )
            check_rows(guide, f"guide {name!r}")
            policy = restrict_policy(guide[tasks.rho], tasks.mdp.allowed)
            options = {"guide": policy, "tau": tau, "strategy": strategy}
        seeds = [np.random.SeedSequence(seed, spawn_key=(0, i)) for i in range(n_runs)]
        runs = q_learning_runs(tasks.mdp, steps, rngs=seeds, window=steps, **options)
        goals[name] = np.array([run.goals.sum() for run in runs])
    return Race(tasks, dict(guides), goals, steps, tau, strategy, seed)
