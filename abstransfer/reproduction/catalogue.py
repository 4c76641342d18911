"""
All experiments of the book, as data, and one call that runs them.

For Figures 3 and 4 (pages 8 and 9): both rewards; the paper's tau, a grid of
tau, and the tau that is best there; and three more buildings that fit the
paper's reference rows as well.  Beside them stand controls that need no other
building (a hint of what can be done, the eager robot, a robot that cannot choose
what is not there), and the same for a learner that moves by compass.

For page 10: robots with the guides of :mod:`.guides`, at the same tau in a
strategy but for `study-own`; and operations on notes, in the four buildings and
in drawn ones.  What is predicted of the second edition stands in
``data/hypotheses.md``, committed before its results.

For page "Neighbours": other methods of transfer, tuned by one budget; see
:mod:`.bench`, and ``data/hypotheses-bench.md``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from ..experiments.arms import ARMS, STRATEGIES, TAUS, Arm, tau_cells
from ..experiments.problem import Problem
from ..experiments.results import Results
from ..learning.settings import whole
from .bench import NEIGHBOURS, Bench
from .blind import BLIND, TEACHER, WHISPER
from .folders import Experiment, Operated, Searched, Survey
from .guides import ADVICE, TAU, TINY
from .traps import EXCHANGED

SHORT = ("beta-0", "beta-0.25", "beta-0.5", "beta-1", "beta-4")
BROAD = ("nd-available-0.5", "available")
SOME = SHORT + BROAD
HINT = Arm("hint", None, "hard", 0, TINY)
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


READ = {"masked": {"unavailable": "masked"}, "compass": {"actions": "compass"}}


def _controls(target: str) -> tuple[Experiment, ...]:
    """Return what stands beside the nine arms in a building."""
    n, more = 10 if target == "target" else 6, (HINT, *EAGER)
    return (
        Experiment(f"controls-{target}", 10, target=target, given=more),
        Experiment(f"traps-{target}", 8, target=target, given=_TRAP_ARMS),
        Experiment(f"masked-{target}", 10, target=target, problem=READ["masked"]),
        Experiment(
            f"compass-{target}",
            n,
            target=target,
            problem=READ["compass"],
            given=(*ARMS, *more),
        ),
        *(
            Experiment(
                f"{name}-{target}-tuned",
                n,
                target=target,
                problem=problem,
                tuned_by=f"{name}-target-tau",
            )
            for name, problem in READ.items()
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
    *(
        Experiment(
            f"{name}-target-tau",
            4,
            problem=problem,
            grid=True,
            given=tau_cells(taus=TAUS[:8]),
        )
        for name, problem in READ.items()
    ),
    *(
        Experiment(
            f"goal-{target}-tuned", 10, target=target, tuned_by="goal-target-tau"
        )
        for target in TARGETS[1:]
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
    *(Operated(f"operations-{target}", 6, target) for target in TARGETS),
    Operated("drawn", 20, None),
)
EXPERIMENTS = _FIRST_EDITION + _SECOND_EDITION + NEIGHBOURS + BLIND + WHISPER + TEACHER
#: What one command repeats alone.
#:
#: :meta hide-value:
STUDIES = {
    "blind": BLIND,
    "whisper": WHISPER,
    "teacher": TEACHER,
    "neighbours": NEIGHBOURS,
}
Entry = Experiment | Operated | Survey | Searched | Bench


def study(name: str, n_buildings: int | None = None) -> tuple[Entry, ...]:
    """
    Return the experiments of a study; with fewer than its drawn buildings, on demand.

    >>> [len(one.seeds) for one in study("blind", 8)[:2]]
    [8, 8]
    """
    if name not in STUDIES:
        raise ValueError(f"study must be one of {', '.join(STUDIES)}, got {name!r}")
    if n_buildings is not None:
        n_buildings = whole("n_buildings", n_buildings, 1)
    return tuple(
        one._replace(n_runs=min(one.n_runs, n_buildings or one.n_runs))
        if isinstance(one, Operated | Bench) and not one.target
        else one._replace(seeds=one.seeds[:n_buildings])
        if isinstance(one, Survey)
        else one
        for one in STUDIES[name]
    )


def in_place_of_target(target: str) -> tuple[Entry, ...]:
    """
    Return what the book does in its target, to be done in another building.

    For whoever has the paper's own map, or draws one; `target` is its name or file.

    >>> {experiment.target for experiment in in_place_of_target("source")}
    {'source'}
    """
    return tuple(
        experiment._replace(target=target)
        for experiment in EXPERIMENTS
        if experiment.target == "target"
    )


def reproduce(
    out: str | Path,
    *,
    experiments: Iterable[Entry] = EXPERIMENTS,
    problem: Problem | None = None,
    on_start: Callable[[Entry], Callable | None] = lambda _: None,
    **options,
) -> dict[str, Results]:
    """
    Run experiments, each into its folder in `out`; or go on where a call ended.

    Parameters
    ----------
    out : path
    experiments : iterable of what the catalogue holds
        By default all that the book shows; the whole takes some 140 minutes of one
        core, as the stored records say, half of it on two.
    problem : Problem, optional
        What is not the book's; reward and target are those of the experiment.
    on_start : callable, optional
        Called with each experiment; returns its `on_progress`.
    **options
        Others of :func:`~abstransfer.experiments.run.run_experiment`; `n_runs` in
        place of the number of runs of each experiment.

    Returns
    -------
    dict from folder to Results
    """
    return {
        experiment.folder: experiment.run(
            out,
            problem,
            on_progress=on_start(experiment),
            **options,
        )
        for experiment in experiments
    }
