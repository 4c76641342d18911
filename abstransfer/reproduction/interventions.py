"""
Which operations on notes page 10 compares, and the experiment that runs them.

Every run: five robots are advised for tau steps, with the same luck.  Then one
goes on alone for the rest of a run from each of the tables that the operations
make of what they left, all with the same new luck.  What is counted is the goals
after tau.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..driving import advised
from ..experiments.arms import PAPER_STEPS, Arm
from ..experiments.diagnosis import ready
from ..experiments.plan import SEED
from ..experiments.problem import Problem, target_tasks
from ..experiments.results import Results, load_results, save_results
from ..experiments.surgery import (
    Left,
    directions,
    drawn,
    erase,
    go_on,
    graft,
    leave,
    noted,
    shuffle_actions,
    shuffle_states,
)
from .buildings import draw_building
from .catalogue import HINT, TAU, make_guides

#: What is asked of drawn buildings, where every run has its own.
MAIN = (
    "nd",
    "prob",
    "half",
    "eager",
    "wanderer",
    "nd-erased",
    "prob-grafted",
)
#: The robots that are advised, and the advice of each, by its name in the study.
ROBOTS = {
    "nd": "beta-0",
    "prob": "beta-1",
    "half": "nd-available-0.5",  # half ND, half eager
    "eager": "available",
    "wanderer": "all",
}
ADVISED, ALONE = 2, 3  # streams of seeds: none of those that report or tune


def _only_nd(left: Left) -> np.ndarray:
    """Return where ND has notes and Prob is blank, (S,)."""
    return noted(left.notes["nd"]) & ~noted(left.notes["prob"])


def _kept(notes: np.ndarray, where: np.ndarray) -> np.ndarray:
    return erase(notes, ~where)


def _thinned(left: Left, robot: str, like: str) -> np.ndarray:
    """Return a robot's notes, kept in as many states as another has, by chance."""
    notes = left.notes[robot]
    n = min(noted(left.notes[like]).sum(), noted(notes).sum())
    return _kept(notes, drawn(noted(notes), n, left.rng))


def _nearest(left: Left, n: int) -> np.ndarray:
    """Return ND's notes in the n of its states that lie nearest to the goal."""
    notes = left.notes["nd"]
    worth = np.where(noted(notes), left.best.max(axis=1), -1)
    return _kept(notes, np.argsort(np.argsort(-worth, kind="stable")) < n)


def _third(left: Left, third: int) -> np.ndarray:
    """Return Prob's notes and a third of ND's others; 0 is nearest to the goal."""
    states = np.flatnonzero(_only_nd(left))
    far = states[np.argsort(-left.best.max(axis=1)[states], kind="stable")]
    where = np.zeros(len(left.best), dtype=bool)
    where[np.array_split(far, 3)[third]] = True
    return graft(left.notes["prob"], left.notes["nd"], where)


def _level(notes: np.ndarray) -> np.ndarray:
    """Return notes that are all as large as the largest of their state."""
    return np.where(notes > 0, notes.max(axis=1, keepdims=True), notes)


def _blank(left: Left) -> np.ndarray:
    return erase(left.best, np.ones(len(left.best), dtype=bool))


def _perfect_where(left: Left, robot: str) -> np.ndarray:
    return _kept(left.best, noted(left.notes[robot]))


OPERATIONS: dict[str, Callable[[Left], np.ndarray]] = {
    # Nothing is changed.
    **{robot: lambda left, robot=robot: left.notes[robot] for robot in ROBOTS},
    "blank": _blank,
    "perfect": lambda left: left.best,
    # Where there are notes.
    "nd-erased": lambda left: erase(left.notes["nd"], _only_nd(left)),
    "prob-grafted": lambda left: graft(
        left.notes["prob"], left.notes["nd"], _only_nd(left)
    ),
    "nd-thinned": lambda left: _thinned(left, "nd", "prob"),
    "nd-nearest": lambda left: _nearest(left, int(noted(left.notes["prob"]).sum())),
    "half-thinned": lambda left: _thinned(left, "half", "nd"),
    "half-on-nd": lambda left: _kept(left.notes["half"], noted(left.notes["nd"])),
    "nd-large": lambda left: _kept(
        left.notes["nd"], left.notes["nd"].max(axis=1) >= HINT.hint
    ),
    "prob-near": lambda left: _third(left, 0),
    "prob-middle": lambda left: _third(left, 1),
    "prob-far": lambda left: _third(left, 2),
    # How good they are.
    "perfect-on-prob": lambda left: _perfect_where(left, "prob"),
    "perfect-on-nd": lambda left: _perfect_where(left, "nd"),
    "nd-directions": lambda left: directions(left.notes["nd"]),
    "nd-level": lambda left: _level(left.notes["nd"]),
    "nd-thousandth": lambda left: left.notes["nd"] / 1000,
    "nd-wrong-way": lambda left: shuffle_actions(
        left.notes["nd"], left.available, left.rng
    ),
    "nd-elsewhere": lambda left: shuffle_states(left.notes["nd"], left.rng),
    # The same experience, thought through.
    **{
        f"{robot}-digested": lambda left, robot=robot: left.digested[robot]
        for robot in ROBOTS
    },
}


class Case(NamedTuple):
    """One run of the experiment: all that a worker needs to know."""

    problem: Problem  #: what is learned
    guides: Mapping[str, np.ndarray]  #: advice (Z, A) of the robots
    operations: tuple[str, ...]  #: what is done to the notes
    tau: int  #: steps of advice
    n_steps: int  #: of a whole run
    seed: int  #: of all runs
    run: int  #: which run


def operate(case: Case) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """
    Return goals after tau and share of states noted at tau, by operation.

    And how ready the notes of the robots are that were not operated on.
    """
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
        case.n_steps - case.tau,
        seed=alone,
        alpha=problem.alpha,
        epsilon=problem.epsilon,
        gamma=problem.gamma,
        max_episode=problem.max_episode,
    )
    way = ~tasks.mdp.terminal
    share = [noted(notes)[way].mean() for notes in tables]
    able = [
        ready(tasks.mdp, notes, epsilon=problem.epsilon)
        for name, notes in zip(case.operations, tables, strict=True)
        if name in ROBOTS
    ]
    return np.array(goals), np.array(share), np.array(able)


def run_operations(
    problem: Problem | None = None,
    *,
    operations: Iterable[str] = tuple(OPERATIONS),
    n_runs: int = 12,
    drawn: bool = False,
    tau: int = TAU["hard"],
    n_steps: int = PAPER_STEPS,
    seed: int = SEED,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> Results:
    """
    Return the goals after tau of every operation, (operations, N, 1).

    With `drawn`, run i has a building of its own, that of seed i.  `out` is a
    folder to store in; results that are there already are read.  The record holds,
    by operation, what it was at tau in each run: ``noted``, the share of states
    with a note, and ``ready``, for robots that were not operated on.

    Raises
    ------
    ValueError
        If an operation is unknown, or `out` holds another experiment.
    """
    problem, operations = problem or Problem(), tuple(operations)
    if problem.reward != "goal" or problem.q0:
        raise ValueError("problem must pay at the goal and start blank: 0 is no note")
    for name in operations:
        if name not in OPERATIONS:
            raise ValueError(
                f"operations must be among {tuple(OPERATIONS)}, got {name!r}"
            )
    parameters = {
        "reading": problem.record(),
        "steps": n_steps - tau,
        "window": n_steps - tau,
        "arms": [Arm(name, None, "hard", tau).record() for name in operations],
        "runs": n_runs,
        "seed": seed,
        "stream": "surgery",
    }
    if drawn:
        parameters["reading"]["target"] = "drawn by the number of the run"
    if out and (Path(out) / "experiment.json").is_file():
        stored = load_results(out)
        if stored.record["parameters"] != parameters:
            raise ValueError(f"{out} holds another experiment, so nothing was run")
        return stored
    advice = make_guides(ROBOTS.values(), problem)
    guides = {robot: advice[name] for robot, name in ROBOTS.items()}
    cases = [
        Case(
            replace(problem, target=draw_building(run)) if drawn else problem,
            guides,
            operations,
            tau,
            n_steps,
            seed,
            run,
        )
        for run in range(n_runs)
    ]
    found = []
    on_progress(0, n_runs)
    own = executor is None
    pool = executor or ProcessPoolExecutor(
        n_workers, multiprocessing.get_context("spawn")
    )
    try:
        for result in pool.map(operate, cases):
            found.append(result)
            on_progress(len(found), n_runs)
    finally:
        if own:
            pool.shutdown(cancel_futures=True)
    goals, share, able = (np.stack(x, axis=1) for x in zip(*found, strict=True))
    robots = [name for name in operations if name in ROBOTS]
    record = {
        "parameters": parameters,
        "noted": dict(zip(operations, share.round(4).tolist(), strict=True)),
        "ready": dict(zip(robots, able.round(4).tolist(), strict=True)),
    }
    results = Results(
        tuple(Arm(name, None, "hard", tau) for name in operations),
        goals[:, :, None],
        record,
    )
    if out:
        save_results(out, results)
    return results
