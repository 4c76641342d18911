"""
The plan of an experiment: everything it depends on, checked before a step is run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from ..driving import advised
from ..learning.settings import exact_seed, whole
from .arms import MOST_WINDOWS, SCALES, Arm, Scale, check_arms
from .problem import GUIDES, Problem, build_guides, digest, target_tasks
from .workers import Job

SEED = 2015  # the year of the paper
STREAMS = {"report": 0, "tune": 1}
CHUNK = 6  # runs in a job; they share the loop, so that none waits for memory alone


class Plan(NamedTuple):
    """An experiment, checked, before its first step."""

    arms: tuple[Arm, ...]  #: what is compared
    problem: Problem  #: what is learned
    scale: Scale  #: steps of a run and of a window
    n_runs: int  #: runs of each arm
    seed: int  #: of all runs
    stream: str  #: "report" or "tune"
    guides: dict[str, np.ndarray]  #: abstract policies (Z, A)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape of the goals: arms, N runs, B windows."""
        return len(self.arms), self.n_runs, self.scale.steps // self.scale.window

    @property
    def n_steps(self) -> int:
        """Steps of all runs together."""
        return len(self.arms) * self.n_runs * self.scale.steps


def make_plan(
    arms: Iterable[Arm],
    problem: Problem | None,
    scale: str | Scale,
    n_runs: int,
    *,
    seed: int = SEED,
    stream: str = "report",
    guides: Mapping[str, np.ndarray] | None = None,
) -> Plan:
    """Return the experiment, its guides built; arguments as for `run_experiment`."""
    if isinstance(scale, str):
        if scale not in SCALES:
            raise ValueError(f"scale must be one of {tuple(SCALES)}, got {scale!r}")
        scale = SCALES[scale]
    elif not isinstance(scale, Scale):
        raise ValueError(f"scale must be a Scale or its name, got {scale!r}")
    scale = Scale(whole("steps", scale.steps, 1), whole("window", scale.window, 1))
    if scale.steps % scale.window:
        raise ValueError(f"scale must be made of whole windows, got {scale}")
    n_runs, seed = whole("n_runs", n_runs, 1), exact_seed("seed", seed)
    if stream not in STREAMS:
        raise ValueError(f"stream must be one of {tuple(STREAMS)}, got {stream!r}")
    arms, problem, guides = check_arms(arms), problem or Problem(), dict(guides or {})
    n_windows = len(arms) * n_runs * (scale.steps // scale.window)
    if n_windows > MOST_WINDOWS:
        raise ValueError(
            f"arms x runs x windows must be at most {MOST_WINDOWS:,}, which fit in "
            f"memory, got {n_windows:,}; take fewer runs, or longer windows"
        )
    wanted = {arm.guide: arm for arm in arms if arm.guide}
    for name, arm in wanted.items():
        if name not in (*GUIDES, *guides):
            known = ", ".join((*GUIDES, *guides))
            raise ValueError(
                f"guide of arm {arm.name!r} must be one of {known}, got {name!r}"
            )
    for name, guide in guides.items():
        try:
            advised(target_tasks(problem), guide)
        except ValueError as error:
            raise ValueError(f"guide {name!r} is none: {error}") from None
    built = build_guides(problem, [name for name in wanted if name not in guides])
    guides = {name: np.asarray((guides | built)[name]) for name in wanted}
    return Plan(arms, problem, scale, n_runs, seed, stream, guides)


def parameters(plan: Plan) -> dict:
    """Return all that the goals depend on, for JSON."""
    return {
        "reading": plan.problem.record(),
        "steps": plan.scale.steps,
        "window": plan.scale.window,
        "arms": [
            arm.record() | {"tau_steps": plan.scale.tau(arm)} for arm in plan.arms
        ],
        "runs": plan.n_runs,
        "seed": plan.seed,
        "stream": plan.stream,
        # Rounded: the last digits depend on the machine that solved the source.
        "guides": {
            name: digest(np.round(policy + 0.0, 6).tobytes())
            for name, policy in plan.guides.items()
        },
    }


def make_jobs(plan: Plan, done: np.ndarray) -> Iterator[tuple[tuple[int, int], Job]]:
    """Yield the jobs for runs that are not done (arms, N), by arm and first run."""
    stream = STREAMS[plan.stream]
    for a, arm in enumerate(plan.arms):
        missing = np.flatnonzero(~done[a])
        breaks = np.flatnonzero(np.diff(missing) != 1) + 1
        for block in np.split(missing, breaks):
            for i in range(0, len(block), CHUNK):
                runs = block[i : i + CHUNK].tolist()
                yield (
                    (a, runs[0]),
                    Job(
                        plan.problem,
                        arm.strategy,
                        plan.scale.tau(arm),
                        plan.guides.get(arm.guide),
                        plan.scale,
                        tuple(
                            np.random.SeedSequence(plan.seed, spawn_key=(stream, run))
                            for run in runs
                        ),
                        arm.hint,
                    ),
                )
