"""
The command ``class``: what a class handed in.
"""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

from .options import add_option

HELP = "run what a class handed in, and write tables"
DESCRIPTION = "Run the notebooks of a class again, or pool its result cards."


def add_options(parser) -> None:
    """Add the options of the command."""
    parts = parser.add_subparsers(required=True, metavar="PART", dest="part")
    text = "run notebooks; a row a student, a column an exercise"
    part = parts.add_parser("collect", help=text, description=text)
    part.add_argument("folder", metavar="DIR", type=Path, help="what was handed in")
    part.add_argument("--csv", metavar="FILE", type=Path, required=True, help="table")
    add_option(part, "seconds", 600, "time of a notebook")
    add_option(part, "cell_seconds", 120, "time of a cell")
    add_option(part, "megabytes", 4096, "memory of a process")
    text = "pool result cards into a test of a claim"
    part = parts.add_parser("pool", help=text, description=text)
    part.add_argument("folder", metavar="DIR", type=Path, help="what was handed in")
    for name, default, text in (
        ("--robot", "nd", "whose gain, by its name on the cards"),
        ("--over", "none", "compared with whom"),
    ):
        text = f"{text} ({default})"
        part.add_argument(name, metavar="ROBOT", default=default, help=text)
    add_option(part, "margin", 0.0, "the claim: the gain is above this share")
    part.add_argument(
        "--figure", metavar="FILE", type=Path, help="picture to write, such as wall.png"
    )


def run(arguments) -> int:
    """Run one part of the command."""
    return (_collect if arguments.part == "collect" else _pool)(arguments)


def _pool(arguments) -> int:
    from ..classroom.pooling import pool
    from ..plotting import describe_pool, figure, plot_pool

    names = {"robot": arguments.robot, "over": arguments.over}
    tell = partial(print, flush=True)
    found = pool(arguments.folder, **names, margin=arguments.margin, tell=tell)
    gains = list(found.gains.values())
    claim = f"more than {100 * arguments.margin:g} % over {arguments.over}"
    print(describe_pool(gains, found.interval, **names))
    if found.left_out:
        print(f"Left out, as said above: {', '.join(found.left_out)}.")
    print(f"The claim that {arguments.robot} gains {claim}: {found.verdict}.")
    if arguments.figure:
        figure(plot_pool, gains, found.interval, **names).save(arguments.figure)
    return 0


def _collect(arguments) -> int:
    from ..classroom.collecting import collect, second_of, shut_off

    if not shut_off():
        print("This system cannot shut off the network.", file=sys.stderr)
    found = collect(
        arguments.folder,
        arguments.csv,
        seconds=arguments.seconds,
        cell_seconds=arguments.cell_seconds,
        megabytes=arguments.megabytes,
        tell=lambda text: print(text, flush=True),
    )
    print(f"{len(found)} notebooks: the answers are in {arguments.csv},")
    print(f"the mistakes in {second_of(arguments.csv)}")
    return 0
