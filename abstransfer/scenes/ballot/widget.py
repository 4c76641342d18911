"""The scene of page 5: a box of votes for each abstract state, and a dial."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import traitlets

from ...abstraction import LABELS
from ...builders import count_votes
from ...driving import PAPER
from ...maps import Map
from ...navigation import navigation_tasks
from ...plotting.style import count, number
from ...policies import break_ties
from ..base import MapTrait, Scene, Still
from ..dial.widget import BETAS, LAST, STEP, _driving, _policy
from ..parts.counts import _optimal
from ..parts.panels import Panel, panels_svg
from ..parts.stills import building_svg
from .still import box_svg

WINNER = LAST + STEP  # how the browser writes an infinite beta
PAGES = {"ND": 0.0, "Prob": 1.0, "Winner": np.inf}


class BetaTrait(traitlets.Float):
    """A place of the dial: a number up to its end, or infinity for the winner."""

    info_text = f"a number in 0..{LAST:g}, or infinity"

    def __init__(self, default=1.0, **options):
        super().__init__(default, **options)
        self.tag(
            sync=True,
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
    The ballot box: what states that look alike vote for, and the pages of advice.

    Parameters
    ----------
    source, map : Map, text or name
        Where the votes are cast, and where the page of advice is tried, too.
    z : int
        The abstract state whose box is open.
    task : int
        Which goal of the source is shown, counted from 0.
    beta : float, 0 to 8, or infinity
        The power of the shares: ND at 0, Prob at 1, the winner at infinity.

    Examples
    --------
    >>> scene = Ballot(beta=0.5)
    >>> scene.votes[:5]  # of the abstract state on page 5
    array([3.5, 2.5, 0. , 0. , 1. ])
    >>> scene.page[scene.z, :5].round(2)  # what the page says of it
    array([0.42, 0.36, 0.  , 0.  , 0.22])
    >>> round(scene.driving(), 1), round(scene.driving("target"), 1)
    (-34.8, -68.4)
    """

    scene = "ballot"
    map = MapTrait("target")
    source = MapTrait("source")
    z = traitlets.CInt(0b10011, min=0, max=2**11 - 1).tag(sync=True)
    task = traitlets.CInt(7, min=0).tag(sync=True)
    beta = BetaTrait()
    bet = traitlets.Unicode("").tag(sync=True)
    bet_more = traitlets.Unicode("").tag(sync=True)

    @property
    def votes(self) -> np.ndarray:
        """The votes (A,) in the box, over all tasks of the source."""
        return _votes(self.source)[self.z]

    @property
    def page(self) -> np.ndarray:
        """The page of advice (Z, A) at `beta`."""
        return _policy(self.source, self.beta)

    def driving(self, where: str = "source", beta: float | None = None) -> float:
        """Return the mean value of a cell under the page at `beta`: exact."""
        map_ = {"source": self.source, "target": self.map}[where]
        return _driving(self.source, map_, self.beta if beta is None else beta)

    def still(self) -> Still:
        """Return the box, its probabilities, and the values along the dial."""
        pages = {name: _policy(self.source, beta) for name, beta in PAGES.items()}
        voted = np.flatnonzero(self.votes)
        shares = {
            LABELS[a].replace("_", " "): [
                (name, float(pages[name][self.z, a])) for name in ("Prob", "ND")
            ]
            for a in voted
        }
        lines = {
            name: [(beta, self.driving(name, beta)) for beta in BETAS]
            for name in ("source", "target")
        }
        peaks = {
            name: max(points, key=lambda point: point[1])
            for name, points in lines.items()
        }
        beta, best = peaks["source"]
        known = {name: self.driving("source", at) for name, at in PAGES.items()}
        caption = (
            f"A ballot box. {count(round(self.votes.sum()), 'state')} of the small "
            f"building vote for {count(len(voted), 'action')}. Of the pages of advice "
            f"that such boxes make, the one at \u03b2 = {beta:g} drives best in the "
            f"small building: a cell is worth {number(best)}, with Prob "
            f"{number(known['Prob'])}, with ND {number(known['ND'])}, if the winner "
            f"takes all {number(known['Winner'])}."
        )
        values = np.array([value for points in lines.values() for _, value in points])
        low, high = 10 * np.floor(values.min() / 10), 10 * np.ceil(values.max() / 10)
        panel = Panel("mean value of a cell", lines, low, high + 10, beta)
        frames = [
            self._building(),
            box_svg(shares, "What Prob and ND make of the votes in the box."),
            panels_svg([panel], f"The dial: best in the small building at {beta:g}."),
        ]
        places = {**PAGES, f"\u03b2 = {beta:g}": beta}
        rows = [
            (name, *(number(self.driving(w, at), 2) for w in lines), *_paper(name))
            for name, at in places.items()
        ]
        head = ("page", "small building", "large", "paper: small", "large")
        return Still(frames, caption, head, rows)

    def _building(self) -> str:
        task = min(self.task, len(self.source.goals) - 1)
        tasks = navigation_tasks(self.source, keep=[task])
        lit = (tasks.rho == self.z) & ~tasks.mdp.terminal
        alt = f"The small building: {count(lit.sum(), 'cell')} of the box."
        values = np.where(lit, 1.0, np.nan)
        return building_svg(self.source, alt, values=values, goal=tasks.goal[0])


def _paper(name: str) -> tuple[str, str]:
    """Return the paper's values of a page, in both buildings, if it has them."""
    values = [PAPER[where].get(name.lower()) for where in ("source", "target")]
    return tuple("\u2013" if v is None else number(v, 2) for v in values)


@lru_cache(maxsize=8)
def _votes(source: Map) -> np.ndarray:
    tasks = navigation_tasks(source)
    return count_votes(break_ties(_optimal(source)), tasks.rho, tasks.n_abstract)
