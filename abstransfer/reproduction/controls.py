"""
The experiments of the second edition, as data: controls, a compass, traps, tau.

An effect "over no advice" stands beside controls that need no other building: a
first hint of what can be done, a robot that cannot choose what is not there, and
the eager robot.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..experiments.arms import ARMS, STRATEGIES, TAUS, Arm, Scale, tau_cells
from ..experiments.diagnosis import stuck
from ..experiments.plan import SEED
from ..experiments.problem import Problem, target_tasks
from ..experiments.results import Results, load_results
from ..experiments.run import run_experiment
from ..experiments.tuning import tune, tuned_arms
from ..maps import read_map
from .catalogue import ADVICE, TAU, make_guides
from .interventions import TINY

TARGETS = ("target", "target_b", "target_c", "target_d")
HINT = Arm("hint", None, "hard", 0, TINY)
EAGER = tuple(Arm(f"eager-{s}", "available", s, TAU[s]) for s in STRATEGIES)
#: Between the points of the first grid, in steps at paper scale.
FINE = tuple(round(1e6 * tau) for tau in (2.5, 3, 4, 4.5, 5, 7.5, 12, 16))


def trap_views(problem: Problem, advice: np.ndarray, share: float = 0.9) -> np.ndarray:
    """
    Return the abstract states that hold most of those who do not arrive, (Z,) bool.

    The fewest that hold at least `share` of the episodes which advice (Z, A) leaves
    on the way after 5,000 steps.
    """
    tasks = target_tasks(problem)
    late = stuck(tasks.mdp, advice[tasks.rho], problem.max_episode)
    by_view = np.bincount(tasks.rho, late, minlength=len(advice))
    order = np.argsort(-by_view, kind="stable")
    n = int(np.searchsorted(by_view[order].cumsum(), share * by_view.sum())) + 1
    views = np.zeros(len(advice), dtype=bool)
    views[order[:n]] = True
    return views


def trap_guides(problem: Problem) -> dict[str, np.ndarray]:
    """
    Return Prob and ND with rows exchanged, or diluted, in Prob's traps or elsewhere.

    Names say whose advice, and what was put where.
    """
    advice = make_guides(("beta-0", "beta-1", "available"), problem)
    nd, prob, eager = advice["beta-0"], advice["beta-1"], advice["available"]
    traps = trap_views(problem, prob)[:, None]
    half = (prob + eager) / 2
    return {
        "nd": nd,
        "prob": prob,
        "prob-nd-in-traps": np.where(traps, nd, prob),
        "nd-prob-in-traps": np.where(traps, prob, nd),
        "prob-eager-in-traps": np.where(traps, half, prob),
        "prob-eager-elsewhere": np.where(traps, prob, half),
        "prob-eager": half,
    }


TRAPS = tuple(
    Arm(f"{name}-hard", name, "hard", TAU["hard"])
    for name in (
        "nd",
        "prob",
        "prob-nd-in-traps",
        "nd-prob-in-traps",
        "prob-eager-in-traps",
        "prob-eager-elsewhere",
        "prob-eager",
    )
)
#: ND, Prob, half ND half eager, and eager: each at its own tau.
FOUR = tuple(
    Arm(f"{name}-{s}", name, s, TAU[s])
    for name in ("beta-0", "beta-1", "nd-available-0.5", "available")
    for s in STRATEGIES
)
OWN_TAUS = {"hard": (2_000_000, 3_500_000, 6_000_000)}
OWN_TAUS["soft"] = (6_000_000, 9_000_000, 11_000_000)


class Control(NamedTuple):
    """One folder of results."""

    folder: str
    arms: tuple[Arm, ...]
    target: str = "target"
    problem: Mapping = {}  # what is not the problem of the book
    n_runs: int = 10
    tuned_by: str | None = None  # folder of the grid whose best tau to take
    grid: bool = False  # with the tuning seeds


def _of_building(target: str) -> tuple[Control, ...]:
    compass, n_runs = {"actions": "compass"}, 10 if target == "target" else 6
    tuned_by = "compass-target-tau"
    return (
        Control(f"controls-{target}", (HINT, *EAGER), target),
        Control(
            f"masked-{target}",
            (ARMS[0], ARMS[3], ARMS[5]),  # none, ND hard, Prob hard
            target,
            {"unavailable": "masked"},
        ),
        Control(f"traps-{target}", TRAPS, target, n_runs=8),
        Control(f"compass-{target}", (*ARMS, HINT, *EAGER), target, compass, n_runs),
        Control(f"compass-{target}-tuned", ARMS, target, compass, n_runs, tuned_by),
    )


CONTROLS = (
    Control(
        "compass-target-tau",
        tau_cells(taus=TAUS[:8]),
        problem={"actions": "compass"},
        n_runs=4,
        grid=True,
    ),
    *(control for target in TARGETS for control in _of_building(target)),
    Control(
        "goal-target-tau-fine", tau_cells(ARMS[3:7], FINE), n_runs=6, grid=True
    ),  # ND and Prob
    Control(
        "study-own-tau",
        tuple(arm._replace(tau=t) for arm in FOUR for t in OWN_TAUS[arm.strategy]),
        n_runs=4,
        grid=True,
    ),
    Control("study-own", FOUR, tuned_by="study-own-tau"),
)


def run_controls(
    out: str | Path,
    folders: Iterable[str] | None = None,
    *,
    scale: str | Scale = "paper",
    n_runs: int | None = None,
    seed: int = SEED,
    on_start: Callable[[Control], Callable | None] = lambda control: None,
    **options,
) -> dict[str, Results]:
    """
    Run controls, each into its folder in `out`; or go on where a call ended.

    `folders` names some of them; all by default.  Other options: see
    :func:`~abstransfer.experiments.run.run_experiment`.
    """
    known = {control.folder: control for control in CONTROLS}
    found = {}
    for folder in known if folders is None else folders:
        if folder not in known:
            raise ValueError(f"folders must be among {tuple(known)}, got {folder!r}")
        control = known[folder]
        problem = Problem(target=read_map(control.target), **control.problem)
        arms = control.arms
        if control.tuned_by:
            arms = tuned_arms(tune(load_results(Path(out) / control.tuned_by)), arms)
        own = {arm.guide for arm in arms if arm.guide}
        guides = make_guides(sorted(own & set(ADVICE)), problem)
        if arms == TRAPS:
            guides = trap_guides(problem)
        found[folder] = run_experiment(
            arms,
            problem,
            scale=scale,
            n_runs=control.n_runs if n_runs is None else n_runs,
            seed=seed,
            stream="tune" if control.grid else "report",
            guides=guides,
            out=Path(out) / folder,
            on_progress=on_start(control),
            **options,
        )
    return found
