"""
Measure how long the pages run, as a share of the time that each states.

    python benchmarks/pages.py                   all pages
    python benchmarks/pages.py book/07_*.ipynb   some

What is measured is processor time, which other programs do not prolong; and it is
divided by how much slower than the authors' machine this one is at a small task.
A share above 1 says: measure again on an idle machine, then state more.
No test asks for it, because no machine owes a test its speed.
"""

from __future__ import annotations

import argparse
import json
import re
import resource
import sys
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np

from abstransfer import navigation_tasks, parse_map
from abstransfer.learning import q_learning_runs

ROOT = Path(__file__).parents[1]
WORDS = "zero one two three four five six seven eight nine ten eleven twelve"
COUNT = {word: i for i, word in enumerate(WORDS.split())}
COUNT |= {"a": 1, "half a": 0.5, "fifteen": 15, "twenty": 20, "thirty": 30}
COUNT |= {"forty": 40, "fifty": 50, "ninety": 90}
STATED = re.compile(
    r"notebook runs in (?:about |less than )?(half a|\w+) (second|minute)s?"
)
REFERENCE = 0.15  # processor seconds of `yardstick` on the authors' machine


def stated_seconds(text: str) -> float:
    """Return the run time that a page states."""
    match = STATED.search(text)
    if not match:
        raise ValueError("a page must say 'The notebook runs in about ... seconds.'")
    count = float(match[1]) if match[1].isdigit() else COUNT[match[1]]
    return count * (60 if match[2] == "minute" else 1)


def processor_seconds(function: Callable, *arguments) -> tuple[object, float]:
    """Return what a function returns, and the processor time of it and its children."""

    def used():
        child = resource.getrusage(resource.RUSAGE_CHILDREN)
        return time.process_time() + child.ru_utime + child.ru_stime

    before = used()
    result = function(*arguments)
    return result, used() - before


def yardstick() -> None:
    """Do a little of what pages do: plain Python, and arrays, on one core."""
    total = 0
    for i in range(2_000_000):
        total += i & 3
    array = np.random.default_rng(0).random(500_000)
    for _ in range(10):
        np.sort(array)


@cache
def slowness() -> float:
    """Return how many times slower than the authors' this machine is, at least 1."""
    return max(1.0, min(processor_seconds(yardstick)[1] for _ in range(3)) / REFERENCE)


@cache
def warm_up() -> None:
    """Have the loops compiled and stored, so that no page pays for it."""
    tiny = navigation_tasks(parse_map("+-+-+\n|.d*|\n+-+-+"))
    for n_runs in (1, 3):
        for guide in ({}, {"guide": tiny.mdp.allowed / 8, "tau": 5}):
            for strategy in ("hard", "soft"):
                options = guide | {"strategy": strategy}
                q_learning_runs(tiny.mdp, 10, rngs=range(n_runs), **options)


def main(arguments: list[str] | None = None) -> int:
    sys.path.insert(0, str(ROOT / "scripts"))
    from refresh_notebooks import refreshed

    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("pages", nargs="*", type=Path, help="default: all pages")
    pages = parser.parse_args(arguments).pages
    warm_up()
    for path in pages or sorted((ROOT / "book").glob("[0-9]*.ipynb")):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        stated = stated_seconds("".join("".join(cell["source"]) for cell in cells))
        _, measured = processor_seconds(refreshed, path)
        share = measured / slowness() / stated
        print(f"{path.stem:20} {stated:5.0f} s stated, of which it takes {share:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
