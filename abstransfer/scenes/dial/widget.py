"""The scene of page 10: one dial from ND to winner-takes-all, and two curves."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import traitlets

from ...driving import executed_values
from ...experiments.arms import PAPER_STEPS, STRATEGIES, Arm
from ...experiments.problem import Problem, build_guides, driving_tasks
from ...plotting.style import number
from ...policies import beta_policy
from ..base import Still
from ..parts.panels import Panel, panels_svg
from ..parts.runs import RunScene

LAST, STEP = 8.0, 0.25
BETAS = tuple(float(beta) for beta in np.arange(0, LAST + STEP, STEP))
TRIED = (0.0, 0.5, 1.0, 8.0)  # of the still picture's second curve


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
    beta = traitlets.Float(1.0, min=0.0, max=LAST).tag(sync=True)
    reward = traitlets.Enum(("goal", "cost"), "goal").tag(sync=True)
    strategy = traitlets.Enum(STRATEGIES, "hard").tag(sync=True)
    tau = traitlets.CInt(3_500_000, min=0, max=PAPER_STEPS).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True)
    points = traitlets.List().tag(sync=True)

    @property
    def problem(self) -> Problem:
        """The problem that is learned."""
        return Problem(source=self.source, target=self.map, reward=self.reward)

    @property
    def policy(self) -> np.ndarray:
        """The abstract policy (Z, A) at `beta`."""
        return _policy(self.source, self.beta)

    def driving(self, beta: float, where: str = "target") -> float:
        """Return what driving is worth, the mean value of a cell: exact."""
        return _driving(self.source, getattr(self, _MAPS[where]), beta)

    def teaching(self, beta: float) -> int:
        """Return the goals of a run with advice at `beta`: stored, or run here."""
        guide = {0: "nd", 1: "prob"}.get(beta) if self.reward == "goal" else None
        if guide:
            arm = Arm(f"{guide}-{self.strategy}", guide, self.strategy, self.tau)
            return int(self.learn(arm).sum())
        arm = Arm("yours", "yours", self.strategy, self.tau)
        return int(self.learn(arm, _policy(self.source, beta)).sum())

    def options(self) -> dict:
        """Return the state of the built page: it knows the teaching of ND and Prob."""
        if self.reward != "goal":
            return self.changed
        setting = [self.strategy, self.reward, self.tau, self.luck, self.steps]
        known = [[beta, self.teaching(beta), *setting] for beta in (0, 1)]
        return self.changed | {"points": known + self.points}

    def still(self) -> Still:
        """Return the curve of driving, the curve of teaching, and both."""
        drives = {
            name: [(beta, self.driving(beta, name)) for beta in BETAS]
            for name in ("source", "target")
        }
        teaches = [(beta, self.teaching(beta)) for beta in TRIED]
        driver, driven = max(drives["target"], key=lambda point: point[1])
        teacher, goals = max(teaches, key=lambda point: point[1])
        values = [value for points in drives.values() for _, value in points]
        low, high = np.floor(min(values) / 10) * 10, np.ceil(max(values) / 10) * 10 + 10
        most = np.ceil(goals / 5e4) * 50 + 50
        thousands = [(beta, n / 1000) for beta, n in teaches]
        panels = (
            Panel("drives: mean value of a cell", drives, low, high, driver),
            Panel(
                "teaches: thousands of goals",
                {self.strategy: thousands},
                0.0,
                most,
                teacher,
            ),
        )
        steps = f"{self.scale.steps / 1e6:g} million steps"
        tau = f"{self.tau / 1e6:g} million"
        caption = (
            f"One dial, two curves. In the target the policy drives best at \u03b2 = "
            f"{driver:g}, where a cell is worth {number(driven)}; of {len(TRIED)} "
            f"places tried it teaches best at \u03b2 = {teacher:g}: {goals:,} goals in "
            f"{steps} ({self.strategy} advice until step {tau}, run {self.luck})."
        )
        rows = [
            (
                f"{beta:g}",
                number(self.driving(beta, "source"), 2),
                number(self.driving(beta), 2),
                f"{n:,}",
            )
            for beta, n in teaches
        ]
        head = ("\u03b2", "drives in the source", "in the target", "teaches: goals")
        frames = [
            *(panels_svg([p], f"{p.title}: best at {p.peak:g}.") for p in panels),
            panels_svg(panels, caption),
        ]
        return Still(frames, caption, head, rows)


_MAPS = {"source": "source", "target": "map"}


@lru_cache(maxsize=8)
def _policy(source, beta: float) -> np.ndarray:
    prob = build_guides(Problem(source=source), ["prob"])["prob"]
    return beta_policy(prob, beta)


@lru_cache(maxsize=256)
def _driving(source, target, beta: float) -> float:
    guides = {"policy": _policy(source, beta)}
    return executed_values(driving_tasks(Problem(target=target)), guides)["policy"]
