"""
The experiment that searches for the best teacher, and stores what it tried.

A search is one job: what it tries next depends on all that it has tried.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path
from time import thread_time
from typing import NamedTuple

import numpy as np

from ..driving import advised
from ..experiments.arms import SCALES, Arm, Scale
from ..experiments.plan import SEED, STREAMS
from ..experiments.problem import Problem, target_tasks
from ..experiments.results import Results
from ..experiments.run import Work, carry_out
from ..experiments.workers import heed_stop
from ..learning import q_learning_runs
from ..learning.settings import whole
from .guides import make_guides
from .surveys import ENDS
from .teachers import BUDGET, TAU_RANGE, mixed, search


class Quest(NamedTuple):
    """All that a worker needs to know."""

    problem: Problem  #: what is learned
    nd: np.ndarray  #: advice (Z, A)
    eager: np.ndarray  #: advice (Z, A)
    scale: Scale  #: steps of a run
    seeds: tuple[np.random.SeedSequence, ...]  #: of the runs of each trial
    budget: int  #: trials


def seek(quest: Quest) -> tuple[np.ndarray, list[dict], float]:
    """Return goals (trials, N), what was tried, and the core seconds it took."""
    began, tasks, goals, tried = thread_time(), target_tasks(quest.problem), [], []
    problem = quest.problem

    def teach(name: str, tau: int) -> float:
        heed_stop()
        runs = q_learning_runs(
            tasks.mdp,
            quest.scale.steps,
            rngs=quest.seeds,
            guide=advised(tasks, mixed(name, quest.nd, quest.eager)),
            tau=quest.scale.tau(Arm(name, name, "hard", tau)),
            alpha=problem.alpha,
            epsilon=problem.epsilon,
            gamma=problem.gamma,
            q0=problem.q0,
            max_episode=problem.max_episode,
            on_progress=heed_stop,
        )
        goals.append([int(run.goals.sum()) for run in runs])
        tried.append({"guide": name, "tau": tau})
        return float(np.mean(goals[-1]))

    search(teach, quest.budget)
    return np.array(goals), tried, thread_time() - began


def run_search(
    problem: Problem | None = None,
    *,
    n_runs: int = 3,
    budget: int = BUDGET,
    scale: str | Scale = "paper",
    seed: int = SEED,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> Results:
    """
    Return the goals of all that a search has tried, (trials, N, 1), in its order.

    Parameters
    ----------
    problem : Problem, optional
        Whose target is searched in; by default the book's.
    n_runs : int, default 3
        Runs of each trial, with the seeds that tune.
    budget : int
        Trials.
    scale, seed, executor, n_workers, out, on_progress
        As for :func:`~abstransfer.experiments.run.run_experiment`.

    Returns
    -------
    Results
        ``tried`` in the record has the advice and tau of each trial.
    """
    problem, n_runs = problem or Problem(), whole("n_runs", n_runs, 1)
    budget = whole("budget", budget, 1)
    scale = SCALES[scale] if isinstance(scale, str) else scale
    arms = tuple(Arm(f"try-{i:02}", None, "hard", 0) for i in range(budget))
    advice = make_guides({ENDS[0], ENDS[-1]}, problem)
    seeds = tuple(
        np.random.SeedSequence(seed, spawn_key=(STREAMS["tune"], run))
        for run in range(n_runs)
    )
    quest = Quest(problem, advice[ENDS[0]], advice[ENDS[-1]], scale, seeds, budget)

    def jobs(done):
        return [] if done.all() else [("search", quest)]

    def keep(store, _, outcome):
        goals, tried, seconds = outcome
        for i, (row, trial) in enumerate(zip(goals, tried, strict=True)):
            store.save(i, 0, row[:, None], seconds / budget, **trial)

    return carry_out(
        Work(
            arms,
            (budget, n_runs, 1),
            scale.steps,
            {
                "reading": problem.record(),
                "steps": scale.steps,
                "window": scale.steps,
                "arms": [arm.record() | {"tau_steps": 0} for arm in arms],
                "runs": n_runs,
                "seed": seed,
                "stream": "tune",
                "bounds": {"shares": [0, 1], "tau": list(TAU_RANGE)},
            },
            seek,
            jobs,
            keep,
            lambda store: {"tried": [store.measures[i, 0] for i in range(budget)]},
        ),
        executor=executor,
        n_workers=n_workers,
        out=out,
        on_progress=on_progress,
    )
