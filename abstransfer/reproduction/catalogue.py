"""
All experiments of the book, as data, and one call that runs them.

For Figures 3 and 4 (pages 8 and 9): both rewards; the paper's tau, a grid of
tau, and the tau that is best there; and three more buildings that fit the
paper's reference rows as well.  Beside them stand controls that need no other
building (a hint of what can be done, the eager robot, a robot that cannot choose
what is not there), and the same for a learner that moves by compass.

For page 10, which asks what makes advice teach well: guides made of the
paper's by two dials.  `beta` raises the probabilities to a power (0 makes ND
of Prob); `share` mixes in a robot that draws uniformly, among the available
actions or among all.  Guides of a strategy have the same tau but in `study-own`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..experiments.arms import ARMS, STRATEGIES, TAUS, Arm, tau_cells
from ..experiments.problem import GUIDES, Problem, build_guides
from ..experiments.results import Results, load_results
from ..experiments.run import run_experiment
from ..experiments.tuning import tune, tuned_arms
from ..maps import read_map
from ..navigation import navigation_tasks
from ..policies import beta_policy, uniform_policy
from .traps import EXCHANGED, exchange_rows

TAU = {"hard": 3_500_000, "soft": 6_000_000}  # the paper's, of Prob
BETAS = (0, 0.25, 0.5, 1, 2, 4, 8)
SHARES = (0.1, 0.25, 0.5, 0.75)


class Advice(NamedTuple):
    """How a guide is made: (1 - share) base^beta + share x uniform."""

    base: str  #: a builder: "prob", "grad"
    beta: float = 1  #: 0 keeps which actions, and forgets how often
    into: str = "available"  #: what the uniform part draws from: "available", "all"
    share: float = 0  #: of the uniform part


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


SHORT = ("beta-0", "beta-0.25", "beta-0.5", "beta-1", "beta-4")
BROAD = ("nd-available-0.5", "available")
SOME = SHORT + BROAD
HINT = Arm("hint", None, "hard", 0, 1e-12)
EAGER = tuple(Arm(f"eager-{s}", "available", s, TAU[s]) for s in STRATEGIES)
FINE = tuple(round(1e6 * tau) for tau in (2.5, 3, 4, 4.5, 5, 7.5, 12, 16))
#: ND, Prob, half ND half eager, and eager; in `study-own` each at its own tau.
FOUR = ("beta-0", "beta-1", *BROAD)
OWN_TAUS = {
    "hard": (2_000_000, 3_500_000, 6_000_000),
    "soft": (6_000_000, 9_000_000, 11_000_000),
}
_FOUR_ARMS = tuple(Arm(f"{g}-{s}", g, s, TAU[s]) for g in FOUR for s in STRATEGIES)
_TRAP_ARMS = tuple(
    Arm(f"{guide}-hard", guide, "hard", TAU["hard"])
    for guide in ("beta-0", "beta-1", *EXCHANGED, "prob-available-0.5")
)
TARGETS = ("target", "target_b", "target_c", "target_d")


def _controls(target: str) -> tuple[Experiment, ...]:
    """Return what stands beside the nine arms in a building."""
    compass, n = {"actions": "compass"}, 10 if target == "target" else 6
    masked = (ARMS[0], ARMS[3], ARMS[5])  # none, ND hard, Prob hard
    return (
        Experiment(f"controls-{target}", 10, target=target, given=(HINT, *EAGER)),
        Experiment(
            f"masked-{target}",
            10,
            target=target,
            problem={"unavailable": "masked"},
            given=masked,
        ),
        Experiment(f"traps-{target}", 8, target=target, given=_TRAP_ARMS),
        Experiment(
            f"compass-{target}",
            n,
            target=target,
            problem=compass,
            given=(*ARMS, HINT, *EAGER),
        ),
        Experiment(
            f"compass-{target}-tuned",
            n,
            target=target,
            problem=compass,
            tuned_by="compass-target-tau",
        ),
    )


_FIRST_EDITION = (
    *(Experiment(f"{r}-target", 50, r) for r in ("goal", "cost")),
    *(
        Experiment(f"{r}-target_{x}", 20, r, f"target_{x}")
        for r in ("goal", "cost")
        for x in "bcd"
    ),
    *(Experiment(f"{r}-target-tau", 10, r, grid=True) for r in ("goal", "cost")),
    *(
        Experiment(f"{r}-target-tuned", 50, r, tuned_by=f"{r}-target-tau")
        for r in ("goal", "cost")
    ),
    Experiment("study-goal-target", 20, guides=tuple(ADVICE)),
    Experiment("study-rescue-target", 20, problem={"max_episode": 500}, guides=SOME),
    Experiment(
        "study-masked-target", 20, problem={"unavailable": "masked"}, guides=SOME
    ),
    Experiment("study-cost-target", 20, "cost", guides=SOME),
    *(
        Experiment(
            f"study-goal-target_{x}",
            20,
            target=f"target_{x}",
            guides=SOME,
            strategies=("hard",),
        )
        for x in "bcd"
    ),
    Experiment(
        "study-tau-target",
        10,
        guides=("beta-0", "beta-1", *BROAD),
        strategies=("hard",),
        taus=(1_000_000, 2_000_000, 3_500_000, 6_000_000, 9_000_000),
    ),
)
_SECOND_EDITION = (
    Experiment(
        "compass-target-tau",
        4,
        problem={"actions": "compass"},
        grid=True,
        given=tau_cells(taus=TAUS[:8]),
    ),
    *(experiment for target in TARGETS for experiment in _controls(target)),
    Experiment("goal-target-tau-fine", 6, grid=True, given=tau_cells(ARMS[3:7], FINE)),
    Experiment(
        "study-own-tau",
        4,
        grid=True,
        given=tuple(
            arm._replace(tau=t) for arm in _FOUR_ARMS for t in OWN_TAUS[arm.strategy]
        ),
    ),
    Experiment("study-own", 10, tuned_by="study-own-tau", given=_FOUR_ARMS),
)
#: Of the second edition, those whose results are stored.
_STORED = ("controls-target",)
EXPERIMENTS = _FIRST_EDITION + tuple(
    experiment for experiment in _SECOND_EDITION if experiment.folder in _STORED
)
#: The others: written down before they were run, and not stored yet.
PLANNED = tuple(
    experiment for experiment in _SECOND_EDITION if experiment not in EXPERIMENTS
)


def make_guides(
    names: Iterable[str] = tuple(ADVICE), problem: Problem | None = None
) -> dict[str, np.ndarray]:
    """
    Return the abstract policies (Z, A) of these names in `ADVICE` or `EXCHANGED`.

    Raises KeyError for a name that is in neither.

    >>> guides = make_guides(["beta-0", "beta-1"])
    >>> bool(((guides["beta-0"] > 0) == (guides["beta-1"] > 0)).all())
    True
    """
    problem, names = problem or Problem(), list(names)
    if set(names) & set(EXCHANGED):
        plain = [name for name in names if name not in EXCHANGED]
        made = make_guides({"beta-0", "beta-1", "available", *plain}, problem)
        made |= exchange_rows(
            problem, *(made[n] for n in ("beta-0", "beta-1", "available"))
        )
        return {name: made[name] for name in names}
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


def reproduce(
    out: str | Path,
    *,
    experiments: Iterable[Experiment] = EXPERIMENTS,
    problem: Problem | None = None,
    n_runs: int | None = None,
    on_start: Callable[[Experiment], Callable | None] = lambda experiment: None,
    **options,
) -> dict[str, Results]:
    """
    Run experiments, each into its folder in `out`; or go on where a call ended.

    Parameters
    ----------
    out : path
    experiments : iterable of Experiment
        By default all that the book shows; the whole takes some 25 to 50 minutes
        of two cores.
    problem : Problem, optional
        What is not the book's; reward and target are those of the experiment.
    n_runs : int, optional
        In place of the number of runs of each experiment.
    on_start : callable, optional
        Called with each experiment; returns its `on_progress`.
    **options
        Others of :func:`~abstransfer.experiments.run.run_experiment`.

    Returns
    -------
    dict from folder to Results
    """
    found = {}
    for experiment in experiments:
        changed = {"reward": experiment.reward, **experiment.problem}
        target = read_map(experiment.target)
        here = replace(problem or Problem(), target=target, **changed)
        arms = experiment.arms(out)
        made = {arm.guide for arm in arms} & {*ADVICE, *EXCHANGED} - set(GUIDES)
        found[experiment.folder] = run_experiment(
            arms,
            here,
            n_runs=experiment.n_runs if n_runs is None else n_runs,
            stream="tune" if experiment.grid else "report",
            guides=make_guides(made, here) if made else None,
            out=Path(out) / experiment.folder,
            on_progress=on_start(experiment),
            **options,
        )
    return found
