"""
The experiment that runs the operations on notes, and stores it as any other.

Every run: robots are advised for tau steps, with the same luck.  Then one goes
on alone for the rest of a run from each of the tables that the operations make
of what they left, all with the same new luck.  What is counted is the goals
after tau.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from time import thread_time
from typing import NamedTuple

import numpy as np

from ..driving import advised, executed_values
from ..experiments.arms import SCALES, Arm, Scale
from ..experiments.diagnosis import arrival, ready
from ..experiments.plan import SEED
from ..experiments.problem import Problem, digest, driving_tasks, target_tasks
from ..experiments.results import Results
from ..experiments.run import Work, carry_out
from ..experiments.store import Store
from ..experiments.surgery import go_on, leave, noted
from ..experiments.workers import heed_stop
from ..learning.settings import whole
from .buildings import draw_building
from .guides import TAU, make_guides
from .operations import OPERATIONS, ROBOTS

ADVISED, ALONE = 2, 3  # streams of seeds: none of those that report or tune
DRIVERS = ("nd", "prob", "grad")  # robots that are judged as drivers, as in Table 1


class Case(NamedTuple):
    """One run: all that a worker needs to know."""

    problem: Problem  #: what is learned
    guides: Mapping[str, np.ndarray]  #: advice (Z, A) of the robots
    drivers: tuple[str, ...]  #: robots that are judged as drivers
    operations: tuple[str, ...]  #: what is done to the notes
    tau: int  #: steps of advice
    steps: int  #: that follow, alone
    seed: int  #: of all runs
    run: int  #: which run


class Outcome(NamedTuple):
    """What came of a run."""

    goals: tuple[int, ...]  #: after tau, by operation
    measures: tuple[dict, ...]  #: by operation, by name
    seconds: float  #: of one core


def operate(case: Case) -> Outcome:
    """Return what comes of one run, by operation."""
    heed_stop()
    began = thread_time()
    tasks, problem = target_tasks(case.problem), case.problem
    advised_by, alone = (
        np.random.SeedSequence(case.seed, spawn_key=(stream, case.run))
        for stream in (ADVISED, ALONE)
    )
    think = {
        name.removesuffix("-digested")
        for name in case.operations
        if name.endswith("-digested")
    }
    left = leave(
        tasks.mdp,
        tasks.available,
        {name: advised(tasks, advice) for name, advice in case.guides.items()},
        case.tau,
        seed=advised_by,
        gamma=problem.gamma,
        max_episode=problem.max_episode,
        think=think,
    )
    heed_stop()
    tables = [
        # Luck by name: no operation depends on which others there are.
        OPERATIONS[name](
            left._replace(
                rng=np.random.default_rng([case.seed, case.run, *name.encode()])
            )
        )
        for name in case.operations
    ]
    goals = go_on(
        tasks.mdp,
        tables,
        case.steps,
        seed=alone,
        alpha=problem.alpha,
        epsilon=problem.epsilon,
        gamma=problem.gamma,
        max_episode=problem.max_episode,
        on_progress=heed_stop,
    )
    measures = tuple(
        _measures(case, tasks.mdp, name, notes)
        for name, notes in zip(case.operations, tables, strict=True)
    )
    return Outcome(tuple(goals), measures, thread_time() - began)


def _measures(case: Case, mdp, name: str, notes: np.ndarray) -> dict:
    """Return what is measured of an operation's notes, and of the robot it names."""
    found = {"noted": round(float(noted(notes)[~mdp.terminal].mean()), 4)}
    if name in ROBOTS:
        found["ready"] = round(ready(mdp, notes, epsilon=case.problem.epsilon), 4)
    if name in case.drivers:
        found["letters"], found["value"] = _drives(case.problem, case.guides[name])
    return found


def _drives(problem: Problem, advice: np.ndarray) -> tuple[float, float]:
    """Return letters in 500,000 steps and the value of Table 1, both exact."""
    tasks = driving_tasks(problem)
    found = arrival(tasks.mdp, advised(tasks, advice), problem.max_episode)
    letters = 500_000 * found.goals_per_step(~tasks.mdp.terminal)
    value = executed_values(tasks, {"": advice})[""]
    return round(letters, 2), round(float(value), 4)


def run_operations(
    problem: Problem | None = None,
    *,
    operations: Iterable[str] = tuple(OPERATIONS),
    n_runs: int = 6,
    drawn: bool = False,
    first: int = 0,
    scale: str | Scale = "paper",
    seed: int = SEED,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> Results:
    """
    Return the goals after tau of every operation, (operations, N, 1).

    Parameters
    ----------
    problem : Problem, optional
        By default the book's.
    operations : iterable of names in OPERATIONS
    n_runs : int, default 6
    drawn : bool
        Run i has a building of its own, that of seed `first` + i.
    first : int, default 0
    scale, seed, executor, n_workers, out, on_progress
        As for :func:`~abstransfer.experiments.run.run_experiment`, to which a
        folder and an interrupt are the same.

    Returns
    -------
    Results
        The record holds, by operation, what was measured in each run at tau:
        ``noted``, the share of states with a note; ``ready``, of robots that were
        not operated on; in drawn buildings also ``letters`` in 500,000 steps and
        ``value`` at 0.99 of three robots as drivers.

    Raises
    ------
    ValueError
        If an operation is unknown, the problem has notes that say nothing, or
        `out` holds another experiment.
    """
    problem, operations = problem or Problem(), tuple(operations)
    if problem.reward != "goal" or problem.q0:
        raise ValueError("problem must pay at the goal and start blank: 0 is no note")
    for name in operations:
        if name not in OPERATIONS:
            raise ValueError(
                f"operations must be among {tuple(OPERATIONS)}, got {name!r}"
            )
    n_runs = whole("n_runs", n_runs, 1)
    scale = SCALES[scale] if isinstance(scale, str) else scale
    arms = tuple(Arm(name, None, "hard", TAU["hard"]) for name in operations)
    tau = scale.tau(arms[0])
    advice = make_guides(ROBOTS.values(), problem)
    case = Case(
        problem,
        {robot: advice[name] for robot, name in ROBOTS.items()},
        DRIVERS if drawn else (),
        operations,
        tau,
        scale.steps - tau,
        seed,
        0,
    )
    problems = [problem] * n_runs
    if drawn:
        seeds = range(first, first + n_runs)
        problems = [replace(problem, target=draw_building(i)) for i in seeds]

    def jobs(done):
        for run in range(n_runs):
            missing = tuple(np.flatnonzero(~done[:, run]).tolist())
            if missing:
                names = tuple(operations[i] for i in missing)
                of_run = {"problem": problems[run], "operations": names, "run": run}
                yield (missing, run), case._replace(**of_run)

    return carry_out(
        Work(
            arms,
            (len(arms), n_runs, 1),
            case.steps,
            _parameters(case, arms, problems, drawn),
            operate,
            jobs,
            _keep,
            lambda store: _measured(store, operations),
        ),
        executor=executor,
        n_workers=n_workers,
        out=out,
        on_progress=on_progress,
    )


def _parameters(case: Case, arms, problems, drawn: bool) -> dict:
    """Return all that the goals depend on, for JSON."""
    reading = case.problem.record()
    if drawn:
        maps = "\n".join(str(problem.target) for problem in problems)
        reading["target"] = {"name": "drawn", "sha256": digest(maps.encode())}
    return {
        "reading": reading,
        "steps": case.steps,
        "window": case.steps,
        "arms": [arm.record() | {"tau_steps": case.tau} for arm in arms],
        "runs": len(problems),
        "seed": case.seed,
        "stream": "operations",
        "guides": {
            robot: digest(np.round(advice + 0.0, 6).tobytes())
            for robot, advice in case.guides.items()
        },
    }


def _keep(store: Store, key, outcome: Outcome) -> None:
    """Keep what came of a run: each operation by itself, so that each is resumed."""
    missing, run = key
    for arm, goals, found in zip(missing, *outcome[:2], strict=True):
        store.save(
            arm, run, np.array([[goals]]), outcome.seconds / len(missing), **found
        )


def _measured(store: Store, operations) -> dict:
    """Return what was measured, by measure and operation, a list of runs each."""
    found = {}
    for (arm, _), measures in sorted(store.measures.items()):
        for name, value in measures.items():
            by_operation = found.setdefault(name, {})
            by_operation.setdefault(operations[arm], []).append(value)
    return found
