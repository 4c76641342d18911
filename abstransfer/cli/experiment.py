"""
The command ``experiment``.
"""

from __future__ import annotations

import os

from ..experiments.arms import SCALES
from ..experiments.plan import SEED
from . import INTERRUPTED
from .cost import EVERYTHING, say_how_long
from .options import (
    add_folder,
    add_map,
    add_option,
    add_problem,
    problem_of,
    progress_bar,
)

HELP = "many runs of the nine arms; resumes what was interrupted"
DESCRIPTION = (
    "Run the nine arms of Figures 3 and 4. Results go to a folder; the same command "
    "again resumes an interrupted experiment."
)
STUDIES = ("blind", "whisper", "teacher", "neighbours")
KEPT = "what is done is kept in {}; the same command goes on from there"


def add_options(parser) -> None:
    """Add the options of the command."""
    text = "1, 10 or 30 million steps a run; tau shrinks along"
    add_option(parser, "scale", "paper", text, tuple(SCALES))
    add_folder(parser, "out", "folder of results", required=True)
    add_option(parser, "jobs", None, "processes (one per processor)")
    add_option(parser, "runs", None, "runs per arm (50; 10 in a grid)")
    add_map(parser, "target", "target", "building to learn in")
    add_problem(parser)
    add_option(parser, "seed", SEED, "seed of the experiment")
    what = parser.add_mutually_exclusive_group()
    text = "every guided arm at ten tau"
    what.add_argument("--tau-grid", action="store_true", help=text)
    add_folder(what, "tuned", "use the best tau of the grid in this folder")
    text = (
        "all that the book shows: both rewards, grids, tuned tau, four buildings, "
        "controls, three readings of the learner, and what makes advice teach "
        f"(page 10); some {EVERYTHING} minutes of one core; with --target, all that "
        "is done in the target, in that building"
    )
    what.add_argument("--everything", action="store_true", help=text)
    text = (
        "one study alone: the claims in 24 drawn buildings, whispered advice, the best "
        "teacher, other methods on one ladder; prints its verdicts"
    )
    what.add_argument("--study", choices=STUDIES, help=text)
    text = "of a study, the first so many of its drawn buildings (all)"
    add_option(parser, "buildings", None, text)


def run(arguments) -> int:
    """Run an experiment, or all of them, and print what came out."""
    from ..reproduction.catalogue import (
        EXPERIMENTS,
        Experiment,
        in_place_of_target,
        reproduce,
        study,
    )

    experiments = EXPERIMENTS
    if arguments.study:
        if (arguments.reward, arguments.target) != ("goal", "target") or arguments.runs:
            raise ValueError("--study has its own --reward, --target and --runs")
        experiments = study(arguments.study, arguments.buildings)
    elif arguments.buildings is not None:
        raise ValueError("--buildings needs a --study")
    elif not arguments.everything:
        grid, tuned = arguments.tau_grid, arguments.tuned
        one = Experiment(
            folder=".",
            n_runs=10 if grid else 50,
            reward=arguments.reward,
            target=arguments.target,
            grid=grid,
            tuned_by=tuned and os.path.abspath(tuned),
        )
        experiments = (one,)
    elif arguments.reward != "goal":
        raise ValueError("--everything has its own --reward")
    elif arguments.target != "target":
        experiments = in_place_of_target(arguments.target)
    bars = _Bars(arguments.jobs)
    runs = {} if arguments.runs is None else {"n_runs": arguments.runs}
    how_to_go_on = KEPT.format(arguments.out)
    INTERRUPTED.append(how_to_go_on)
    try:
        reproduce(
            arguments.out,
            experiments=experiments,
            problem=problem_of(arguments, arguments.target),
            scale=arguments.scale,
            **runs,
            seed=arguments.seed,
            n_workers=arguments.jobs,
            on_start=lambda experiment: bars.new(experiment.folder),
        )
    except ChildProcessError as error:
        raise ChildProcessError(f"{error}; {how_to_go_on}") from None
    finally:
        bars.close()
    print(_summary(arguments.out))
    if arguments.study:
        print(_verdicts(arguments.study, arguments.out))
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


def _verdicts(name: str, out: str) -> str:
    """Return one line for each hypothesis of a study that its folders can judge."""
    from ..experiments.results import load_results
    from ..reproduction.bench_rules import judge_bench
    from ..reproduction.blind_rules import OF_STUDY, as_predicted, judge_blind

    def read(folder):
        return load_results(os.path.join(out, folder))

    if name == "neighbours":
        judged = judge_bench(read=read)
    else:
        judged = judge_blind(OF_STUDY[name], read)
    return "\n".join(
        f"{key}: {found.verdict}, {'' if as_predicted(found) else 'not '}as predicted"
        for key, found in judged.items()
    )


class _Bars:
    """Progress bars on stderr, one experiment after another."""

    def __init__(self, n_workers: int | None):
        self.n_workers, self.bar = n_workers or os.cpu_count() or 1, None

    def new(self, name: str):
        """Return an `on_progress` that draws a bar of steps."""
        self.close()
        name = "experiment" if name == "." else name

        def show(done: int, total: int) -> None:
            if self.bar is None:
                say_how_long(total - done, self.n_workers)
                self.bar = progress_bar(name, total, done)
            self.bar.update(done - self.bar.n)

        return show

    def close(self) -> None:
        """Leave the bar as it stands."""
        if self.bar is not None:
            self.bar.close()
        self.bar = None
