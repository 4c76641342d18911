"""The scene of page 10: one dial from ND to winner-takes-all, and two curves."""

from __future__ import annotations

import numpy as np
import traitlets

from ...experiments.arms import PAPER_STEPS, STRATEGIES, Arm
from ...experiments.problem import Problem
from ..parts.betas import LAST, STEP, driving_at, policy_at
from ..parts.runs import RunScene

MAPS = {"source": "source", "target": "map"}  # traits by what they are


class Dial(RunScene):
    """
    One dial, two curves: who drives best, and who teaches best?

    The policies proportional to p ** beta: ND at 0, Prob at 1, and close to
    winner-takes-all at 8.  How well each drives is exact; how well it teaches is
    learned in the browser, in as many steps as the paper's.

    Parameters
    ----------
    beta : float, 0 to 8
    reward : {"goal", "cost"}
        Of the learner, whose values start at 0: 1 at the goal, or -1 a step.
    strategy : {"hard", "soft"}
    tau : int
        Last step in which the policy gives advice, out of 30 million.
    luck : int
        Run of the stored experiments, 1 to 50: the random numbers are the same.
    map, source : Map, text or name
        Where it drives and teaches, and where the policies come from.
    steps : int
        Length of a run; tau shrinks along.

    Examples
    --------
    >>> scene = Dial(beta=0.5)
    >>> scene
    Dial(beta=0.5)
    >>> round(scene.driving(0.5), 1)  # mean value of a cell of the target
    -68.4
    >>> scene.policy.shape  # at beta
    (2048, 8)
    >>> scene.points  # what was tried: beta, goals, and the settings
    []
    """

    scene = "dial"
    constants = {"step": STEP}
    beta = traitlets.Float(1.0, min=0.0, max=LAST).tag(sync=True)
    reward = traitlets.Enum(("goal", "cost"), "goal").tag(sync=True)
    strategy = traitlets.Enum(STRATEGIES, "hard").tag(sync=True)
    tau = traitlets.CInt(3_500_000, min=0, max=PAPER_STEPS).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    points = traitlets.List().tag(sync=True, local=True)

    @property
    def problem(self) -> Problem:
        """The problem that is learned."""
        return Problem(source=self.source, target=self.map, reward=self.reward)

    @property
    def policy(self) -> np.ndarray:
        """The abstract policy (Z, A) at `beta`."""
        return policy_at(self.source, self.beta)

    def driving(self, beta: float, where: str = "target") -> float:
        """Return what driving is worth, the mean value of a cell: exact."""
        return driving_at(self.source, getattr(self, MAPS[where]), beta)

    def teaching(self, beta: float) -> int:
        """Return the goals of a run with advice at `beta`: stored, or run here."""
        guide = {0: "nd", 1: "prob"}.get(beta) if self.reward == "goal" else None
        if guide:
            arm = Arm(f"{guide}-{self.strategy}", guide, self.strategy, self.tau)
            return int(self.learn(arm).sum())
        arm = Arm("yours", "yours", self.strategy, self.tau)
        return int(self.learn(arm, policy_at(self.source, beta)).sum())

    def options(self) -> dict:
        """Return the state of the built page: it knows the teaching of ND and Prob."""
        if self.reward != "goal":
            return self.changed
        setting = [self.strategy, self.reward, self.tau, self.luck, self.steps]
        known = [[beta, self.teaching(beta), *setting] for beta in (0, 1)]
        return self.changed | {"points": known + self.points}
