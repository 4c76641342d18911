"""
The best teacher: ND mixed with the eager robot, in which shares?

One share in all views, or one for each of three distances to the goal: near, almost
near, and far.  A search by SciPy asks for these and for tau.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..abstraction import FEATURES

START = "mix-"  # how the names of such advice begin
SHARES = (0, 0.25, 0.5, 0.7, 0.85, 1)  # of the eager robot
TAUS = (1_000_000, 2_000_000, 3_500_000)
BUDGET = 60  # mixtures that a search may try
TAU_RANGE = 0.5e6, 8e6  # in which it may choose tau, on a scale of logs


def mixed(name: str, nd: np.ndarray, eager: np.ndarray) -> np.ndarray:
    """
    Return the advice (Z, A) of a name: "mix-0.5", or "mix-0.2-0.5-0.8" by distance.

    >>> nd, eager = np.full((2048, 2), [1.0, 0.0]), np.full((2048, 2), 0.5)
    >>> mixed("mix-0.5", nd, eager)[0].tolist()
    [0.75, 0.25]
    >>> mixed("mix-0-0.5-1", nd, eager)[[1 << 8, 1 << 9, 0], 0].tolist()
    [1.0, 0.75, 0.5]
    """
    shares = np.array([float(share) for share in name.removeprefix(START).split("-")])
    view = np.arange(len(nd))
    near, almost = (
        (view >> FEATURES.index(feature)) & 1
        for feature in ("near_goal", "almost_near_goal")
    )
    distance = np.where(near, 0, np.where(almost, 1, 2))
    share = np.broadcast_to(shares, 3)[distance][:, None]
    return (1 - share) * nd + share * eager


def search(teach: Callable[[str, int], float], budget: int = BUDGET) -> None:
    """
    Try mixtures, by name and tau, that promise to teach best; `teach` says how well.

    Exactly `budget` of them, the first of which is half and half.

    References
    ----------
    Jones, Perttunen & Stuckman (1993), Lipschitzian optimization without the
    Lipschitz constant; Gablonsky & Kelley (2001), A locally-biased form of the
    DIRECT algorithm.  It draws no random numbers, takes bounds, and needs no slope.

    >>> tried = []
    >>> search(lambda name, tau: tried.append((name, tau)) or 1.0, 4)
    >>> tried[0], len(tried)
    (('mix-0.5-0.5-0.5', 2000000), 4)
    """
    from scipy.optimize import direct  # slow to load

    left, least, most = budget, *np.log(TAU_RANGE)

    def loss(x):
        nonlocal left
        if not left:
            raise _Spent
        left -= 1
        shares = "-".join(f"{share:.4g}" for share in x[:3])
        tau = round(float(np.exp(least + x[3] * (most - least))), -3)
        return -teach(f"{START}{shares}", int(tau))

    while left:  # it may give up early: then it begins again
        try:
            direct(loss, [(0, 1)] * 4, maxfun=10 * budget, maxiter=10 * budget)
        except _Spent:
            return


class _Spent(Exception):
    """The budget is spent."""
