"""The scene of page 8: for how many steps should a guide advise?"""

from __future__ import annotations

import traitlets

from ...experiments.arms import ARMS, PAPER_STEPS, STRATEGIES, Arm
from ..parts.runs import RunScene

GUIDES = ("nd", "prob", "grad", "rand")


class TauSlider(RunScene):
    """
    A slider for tau, the steps of advice: curves of hard and soft at full scale.

    Parameters
    ----------
    guide : {"nd", "prob", "grad", "rand"}
        Who advises.
    tau : int
        Last step in which the guide has a say, out of 30 million.
    luck : int
        Run of the stored experiments, 1 to 50: the random numbers are the same.
    all : bool
        Whether all ten tau of the grid are learned.
    map, source : Map, text or name
        Where the robot learns, and where the advice comes from.
    steps : int
        Length of a run; tau shrinks along.

    Examples
    --------
    >>> scene = TauSlider(guide="prob", tau=6e6)
    >>> scene
    TauSlider(guide='prob', tau=6000000)
    >>> scene.curves  # goals by window, by "guide-strategy tau luck steps"
    {}
    """

    scene = "tau"
    guide = traitlets.Enum(GUIDES, "nd").tag(sync=True)
    tau = traitlets.CInt(9_000_000, min=0, max=PAPER_STEPS).tag(sync=True)
    all = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    curves = traitlets.Dict().tag(sync=True, local=True)

    def arm(self, strategy: str | None, tau: int | None = None) -> Arm:
        """Return what is learned: with a strategy, or without advice."""
        if strategy is None:
            return next(arm for arm in ARMS if arm.guide is None)
        tau = self.tau if tau is None else tau
        return Arm(f"{self.guide}-{strategy}", self.guide, strategy, tau)

    def options(self) -> dict:
        """Return the state of the built page: what it shows first is learned here."""
        arms = [self.arm(strategy) for strategy in (None, *STRATEGIES)]
        known = {
            f"{arm.name} {arm.tau} {self.luck} {self.steps}": self.learn(arm).tolist()
            for arm in arms
            if arm.tau or not arm.guide
        }
        return self.changed | {"curves": known | self.curves}


def millions(steps: int) -> str:
    """Return a number of steps as scenes write it.

    >>> millions(3_500_000)
    '3.5 M'
    """
    return f"{steps / 1e6:.1f}".removesuffix(".0") + " M"
