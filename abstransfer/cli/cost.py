"""
What a command takes, said before the work where it is much.

For Table 1 time and memory are about linear in the states, which are cells times
goals; for learning time is linear in the steps.
"""

from __future__ import annotations

import os
import sys

from ..maps import Map

LONG, LARGE = 10, 2e9  # seconds and bytes from which a user is told
# For a state of the source (300 climbing steps) and of the target, as measured on a
# busy server in 2026: a quiet machine is faster.  Parts of the source are held.
SECONDS = 4e-4, 2e-5
BYTES = 800, 0
STEP = 11e-9  # seconds of a step of learning, as in most stored results
EVERYTHING = 140  # minutes of one core, as all stored results took
LEAST = 2e8  # bytes: the program itself, and the part that is worked on


def say_what_it_takes(source: Map, target: Map | None) -> None:
    """
    Print one line on stderr where Table 1 takes long or much memory.

    Raises ValueError where the memory of this machine cannot hold it.
    """
    states = [n_states(source), n_states(target) if target else 0]
    seconds = sum(n * each for n, each in zip(states, SECONDS, strict=True))
    size = LEAST + sum(n * each for n, each in zip(states, BYTES, strict=True))
    has = memory()
    if has is not None and size > has:
        raise ValueError(
            f"{states[0]:,} states of the source (cells times goals) need about "
            f"{size / 1e9:.0f} GB of memory, and this machine has {has / 1e9:.0f}; "
            "take a smaller map, or one with fewer goals"
        )
    if seconds > LONG or size > LARGE:
        print(
            f"abstransfer: {states[0]:,} states in the source and {states[1]:,} in "
            f"the target (cells times goals): this may take about {_spoken(seconds)} "
            f"and {max(size / 1e9, 0.1):.1f} GB",
            file=sys.stderr,
        )


def say_how_long(n_steps: int, n_workers: int) -> None:
    """Print one line on stderr where learning takes long."""
    seconds = n_steps * STEP / n_workers
    if seconds > LONG:
        print(
            f"abstransfer: {n_steps:,} steps; with {n_workers} at work this may take "
            f"about {_spoken(seconds)}",
            file=sys.stderr,
        )


def n_states(map_: Map) -> int:
    """Return the number of states of a map's tasks: cells times goals."""
    return map_.n_cells * len(map_.goals)


def memory() -> int | None:
    """Return the bytes of memory of this machine, or None where it does not say."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):  # Windows has no sysconf
        return None


def _spoken(seconds: float) -> str:
    """Return a time as a person says it.

    >>> _spoken(42), _spoken(1000), _spoken(1e6)
    ('42 s', '17 min', '12 days')
    """
    for most, unit, name in (
        (120, 1, "s"),
        (7200, 60, "min"),
        (172_800, 3600, "hours"),
    ):
        if seconds < most:
            return f"{seconds / unit:.0f} {name}"
    return f"{seconds / 86_400:,.0f} days"
