"""The scene of page 4: cells that look alike are painted alike, in two buildings."""

from __future__ import annotations

import numpy as np
import traitlets

from ...abstraction import FEATURES
from ...navigation import NavigationTasks, navigation_tasks
from ..base import MapTrait, Scene
from .counts import Counts, count_states, mask_of

ALL = (1 << len(FEATURES)) - 1


class FeaturesTrait(traitlets.TraitType):
    """A trait that holds names of features; in the browser a number, a bit each."""

    info_text = f"names among {', '.join(FEATURES)}"

    def __init__(self, **options):
        super().__init__(FEATURES, **options)
        self.tag(
            sync=True,
            bounds=(0, ALL),
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
    torn : bool
        Whether cells are marked where the best single action is wrong.

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
    torn = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    bet_new = traitlets.Unicode("").tag(sync=True, local=True)

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
            for name, tasks in self.shown.items()
        }

    @property
    def shown(self) -> dict[str, NavigationTasks]:
        """The two tasks that are shown, with all features."""
        pairs = ("source", self.source, self.task), ("target", self.map, self.away)
        return {
            name: navigation_tasks(map_, keep=[min(task, len(map_.goals) - 1)])
            for name, map_, task in pairs
        }
