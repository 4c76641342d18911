"""The scene of page 4: cells that look alike are painted alike, in two buildings."""

from __future__ import annotations

import numpy as np
import traitlets

from ...abstraction import FEATURES, LABELS
from ...navigation import NavigationTasks, navigation_tasks
from ...plotting.style import count
from ...plotting.tasks import abstract_ranks
from ..base import MapTrait, Scene, Still
from ..parts.counts import Counts, count_states, mask_of
from ..parts.stills import building_svg

ALL = (1 << len(FEATURES)) - 1
CHOICES = {  # rows of the still picture's table
    "all 11": FEATURES,
    "the 8 sights": LABELS,
    "no sights": FEATURES[len(LABELS) :],
    "none": (),
}


class FeaturesTrait(traitlets.TraitType):
    """A trait that holds names of features; in the browser a number, a bit each."""

    info_text = f"names among {', '.join(FEATURES)}"

    def __init__(self, **options):
        super().__init__(FEATURES, **options)
        self.tag(
            sync=True,
            to_json=lambda names, _: mask_of(names),
            from_json=lambda mask, _: [
                f for i, f in enumerate(FEATURES) if mask >> i & 1
            ],
        )

    def validate(self, obj, value):
        """Return the names in the order of FEATURES."""
        if isinstance(value, str) or not set(value) <= set(FEATURES):
            self.error(obj, value)
        return tuple(name for name in FEATURES if name in value)


class Paint(Scene):
    """
    Paint by abstract state: what looks alike to the robot, in two buildings.

    Parameters
    ----------
    source, map : Map, text or name
        The small building and the large one.
    task, away : int
        Which goal of the small and of the large building, counted from 0.
    z : int
        The abstract state whose cells are lit, over all 11 features; -1 for none.
    features : sequence of str
        Names of the features that are kept; the others are forgotten.

    Examples
    --------
    >>> scene = Paint(z=530)
    >>> scene.lit["source"], scene.lit["target"]  # cells of the two tasks
    ([78], [150, 158, 363, 365, 394])
    >>> scene.counts.source, round(scene.counts.unseen, 3)
    (88, 0.009)
    >>> scene.features = ["in_room", "near_goal"]
    >>> scene.counts.source
    4
    """

    scene = "paint"
    map = MapTrait("target")
    source = MapTrait("source")
    task = traitlets.CInt(0, min=0).tag(sync=True)
    away = traitlets.CInt(11, min=0).tag(sync=True)
    z = traitlets.CInt(530, min=-1, max=ALL).tag(sync=True)
    features = FeaturesTrait()
    bet = traitlets.Unicode("").tag(sync=True)
    bet_new = traitlets.Unicode("").tag(sync=True)

    @property
    def counts(self) -> Counts:
        """What the features that are kept tell apart."""
        return count_states(self.source, self.map, self.features)

    @property
    def lit(self) -> dict[str, list[int]]:
        """The cells that are lit, of both tasks."""
        mask = mask_of(self.features)
        return {
            name: [
                int(cell)
                for cell in np.flatnonzero(~tasks.mdp.terminal)
                if self.z >= 0 and not (tasks.rho[cell] ^ self.z) & mask
            ]
            for name, tasks in self._shown().items()
        }

    def _shown(self) -> dict[str, NavigationTasks]:
        """Return the two tasks that are shown, with all features."""
        pairs = ("source", self.source, self.task), ("target", self.map, self.away)
        return {
            name: navigation_tasks(map_, keep=[min(task, len(map_.goals) - 1)])
            for name, map_, task in pairs
        }

    def still(self) -> Still:
        """Return the painted building, and what is lit in both."""
        shown, lit, all_ = self._shown(), self.lit, self.counts
        task = min(self.task, len(self.source.goals) - 1)
        home = navigation_tasks(self.source, keep=[task], features=self.features)
        rank = abstract_ranks(home, 0)
        texts = ["" if r < 0 else str(r + 1) for r in rank]
        alt = f"The small building: {rank.max() + 1} numbers for what looks alike."
        goal = shown["source"].goal[0]
        frames = [building_svg(self.source, alt, texts=texts, goal=goal)]
        for name, tasks in shown.items():
            map_, size = tasks.maps[0], "small" if name == "source" else "large"
            values = np.full(map_.n_cells, np.nan)
            values[lit[name]] = 1.0
            alt = f"The {size} building: {count(len(lit[name]), 'cell')} lit."
            frames.append(building_svg(map_, alt, values=values, goal=tasks.goal[0]))
        caption = (
            f"Cells that look alike. With {count(len(self.features), 'feature')}, "
            f"{all_.source} abstract states occur in the small building and "
            f"{all_.target} in the large one, where {all_.unseen:.1%} of the states "
            f"look like nothing in the small one. Lit: one abstract state, in "
            f"{count(len(lit['source']), 'cell')} of a task of the small building and "
            f"{len(lit['target'])} of a task of the large one."
        )
        rows = []
        for name, chosen in CHOICES.items():
            of = count_states(self.source, self.map, chosen)
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
