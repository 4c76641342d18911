"""What a choice of features tells apart, counted over all tasks of two buildings."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...abstraction import FEATURES, unseen_share
from ...builders import count_votes
from ...maps import Map
from ...navigation import navigation_tasks
from ...solvers import optimal_actions, optimal_values


class Counts(NamedTuple):
    """What features tell apart; shares are of states, goals left out."""

    source: int  # abstract states that occur
    target: int
    unseen: float  # share of the target that looks like nothing in the source
    torn: float  # share of the source in which no one action suits all that look so
    right: float  # share of the source where the best such action is optimal


def mask_of(features) -> int:
    """
    Return the number in which feature f is bit f.

    >>> mask_of(["near_goal", "see_door_far_head_to_goal"])
    258
    """
    return sum(1 << FEATURES.index(name) for name in features)


@lru_cache(maxsize=64)
def count_states(source: Map, target: Map, features: tuple[str, ...]) -> Counts:
    """Return what these features tell apart, over all tasks of two buildings."""
    home, away = (navigation_tasks(m, features=features) for m in (source, target))
    seen, abroad = (tasks.rho[~tasks.mdp.terminal] for tasks in (home, away))
    suits = count_votes(_optimal(source), home.rho, home.n_abstract).max(axis=1)
    states = np.bincount(seen, minlength=home.n_abstract)
    return Counts(
        source=len(np.unique(seen)),
        target=len(np.unique(abroad)),
        unseen=unseen_share(abroad, seen),
        torn=float(states[suits < states].sum() / len(seen)),
        right=float(suits.sum() / len(seen)),
    )


@lru_cache(maxsize=2)
def _optimal(source: Map) -> np.ndarray:
    mdp = navigation_tasks(source).mdp
    return optimal_actions(mdp, optimal_values(mdp))
