"""The still of the ballot box: the box, its probabilities, and values by the dial."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...abstraction import LABELS
from ...driving import PAPER
from ...navigation import navigation_tasks
from ...plotting.style import count, number
from ..base import Still
from ..parts.betas import BETAS, HEIGHT, driving_chart, policy_at
from ..parts.building import draw_building
from ..parts.charts import Axis, Row, row_chart
from ..parts.svg import WIDTH, picture
from .widget import ADVICE, Ballot


def draw(scene: Ballot) -> Still:
    """Return the cells of the box, the bars, and the curves over the dial."""
    advice = {name: policy_at(scene.source, beta) for name, beta in ADVICE.items()}
    voted = np.flatnonzero(scene.votes)
    bars = []
    for a in voted:
        bars.append(Row(LABELS[a].replace("_", " ")))
        for name in ("Prob", "ND"):
            share = advice[name][scene.z, a]
            bars.append(Row(name, f"{share:.2f}", name.lower(), bar=share))
    # The large building answers a bet of page 7, so it waits until it is asked for.
    where = ("source", "target")[: 1 + scene.large]
    lines = {
        name: [(beta, scene.driving(name, beta)) for beta in BETAS] for name in where
    }
    beta, best = max(lines["source"], key=lambda point: point[1])
    places = {**ADVICE, f"\u03b2 = {beta:g}": beta}
    worth = {
        name: {place: scene.driving(place, at) for place in where}
        for name, at in places.items()
    }
    known = {name: number(of["source"]) for name, of in worth.items()}
    caption = (
        f"A ballot box. {count(round(scene.votes.sum()), 'state')} of the small "
        f"building vote for {count(len(voted), 'action')}. Of all the advice "
        f"that such boxes make, that at \u03b2 = {beta:g} drives best in the "
        f"small building: a cell is worth {number(best)}, with Prob {known['Prob']}, "
        f"with ND {known['ND']}, if the winner takes all {known['Winner']}."
    )
    drives = driving_chart(lines, beta, "mean value of a cell")
    alt = f"The dial: best in the small building at {beta:g}."
    words = "What Prob and ND make of the votes in the box."
    shares = row_chart(bars, Axis(0, 1, {}, "probability"), words, tall=17)
    frames = [_box(scene), shares, picture(drives, alt, WIDTH, HEIGHT)]
    rows = [
        (name, *(number(of[place], 2) for place in where), *_paper(name, where))
        for name, of in worth.items()
    ]
    names = ("small building", "large building")[: len(where)]
    head = ("advice", *names, *(f"paper: {name}" for name in names))
    return Still(frames, caption, head, rows)


def _box(scene: Ballot) -> str:
    task = min(scene.task, len(scene.source.goals) - 1)
    tasks = navigation_tasks(scene.source, keep=[task])
    lit = (tasks.rho == scene.z) & ~tasks.mdp.terminal
    alt = f"The small building: {count(lit.sum(), 'cell')} of the box."
    values = np.where(lit, 1.0, np.nan)
    return draw_building(scene.source, alt, values=values, goal=tasks.goal[0])


def _paper(name: str, where: Sequence[str]) -> Sequence[str]:
    """Return the paper's values of advice in the buildings, if it has them."""
    values = [PAPER[place].get(name.lower()) for place in where]
    return ["\u2013" if v is None else number(v, 2) for v in values]
