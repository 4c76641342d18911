"""
The bench: all methods of :mod:`.neighbours`, tuned by one budget, on one ladder.

Every method has the same two tuning runs for each of its settings, in the target,
with seeds of their own.  What is chosen there is run in the target with other seeds,
and in drawn buildings, which nothing was tuned for: once in each.  A run has the same
luck for every method.  What is counted is the goals of whole runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from time import thread_time
from typing import NamedTuple

import numpy as np

from .. import rivals
from ..experiments.arms import SCALES, Arm, Scale
from ..experiments.plan import SEED, STREAMS
from ..experiments.problem import Problem, digest
from ..experiments.results import Results, load_results, read_results
from ..experiments.run import Work, carry_out
from ..experiments.stats import Interval, gain_interval, t_interval
from ..experiments.store import Store
from ..experiments.workers import SLICE, heed_stop
from ..learning import Learner
from ..learning.settings import whole
from ..maps import read_map
from .buildings import draw_building
from .neighbours import METHODS, Start, known

NAMES = {method.name: method for method in METHODS}
TUNING, TARGET, DRAWN = "neighbours-tuning", "neighbours-target", "neighbours-drawn"
FIRST = 100  # seed of the first drawn building
CEILING, BEST_OF_PAPER = "ceiling", "nd-hard"
TOGETHER = 9  # runs in a job, of one building


class Tried(NamedTuple):
    """A method with one of its settings."""

    method: str  #: a name in NAMES
    setting: object  #: one of its settings

    def record(self, name: str) -> dict:
        """Return it for JSON, as an arm of this name."""
        setting = self.setting
        if isinstance(setting, tuple):
            setting = list(setting)  # as JSON gives it back
        arm = Arm(name, None, "hard", 0)
        return arm.record() | {"method": self.method, "setting": setting}


class Case(NamedTuple):
    """Some runs of one building, with one luck: all that a worker needs to know."""

    problem: Problem  #: what is learned
    tried: tuple[Tried, ...]  #: by whom
    scale: Scale  #: steps of a run and of a window
    seed: np.random.SeedSequence  #: of all of them


def do_case(case: Case) -> tuple[np.ndarray, float]:
    """Return the goals (n, B) of some runs, and the core seconds they took."""
    heed_stop()
    began = thread_time()
    here, steps = known(case.problem), case.scale.steps
    made = [NAMES[m].make(here, setting, steps) for m, setting in case.tried]
    goals = np.zeros((len(made), steps // case.scale.window), np.int64)
    alone = [i for i, one in enumerate(made) if one.rival is None and not one.tau]
    if alone:  # these differ in their first notes only, and share a loop
        tables = [np.broadcast_to(made[i].q0, here.shape) for i in alone]
        goals[alone] = _learn(case, here, Start(), q0s=tables)
    for i, one in enumerate(made):
        if i not in alone:
            goals[i] = _learn(case, here, one)
    return goals, thread_time() - began


def _learn(case: Case, here, one: Start, q0s=None) -> np.ndarray:
    """Return the goals of one run, or of one for each table of first notes."""
    problem, mdp = case.problem, here.tasks.mdp
    options = {
        "guide": one.guide,
        "alpha": problem.alpha,
        "epsilon": problem.epsilon if one.epsilon is None else one.epsilon,
        "gamma": problem.gamma,
        "max_episode": problem.max_episode,
        "window": case.scale.window,
    }
    steps = case.scale.steps
    if one.rival:
        options |= {"rng": case.seed, "on_progress": heed_stop}
        return rivals.learn_as(one.rival, mdp, steps, **options).goals
    options |= {"strategy": one.strategy, "tau": one.tau, "q0s": q0s}
    learner = Learner(mdp, rngs=[case.seed] * (len(q0s) if q0s else 1), **options)
    for first in range(0, steps, SLICE):
        learner.advance(min(SLICE, steps - first), on_progress=heed_stop)
    return np.array([run.goals for run in learner.results()])


class Bench(NamedTuple):
    """One folder of results of the bench."""

    folder: str  #: its name below data/results
    n_runs: int  #: runs of each method, or of each setting
    target: str | None  #: name of the map; None for a drawn one each run
    tuned_by: str | None = None  #: folder whose best settings to take; None: all
    curves: bool = False  #: whether goals are counted by window, or as a whole

    def run(self, out: str | Path, problem: Problem | None = None, **options):
        """Return the results, from its folder in `out`; see `reproduce`."""
        tried = all_settings()
        if self.tuned_by:
            tried = chosen(load_results(Path(out) / self.tuned_by))
        return run_bench(
            tried,
            self.here(problem),
            drawn=not self.target,
            curves=self.curves,
            stream="report" if self.tuned_by else "tune",
            out=Path(out) / self.folder,
            **{"n_runs": self.n_runs} | options,
        )

    def here(self, problem: Problem | None = None) -> Problem:
        """Return a problem, by default the book's, as it is read here."""
        problem = problem or Problem()
        if not self.target:
            return problem
        return replace(problem, target=read_map(self.target))


NEIGHBOURS = (
    Bench(TUNING, 2, "target"),
    Bench(TARGET, 5, "target", TUNING, curves=True),
    Bench(DRAWN, 24, None, TUNING),
)


def all_settings() -> dict[str, Tried]:
    """
    Return every method with each of its settings, by the name of its arm.

    >>> all_settings()["nd-hard 3500000"]
    Tried(method='nd-hard', setting=3500000)
    """
    return {
        f"{method.name} {setting_text(setting)}".strip(): Tried(method.name, setting)
        for method in METHODS
        for setting in method.settings
    }


def chosen(tuning: Results) -> dict[str, Tried]:
    """Return every method with the setting of most goals in the mean, by its name."""
    means = tuning.goals.sum(axis=2).mean(axis=1)
    by_arm = dict(zip((arm.name for arm in tuning.arms), means, strict=True))
    best: dict[str, tuple[float, Tried]] = {}
    for arm, tried in all_settings().items():  # of equal ones, the first
        if by_arm[arm] > best.get(tried.method, (-1,))[0]:
            best[tried.method] = by_arm[arm], tried
    return {name: tried for name, (_, tried) in best.items()}


def setting_text(setting) -> str:
    """
    Return a setting as a plain word.

    >>> setting_text((0.95, 0.05)), setting_text(None)
    ('0.95 0.05', '')
    """
    if setting is None:
        return ""
    several = setting if isinstance(setting, tuple) else (setting,)
    return " ".join(str(x) if isinstance(x, int) else f"{x:g}" for x in several)


def run_bench(
    tried: dict[str, Tried],
    problem: Problem | None = None,
    *,
    n_runs: int = 5,
    drawn: bool = False,
    curves: bool = False,
    scale: str | Scale = "paper",
    stream: str = "report",
    seed: int = SEED,
    executor: Executor | None = None,
    n_workers: int | None = None,
    out: str | Path | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> Results:
    """
    Return the goals of methods with their settings, (methods, N, B).

    Parameters
    ----------
    tried : dict from name of an arm to Tried
    problem : Problem, optional
        By default the book's.
    n_runs : int, default 5
    drawn : bool
        Run i has a building of its own, that of seed 100 + i.
    curves : bool
        Count goals by window; else B is 1.
    scale, stream, seed, executor, n_workers, out, on_progress
        As for :func:`~abstransfer.experiments.run.run_experiment`, to which a
        folder and an interrupt are the same.

    Raises
    ------
    ValueError
        If a method is unknown, or `out` holds another experiment.
    """
    problem, n_runs = problem or Problem(), whole("n_runs", n_runs, 1)
    for one in tried.values():
        if one.method not in NAMES:
            raise ValueError(
                f"tried must hold methods among {tuple(NAMES)}, got {one.method!r}"
            )
    scale = SCALES[scale] if isinstance(scale, str) else scale
    if not curves:
        scale = Scale(scale.steps, scale.steps)
    problems = [problem] * n_runs
    if drawn:
        buildings = [draw_building(FIRST + i) for i in range(n_runs)]
        problems = [replace(problem, target=building) for building in buildings]
    arms = tuple(Arm(name, None, "hard", 0) for name in tried)

    def jobs(done: np.ndarray) -> Iterator[tuple[tuple, Case]]:
        for run in range(n_runs):
            missing = np.flatnonzero(~done[:, run]).tolist()
            for first in range(0, len(missing), TOGETHER):
                some = tuple(missing[first : first + TOGETHER])
                key = np.random.SeedSequence(seed, spawn_key=(STREAMS[stream], run))
                asked = tuple(list(tried.values())[i] for i in some)
                yield (some, run), Case(problems[run], asked, scale, key)

    return carry_out(
        Work(
            arms,
            (len(arms), n_runs, scale.steps // scale.window),
            scale.steps,
            {
                "reading": _reading(problem, problems, drawn),
                "steps": scale.steps,
                "window": scale.window,
                "arms": [one.record(name) for name, one in tried.items()],
                "runs": n_runs,
                "seed": seed,
                "stream": stream,
            },
            do_case,
            jobs,
            _keep,
            lambda store: {},
        ),
        executor=executor,
        n_workers=n_workers,
        out=out,
        on_progress=on_progress,
    )


def _reading(problem: Problem, problems: list[Problem], drawn: bool) -> dict:
    """Return what is learned, for JSON; several buildings as one, by their texts."""
    if not drawn:
        return problem.record()
    maps = "\n".join(str(each.target) for each in problems)
    return problem.record() | {
        "target": {"name": "drawn", "sha256": digest(maps.encode())}
    }


def _keep(store: Store, key, outcome) -> None:
    """Keep what came of some runs: each by itself, so that each is resumed."""
    (missing, run), (goals, seconds) = key, outcome
    for arm, each in zip(missing, goals, strict=True):
        store.save(arm, run, each[None], seconds / len(missing))


class Rung(NamedTuple):
    """A method on the ladder."""

    name: str  #: a name in NAMES
    says: str  #: what it does
    source: str  #: author and year
    setting: str  #: that tuning chose, in words
    at_edge: bool  #: whether it ends the row of those tried: a better may lie beyond
    goals: Interval  #: of a whole run
    shortfall: Interval  #: share of the ceiling's goals that it misses; below 0: none
    over_nd: Interval  #: gain over ND hard, run by run
    wins: int  #: runs, or buildings, in which it beats ND hard


def ladder(
    folder: str = DRAWN, read: Callable[[str], Results] = read_results
) -> tuple[Rung, ...]:
    """
    Return all methods, that of the smallest shortfall first.

    Intervals are Student's: over drawn buildings (``neighbours-drawn``), where each
    has a run, or over runs in the target (``neighbours-target``).

    Parameters
    ----------
    folder : str
    read : callable
        Returns the results of a folder by its name; by default the stored ones.
    """
    results = read(folder)
    settings = {arm["name"]: arm for arm in results.record["parameters"]["arms"]}
    goals = {arm.name: results.totals(arm.name) for arm in results.arms}
    best, nd = goals[CEILING], goals[BEST_OF_PAPER]
    rungs = [
        Rung(
            name,
            NAMES[name].says,
            NAMES[name].source,
            told(name, settings[name]["setting"]),
            at_edge(name, settings[name]["setting"]),
            t_interval(found),
            t_interval(1 - found / best),
            gain_interval(found, nd),
            int((found > nd).sum()),
        )
        for name, found in goals.items()
    ]
    return tuple(sorted(rungs, key=lambda rung: rung.shortfall.estimate))


def told(name: str, setting) -> str:
    """
    Return a setting of a method in words.

    >>> told("library", (0.95, 0.05)), told("none", None)
    ('v, heat = 0.95, 0.05', '')
    """
    if setting is None:
        return ""
    setting = tuple(setting) if isinstance(setting, list) else setting
    return f"{NAMES[name].about} = {setting_text(setting).replace(' ', ', ')}"


def at_edge(name: str, setting) -> bool:
    """
    Return whether a setting is the least or the largest that was tried.

    In any of its numbers, where three or more were tried.

    >>> at_edge("nd-hard", 3_500_000), at_edge("library", (0.98, 0.05))
    (False, True)
    """
    if setting is None:
        return False
    rows = np.atleast_2d(np.array(NAMES[name].settings, dtype=float).T)
    return any(
        len(set(row)) > 2 and x in (row.min(), row.max())
        for row, x in zip(rows, np.atleast_1d(setting), strict=True)
    )


def ladder_table(rungs: Iterable[Rung]) -> list[dict]:
    """Return a row for each rung, for ``tables.to_markdown``."""
    return [
        {
            "method": rung.name,
            "source": rung.source,
            "setting": rung.setting + (" (edge)" if rung.at_edge else ""),
            "goals, thousands": _text(rung.goals, 1e-3, 1),
            "short of the ceiling, %": _text(rung.shortfall, 100, 1),
            "over ND hard, %": _text(rung.over_nd, 100, 1, "+"),
            "beats ND hard": rung.wins,
        }
        for rung in rungs
    ]


def _text(interval: Interval, factor: float, digits: int, sign: str = "") -> str:
    estimate, low, high = (f"{factor * x:{sign}.{digits}f}" for x in interval)
    return estimate if low == "nan" else f"{estimate} [{low}, {high}]"
