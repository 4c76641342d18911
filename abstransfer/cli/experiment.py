"""
The commands ``experiment`` and ``figures``.
"""

from __future__ import annotations

import sys

from .._paths import DATA
from ..experiments.arms import SCALES
from ..experiments.plan import SEED
from .learn import MAP_HELP, add_problem, count, option, problem_of, progress_bar


def add_experiment(commands) -> None:
    parser = commands.add_parser(
        "experiment",
        help="many runs of the nine arms; resumes what was interrupted",
        description="Run the nine arms of Figures 3 and 4. Results go to a folder; "
        "the same command again resumes an interrupted experiment.",
    )
    parser.set_defaults(run=_run_experiment)
    scale_help = "1, 10 or 30 million steps a run; tau shrinks along (paper)"
    parser.add_argument(
        "--scale", default="paper", choices=tuple(SCALES), help=scale_help
    )
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of results")
    option(parser, "--jobs", None, "N", "processes (one per processor)", count)
    option(parser, "--runs", None, "N", "runs per arm (50; 10 in a grid)", count)
    option(parser, "--target", "target", "MAP", "building to learn in: " + MAP_HELP)
    add_problem(parser)
    option(parser, "--seed", SEED, "K", "seed of the experiment", count)
    what = parser.add_mutually_exclusive_group()
    what.add_argument(
        "--tau-grid", action="store_true", help="every guided arm at ten tau"
    )
    what.add_argument(
        "--tuned", metavar="DIR", help="use the best tau of the grid in this folder"
    )
    what.add_argument(
        "--everything",
        action="store_true",
        help="all that the book shows: both rewards, grids, tuned tau, four buildings, "
        "and what makes advice teach (page 10)",
    )


def add_figures(commands) -> None:
    parser = commands.add_parser(
        "figures",
        help="Figures 3 and 4, table of tau and ledger, from stored results",
        description="Make figures (SVG, PNG) and tables (CSV, Markdown).",
    )
    parser.set_defaults(run=_run_figures)
    parser.add_argument(
        "--out", required=True, metavar="DIR", help="folder to write to"
    )
    stored = str(DATA / "results")
    option(
        parser, "--results", stored, "DIR", "folder of experiments (the stored ones)"
    )


def _run_experiment(arguments) -> int:
    from ..experiments.run import run_experiment
    from ..reproduction.catalogue import Experiment, reproduce

    if arguments.everything and (arguments.reward, arguments.target) != (
        "goal",
        "target",
    ):
        raise ValueError("--everything has its own --reward and --target")
    bars = _Bars()
    try:
        if arguments.everything:
            reproduce(
                arguments.out,
                scale=arguments.scale,
                problem=problem_of(arguments, arguments.target),
                n_runs=arguments.runs,
                seed=arguments.seed,
                n_workers=arguments.jobs,
                on_start=lambda experiment: bars.new(experiment.folder),
            )
        else:
            grid = arguments.tau_grid
            what = Experiment("", 0, grid=grid, tuned_by=arguments.tuned)
            runs = arguments.runs if arguments.runs is not None else 10 if grid else 50
            run_experiment(
                what.arms(""),
                problem_of(arguments, arguments.target),
                scale=arguments.scale,
                n_runs=runs,
                seed=arguments.seed,
                stream="tune" if grid else "report",
                n_workers=arguments.jobs,
                out=arguments.out,
                on_progress=bars.new("experiment"),
            )
    except (KeyboardInterrupt, ChildProcessError):
        bars.close()
        print(
            f"abstransfer: what is done is kept in {arguments.out}; "
            "the same command goes on from there",
            file=sys.stderr,
        )
        raise
    bars.close()
    print(_summary(arguments.out))
    return 0


def _summary(out: str) -> str:
    """Return one line for each experiment in a folder."""
    from ..reproduction.figures import finished_experiments

    lines = []
    for name, results in finished_experiments(out).items():
        total, (arms, runs, _) = results.goals.sum(), results.goals.shape
        seconds = results.record["seconds"]
        lines.append(
            f"{name}: {arms} arms x {runs} runs, {total:,} goals; "
            f"{seconds['cores']} s of one core, {seconds['ns_per_step']} ns a step"
        )
    return "\n".join(lines)


def _run_figures(arguments) -> int:
    from ..reproduction.figures import make_figures

    make_figures(arguments.results, arguments.out, on_file=print)
    return 0


class _Bars:
    """Progress bars on stderr, one experiment after another."""

    def __init__(self):
        self.bar = None

    def new(self, name: str):
        """Return an `on_progress` that draws a bar of steps."""
        self.close()
        before = 0

        def show(done: int, total: int) -> None:
            nonlocal before
            if self.bar is None:
                self.bar = progress_bar(name, total, done)
            else:
                self.bar.update(done - before)
            before = done

        return show

    def close(self) -> None:
        """Leave the bar as it stands."""
        if self.bar is not None:
            self.bar.close()
        self.bar = None
