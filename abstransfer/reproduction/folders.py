"""
One folder of results as data: what is run into it, and how.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ..experiments.arms import ARMS, SCALES, STRATEGIES, Arm, Scale, tau_cells
from ..experiments.problem import GUIDES, Problem
from ..experiments.results import load_results
from ..experiments.run import run_experiment
from ..experiments.tuning import tune, tuned_arms
from ..maps import Map, read_map
from .buildings import BLOCKS, draw_building
from .guides import ADVICE, TAU, make_guides
from .interventions import run_operations
from .operations import MAIN, OPERATIONS
from .searches import run_search
from .surveys import Told, run_survey, settle
from .traps import EXCHANGED


class Experiment(NamedTuple):
    """One folder of results."""

    folder: str  #: its name below data/results
    n_runs: int  #: runs of each arm
    reward: str = "goal"  #: "goal" or "cost"
    target: str = "target"  #: name of the map
    problem: Mapping = {}  #: what else is not the problem of the book
    grid: bool = False  #: every guided arm at every tau, with the tuning seeds
    tuned_by: str | None = None  #: folder of the grid whose best tau to take
    guides: tuple[str, ...] = ()  #: names in ADVICE, in place of the nine arms
    strategies: tuple[str, ...] = STRATEGIES  #: under which they are given
    taus: tuple[int, ...] = ()  #: for which they are given, in place of TAU
    given: tuple[Arm, ...] = ()  #: arms in place of all these

    def run(self, out: str | Path, problem: Problem | None = None, **options):
        """Return the results, from its folder in `out`; see `reproduce`."""
        problem, arms = self.here(problem), self.arms(out)
        made = {arm.guide for arm in arms} & {*ADVICE, *EXCHANGED} - set(GUIDES)
        options = {"n_runs": self.n_runs} | options
        return run_experiment(
            arms,
            problem,
            stream="tune" if self.grid else "report",
            guides=make_guides(made, problem) if made else None,
            out=Path(out) / self.folder,
            **options,
        )

    def here(self, problem: Problem | None = None) -> Problem:
        """Return a problem, by default the book's, as it is read here."""
        changed = {"reward": self.reward, **self.problem}
        return replace(problem or Problem(), target=read_map(self.target), **changed)

    def arms(self, out: str | Path) -> tuple[Arm, ...]:
        """
        Return what is compared; a tuned experiment reads its grid in `out`.

        >>> [arm.name for arm in Experiment("x", 1, guides=("grad",)).arms("")]
        ['none', 'grad-hard', 'grad-soft']
        """
        if self.tuned_by:
            grid = tune(load_results(Path(out) / self.tuned_by))
            return tuned_arms(grid, self.given or ARMS)
        if self.given:
            return self.given
        if not self.guides:
            return tau_cells() if self.grid else ARMS
        return ARMS[:1] + tuple(
            Arm(f"{guide}-{strategy}", guide, strategy, tau)
            for guide in self.guides
            for strategy in self.strategies
            for tau in self.taus or (TAU[strategy],)
        )


class Operated(NamedTuple):
    """One folder of results of operations on notes."""

    folder: str  #: its name below data/results
    n_runs: int  #: runs of each operation
    target: str | None  #: name of the map; None for a drawn one each run
    first: int = 0  #: seed of the first drawn building
    operations: tuple[str, ...] = ()  #: by default all, in drawn buildings MAIN

    def run(self, out: str | Path, problem: Problem | None = None, **options):
        """Return the results, from its folder in `out`; see `reproduce`."""
        options = {"n_runs": self.n_runs} | options
        return run_operations(
            self.here(problem),
            operations=self.operations or (OPERATIONS if self.target else MAIN),
            drawn=not self.target,
            first=self.first,
            out=Path(out) / self.folder,
            **options,
        )

    def here(self, problem: Problem | None = None) -> Problem:
        """Return a problem, by default the book's, as it is read here."""
        problem = problem or Problem()
        if not self.target:
            return problem
        return replace(problem, target=read_map(self.target))


class Survey(NamedTuple):
    """One folder of results of arms in many buildings, or in one."""

    folder: str  #: its name below data/results
    n_runs: int  #: runs of each arm in each building
    given: tuple[Told, ...]  #: what is compared
    target: str | None = None  #: name of the map; None for drawn ones
    seeds: tuple[int, ...] = ()  #: of the drawn ones
    blocks: tuple[int, int] = BLOCKS  #: their size
    problem: Mapping = {}  #: what is not the problem of the book
    stream: str = "report"  #: of seeds; "tune" for what finds the best
    drives: tuple[str, ...] = ()  #: arms whose advice is also driven
    per_state: bool = False  #: as many steps for each state as in the target's size

    def run(self, out: str | Path, problem: Problem | None = None, **options):
        """Return the results, from its folder in `out`; see `reproduce`."""
        options = {"n_runs": self.n_runs, "scale": "paper"} | options
        buildings = [draw_building(seed, self.blocks) for seed in self.seeds]
        if self.target:
            buildings = [read_map(self.target)]
        if self.per_state:
            options["scale"] = per_state(options["scale"], buildings[0])
        return run_survey(
            self.arms(out),
            buildings,
            self.here(problem),
            stream=self.stream,
            drives=self.drives,
            out=Path(out) / self.folder,
            **options,
        )

    def here(self, problem: Problem | None = None) -> Problem:
        """Return a problem, by default the book's, as it is read here."""
        return replace(problem or Problem(), **self.problem)

    def arms(self, out: str | Path) -> tuple[Told, ...]:
        """Return what is compared; a tuned arm is read from its folder in `out`."""
        return tuple(
            settle(one, load_results(Path(out) / one.own)) if one.own else one
            for one in self.given
        )


class Searched(NamedTuple):
    """One folder of results of a search for the best teacher."""

    folder: str  #: its name below data/results
    n_runs: int  #: runs of each trial
    target: str  #: name of the map

    def run(self, out: str | Path, problem: Problem | None = None, **options):
        """Return the results, from its folder in `out`; see `reproduce`."""
        options = {"n_runs": self.n_runs, "scale": "paper"} | options
        problem = self.here(problem)
        options["scale"] = per_state(options["scale"], problem.target)
        return run_search(problem, out=Path(out) / self.folder, **options)

    def here(self, problem: Problem | None = None) -> Problem:
        """Return a problem, by default the book's, as it is read here."""
        return replace(problem or Problem(), target=read_map(self.target))


def per_state(scale: str | Scale, building: Map) -> Scale:
    """
    Return a scale with as many steps for each state as it has in the target.

    >>> per_state("paper", read_map("target")).steps
    30000000
    >>> per_state("paper", read_map("source")).steps
    2357143
    """
    steps = SCALES[scale].steps if isinstance(scale, str) else scale.steps
    here, there = (map_.n_cells * len(map_.goals) for map_ in (building, _target()))
    return Scale(round(steps * here / there), 1)


@cache
def _target() -> Map:
    return read_map("target")
