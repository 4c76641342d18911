"""The still of the painted cells: what looks alike in one building, and in two."""

from __future__ import annotations

import numpy as np

from ...abstraction import FEATURES, LABELS
from ...navigation import navigation_tasks
from ...plotting.style import count
from ...plotting.tasks import abstract_ranks
from ..base import Still
from ..parts.building import draw_building
from .counts import count_states
from .widget import Paint

CHOICES = {  # rows of the table
    "all 11": FEATURES,
    "the 8 sights": LABELS,
    "no sights": FEATURES[len(LABELS) :],
    "none": (),
}


def draw(scene: Paint) -> Still:
    """Return the painted building, and what is lit in both."""
    shown, lit, counts = scene.shown, scene.lit, scene.counts
    keep = [min(scene.task, len(scene.source.goals) - 1)]
    home = navigation_tasks(scene.source, keep=keep, features=scene.features)
    rank = abstract_ranks(home, 0)
    texts = ["" if r < 0 else str(r + 1) for r in rank]
    alt = f"The small building: {rank.max() + 1} numbers for what looks alike."
    frames = [draw_building(scene.source, alt, texts=texts, goal=home.goal[0])]
    for name, tasks in shown.items():
        map_, size = tasks.maps[0], "small" if name == "source" else "large"
        values = np.full(map_.n_cells, np.nan)
        values[lit[name]] = 1.0
        alt = f"The {size} building: {count(len(lit[name]), 'cell')} lit."
        frames.append(draw_building(map_, alt, values=values, goal=tasks.goal[0]))
    caption = (
        f"Cells that look alike. With {count(len(scene.features), 'feature')}, "
        f"{counts.source} abstract states occur in the small building and "
        f"{counts.target} in the large one, where {counts.unseen:.1%} of the states "
        f"look like nothing in the small one. Lit: one abstract state, in "
        f"{count(len(lit['source']), 'cell')} of a task of the small building and "
        f"{len(lit['target'])} of a task of the large one."
    )
    rows = []
    for name, chosen in CHOICES.items():
        of = count_states(scene.source, scene.map, chosen)
        shares = of.unseen, of.torn, of.right
        rows.append((name, of.source, of.target, *(f"{x:.1%}" for x in shares)))
    head = (
        "features",
        "abstract states, small",
        "large",
        "large: looks new",
        "small: in a conflict",
        "one action right",
    )
    return Still(frames, caption, head, rows)
