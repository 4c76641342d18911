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
from typing import NamedTuple

import numpy as np

from ..driving import executed_values
from ..learning.settings import whole
from .arms import ARMS, Arm, Scale
from .plan import SEED, make_jobs, make_plan, parameters
from .problem import Problem, driving_tasks
from .results import Results, load_results
from .store import Store, claim
from .workers import MOST_WORKERS, run_job, run_jobs


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
    return carry_out(
        Work(
            plan.arms,
            plan.shape,
            plan.scale.steps,
            parameters(plan),
            run_job,
            lambda done: make_jobs(plan, done),
            lambda store, key, outcome: store.save(*key, *outcome),
            lambda store: {
                "executed": executed_values(driving_tasks(plan.problem), plan.guides)
            },
        ),
        executor=executor,
        n_workers=n_workers,
        out=out,
        on_progress=on_progress,
    )


class Work(NamedTuple):
    """Runs of arms, of any kind, and how they are done and kept."""

    arms: tuple[Arm, ...]  #: what is compared
    shape: tuple[int, int, int]  #: of the goals: arms, N runs, B windows
    steps: int  #: of a run
    parameters: dict  #: all that the goals depend on, for JSON
    do: Callable  #: what a worker does with a job, and returns
    jobs: Callable  #: keys and jobs that remain, from what is done (arms, N)
    keep: Callable  #: puts the key and the outcome of a job into the store
    learned: Callable  #: what else the record says, from the store


def carry_out(
    work: Work,
    *,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> Results:
    """
    Do what remains of a work, and return its results; see :func:`run_experiment`.

    What `out` holds afterwards is the experiment that its record names.
    """
    if n_workers is not None:
        n_workers = whole("n_workers", n_workers, 1, MOST_WORKERS)
    if out is None:
        store = Store(work.shape)
    else:
        store = claim(out, work.parameters, work.shape)
        if store is None:  # it has finished
            return load_results(out)
    with store:
        resumed, began = store.done.any(), time.perf_counter()

        def tell():
            if on_progress:
                on_progress(int(store.done.sum()) * work.steps, n_steps)

        def keep(key, outcome):
            work.keep(store, key, outcome)
            tell()

        n_steps = work.shape[0] * work.shape[1] * work.steps
        tell()
        jobs = dict(work.jobs(store.done))
        run_jobs(work.do, jobs, executor, n_workers, keep)
        wall = None if resumed else time.perf_counter() - began
        record = {"parameters": work.parameters} | work.learned(store)
        record |= _spent(store.seconds, wall, n_steps)
        results = Results(work.arms, store.goals, record)
        store.finish(results)
    return results


def _spent(seconds: float, wall: float | None, n_steps: int) -> dict:
    """Return what made the results; no path, no name of a machine."""
    packages = ("abstransfer", "numpy", "scipy", "numba")
    return {
        "seconds": {
            "cores": round(seconds, 2),
            "wall": wall and round(wall, 2),  # None if it was interrupted
            "ns_per_step": round(1e9 * seconds / n_steps, 2),
        },
        "versions": {"python": platform.python_version()}
        | {package: metadata.version(package) for package in packages},
    }
