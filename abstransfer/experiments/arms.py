"""
What is compared: the nine arms, the grid of tau, and the scales, all as data.

An arm is one learner of Figures 3 and 4: plain Q-learning, or a guide and a
strategy.  A scale says how long it learns.  Page 8 of the book teaches this
module.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from ..learning.settings import STRATEGIES, choice, number, whole
from ..mdp import LARGEST

PAPER_STEPS = 30_000_000
MOST_WINDOWS = 10_000_000  # of all runs together, which are held in memory


class Arm(NamedTuple):
    """One learner."""

    name: str  #: "none", or guide and strategy, as in "nd-hard"
    guide: str | None  #: "rand", a builder, or the name of a policy you pass
    strategy: str  #: "hard" or "soft"; not read without a guide
    tau: int  #: steps of advice, at paper scale
    hint: float = 0.0  #: first note on the actions that exist, above all others

    def record(self) -> dict:
        """Return the arm for JSON; without a hint, as before there was one."""
        return {k: v for k, v in self._asdict().items() if k != "hint" or v}


ARMS = (
    Arm("none", None, "hard", 0),
    Arm("rand-hard", "rand", "hard", 9_000_000),
    Arm("rand-soft", "rand", "soft", 19_000_000),
    Arm("nd-hard", "nd", "hard", 3_500_000),
    Arm("nd-soft", "nd", "soft", 11_000_000),
    Arm("prob-hard", "prob", "hard", 3_500_000),
    Arm("prob-soft", "prob", "soft", 6_000_000),
    Arm("grad-hard", "grad", "hard", 3_500_000),
    Arm("grad-soft", "grad", "soft", 6_000_000),
)
TAUS = tuple(
    round(1e6 * tau) for tau in (0.5, 1, 2, 3.5, 6, 9, 11, 14, 19, 25)
)  # holds every tau of the paper


class Scale(NamedTuple):
    """How long every run learns."""

    steps: int  #: of a run
    window: int  #: steps in which goals are counted together

    def tau(self, arm: Arm) -> int:
        """
        Return the steps of advice of an arm at this scale: tau shrinks along.

        >>> SCALES["page"].tau(ARMS[3])  # 3.5 million / 30
        116667
        """
        return round(arm.tau * self.steps / PAPER_STEPS)


SCALES = {
    "page": Scale(1_000_000, 20_000),  # 1/30, 50 windows
    "class": Scale(10_000_000, 200_000),  # 1/3, 50 windows
    "paper": Scale(PAPER_STEPS, 500_000),  # 60 windows
}


def tau_cells(
    arms: Iterable[Arm] = ARMS, taus: Iterable[int] = TAUS
) -> tuple[Arm, ...]:
    """
    Return the cells of the tau grid: every arm that has a guide, at every tau.

    >>> len(tau_cells())  # 8 arms x 10 tau
    80
    """
    taus = tuple(taus)
    return tuple(arm._replace(tau=tau) for arm in arms if arm.guide for tau in taus)


def check_arms(arms: Iterable[Arm]) -> tuple[Arm, ...]:
    """Return the arms; refuse by name what cannot be run, or told apart."""
    arms = tuple(map(_check_arm, arms))
    if not arms:
        raise ValueError("arms must hold at least one arm, got none")
    keys = [(arm.name, arm.tau) for arm in arms]
    twice = next((key for key in keys if keys.count(key) > 1), None)
    if twice:
        raise ValueError(f"arms must differ in name or tau, got {twice} twice")
    return arms


def _check_arm(arm: Arm) -> Arm:
    if not isinstance(arm, Arm):
        raise ValueError(f"arms must hold Arm records, got {arm!r}")
    # Plain in a table: printed ASCII, no quote, no comma.
    if not re.fullmatch(r"[ !#-+\--~]+", str(arm.name)):
        raise ValueError(
            f"the name of an arm must be a plain word (ASCII), got {arm.name!r}"
        )
    of = f"of arm {arm.name!r}"
    choice(f"strategy {of}", arm.strategy, STRATEGIES)
    number(f"hint {of}", arm.hint, -LARGEST, LARGEST)
    return arm._replace(tau=whole(f"tau {of}", arm.tau))
