"""The scene of page 0: robots that differ in the advice they get learn side by side."""

from __future__ import annotations

import traitlets

from ...experiments.arms import ARMS, PAPER_STEPS, Arm
from ...experiments.problem import target_tasks
from ...learning import q_learning
from ..parts.runs import PolicyTrait, RunScene, scaled

FIRST = 1000  # steps that can be looked at
RACERS = ("none", "rand-hard", "prob-hard", "nd-hard")
LETTERS = {"none": "Q", "rand": "W", "prob": "P", "nd": "N", "yours": "Y"}


class Race(RunScene):
    """
    Four robots in one building: which advice helps most to learn?

    They share the tasks, the starts and the luck; one gets no advice, the others
    that of the wanderer, of Prob and of ND.

    Parameters
    ----------
    policy : ndarray of float, shape (Z, A), optional
        Your own abstract policy: a fifth robot that it advises joins the race.
    tau : int
        Steps for which your policy advises, out of 30 million.
    luck : int
        Run of the stored experiments, 1 to 50: the random numbers are the same.
    t : int
        The step that is looked at, 0 to 1000.
    full : bool
        Whether all steps are learned.
    map, source : Map, text or name
        Where the robots learn, and where the advice comes from.
    steps : int
        Length of a run.

    Examples
    --------
    >>> Race(t=76)
    Race(t=76)
    >>> scene = Race()
    >>> scene.goals  # by robot and window, once all steps are learned
    {}
    """

    scene = "race"
    constants = {"racers": RACERS}
    luck = traitlets.Int(8, min=1, max=50).tag(sync=True)
    t = traitlets.Int(39, min=0, max=FIRST).tag(sync=True)
    policy = PolicyTrait().tag(local=True)
    tau = traitlets.Int(3_500_000, min=0, max=PAPER_STEPS).tag(sync=True)
    full = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    goals = traitlets.Dict().tag(sync=True, local=True)

    @property
    def arms(self) -> tuple[Arm, ...]:
        """Those who race."""
        arms = sorted(
            (arm for arm in ARMS if arm.name in RACERS),
            key=lambda arm: RACERS.index(arm.name),
        )
        if self.policy is not None:
            arms.append(Arm("yours", "yours", "hard", self.tau))
        return tuple(arms)

    def first_steps(self, arm: Arm):
        """Return the trace of the first 1000 steps of an arm."""
        tasks = target_tasks(self.problem)
        guide = self.advice(arm)
        tau = 0 if guide is None else scaled(arm, self.steps)
        return q_learning(
            tasks.mdp, FIRST, rng=self.seed, guide=guide, tau=tau, trace=FIRST
        ).trace
