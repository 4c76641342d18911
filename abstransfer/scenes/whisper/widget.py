"""The scene of page 11: first notes that a robot is whispered, at any size."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache, partial

import numpy as np
import traitlets

from ...experiments.arms import ARMS, SCALES
from ...experiments.problem import Problem, target_tasks
from ...experiments.results import read_results
from ...reproduction.whispers import first_notes, taught
from ..parts.runs import RunScene, alone

WHAT = ("values", "half", "prob", "nd", "exists")
POWERS = (0, 1, 3, 6, 9, 20, 40)  # of the sweep: sizes 1 to 1e-40
STORED = ("none", "nd-hard", "hint", "whisper", "ceiling")  # of the bench, in target
FOLDER = "neighbours-target"


class Whisper(RunScene):
    """
    Whispered advice: first notes at a size, no phase of advice, and a race.

    Parameters
    ----------
    what : {"values", "half", "prob", "nd", "exists"}
        What is whispered: values by view, chances of advice, or what exists.
    power : int, 0 to 40
        The size is 10 to the minus this.
    luck : int
        Run of the stored experiments: the random numbers are the same.
    map, source : Map, text or name
        Where the robot learns, and what teaches it.
    steps : int
        Length of a run.

    Examples
    --------
    >>> scene = Whisper(power=20, steps=600_000)
    >>> scene
    Whisper(power=20, steps=600000)
    >>> scene.goals("values", 20).shape  # by window
    (60,)
    """

    scene = "whisper"
    constants = {"powers": POWERS}
    what = traitlets.Enum(WHAT, "values").tag(sync=True)
    power = traitlets.Int(9, min=0, max=max(POWERS)).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    curves = traitlets.Dict().tag(sync=True, local=True)
    stored = traitlets.Dict().tag(sync=True, local=True)

    def goals(self, what: str, power: int | None = None) -> np.ndarray:
        """Return goals by window (60,): of a whisper, or of "none" or "nd"'s advice."""
        if power is None:
            name = {"none": "none", "advice": "nd-hard"}[what]
            return self.learn(next(arm for arm in ARMS if arm.name == name))
        return self.goals_of([(what, power)])[0]

    def goals_of(self, whispers: Iterable[tuple[str, int]]) -> list[np.ndarray]:
        """Return the same of several whispers: the robots take turns to learn."""
        settings = self.problem, self.scale, self.luck
        notes = {(*settings, *one): partial(self._notes, *one) for one in whispers}
        return alone(target_tasks(self.problem), self.scale, self.seed, notes)

    def _notes(self, what: str, power: int) -> np.ndarray:
        table = tables(self.problem)[what]
        return first_notes(target_tasks(self.problem), table, float(f"1e-{power}"))

    def options(self) -> dict:
        """Return the state of the built page: both rivals, and the stored means."""
        known = {
            f"{name} - {self.luck} {self.steps}": self.goals(name).tolist()
            for name in ("none", "advice")
        }
        more = {"curves": known | self.curves}
        if self.scale == SCALES["paper"] and self.problem == Problem():
            bench = read_results(FOLDER)
            more["stored"] = {n: round(bench.totals(n).mean()) for n in STORED}
        return self.changed | more


@lru_cache(maxsize=2)
def tables(problem: Problem) -> dict[str, np.ndarray]:
    """Return what can be whispered, made once."""
    return taught(problem)
