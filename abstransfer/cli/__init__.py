"""
The command line: Table 1, learning, figures, and whether this machine is ready.

Every subcommand takes ``--json`` for output that programs read.  Bad input
ends with a message and exit code 2, an interrupt with 130.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from functools import partial

from ..driving import format_table1, table1
from ..maps import read_map
from ..navigation import tasks_in_parts
from .cost import say_what_it_takes
from .experiment import add_experiment, add_figures
from .learn import add_learn


def main(argv: list[str] | None = None) -> int:
    """Run one command; return its exit code."""
    arguments = _parser().parse_args(argv)
    try:
        code = arguments.run(arguments)
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # the reader has seen enough, as `| head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError) as error:
        print(f"abstransfer: {error}", file=sys.stderr)
        return 2
    except MemoryError:
        print("abstransfer: there is not enough memory for this", file=sys.stderr)
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
    for add in (add_learn, add_experiment, add_figures):
        add(commands)
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

    options = dict(
        success=arguments.success,
        gamma=arguments.gamma,
        actions=arguments.actions,
        unavailable=arguments.unavailable,
        near=arguments.near,
        almost_near=arguments.almost_near,
    )
    source = read_map(arguments.source)
    target = None if arguments.source_only else read_map(arguments.target)
    say_what_it_takes(source, target)
    bar = partial(tqdm, leave=False, disable=None)

    def parts(map_):
        with bar(desc="tasks", unit="goal", total=len(map_.goals)) as goals:
            for part in tasks_in_parts(map_, **options):
                yield part
                goals.update(len(part.goal))

    result = table1(
        list(tasks_in_parts(source, **options)),
        None if target is None else parts(target),
        progress=partial(bar, desc="AbsProb-PI", unit="iteration"),
    )
    if arguments.json:
        print(json.dumps(result, indent=2))
    else:
        print(format_table1(result))
    return 0


def _add_doctor(commands) -> None:
    parser = commands.add_parser(
        "doctor",
        help="is this machine ready, and what to do if not",
        description="Check versions, kernel and browser.",
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
