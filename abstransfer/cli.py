"""
The command line: Table 1, and whether this machine is ready.

Every subcommand takes ``--json`` for output that programs read.  Bad input
ends with a message and exit code 2, an interrupt with 130.
"""

from __future__ import annotations

import argparse
import json
import sys
from functools import partial

from .maps import read_map
from .navigation import navigation_tasks
from .table1 import PAPER, ROWS, table1

NAMES = {
    "rand": "pi_rand",
    "nd": "pi_AbsND",
    "prob": "pi_AbsProb",
    "grad": "pi_AbsGrad",
    "optimal": "pi*",
}


def main(argv: list[str] | None = None) -> int:
    """Run one command; return its exit code."""
    arguments = _parser().parse_args(argv)
    try:
        return arguments.run(arguments)
    except (ValueError, OSError) as error:
        print(f"abstransfer: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("abstransfer: interrupted", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="abstransfer",
        description="Transfer learning by abstract policies (Freire & Costa 2015).",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _add_table1(commands)
    _add_doctor(commands)
    return parser


def _add_table1(commands) -> None:
    parser = commands.add_parser(
        "table1",
        help="values of all policies in source and target, beside the paper's",
        description="Build the abstract policies of the source, and evaluate them "
        "exactly in source and target: Table 1 of the paper.",
    )
    parser.set_defaults(run=_run_table1)
    map_help = "a map file, or the name of a map that comes with the package"
    parser.add_argument("--source", default="source", metavar="MAP", help=map_help)
    parser.add_argument("--target", default="target", metavar="MAP", help=map_help)
    parser.add_argument(
        "--source-only", action="store_true", help="leave the target out"
    )
    parser.add_argument(
        "--success",
        type=float,
        default=0.9,
        metavar="P",
        help="probability that a move succeeds (0.9)",
    )
    parser.add_argument(
        "--gamma", type=float, default=0.99, metavar="G", help="discount (0.99)"
    )
    parser.add_argument(
        "--actions",
        default="relational",
        choices=("relational", "compass"),
        help="go to what I see, or N, E, S, W",
    )
    parser.add_argument(
        "--unavailable",
        default="wait",
        choices=("wait", "masked"),
        help="an action with nowhere to go spends a step, or is not chosen",
    )
    parser.add_argument(
        "--near",
        type=int,
        default=5,
        metavar="D",
        help="largest Manhattan distance of near_goal (5)",
    )
    parser.add_argument(
        "--almost-near",
        type=int,
        default=8,
        metavar="D",
        help="largest Manhattan distance of almost_near_goal (8)",
    )
    parser.add_argument("--json", action="store_true", help="print JSON")


def _run_table1(arguments) -> int:
    from tqdm import tqdm

    tasks = partial(
        navigation_tasks,
        success=arguments.success,
        gamma=arguments.gamma,
        actions=arguments.actions,
        unavailable=arguments.unavailable,
        near=arguments.near,
        almost_near=arguments.almost_near,
    )
    source = tasks(read_map(arguments.source))
    target = None if arguments.source_only else tasks(read_map(arguments.target))
    progress = partial(tqdm, desc="AbsProb-PI", unit="iteration", leave=False, delay=1)
    result = table1(source, target, progress=progress)
    if arguments.json:
        print(json.dumps(result, indent=2))
    else:
        print(_format_table1(result))
    return 0


def _format_table1(result: dict) -> str:
    """Return the table as text: a block of three columns per building."""
    columns = [name for name in ("source", "target") if name in result]
    lines = [
        " " * 20 + "".join(f"{name:^30}" for name in columns).rstrip(),
        f"{'':20}" + f"{'here':>10}{'paper':>10}{'differs':>10}" * len(columns),
    ]
    for row in ROWS:
        line = f"{NAMES[row]:20}"
        for name in columns:
            here, paper = result[name][row], PAPER[name][row]
            line += (
                f"{here:10.2f}{paper:10.2f}{100 * (here - paper) / abs(paper):+8.1f} %"
            )
        lines.append(line)
    extra = {
        "uniform_available": ("uniform, available", ".2f"),
        "cells": ("cells", "d"),
        "rooms": ("rooms", "d"),
        "goals": ("goals", "d"),
        "abstract_states": ("abstract states", "d"),
    }
    for key, (label, form) in extra.items():
        values = "".join(f"{result[name][key]:10{form}}{'':20}" for name in columns)
        lines.append(f"{label:20}{values}".rstrip())
    if "unseen" in result:
        lines.append("")
        lines.append(
            f"{100 * result['unseen']:.1f} % of the target's states are in an abstract "
            "state that the source has not."
        )
    lines.append("Mean discounted reward over all cells and tasks; higher is better.")
    return "\n".join(lines)


def _add_doctor(commands) -> None:
    parser = commands.add_parser(
        "doctor",
        help="is this machine ready, and what to do if not",
        description="Check versions, kernel, browser and node.",
    )
    parser.set_defaults(run=_run_doctor)
    parser.add_argument("--json", action="store_true", help="print JSON")


def _run_doctor(arguments) -> int:
    from .doctor import diagnose

    checks = diagnose()
    if arguments.json:
        print(json.dumps([check._asdict() for check in checks], indent=2))
    else:
        for check in checks:
            print(f"{'ok' if check.ok else 'MISSING':8} {check.name}: {check.found}")
            if not check.ok:
                print(f"{'':8} {check.remedy}")
    return 0 if all(check.ok for check in checks) else 1
