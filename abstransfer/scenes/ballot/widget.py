"""The scene of page 5: a box of votes for each abstract state, and a dial."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import traitlets

from ...builders import count_votes
from ...maps import Map
from ...navigation import navigation_tasks
from ...policies import break_ties
from ...solvers import optimal_actions, optimal_values
from ..base import MapTrait, Scene
from ..parts.betas import LAST, STEP, driving_at, policy_at

WINNER = LAST + STEP  # how the browser writes an infinite beta
ADVICE = {"ND": 0.0, "Prob": 1.0, "Winner": np.inf}


class BetaTrait(traitlets.Float):
    """A place of the dial: a number up to its end, or infinity for the winner."""

    info_text = f"a number in 0..{LAST:g}, or infinity"

    def __init__(self, default=1.0, **options):
        super().__init__(default, **options)
        self.tag(
            sync=True,
            bounds=(0.0, WINNER),
            to_json=lambda beta, _: WINNER if np.isinf(beta) else beta,
            from_json=lambda beta, _: np.inf if beta > LAST else float(beta),
        )

    def validate(self, obj, value):
        """Return the number; refuse what is not on the dial."""
        beta = super().validate(obj, value)
        if not (0 <= beta <= LAST or beta == np.inf):
            self.error(obj, value)
        return beta


class Ballot(Scene):
    """
    The ballot box: what states that look alike vote for, and the advice.

    Parameters
    ----------
    source, map : Map, text or name
        Where the votes are cast, and where the advice is tried, too.
    z : int
        The abstract state whose box is open.
    task : int
        Which goal of the source is shown, counted from 0.
    beta : float, 0 to 8, or infinity
        The power of the shares: ND at 0, Prob at 1, the winner at infinity.
    large : bool
        Whether the large building is shown, too: it answers a bet of page 7.

    Examples
    --------
    >>> scene = Ballot(beta=0.5)
    >>> scene.votes[:5]  # in the box of page 5
    array([3.5, 2.5, 0. , 0. , 1. ])
    >>> scene.advice[scene.z, :5].round(2)  # what they make
    array([0.42, 0.36, 0.  , 0.  , 0.22])
    >>> round(scene.driving(), 1), round(scene.driving("target"), 1)
    (-34.8, -68.4)
    """

    scene = "ballot"
    constants = {"last": LAST, "step": STEP}
    map = MapTrait("target")
    source = MapTrait("source")
    z = traitlets.CInt(0b10011, min=0, max=2**11 - 1).tag(sync=True)
    task = traitlets.CInt(7, min=0).tag(sync=True)
    beta = BetaTrait()
    large = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    bet_more = traitlets.Unicode("").tag(sync=True, local=True)

    @property
    def votes(self) -> np.ndarray:
        """The votes (A,) in the box, over all tasks of the source."""
        return _votes(self.source)[self.z]

    @property
    def advice(self) -> np.ndarray:
        """The advice (Z, A) at `beta`."""
        return policy_at(self.source, self.beta)

    def driving(self, where: str = "source", beta: float | None = None) -> float:
        """Return the mean value of a cell under the advice at `beta`: exact."""
        map_ = {"source": self.source, "target": self.map}[where]
        return driving_at(self.source, map_, self.beta if beta is None else beta)


@lru_cache(maxsize=8)
def _votes(source: Map) -> np.ndarray:
    tasks = navigation_tasks(source)
    best = optimal_actions(tasks.mdp, optimal_values(tasks.mdp))
    return count_votes(break_ties(best), tasks.rho, tasks.n_abstract)
