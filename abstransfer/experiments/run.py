"""
Experiments: many runs of many arms, on as many workers as there are.

A run depends on its seed, its arm and the problem; not on the number of
workers, their kind, or the order in which they finish.  Run i of every arm
has the same seed (common random numbers), and the seeds that tune tau are
none of those that report.  Page 9 of the book teaches this module.
"""

from __future__ import annotations

import platform
import time
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from importlib import metadata
from pathlib import Path

import numpy as np

from ..driving import executed_values
from ..learning.settings import whole
from .arms import ARMS, Arm, Scale
from .plan import SEED, Plan, make_jobs, make_plan, parameters
from .problem import Problem, driving_tasks
from .results import Results, load_results
from .store import Store, claim
from .workers import MOST_WORKERS, run_jobs


def run_experiment(
    arms: Iterable[Arm] = ARMS,
    problem: Problem | None = None,
    *,
    scale: str | Scale = "paper",
    n_runs: int = 50,
    seed: int = SEED,
    stream: str = "report",
    guides: Mapping[str, np.ndarray] | None = None,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> Results:
    """
    Run every arm N times, and return the goals per window.

    Parameters
    ----------
    arms : iterable of Arm
    problem : Problem, optional
        By default the paper's maps, with reward ``"goal"``.
    scale : {"page", "class", "paper"} or Scale
        Steps of a run and of a window; tau shrinks along.  The problem does not:
        at page scale a run sees a state-action pair 7 times in the mean, not
        200.  A smaller scale is the beginning of learning, not a small copy of
        it: at page scale Q-learning and random have hardly reached a goal, and
        advice looks better, soft advice above all, than it is in the end.
    n_runs : int, default 50
    seed : int
        Run i draws from ``SeedSequence(seed, spawn_key=(stream, i))``.
    stream : {"report", "tune"}
        Which seeds: no run that tunes tau is one that reports.
    guides : dict from name to ndarray (Z, A), optional
        Abstract policies for arms whose guide is not one of GUIDES.
    executor : concurrent.futures.Executor, optional
        Threads, Dask's ``client.get_executor()``, ...; by default `n_workers`
        processes on this machine, one for each processor.
    out : path, optional
        Folder to store in.  An interrupted experiment is resumed from there; one
        that has finished is read from there.
    on_progress : callable, optional
        Called with the steps done and to do, at first and after every job.

    Returns
    -------
    Results

    Raises
    ------
    ValueError
        If an argument is bad, or `out` holds another experiment, or what is not
        whole; named.
    BlockingIOError
        If another process works in `out`.
    ChildProcessError
        If a worker died.
    """
    plan = make_plan(
        arms, problem, scale, n_runs, seed=seed, stream=stream, guides=guides
    )
    if n_workers is not None:
        n_workers = whole("n_workers", n_workers, 1, MOST_WORKERS)
    if out is None:
        store = Store(plan.shape)
    else:
        store = claim(out, parameters(plan), plan.shape)
        if store is None:  # it has finished
            return load_results(out)
    with store:
        resumed, began = store.done.any(), time.perf_counter()

        def tell():
            if on_progress:
                on_progress(int(store.done.sum()) * plan.scale.steps, plan.n_steps)

        def keep(key, goals, seconds):
            store.save(*key, goals, seconds)
            tell()

        tell()
        run_jobs(dict(make_jobs(plan, store.done)), executor, n_workers, keep)
        wall = None if resumed else time.perf_counter() - began
        results = Results(plan.arms, store.goals, _record(plan, store.seconds, wall))
        store.finish(results)
    return results


def _record(plan: Plan, seconds: float, wall: float | None) -> dict:
    """Return what made the results; no path, no name of a machine."""
    packages = ("abstransfer", "numpy", "scipy", "numba")
    return {
        "parameters": parameters(plan),
        "executed": executed_values(driving_tasks(plan.problem), plan.guides),
        "seconds": {
            "cores": round(seconds, 2),
            "wall": wall and round(wall, 2),  # None if it was interrupted
            "ns_per_step": round(1e9 * seconds / plan.n_steps, 2),
        },
        "versions": {"python": platform.python_version()}
        | {package: metadata.version(package) for package in packages},
    }
