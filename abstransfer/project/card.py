"""
The card of a race: a result that can be handed in, and run again by others.

Page 11 of the book teaches this module.
"""

from __future__ import annotations

import json
import platform
from dataclasses import asdict, dataclass, fields, replace
from importlib import metadata
from pathlib import Path

import numpy as np

from ..driving import column
from ..experiments.problem import digest
from ..experiments.stats import Interval, mean_interval, relative_gain
from .racing import Race


@dataclass(frozen=True)
class Card:
    """What a race showed; :func:`make_card` makes one."""

    title: str
    by: str
    building: str  # the text of its maps
    counts: dict[str, int]  # cells, rooms, goals, abstract states
    settings: dict  # features, steps, tau, strategy, runs, seed
    drives: dict[str, float]  # value of obeying, as in a column of Table 1
    goals: dict[str, Interval]  # of a run
    gains: dict[str, Interval]  # over Q-learning: 0.1 is 10 % more goals
    versions: dict[str, str]  # in the files, not in the text

    @property
    def fingerprint(self) -> str:
        """Short fingerprint of all but the versions: equal cards, equal results."""
        content = asdict(self) | {"versions": {}}
        return digest(json.dumps(content, sort_keys=True).encode())

    def __str__(self) -> str:
        """Return the card as Markdown; values round, so machines agree on it."""
        counts = (f"{n} {name.replace('_', ' ')}" for name, n in self.counts.items())
        settings = (f"{name} {value}" for name, value in self.settings.items())
        head = ("robot", "drives", "goals of a run", "over none")
        rows = [head] + [
            (
                name,
                f"{self.drives[name]:.2f}" if name in self.drives else "",
                _text(self.goals.get(name), 1, "{:,.0f}", ""),
                _text(self.gains.get(name), 100, "{:+.1f}", " %"),
            )
            for name in dict.fromkeys([*self.goals, *self.drives])
        ]
        building = f"Building {digest(self.building.encode())}: {', '.join(counts)}."
        lines = [f"# {self.title}", "", f"By {self.by}. {building}"]
        lines += [f"Settings: {'; '.join(settings)}.", "", *_table(rows), ""]
        return "\n".join([*lines, "```text", self.building, "```", ""])

    def save(self, path: str | Path) -> Path:
        """Write the card as ``.md``, to be read, or ``.json``, to be collected."""
        path = Path(path)
        if path.suffix == ".json":
            text = json.dumps(asdict(self), indent=1) + "\n"
        elif path.suffix == ".md":
            versions = ", ".join(f"{name} {v}" for name, v in self.versions.items())
            text = f"{self}\nFingerprint {self.fingerprint}. Made with {versions}.\n"
        else:
            raise ValueError(f"path must end in .md or .json, got {path.name!r}")
        path.write_text(text, encoding="utf-8", newline="\n")
        return path


def make_card(race: Race, *, title: str, by: str = "nobody", rng=0) -> Card:
    """
    Return the card of a race, with 95 % intervals over its runs.

    >>> from abstransfer import navigation_tasks, parse_map, uniform_policy
    >>> from abstransfer.project.racing import race
    >>> tasks = navigation_tasks(parse_map("+---+\\n|.d*|\\n+---+"), reward="goal")
    >>> go = {"eager": uniform_policy(tasks.possible)}
    >>> card = make_card(race(tasks, go, steps=90, tau=90, n_runs=2), title="Try")
    >>> card.counts
    {'cells': 2, 'rooms': 1, 'goals': 1, 'abstract_states': 1}
    """
    tasks, rng = race.tasks, np.random.default_rng(rng)
    cost = np.where(tasks.mdp.terminal, 0.0, -1.0)  # Table 1 is about driving
    road = replace(tasks, mdp=replace(tasks.mdp, reward=cost, gamma=0.99))
    found, values = column(road, {}), column(road, race.guides)
    counts = ("cells", "rooms", "goals", "abstract_states")
    names = dict.fromkeys((*race.guides, "rand", "optimal"))
    return Card(
        title=title,
        by=by,
        building="\n\n".join(str(map_) for map_ in tasks.maps),
        counts={name: int(found[name]) for name in counts},
        settings={
            "features": len(tasks.features),
            "steps": race.steps,
            "tau": race.tau,
            "strategy": race.strategy,
            "runs": len(race.goals["none"]),
            "seed": race.seed,
        },
        drives={name: round(values[name], 4) for name in names},
        goals={
            name: _rounded(mean_interval(x, rng=rng)) for name, x in race.goals.items()
        },
        gains={
            name: _rounded(relative_gain(x, race.goals["none"], rng=rng))
            for name, x in race.goals.items()
            if name != "none"
        },
        versions={"python": platform.python_version()}
        | {name: metadata.version(name) for name in ("abstransfer", "numpy", "scipy")},
    )


def read_card(path: str | Path) -> Card:
    """Return the card in a ``.json`` file; ValueError if there is none in it."""
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
        parts = {field.name: content[field.name] for field in fields(Card)}
        for name in ("goals", "gains"):
            parts[name] = {k: Interval(*v) for k, v in parts[name].items()}
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{path}: not a card ({error})") from None
    return Card(**parts)


def _table(rows: list[tuple[str, ...]]) -> list[str]:
    """Return the lines of a table in Markdown whose columns stand under each other."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        f"| {' | '.join(f'{cell:{w}}' for cell, w in zip(row, widths, strict=True))} |"
        for row in rows
    ]
    lines.insert(1, f"|{'|'.join('-' * (w + 2) for w in widths)}|")
    return lines


def _rounded(interval: Interval) -> Interval:
    return Interval(*(round(float(x), 6) for x in interval))


def _text(interval: Interval | None, factor: float, form: str, unit: str) -> str:
    """Return an interval as "6 [5, 7]", in the given form and unit."""
    if interval is None:
        return ""
    estimate, low, high = (form.format(factor * x) for x in interval)
    text = f"{estimate} [{low}, {high}]"
    return (estimate if np.isnan(interval.low) else text) + unit
