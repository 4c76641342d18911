"""The scene of page 6: climbing the value of a page of advice with two knobs."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import traitlets

from ...builders.deduced import Climb, absprob_pi
from ...mdp import MDP
from ...plotting.style import number
from ...solvers import evaluate_policy
from ..base import Scene, Still
from .still import Landscape, hill_svg

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
SIDE = 24  # squares along a side of the still land


class Hill(Scene):
    """
    A page of advice with two knobs, the land of its values, and climbs on it.

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
    p = traitlets.Float(0.3, min=0.0, max=1.0).tag(sync=True)
    q = traitlets.Float(0.3, min=0.0, max=1.0).tag(sync=True)
    start = traitlets.Enum(tuple(STARTS), "hall").tag(sync=True)
    t = traitlets.Int(5, min=0, max=LAST).tag(sync=True)
    earlier = traitlets.List().tag(sync=True)
    sides = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True)

    def value(self, p: float | None = None, q: float | None = None) -> float:
        """Return what a page is worth: the one the climb starts from by default."""
        knobs = (self.p if p is None else p, self.q if q is None else q)
        return float(np.dot(STARTS[self.start], _values(*knobs)))

    def climb(self, iterations: int = LAST) -> Climb:
        """Return the climb of AbsProb-PI from p and q."""
        return _climb(self.p, self.q, self.start, iterations)

    @property
    def ends(self) -> np.ndarray:
        """Whether a climb ends at left and up, by start: q from below, p, (10, 10)."""
        return _ends(self.start)

    def still(self) -> Still:
        """Return the first iterations, the whole climb, and where 100 starts end."""
        history, knobs = self.climb().history, self.climb().policy[:2, 0]
        heights = _land() @ np.array(STARTS[self.start])
        n_left = int(self.ends.sum())
        left, right = self.value(1, 1), self.value(0, 0)
        caption = (
            f"Climbing with two knobs; the robot starts {WORDS[self.start]}. From "
            f"p = {self.p:g}, q = {self.q:g} AbsProb-PI climbs from "
            f"{number(history[0], 2)} to {number(history[-1], 2)} in {LAST} "
            f"iterations and ends {side(*knobs)}; the best page is worth "
            f"{number(heights.max(), 2)}. Of 100 starts, {n_left} end at left and up "
            f"(worth {number(left, 2)}), {100 - n_left} at right and down "
            f"({number(right, 2)}): a climb does not know of the other top."
        )
        rows = [
            (t, *(number(x, 3) for x in self._after(t)), number(history[t], 3))
            for t in sorted({*_moments(LAST), self.t})
        ]
        land = Landscape(heights, {"left and up": left, "right and down": right})
        first, whole = self._way(self.t), self._way(LAST)
        earlier = [Hill(p=p, q=q, start=self.start)._way(LAST) for p, q in self.earlier]
        low, now, high = (number(history[t], 2) for t in (0, self.t, LAST))
        alts = (
            f"The first {self.t} iterations of a climb, from {low} to {now}.",
            f"All {LAST} iterations of a climb, from {low} to {high}.",
            f"A climb, and 100 starts by where they end: {n_left} left and up.",
        )
        frames = [
            hill_svg(land, alts[0], [first]),
            hill_svg(land, alts[1], [*earlier, whole]),
            hill_svg(land, alts[2], [*earlier, whole], self.ends),
        ]
        return Still(frames, caption, ("iteration", "p", "q", "value"), rows)

    def _way(self, last: int) -> list[tuple[float, float]]:
        return [self._after(t) for t in _moments(last)]

    def _after(self, t: int) -> tuple[float, float]:
        return tuple(self.climb(t).policy[:2, 0].tolist())


def page(p: float, q: float) -> np.ndarray:
    """Return the page of advice (3, 2) with these knobs."""
    return np.array([[p, 1 - p], [q, 1 - q], [0.5, 0.5]])


def side(p: float, q: float) -> str:
    """
    Return the top that a page is nearest to.

    >>> side(0.9, 0.8), side(0.2, 0.1), side(0.2, 0.9)
    ('at left and up', 'at right and down', 'in between')
    """
    if min(p, q) > 0.5:
        return "at left and up"
    return "at right and down" if max(p, q) < 0.5 else "in between"


def _moments(last: int) -> list[int]:
    """Return the iterations that a path shows, more of them at first."""
    return [t for t in (0, 1, 2, 3, 4, 6, 10, 20, 50, LAST) if t < last] + [last]


def _values(p: float, q: float) -> np.ndarray:
    return evaluate_policy(HALL, page(p, q)[RHO])


@lru_cache(maxsize=512)
def _climb(p: float, q: float, start: str, iterations: int) -> Climb:
    options = {"initial": page(p, q), "start": np.array(STARTS[start])}
    return absprob_pi(
        HALL, RHO, np.ones((3, 2), bool), iterations=iterations, **options
    )


@lru_cache(maxsize=1)
def _land() -> np.ndarray:
    """Return the values of all states over the knobs, q from below, (n, n, 5)."""
    knobs = np.linspace(0, 1, SIDE + 1)
    return np.array([[_values(p, q) for p in knobs] for q in knobs])


@lru_cache(maxsize=3)
def _ends(start: str) -> np.ndarray:
    knobs = (np.arange(10) + 0.5) / 10
    climbs = [[_climb(p, q, start, EARLY) for p in knobs] for q in knobs]
    return np.array([[c.policy[0, 0] > 0.5 for c in row] for row in climbs])
