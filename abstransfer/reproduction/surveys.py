"""
Surveys: many arms, in one building after another.

An arm is one of `experiments`, and may start from first notes that are whispered.
A building is done at a time: run r of every arm has the same luck there, and none
of the luck of other buildings.  What is counted is the goals of whole runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from time import thread_time
from typing import NamedTuple

import numpy as np

from ..driving import advised, executed_values
from ..experiments.arms import SCALES, Arm, Scale, check_arms
from ..experiments.diagnosis import return_variation
from ..experiments.plan import SEED, STREAMS
from ..experiments.problem import (
    GUIDES,
    Problem,
    build_guides,
    digest,
    driving_tasks,
    target_tasks,
)
from ..experiments.results import Results
from ..experiments.run import Work, carry_out
from ..experiments.store import Store
from ..experiments.surgery import best_notes
from ..experiments.workers import SLICE, heed_stop
from ..learning import Learner
from ..learning.settings import whole
from ..maps import Map
from .guides import make_guides
from .teachers import START, mixed
from .traps import EXCHANGED, exchange_rows
from .whispers import CEILING, first_notes, taught

TOGETHER = 24  # runs in a job, by threes: they share a loop
ENDS = ("beta-0", "beta-1", "available")  # of which other advice is made


class Told(NamedTuple):
    """An arm, and what is whispered to its robot."""

    arm: Arm  #: its advice, strategy and tau
    table: str = ""  #: a name in `whispers`, or CEILING
    size: float = 0.0  #: of the first notes: the table is multiplied by it
    own: str = ""  #: a survey whose best arm of this kind sets advice, tau or size

    def record(self) -> dict:
        """Return the arm for JSON."""
        whispered = {"table": self.table, "size": self.size} if self.table else {}
        return self.arm.record() | whispered


def told(
    name: str, guide: str | None = None, tau: int = 0, strategy: str = "hard", **more
) -> Told:
    """
    Return an arm by name; `more` are the other fields of Told.

    >>> told("values", table="values", size=1e-9).arm.name
    'values'
    """
    return Told(Arm(name, guide, strategy, tau), **more)


def settle(one: Told, results: Results) -> Told:
    """
    Return an arm with the best advice, tau or size that a survey has found.

    Of the arms with its table (or with what its table changes), its guide, or any
    mixture if its guide is no more than "mix-".  Of a search, of all that it tried.
    """
    tried = results.record.get("tried")
    if tried is None:
        tried = results.record["parameters"]["arms"]

    def alike(other: Mapping) -> bool:
        if one.table:
            return other.get("table") == one.table.partition("-")[0]
        guide = other.get("guide") or ""
        return (
            guide.startswith(START)
            if one.arm.guide == START
            else (guide == one.arm.guide)
        )

    means = results.goals.sum(axis=2).mean(axis=1)
    best = max(
        (i for i, other in enumerate(tried) if alike(other)), key=means.__getitem__
    )
    if one.table:
        return one._replace(size=tried[best]["size"])
    return one._replace(
        arm=one.arm._replace(guide=tried[best]["guide"], tau=tried[best]["tau"])
    )


class Case(NamedTuple):
    """Some runs of one building: all that a worker needs to know."""

    problem: Problem  #: what is learned
    arms: tuple[Told, ...]  #: of the runs
    seeds: tuple[np.random.SeedSequence, ...]  #: of the runs
    measured: tuple[bool, ...]  #: whether a run's advice is also driven
    guides: Mapping[str, np.ndarray]  #: abstract policies (Z, A)
    tables: Mapping[str, np.ndarray]  #: what is whispered, (Z, A)
    scale: Scale  #: steps of a run


class Outcome(NamedTuple):
    """What came of the runs."""

    goals: tuple[int, ...]  #: of each run
    measures: tuple[dict, ...]  #: what else was measured of each run, by name
    seconds: float  #: of one core


def learn(case: Case) -> Outcome:
    """Return what came of some runs; those with one guide and one tau share a loop."""
    began, tasks, problem = thread_time(), target_tasks(case.problem), case.problem
    groups = {}
    for i, (arm, *_) in enumerate(case.arms):
        groups.setdefault((arm.guide, arm.strategy, arm.tau), []).append(i)
    goals = np.zeros(len(case.arms), dtype=int)
    for (guide, strategy, tau), members in groups.items():
        heed_stop()
        learner = Learner(
            tasks.mdp,
            rngs=[case.seeds[i] for i in members],
            q0s=[_first_notes(case, tasks, case.arms[i]) for i in members],
            guide=guide and advised(tasks, _advice(case, guide)),
            strategy=strategy,
            tau=tau,
            alpha=problem.alpha,
            epsilon=problem.epsilon,
            gamma=problem.gamma,
            max_episode=problem.max_episode,
            window=case.scale.steps,
        )
        for first in range(0, case.scale.steps, SLICE):
            steps = min(SLICE, case.scale.steps - first)
            learner.advance(steps, on_progress=heed_stop)
        goals[members] = [run.goals.sum() for run in learner.results()]
    measures = tuple(
        _drives(problem, _advice(case, arm.guide)) if measured else {}
        for (arm, *_), measured in zip(case.arms, case.measured, strict=True)
    )
    return Outcome(tuple(goals.tolist()), measures, thread_time() - began)


def _first_notes(case: Case, tasks, one: Told) -> np.ndarray:
    """Return what a robot starts from, (S, A)."""
    start = case.problem.q0 + one.arm.hint * tasks.available
    if one.table == CEILING:
        best = best_notes(tasks.mdp, case.problem.gamma)
        return np.where(tasks.mdp.allowed, best, 0.0)
    if one.table:
        start = start + first_notes(tasks, case.tables[one.table], one.size)
    return start


def _advice(case: Case, guide: str) -> np.ndarray:
    """Return advice by name, (Z, A); some depends on the building."""
    if guide in EXCHANGED:
        ends = (case.guides[name] for name in ENDS)
        return exchange_rows(case.problem, *ends)[guide]
    return case.guides[guide]


def _drives(problem: Problem, advice: np.ndarray) -> dict:
    """Return how advice drives: the value of Table 1, variation of return; exact."""
    tasks = driving_tasks(problem)
    value = executed_values(tasks, {"": advice})[""]
    policy = advised(tasks, advice)
    return {
        "value": round(float(value), 4),
        "variation": round(return_variation(tasks.mdp, policy), 4),
    }


def make_advice(names: Iterable[str], problem: Problem) -> dict[str, np.ndarray]:
    """
    Return advice (Z, A) by name: the paper's, that of `guides`, and mixtures.

    >>> advice = make_advice(["nd", "beta-0", "mix-0"], Problem())
    >>> bool(np.allclose(advice["nd"], advice["mix-0"]))
    True
    """
    names = set(names)
    papers = names & set(GUIDES)
    mixes = {name for name in names if name.startswith(START)}
    made = names - papers - mixes - set(EXCHANGED)
    if mixes or names & set(EXCHANGED):
        made |= set(ENDS)
    advice = build_guides(problem, papers) | make_guides(sorted(made), problem)
    ends = [advice[name] for name in (ENDS[0], ENDS[-1])] if mixes else ()
    return advice | {name: mixed(name, *ends) for name in mixes}


def run_survey(
    arms: Iterable[Told],
    buildings: Iterable[Map],
    problem: Problem | None = None,
    *,
    n_runs: int = 1,
    drives: Iterable[str] = (),
    scale: str | Scale = "paper",
    stream: str = "report",
    seed: int = SEED,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> Results:
    """
    Return the goals of every arm in every building, (arms, buildings x N, 1).

    Parameters
    ----------
    arms : iterable of Told
    buildings : iterable of Map
        In place of the problem's target.
    problem : Problem, optional
        By default the book's.
    n_runs : int, default 1
        Runs of each arm in each building; those of a building follow one another.
    drives : iterable of str
        Arms whose advice is also driven.
    scale, stream, seed, executor, n_workers, out, on_progress
        As for :func:`~abstransfer.experiments.run.run_experiment`, to which a
        folder and an interrupt are the same.

    Returns
    -------
    Results
        The record holds, by arm in `drives`, what was measured in each building:
        ``value`` at 0.99, and ``variation`` of return.

    Raises
    ------
    ValueError
        If an arm is bad, or `out` holds another experiment.
    """
    arms, buildings = tuple(arms), tuple(buildings)
    problem, drives = problem or Problem(), set(drives)
    n_runs = whole("n_runs", n_runs, 1)
    check_arms(one.arm for one in arms)
    scale = SCALES[scale] if isinstance(scale, str) else scale
    scale = Scale(scale.steps, scale.steps)
    own = tuple(one._replace(arm=_shrunk(one.arm, scale)) for one in arms)
    advice = make_advice({one.arm.guide for one in arms} - {None}, problem)
    tables = taught(problem) if any(one.table for one in arms) else {}
    tables = {name: tables[name] for name in {o.table for o in arms} & set(tables)}

    def jobs(done: np.ndarray) -> Iterator[tuple[tuple, Case]]:
        for b, building in enumerate(buildings):
            here = replace(problem, target=building)
            runs = range(b * n_runs, (b + 1) * n_runs)
            missing = [(a, n) for a in range(len(arms)) for n in runs if not done[a, n]]
            missing.sort(key=lambda pair: str(own[pair[0]].arm[1:4]))  # stable
            for first in range(0, len(missing), TOGETHER):
                some = tuple(missing[first : first + TOGETHER])
                yield (
                    some,
                    Case(
                        here,
                        tuple(own[a] for a, _ in some),
                        tuple(
                            np.random.SeedSequence(seed, spawn_key=(STREAMS[stream], n))
                            for _, n in some
                        ),
                        tuple(
                            arms[a].arm.name in drives and n == runs[0] for a, n in some
                        ),
                        advice,
                        tables,
                        scale,
                    ),
                )

    names = [one.arm.name for one in arms]
    return carry_out(
        Work(
            tuple(one.arm for one in arms),
            (len(arms), len(buildings) * n_runs, 1),
            scale.steps,
            {
                "reading": _reading(problem, buildings),
                "steps": scale.steps,
                "window": scale.steps,
                "arms": [
                    one.record() | {"tau_steps": small.arm.tau}
                    for one, small in zip(arms, own, strict=True)
                ],
                "runs": len(buildings) * n_runs,
                "runs_in_a_building": n_runs,
                "seed": seed,
                "stream": stream,
                "guides": _digests(advice),
                "tables": _digests(tables),
            },
            learn,
            jobs,
            _keep,
            lambda store: _measured(store, names),
        ),
        executor=executor,
        n_workers=n_workers,
        out=out,
        on_progress=on_progress,
    )


def _shrunk(arm: Arm, scale: Scale) -> Arm:
    return arm._replace(tau=scale.tau(arm))


def _reading(problem: Problem, buildings: tuple[Map, ...]) -> dict:
    """Return what is learned, for JSON; several buildings as one, by their texts."""
    if len(buildings) == 1:
        return replace(problem, target=buildings[0]).record()
    maps = "\n".join(map(str, buildings))
    return problem.record() | {
        "target": {"name": "drawn", "sha256": digest(maps.encode())}
    }


def _digests(arrays: Mapping[str, np.ndarray]) -> dict[str, str]:
    return {
        name: digest(np.round(array + 0.0, 6).tobytes())
        for name, array in sorted(arrays.items())
    }


def _keep(store: Store, key: tuple, outcome: Outcome) -> None:
    """Keep each run by itself, so that each is resumed."""
    for (arm, run), goals, found in zip(key, *outcome[:2], strict=True):
        seconds = outcome.seconds / len(key)
        store.save(arm, run, np.array([[goals]]), seconds, **found)


def _measured(store: Store, names: list[str]) -> dict:
    """Return what was measured, by measure and arm, a list of buildings each."""
    found = {}
    for (arm, _), measures in sorted(store.measures.items()):
        for name, value in measures.items():
            found.setdefault(name, {}).setdefault(names[arm], []).append(value)
    return found
