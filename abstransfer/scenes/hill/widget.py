"""The scene of page 6: climbing the value of advice with two knobs."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import traitlets

from ...builders.deduced import Climb, absprob_pi
from ...mdp import MDP
from ...solvers import evaluate_policy
from ..base import Scene

LAST = 300  # iterations of a climb
EARLY = 30  # after which it is on one side for good
STARTS = {  # weights of hall, left landing, right landing, tunnel, goal
    "hall": (1.0, 0.0, 0.0, 0.0, 0.0),
    "landing": (0.0, 0.0, 1.0, 0.0, 0.0),
    "both": (0.5, 0.0, 0.5, 0.0, 0.0),
}
WORDS = {
    "hall": "in the hall",
    "landing": "on the right landing",
    "both": "in either, equally often",
}
HALL = MDP(
    next_state=[[[1], [2]], [[4], [0]], [[0], [3]], [[4], [4]], [[4], [4]]],
    prob=np.ones((5, 2, 1)),
    reward=[-1, -1, -1, -1, 0],
    terminal=[False, False, False, False, True],
    gamma=0.99,
)
RHO = np.array([0, 1, 1, 2, 2])  # the landings look alike


class Hill(Scene):
    """
    Advice with two knobs, the land of its values, and climbs on it.

    Parameters
    ----------
    p, q : float
        Where the climb starts: how likely the robot goes left in the hall, and up
        on a landing.
    start : {"hall", "landing", "both"}
        Where the robot starts (the paper's beta).
    t : int
        Iterations of AbsProb-PI that are shown, 0 to 300.
    earlier : list of [p, q]
        Starts of earlier climbs, which stay on the picture.
    sides : bool
        Whether 100 starts are marked by where they end.

    Examples
    --------
    >>> scene = Hill(p=1, q=1)
    >>> round(scene.value(), 2)
    -1.99
    >>> scene.climb(1).history.round(2).tolist()
    [-1.99, -2.04]
    """

    scene = "hill"
    constants = {"early": EARLY, "weights": STARTS, "words": WORDS}
    p = traitlets.Float(0.3, min=0.0, max=1.0).tag(sync=True)
    q = traitlets.Float(0.3, min=0.0, max=1.0).tag(sync=True)
    start = traitlets.Enum(tuple(STARTS), "hall").tag(sync=True)
    t = traitlets.Int(5, min=0, max=LAST).tag(sync=True)
    earlier = traitlets.List().tag(sync=True)
    sides = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)

    def value(self, p: float | None = None, q: float | None = None) -> float:
        """Return what advice is worth: that which the climb starts from by default."""
        knobs = (self.p if p is None else p, self.q if q is None else q)
        return float(np.dot(STARTS[self.start], values_at(*knobs)))

    def climb(self, iterations: int = LAST) -> Climb:
        """Return the climb of AbsProb-PI from p and q."""
        return _climb(self.p, self.q, self.start, iterations)

    @property
    def ends(self) -> np.ndarray:
        """Whether a climb ends at left and up, by start: q from below, p, (10, 10)."""
        return _ends(self.start)


def advice(p: float, q: float) -> np.ndarray:
    """Return the advice (3, 2) with these knobs."""
    return np.array([[p, 1 - p], [q, 1 - q], [0.5, 0.5]])


def side(p: float, q: float) -> str:
    """
    Return the top that advice is nearest to.

    >>> side(0.9, 0.8), side(0.2, 0.1), side(0.2, 0.9)
    ('at left and up', 'at right and down', 'in between')
    """
    if min(p, q) > 0.5:
        return "at left and up"
    return "at right and down" if max(p, q) < 0.5 else "in between"


def values_at(p: float, q: float) -> np.ndarray:
    """Return the values (5,) under advice: what each state is worth."""
    return evaluate_policy(HALL, advice(p, q)[RHO])


@lru_cache(maxsize=512)
def _climb(p: float, q: float, start: str, iterations: int) -> Climb:
    options = {"initial": advice(p, q), "start": np.array(STARTS[start])}
    return absprob_pi(
        HALL, RHO, np.ones((3, 2), bool), iterations=iterations, **options
    )


@lru_cache(maxsize=3)
def _ends(start: str) -> np.ndarray:
    """Climb from 100 starts at once: in as many halls, which do not meet."""
    knobs = (np.arange(10) + 0.5) / 10
    initial = np.array([advice(p, q) for q in knobs for p in knobs])
    n, n_abstract, n_actions = initial.shape
    hall = np.arange(n).repeat(HALL.n_states)
    halls = MDP(
        np.tile(HALL.next_state, (n, 1, 1)) + HALL.n_states * hall[:, None, None],
        np.tile(HALL.prob, (n, 1, 1)),
        np.tile(HALL.reward, n),
        np.tile(HALL.terminal, n),
        HALL.gamma,
    )
    climb = absprob_pi(
        halls,
        np.tile(RHO, n) + n_abstract * hall,
        np.ones((n * n_abstract, n_actions), bool),
        initial=initial.reshape(-1, n_actions),
        start=np.tile(STARTS[start], n) / n,
        iterations=EARLY,
    )
    return (climb.policy[::n_abstract, 0] > 0.5).reshape(10, 10)
