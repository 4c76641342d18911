"""The scene of page 10: operate on a robot's notes, and let it go on."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache, partial

import numpy as np
import traitlets

from ...driving import advised
from ...experiments.arms import Scale
from ...experiments.plan import SEED
from ...experiments.problem import Problem, build_guides, target_tasks
from ...experiments.surgery import leave, noted
from ...reproduction.interventions import ADVISED, ALONE
from ..files import WINDOWS
from ..parts.runs import RunScene, alone
from .operations import KINDS, operate

PATIENTS = ("nd", "prob")
ADVICE = 7  # windows of a run: 3.5 of 30 million steps, the paper's hard tau


class Surgery(RunScene):
    """
    Surgery on notes: change what a robot has noted, nothing else, and let it go on.

    Parameters
    ----------
    patient : {"nd", "prob"}
        Whose robot: it was advised for 3.5 million steps; the other helps out.
    operation : {"none", "erase", "graft", "deal", "thin"}
        Nothing; blank where the other has no notes; the other's notes where it has
        none; notes dealt anew among the actions of their state; half of all states.
    luck : int
        Run of the stored operations; it also draws what is dealt or thinned.
    map, source : Map, text or name
        Where the robot learns, and where the advice comes from.
    steps : int
        Length of a run, advice included.

    Examples
    --------
    >>> scene = Surgery(operation="erase", steps=600_000)
    >>> scene
    Surgery(operation='erase', steps=600000)
    >>> len(scene.goals("nd", "none"))  # windows after the advice
    53
    """

    scene = "surgery"
    constants = {"advice": ADVICE, "advised": ADVISED, "alone": ALONE}
    patient = traitlets.Enum(PATIENTS, "nd").tag(sync=True)
    operation = traitlets.Enum(KINDS, "none").tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    curves = traitlets.Dict().tag(sync=True, local=True)

    def noted(self, patient: str, operation: str) -> float:
        """Return the share of states that have a note when the robot goes on."""
        tasks, notes = target_tasks(self.problem), self._notes(patient, operation)
        return float(noted(notes)[~tasks.mdp.terminal].mean())

    def goals(self, patient: str, operation: str) -> np.ndarray:
        """Return the goals after the advice, by window (53,)."""
        return self.goals_of([(patient, operation)])[0]

    def goals_of(self, pairs: Iterable[tuple[str, str]]) -> list[np.ndarray]:
        """Return the same of several: they take turns to learn, in half the time."""
        window, settings = self.scale.window, (self.problem, self.scale, self.luck)
        return alone(
            target_tasks(self.problem),
            Scale((WINDOWS - ADVICE) * window, window),
            _seed(ALONE, self.luck),
            {(*settings, *pair): partial(self._notes, *pair) for pair in pairs},
        )

    def _notes(self, patient: str, operation: str) -> np.ndarray:
        return _notes(self.problem, self.scale.window, self.luck, patient, operation)

    def options(self) -> dict:
        """Return the state of the built page: what no operation leads to is known."""
        known = {
            f"{patient} none {self.luck} {self.steps}": [
                round(self.noted(patient, "none"), 4),
                *self.goals(patient, "none").tolist(),
            ]
            for patient in PATIENTS
        }
        return self.changed | {"curves": known | self.curves}


def _seed(stream: int, luck: int) -> np.random.SeedSequence:
    return np.random.SeedSequence(SEED, spawn_key=(stream, luck - 1))


@lru_cache(maxsize=4)
def _left(problem: Problem, window: int, luck: int):
    """Return what both robots have noted when the advice ends."""
    tasks, built = target_tasks(problem), build_guides(problem, PATIENTS)
    guides = {name: advised(tasks, advice) for name, advice in built.items()}
    seed = _seed(ADVISED, luck)
    return leave(tasks.mdp, tasks.available, guides, ADVICE * window, seed=seed)


def _notes(problem, window, luck, patient, operation) -> np.ndarray:
    """Return the notes (S, A) with which a robot goes on."""
    left = _left(problem, window, luck)
    other = PATIENTS[1 - PATIENTS.index(patient)]
    mine, others = left.notes[patient], left.notes[other]
    return operate(operation, mine, others, left.available, luck)
