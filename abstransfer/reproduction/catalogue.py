"""
All experiments of the book, as data, and one call that runs them.

Both rewards; the paper's tau, a grid of tau, and the tau that is best there;
and three more buildings that fit the paper's reference rows as well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from ..experiments.arms import ARMS, Arm, tau_cells
from ..experiments.plan import SEED
from ..experiments.problem import Problem
from ..experiments.results import Results, load_results
from ..experiments.run import run_experiment
from ..experiments.tuning import tune, tuned_arms
from ..maps import read_map


class Experiment(NamedTuple):
    """One folder of results."""

    folder: str
    reward: str
    target: str
    n_runs: int
    grid: bool = False  # every guided arm at every tau, with the tuning seeds
    tuned_by: str | None = None  # folder of the grid whose best tau to take


EXPERIMENTS = (
    *(
        Experiment(f"{reward}-target", reward, "target", 50)
        for reward in ("goal", "cost")
    ),
    *(
        Experiment(f"{reward}-target_{x}", reward, f"target_{x}", 20)
        for reward in ("goal", "cost")
        for x in "bcd"
    ),
    *(
        Experiment(f"{reward}-target-tau", reward, "target", 10, grid=True)
        for reward in ("goal", "cost")
    ),
    *(
        Experiment(
            f"{reward}-target-tuned",
            reward,
            "target",
            50,
            tuned_by=f"{reward}-target-tau",
        )
        for reward in ("goal", "cost")
    ),
)


def arms_of(experiment: Experiment, out: str | Path) -> tuple[Arm, ...]:
    """Return the arms of an experiment; a tuned one reads its grid in `out`."""
    if experiment.tuned_by:
        return tuned_arms(tune(load_results(Path(out) / experiment.tuned_by)))
    return tau_cells() if experiment.grid else ARMS


def reproduce(
    out: str | Path,
    *,
    scale: str = "paper",
    problem: Problem | None = None,
    n_runs: int | None = None,
    seed: int = SEED,
    n_workers: int | None = None,
    experiments: tuple[Experiment, ...] = EXPERIMENTS,
    on_start: Callable[[Experiment], Callable | None] = lambda experiment: None,
) -> dict[str, Results]:
    """
    Run all experiments of the book, each into its folder in `out`; or go on.

    Parameters
    ----------
    out, scale, seed, n_workers
        As for :func:`~abstransfer.experiments.run.run_experiment`.
    problem : Problem, optional
        What is not the paper's; reward and target are those of the experiment.
    n_runs : int, optional
        In place of the number of runs of each experiment.
    on_start : callable, optional
        Called with each experiment; returns its `on_progress`.

    Returns
    -------
    dict from folder to Results
    """
    found = {}
    for experiment in experiments:
        found[experiment.folder] = run_experiment(
            arms_of(experiment, out),
            replace(
                problem or Problem(),
                reward=experiment.reward,
                target=read_map(experiment.target),
            ),
            scale=scale,
            n_runs=experiment.n_runs if n_runs is None else n_runs,
            seed=seed,
            stream="tune" if experiment.grid else "report",
            n_workers=n_workers,
            out=Path(out) / experiment.folder,
            on_progress=on_start(experiment),
        )
    return found
