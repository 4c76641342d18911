"""
Compile all loops that learn, and keep them, before many processes ask for them at once.

    python scripts/compile_loops.py

Each process that finds nothing kept compiles for itself: so did all of the tests'.
"""

from __future__ import annotations

import numpy as np

import abstransfer as at
from abstransfer.experiments.arms import Scale
from abstransfer.experiments.problem import Problem
from abstransfer.reproduction.bench import Case, all_settings, do_case

STEPS = 1000


def main() -> None:
    """Take some steps in each way there is: a loop is compiled when it is called."""
    tasks = at.navigation_tasks(at.read_map("target"))
    guide = at.uniform_policy(tasks.available)
    at.experiments.arrival(tasks.mdp, guide, n_steps=1)
    at.q_learning(tasks.mdp, STEPS, rng=0, trace=STEPS)
    hard = {"guide": guide, "tau": STEPS // 2}
    for advice in ({}, hard, {**hard, "strategy": "soft"}):
        for n_runs in (1, 3):  # alone, and three that take turns
            at.q_learning_runs(tasks.mdp, STEPS, rngs=range(n_runs), **advice)
    of_each_method = {tried.method: tried for tried in all_settings().values()}
    small = Problem(target=at.read_map("source"))
    luck = np.random.SeedSequence(0)
    do_case(Case(small, tuple(of_each_method.values()), Scale(STEPS, STEPS), luck))


if __name__ == "__main__":
    main()
