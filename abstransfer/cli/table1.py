"""
The command ``table1``.
"""

from __future__ import annotations

import json
from functools import partial

from ..driving import format_table1, table1
from ..maps import read_map
from ..navigation import tasks_in_parts
from .cost import say_what_it_takes
from .options import add_json, add_map, add_navigation

HELP = "values of all policies in source and target, beside the paper's"
DESCRIPTION = (
    "Build the abstract policies of the source, and evaluate them exactly in source "
    "and target: Table 1 of the paper."
)
OPTIONS = ("success", "gamma", "actions", "unavailable", "near", "almost_near")


def add_options(parser) -> None:
    """Add the options of the command."""
    add_map(parser, "source", "source", "building of the policies")
    add_map(parser, "target", "target", "building to drive in")
    parser.add_argument(
        "--source-only", action="store_true", help="leave the target out"
    )
    add_navigation(parser, OPTIONS)
    add_json(parser)


def run(arguments) -> int:
    """Print Table 1 of two maps."""
    from tqdm import tqdm

    options = {name: getattr(arguments, name) for name in OPTIONS}
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
    print(json.dumps(result, indent=2) if arguments.json else format_table1(result))
    return 0
