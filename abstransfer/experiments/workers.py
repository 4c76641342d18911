"""
Workers: one job on one core, and the pool of processes used by default.

Any ``concurrent.futures`` executor can take the pool's place.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from .._interrupts import LOOK, interrupts_noted
from ..driving import advised
from .arms import Scale
from .problem import Problem, target_tasks

MOST_WORKERS = 1000
SLICE = 5_000_000  # steps after which a job hears that it is to stop
STOP = threading.Event()  # set in a worker process whose parent wants no more


def heed_stop(n_steps: int = 0) -> None:
    """Raise InterruptedError in a worker whose parent wants no more."""
    if STOP.is_set():
        raise InterruptedError("the experiment was interrupted")


class Job(NamedTuple):
    """Some runs of one arm: all that a worker needs to know."""

    problem: Problem  #: what is learned
    strategy: str  #: "hard" or "soft"
    tau: int  #: steps of advice, at this scale
    guide: np.ndarray | None  #: (Z, A)
    scale: Scale  #: steps of a run and of a window
    seeds: tuple[np.random.SeedSequence, ...]  #: one per run
    hint: float = 0.0  #: first note on what can be done, above the problem's q0


def run_job(
    job: Job, on_progress: Callable[[int], None] | None = None
) -> tuple[np.ndarray, float]:
    """
    Return the goals (n, B) of the runs of a job, and the core seconds they took.

    `on_progress` is told the steps just taken, summed over the runs.
    """
    from ..learning import Learner

    def go_on(n_steps: int) -> None:
        heed_stop()
        if on_progress:
            on_progress(n_steps)

    go_on(0)
    tasks, problem = target_tasks(job.problem), job.problem
    guide = None if job.guide is None else advised(tasks, job.guide)
    began = time.thread_time()
    learner = Learner(
        tasks.mdp,
        rngs=job.seeds,
        guide=guide,
        strategy=job.strategy,
        tau=job.tau,
        alpha=problem.alpha,
        epsilon=problem.epsilon,
        gamma=problem.gamma,
        q0=problem.q0 + job.hint * tasks.available,
        max_episode=problem.max_episode,
        window=job.scale.window,
    )
    for first in range(0, job.scale.steps, SLICE):
        learner.advance(min(SLICE, job.scale.steps - first), on_progress=go_on)
    goals = np.array([run.goals for run in learner.results()])
    return goals, time.thread_time() - began


def run_jobs(
    do: Callable,
    jobs: Mapping[Hashable, object],
    executor: Executor | None,
    n_workers: int | None,
    on_result: Callable[[Hashable, object], None],
) -> None:
    """
    Do all jobs; hand the key and the outcome of each to `on_result`, as it comes.

    Without `executor`, a pool of processes is made, which ends with the call,
    with an interrupt, and with this process, however that ends.
    """
    if not jobs:
        return
    if executor is not None:
        futures = _submit(do, jobs, executor)
        try:
            return _collect(futures, on_result)
        finally:
            for future in futures:
                future.cancel()
    from ..learning._runs import say_if_compiling  # which workers leave to us

    say_if_compiling()
    # Not fork: it would copy threads in an unknown state.
    context = multiprocessing.get_context("spawn")
    reader, writer = context.Pipe(duplex=False)
    n_workers = min(n_workers or os.cpu_count() or 1, len(jobs))
    pool = futures = None
    with interrupts_noted() as heard:
        try:
            pool = ProcessPoolExecutor(
                n_workers, context, initializer=_start_worker, initargs=(reader,)
            )
            with _deaf():  # the workers, for good: Ctrl-C is for the parent
                futures = _submit(do, jobs, pool)
            _collect(futures, on_result, heard)
        except (BrokenProcessPool, OSError) as error:
            if futures is None:
                message = f"no worker process can be started ({error})"
            elif isinstance(error, BrokenProcessPool):
                message = "a worker process died: is there enough memory?"
            else:
                raise
            raise ChildProcessError(message) from None
        finally:
            writer.close()  # the workers stop in the middle of their jobs
            if pool is not None:
                pool.shutdown(cancel_futures=True)


def _submit(do, jobs, executor) -> dict:
    return {executor.submit(do, job): key for key, job in jobs.items()}


def _collect(futures, on_result, heard=()) -> None:
    """Hand over each outcome as it comes, until Ctrl-C is heard."""
    waiting = futures
    while waiting and not heard:
        done, waiting = wait(waiting, LOOK, FIRST_COMPLETED)
        # What is done is kept, also where a job beside it has failed.
        for future in sorted(done, key=lambda each: each.exception() is not None):
            on_result(futures[future], future.result())


@contextmanager
def _deaf():
    """Let Ctrl-C wait; processes that are started meanwhile never hear it."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _start_worker(reader) -> None:
    """
    Leave Ctrl-C to the parent; stop when it closes the pipe, and end when it ends.

    Nothing is ended by force while the parent lives: it could wait for ever to
    hand over a job.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def watch():
        try:
            reader.recv()
        except EOFError:
            STOP.set()
        multiprocessing.parent_process().join()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
