"""
The text that a project hands in: what was raced, and the goals of each life.

The scene of page 11 writes the same text.  :func:`verify` runs such a race again,
and says where the two differ.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..abstraction import FEATURES
from ..driving import column
from ..experiments.plan import SEED
from ..maps import parse_map
from ..navigation import navigation_tasks
from .racing import Race
from .setup import GUIDES, Setup, drives, run, scale


class Verified(NamedTuple):
    """A race that was run again."""

    setup: Setup
    race: Race


def card_text(setup: Setup, goals: Mapping[str, Sequence[int]]) -> str:
    """Return the text to hand in; `goals` are those of each life, by robot."""
    tasks = navigation_tasks(setup.map, features=setup.features)
    found, (steps, tau) = column(tasks, {}), scale(setup.map)
    counts = ("cells", "rooms", "goals", "abstract_states")
    seen = "all" if setup.features == FEATURES else ", ".join(setup.features) or "none"
    settings = {
        "Building": ", ".join(f"{found[n]} {n.replace('_', ' ')}" for n in counts),
        "Advice from": setup.advice,
        "Features": seen,
        "Strategy": setup.strategy,
        "Steps": steps,
        "Tau": tau,
        "Lives": setup.lives,
        "Seed": SEED,
    }
    values = drives(setup, [name for name in GUIDES if name in setup.guides])
    lives = [f"life {i + 1}" for i in range(setup.lives)]
    rows = [["robot", "drives", "goals of a life", "over none", *lives]]
    rows.append(["---"] * len(rows[0]))
    total = sum(goals["none"])
    for name in ("none", *values):
        mine = [int(n) for n in goals.get(name, ())]
        gain = ""
        if mine and name != "none":
            gain = f"{_half_up(1000 * sum(mine) / total - 1000) / 10:+.1f} %"
            gain = gain if total else ""
        mean = f"{_half_up(sum(mine) / len(mine))}" if mine else ""
        value = f"{values[name]:.2f}" if name in values else ""
        rows.append([name, value, mean, gain, *(mine or [""] * len(lives))])
    return "\n".join(
        [
            "# Result card",
            "",
            *(f"- {name}: {value}" for name, value in settings.items()),
            "",
            *(f"| {' | '.join(map(str, row))} |" for row in rows),
            "",
            "```text",
            str(setup.map),
            "```",
            "",
        ]
    )


def read_setup(text: str) -> Setup:
    """Return what was raced, from a text to hand in; lines that it lacks are named."""

    def of(name):
        found = re.search(rf"^- {name}: (.*)$", text, re.MULTILINE)
        if not found:
            raise ValueError(f"text must hold a line '- {name}: ...'")
        return found[1].strip()

    drawing = re.search(r"^```text\n(.*?)\n```$", text, re.MULTILINE | re.DOTALL)
    if not drawing:
        raise ValueError("text must hold a building between lines ```text and ```")
    seen = of("Features")
    names = FEATURES if seen == "all" else tuple(re.findall(r"\w+", seen))
    robots = re.findall(r"^\| (\w+) \|.*\| \d+ \|$", text, re.MULTILINE)
    guides = tuple(name for name in GUIDES if name in robots)
    return Setup(
        parse_map(drawing[1]),
        () if seen == "none" else names,
        guides,
        of("Advice from"),
        of("Strategy"),
        int(of("Lives")),
    )


def verify(text: str) -> Verified:
    """
    Run the race of a text to hand in again.

    Raises
    ------
    ValueError
        At the first line that the new race does not confirm: what it says, and
        what it should say.  Lines before the title and after the building are free.

    Examples
    --------
    >>> from abstransfer.project.setup import Setup, run
    >>> setup = Setup(parse_map("+---+\\n|.d*|\\n+---+"), guides=("eager",), lives=1)
    >>> card = card_text(setup, run(setup).goals)
    >>> verify("By me.\\n" + card).setup == setup
    True
    >>> verify(card.replace("Tau: 400", "Tau: 9"))
    Traceback (most recent call last):
    ...
    ValueError: the card says '- Tau: 9', the race again '- Tau: 400'
    """
    setup = read_setup(text)
    again = run(setup)
    said = [line.rstrip() for line in text.splitlines()]
    if "# Result card" in said:
        said = said[said.index("# Result card") :]
    for i, right in enumerate(card_text(setup, again.goals).splitlines()):
        line = said[i] if i < len(said) else ""
        if line != right:
            raise ValueError(f"the card says {line!r}, the race again {right!r}")
    return Verified(setup, again)


def _half_up(x: float) -> int:
    """Return a whole number as JavaScript rounds: halves go up."""
    return int(np.floor(x + 0.5))
