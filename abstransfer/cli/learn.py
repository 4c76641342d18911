"""
The command ``learn``: one run.
"""

from __future__ import annotations

import json

import numpy as np

from ..experiments.arms import ARMS, PAPER_STEPS, STRATEGIES, Scale
from ..experiments.plan import MOST_WINDOWS
from ..experiments.problem import GUIDES, build_guides
from ..experiments.workers import Job, run_job
from ..learning.settings import whole
from .cost import say_how_long
from .options import (
    TEXTS,
    add_json,
    add_map,
    add_option,
    add_problem,
    problem_of,
    progress_bar,
)

HELP = "one run of Q-learning, with or without advice"
DESCRIPTION = "Learn all tasks of a building, advised by an abstract policy."


def add_options(parser) -> None:
    """Add the options of the command."""
    add_map(parser, "map", "target", "building to learn in")
    add_problem(parser)
    add_option(parser, "guide", "none", "whose advice", ("none", *GUIDES))
    add_option(parser, "strategy", "hard", TEXTS["strategy"], STRATEGIES)
    add_option(parser, "tau", None, TEXTS["tau"] + " (the paper's, scaled to --steps)")
    add_option(parser, "steps", PAPER_STEPS, "steps to learn")
    add_option(parser, "window", None, TEXTS["window"] + " (a sixtieth)")
    add_option(parser, "seed", 0, "seed of the run")
    add_json(parser)


def run(arguments) -> int:
    """Learn, and print the goals reached."""
    job = _job(arguments)
    say_how_long(job.scale.steps, 1)
    run_job(job._replace(scale=Scale(2, 1), tau=min(job.tau, 1)))  # loads the loops
    with progress_bar("learn", job.scale.steps) as bar:
        goals, seconds = run_job(job, bar.update)
    result = {
        "goals": int(goals.sum()),
        "per_window": goals[0].tolist(),
        "seconds": round(seconds, 3),
        "ns_per_step": round(1e9 * seconds / job.scale.steps, 2),
    }
    if arguments.json:
        print(json.dumps(result))
        return 0
    print(f"{result['goals']:,} goals in {job.scale.steps:,} steps")
    print(f"goals per {job.scale.window:,} steps:", *result["per_window"])
    print(f"{result['seconds']} s, {result['ns_per_step']} ns a step")
    return 0


def _job(arguments) -> Job:
    """Return the run that the arguments ask for, checked and with its guide."""
    problem, tau, guide = problem_of(arguments, arguments.map), arguments.tau, None
    steps = whole("--steps", arguments.steps, 1)
    window = -(-steps // 60) if arguments.window is None else arguments.window
    scale = Scale(steps, whole("--window", window, 1))
    whole("number of windows", -(-steps // scale.window), 1, MOST_WINDOWS)
    if arguments.guide != "none":
        name = f"{arguments.guide}-{arguments.strategy}"
        paper = next(arm for arm in ARMS if arm.name == name)
        tau = scale.tau(paper) if tau is None else whole("--tau", tau)
        guide = build_guides(problem, [arguments.guide])[arguments.guide]
    elif tau:
        raise ValueError("--tau needs a --guide to follow for that long")
    seeds = (np.random.SeedSequence(arguments.seed),)
    return Job(problem, arguments.strategy, tau or 0, guide, scale, seeds)
