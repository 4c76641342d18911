"""
Options of the commands, made from what the package knows of its settings.
"""

from __future__ import annotations

import argparse
import inspect
from dataclasses import fields
from decimal import Decimal, InvalidOperation

from ..experiments.problem import Problem
from ..learning.settings import LIMITS
from ..maps import read_map
from ..navigation import ACTIONS, REWARDS, UNAVAILABLE, navigation_tasks

CHOICES = {"reward": REWARDS, "actions": ACTIONS, "unavailable": UNAVAILABLE}
TEXTS = {
    "reward": "1 at the goal, else 0; or -1 a step, 0 at the goal",
    "actions": "go to what I see, or N, E, S, W",
    "unavailable": "an action with nowhere to go spends a step, or is not chosen",
    "success": "probability that a move succeeds",
    "near": "largest Manhattan distance of near_goal",
    "almost_near": "largest Manhattan distance of almost_near_goal",
} | {name: known["meaning"] for name, known in LIMITS.items()}


def add_option(parser, name: str, default, text: str, choices=None) -> None:
    """Add ``--name``, whose kind is that of its default; None: a whole number."""
    kind = count if default is None or isinstance(default, int) else type(default)
    if default is not None:
        text += f" ({default})"
    parser.add_argument(
        "--" + name.replace("_", "-"),
        default=default,
        type=kind,
        choices=choices,
        metavar=None if choices else {count: "N", float: "X"}.get(kind, "MAP"),
        help=text,
    )


def add_map(parser, name: str, default: str, text: str) -> None:
    """Add the option of a building."""
    add_option(parser, name, default, f"{text}: a file, or a map of the package")


def add_problem(parser) -> None:
    """Add the options that make a problem, target excepted."""
    add_map(parser, "source", "source", "building of the policies")
    for field in fields(Problem)[2:]:
        name = field.name
        add_option(parser, name, field.default, TEXTS[name], CHOICES.get(name))


def problem_of(arguments, target: str) -> Problem:
    """Return the problem that the options make."""
    options = {
        field.name: getattr(arguments, field.name) for field in fields(Problem)[2:]
    }
    return Problem(read_map(arguments.source), read_map(target), **options)


def add_navigation(parser, names: tuple[str, ...]) -> None:
    """Add options of `navigation_tasks`, by name."""
    known = inspect.signature(navigation_tasks).parameters
    for name in names:
        add_option(parser, name, known[name].default, TEXTS[name], CHOICES.get(name))


def add_folder(parser, name: str, text: str, **options) -> None:
    """Add the option of a folder."""
    parser.add_argument(f"--{name}", metavar="DIR", help=text, **options)


def add_json(parser) -> None:
    """Add ``--json``."""
    parser.add_argument("--json", action="store_true", help="print JSON")


def count(text: str) -> int:
    """
    Return a whole number, exactly; 3_500_000 and 3.5e6 are written alike.

    >>> count("9007199254740993"), count("3.5e6")
    (9007199254740993, 3500000)
    """
    try:
        number = Decimal(text)
        if number >= 0 and number.adjusted() < 1000 and number == int(number):
            return int(number)
    except (InvalidOperation, ValueError, OverflowError):
        pass
    raise argparse.ArgumentTypeError(
        f"must be a whole number, at least 0, got {text[:40]!r}"
    )


def progress_bar(name: str, total: int, done: int = 0):
    """Return a bar that tells steps, steps per second and time left, on terminals."""
    from tqdm import tqdm

    options = {"unit": "step", "unit_scale": True, "disable": None}
    return tqdm(total=total, initial=done, desc=name, **options)
