"""
The study of page 10: which advice drives well, and which teaches well?

Every page of advice here is made of one of the paper's by two dials.  `beta`
raises its probabilities to a power (0 makes ND of Prob); `share` mixes in a
robot that draws uniformly, among the available actions or among all.  All
guides of a strategy have the same tau, so what differs is the advice alone.

The whole study takes about ten minutes of two cores::

    run_studies("data/results", n_workers=2)
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..experiments.arms import STRATEGIES, Arm, Scale
from ..experiments.plan import SEED
from ..experiments.problem import Problem, build_guides
from ..experiments.results import Results
from ..experiments.run import run_experiment
from ..maps import read_map
from ..navigation import navigation_tasks
from ..policies import beta_policy, uniform_policy

TAU = {"hard": 3_500_000, "soft": 6_000_000}  # the paper's, of Prob
BETAS = (0, 0.25, 0.5, 1, 2, 4, 8)
SHARES = (0.1, 0.25, 0.5, 0.75)


class Advice(NamedTuple):
    """How a guide is made: (1 - share) base^beta + share x uniform."""

    base: str  # a builder: "prob", "grad"
    beta: float = 1  # 0 keeps which actions, and forgets how often
    into: str = "available"  # what the uniform part draws from: "available", "all"
    share: float = 0


def _diluted(name: str, base: str, beta: float, into: str) -> dict[str, Advice]:
    return {f"{name}-{into}-{w}": Advice(base, beta, into, w) for w in SHARES}


ADVICE = {
    **{f"beta-{beta}": Advice("prob", beta) for beta in BETAS},
    **_diluted("prob", "prob", 1, "available"),
    **_diluted("prob", "prob", 1, "all"),
    **_diluted("nd", "prob", 0, "available"),
    **_diluted("nd", "prob", 0, "all"),
    **_diluted("grad", "grad", 1, "available"),
    "grad": Advice("grad"),
    "available": Advice("prob", 1, "available", 1),
    "all": Advice("prob", 1, "all", 1),
}


class Study(NamedTuple):
    """One folder of results."""

    folder: str
    guides: tuple[str, ...]  # names in ADVICE
    target: str = "target"
    problem: Mapping = {}  # what is not the reading of the book
    strategies: tuple[str, ...] = STRATEGIES
    taus: tuple[int, ...] = ()  # in place of TAU
    n_runs: int = 20

    @property
    def arms(self) -> tuple[Arm, ...]:
        """Q-learning, and every guide under every strategy, at every tau."""
        return (Arm("none", None, "hard", 0),) + tuple(
            Arm(f"{guide}-{strategy}", guide, strategy, tau)
            for guide in self.guides
            for strategy in self.strategies
            for tau in self.taus or (TAU[strategy],)
        )


SHORT = ("beta-0", "beta-0.25", "beta-0.5", "beta-1", "beta-4")
BROAD = ("nd-available-0.5", "available")
SOME = SHORT + BROAD
STUDIES = (
    Study("study-goal-target", tuple(ADVICE)),
    Study("study-rescue-target", SOME, problem={"max_episode": 500}),
    Study("study-masked-target", SOME, problem={"unavailable": "masked"}),
    Study("study-cost-target", SOME, problem={"reward": "cost"}),
    *(
        Study(f"study-goal-target_{x}", SOME, f"target_{x}", strategies=("hard",))
        for x in "bcd"
    ),
    Study(
        "study-tau-target",
        ("beta-0", "beta-1", *BROAD),
        strategies=("hard",),
        taus=(1_000_000, 2_000_000, 3_500_000, 6_000_000, 9_000_000),
        n_runs=10,
    ),
)


def make_guides(
    names: Iterable[str] = tuple(ADVICE), problem: Problem | None = None
) -> dict[str, np.ndarray]:
    """
    Return the abstract policies (Z, A) of these names in `ADVICE`.

    Raises KeyError for a name that is not there.

    >>> guides = make_guides(["beta-0", "beta-1"])
    >>> bool(((guides["beta-0"] > 0) == (guides["beta-1"] > 0)).all())
    True
    """
    problem = problem or Problem()
    wanted = {name: ADVICE[name] for name in names}
    built = build_guides(problem, {advice.base for advice in wanted.values()})
    source = navigation_tasks(problem.source)
    uniform = {
        "available": uniform_policy(source.possible),
        "all": uniform_policy(np.ones_like(source.possible)),
    }
    return {
        name: (1 - share) * beta_policy(built[base], beta) + share * uniform[into]
        for name, (base, beta, into, share) in wanted.items()
    }


def run_studies(
    out: str | Path,
    *,
    studies: Iterable[Study] = STUDIES,
    scale: str | Scale = "paper",
    n_runs: int | None = None,
    seed: int = SEED,
    on_start: Callable[[Study], Callable | None] = lambda study: None,
    **options,
) -> dict[str, Results]:
    """
    Run studies, each into its folder in `out`; or go on where a call ended.

    `n_runs` replaces that of each study, and `on_start` gets each study and
    returns its `on_progress`.  Other options: see
    :func:`~abstransfer.experiments.run.run_experiment`.
    """
    found = {}
    for study in studies:
        problem = Problem(target=read_map(study.target), **study.problem)
        found[study.folder] = run_experiment(
            study.arms,
            problem,
            scale=scale,
            n_runs=study.n_runs if n_runs is None else n_runs,
            seed=seed,
            guides=make_guides(study.guides, problem),
            out=Path(out) / study.folder,
            on_progress=on_start(study),
            **options,
        )
    return found
