"""
The command ``learn``: one run; and the options that make a problem.
"""

from __future__ import annotations

import argparse
import json

import numpy as np

from ..experiments.arms import ARMS, PAPER_STEPS, STRATEGIES, Scale
from ..experiments.problem import GUIDES, Problem, build_guides
from ..experiments.workers import Job, run_job
from ..maps import read_map

MAP_HELP = "a map file, or the name of a map that comes with the package"


def add_learn(commands) -> None:
    parser = commands.add_parser(
        "learn",
        help="one run of Q-learning, with or without advice",
        description="Learn all tasks of a building, advised by an abstract policy.",
    )
    parser.set_defaults(run=_run_learn)
    option(parser, "--map", "target", "MAP", "building to learn in: " + MAP_HELP)
    add_problem(parser)
    parser.add_argument("--guide", default="none", choices=("none", *GUIDES))
    parser.add_argument("--strategy", default="hard", choices=STRATEGIES)
    tau_help = "steps of advice (the paper's tau, shrunk or stretched like --steps)"
    option(parser, "--tau", None, "T", tau_help, count)
    option(parser, "--steps", PAPER_STEPS, "N", "steps to learn", count)
    option(parser, "--window", None, "N", "steps per window (a sixtieth)", count)
    option(parser, "--seed", 0, "K", "seed of the run", count)
    parser.add_argument("--json", action="store_true", help="print JSON")


def _run_learn(arguments) -> int:
    job = _job(arguments)
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
    steps, problem = arguments.steps, problem_of(arguments, arguments.map)
    window = arguments.window if arguments.window is not None else -(-steps // 60)
    for name, value in (("steps", steps), ("window", window)):
        if value < 1:
            raise ValueError(f"--{name} must be at least 1, got {value}")
    scale, tau, guide = Scale(steps, window), arguments.tau, None
    if arguments.guide != "none":
        name = f"{arguments.guide}-{arguments.strategy}"
        paper = next(arm for arm in ARMS if arm.name == name)
        tau = scale.tau(paper) if tau is None else tau
        guide = build_guides(problem, [arguments.guide])[arguments.guide]
    elif tau:
        raise ValueError("--tau needs a --guide to follow for that long")
    seeds = (np.random.SeedSequence(arguments.seed),)
    return Job(problem, arguments.strategy, tau or 0, guide, scale, seeds)


def progress_bar(name: str, total: int, done: int = 0):
    """Return a bar that tells steps, steps per second and time left, on terminals."""
    from tqdm import tqdm

    options = {"unit": "step", "unit_scale": True, "disable": None}
    return tqdm(total=total, initial=done, desc=name, **options)


def add_problem(parser) -> None:
    """Add the options that make a problem, target excepted."""
    option(parser, "--source", "source", "MAP", "building of the policies: " + MAP_HELP)
    parser.add_argument(
        "--reward",
        default="goal",
        choices=("goal", "cost"),
        help="1 at the goal, else 0; or -1 a step, 0 at the goal",
    )
    parser.add_argument(
        "--unavailable",
        default="wait",
        choices=("wait", "masked"),
        help="an action with nowhere to go spends a step, or is not chosen",
    )
    for name, default, text in (
        ("success", 0.9, "probability that a move succeeds"),
        ("q0", 0.0, "value that all actions start from"),
        ("alpha", 0.1, "learning rate"),
        ("epsilon", 0.1, "probability of exploring"),
        ("gamma", 0.9, "discount"),
    ):
        option(parser, f"--{name}", default, "X", text, float)
    text = "steps after which an episode is cut"
    option(parser, "--max-episode", 5000, "N", text, count)


def option(parser, name, default, metavar, text, type_=str) -> None:
    if type_ is not str and default is not None:
        text += f" ({default})"
    parser.add_argument(name, default=default, metavar=metavar, help=text, type=type_)


def count(text: str) -> int:
    """Return a whole number; 3_500_000 and 3.5e6 are written alike."""
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if number < 0 or not number.is_integer():
        raise argparse.ArgumentTypeError(
            f"must be a whole number, at least 0, got {text!r}"
        )
    return int(number)


def problem_of(arguments, target: str) -> Problem:
    return Problem(
        source=read_map(arguments.source),
        target=read_map(target),
        reward=arguments.reward,
        unavailable=arguments.unavailable,
        success=arguments.success,
        q0=arguments.q0,
        alpha=arguments.alpha,
        epsilon=arguments.epsilon,
        gamma=arguments.gamma,
        max_episode=arguments.max_episode,
    )
