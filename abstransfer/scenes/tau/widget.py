"""The scene of page 8: for how many steps should a guide advise?"""

from __future__ import annotations

import traitlets

from ...experiments.arms import ARMS, PAPER_STEPS, STRATEGIES, Arm
from ..base import Still
from ..parts.curves import curves_svg
from ..parts.runs import NAMES, RunScene, scaled

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
    bet = traitlets.Unicode("").tag(sync=True)
    curves = traitlets.Dict().tag(sync=True)

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

    def still(self) -> Still:
        """Return the curves without advice, with the paper's tau, and as set."""
        here = dict.fromkeys(STRATEGIES, self.tau)
        paper = {strategy: self._paper(strategy) for strategy in STRATEGIES}
        none = self.learn(self.arm(None))
        frames, totals = [self._frame({}, none)], []
        for taus in (paper, here):
            runs = {s: self.learn(self.arm(s, tau)) for s, tau in taus.items()}
            totals.append([f"{runs[s].sum():,}" for s in STRATEGIES])
            frames.append(self._frame(taus, none))
        name, papers = NAMES[self.guide], [millions(tau) for tau in paper.values()]
        (paper_hard, paper_soft), (hard, soft) = totals
        caption = (
            f"How long should a guide advise? With {name}, {millions(self.tau)} steps "
            f"of advice lead to {hard} goals if it advises in all of them (hard), "
            f"to {soft} if ever less often (soft); the paper's choices, {papers[0]} "
            f"and {papers[1]}, to {paper_hard} and {paper_soft}; no advice, to "
            f"{none.sum():,}."
        )
        rows = [(NAMES["none"], "\u2013", f"{none.sum():,}")]
        for taus, goals in zip((paper, here), totals, strict=True):
            rows += [
                (f"{name} {strategy}", millions(taus[strategy]), total)
                for strategy, total in zip(STRATEGIES, goals, strict=True)
            ]
        head = ("advice", "until step \u03c4", "goals of a whole run")
        return Still(frames, caption, head, rows)

    def _paper(self, strategy: str) -> int:
        return next(a.tau for a in ARMS if a.name == f"{self.guide}-{strategy}")

    def _frame(self, taus: dict, none) -> str:
        """Return the curves with these tau, by strategy, and without advice."""
        curves, names = {"none": none}, {"none": NAMES["none"]}
        alt = "Goals by step, without advice"
        for strategy, tau in taus.items():
            arm = self.arm(strategy, tau)
            curves[arm.name], names[arm.name] = self.learn(arm), strategy
            alt += (
                f", and with {NAMES[self.guide]} {strategy} until step {millions(tau)}"
            )
        mark = None
        if len(set(taus.values())) == 1:
            mark = scaled(self.arm("hard"), self.steps)
        steps = self.scale.steps
        return curves_svg(curves, alt + ".", names=names, steps=steps, mark=mark)


def millions(steps: int) -> str:
    """Return a number of steps as scenes write it.

    >>> millions(3_500_000)
    '3.5 M'
    """
    return f"{steps / 1e6:.1f}".removesuffix(".0") + " M"
