"""
The abstraction: eleven features of a cell and a goal, and the abstract state rho.

What a robot sees carries no name of a place, so it means the same in every building.
Page 4 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .maps import CORRIDOR, Map
from .mdp import as_array, numbers

KINDS = ("see_empty_space", "see_door_far", "see_room", "see_corridor")
ORIENTATIONS = ("head_to_goal", "opposite_to_goal")
#: The names of the eight actions, which are what the robot may see and on which side.
LABELS = tuple(f"{kind}_{side}" for side in ORIENTATIONS for kind in KINDS)
#: The eleven yes-or-no facts; bit f of an abstract state is feature f.
FEATURES = (*LABELS, "near_goal", "almost_near_goal", "in_room")
NO_LABEL = -1


class Sight(NamedTuple):
    """What is seen in each of C cells; directions are N, E, S, W."""

    neighbors: np.ndarray  #: (C, 4) cell in that direction, or -1
    labels: np.ndarray  #: (C, 4) index into LABELS of what is seen, or NO_LABEL
    distance: np.ndarray  #: (C,) Manhattan distance to the goal
    in_room: np.ndarray  #: (C,) bool


def look(map_: Map, goal: int) -> Sight:
    """
    Return what a robot sees in each cell of a map when it looks for a goal.

    The sensor looks one cell ahead; a distance ignores walls.

    >>> from abstransfer.maps import parse_map
    >>> sight = look(parse_map("+---+\\n|.d*|\\n+---+"), goal=1)
    >>> [LABELS[label] for label in sight.labels[0] if label != NO_LABEL]
    ['see_room_head_to_goal']
    """
    if goal not in range(map_.n_cells):
        raise ValueError(f"goal must lie in 0..{map_.n_cells - 1}, got {goal!r}")
    neighbors, doors, width = map_.neighbors, map_.doors, map_.shape[1]
    in_room = map_.cells != CORRIDOR
    row, column = np.divmod(np.arange(map_.n_cells), width)
    distance = abs(row - goal // width) + abs(column - goal % width)
    far_door = doors.any(axis=1)
    empty, far, room, corridor = range(len(KINDS))
    first_of = [doors & in_room[neighbors], doors, far_door[neighbors]]
    kind = np.select(first_of, [room, corridor, far], empty)
    away = distance[neighbors] > distance[:, None]
    labels = np.where(neighbors < 0, NO_LABEL, kind + len(KINDS) * away)
    return Sight(neighbors, labels, distance, in_room)


def abstract_states(
    labels: np.ndarray,
    distance: np.ndarray,
    in_room: np.ndarray,
    *,
    near: int = 5,
    almost_near: int = 8,
    features: Sequence[str] = FEATURES,
) -> np.ndarray:
    """
    Return rho (S,), the conjunction of features: bit f is 1 iff feature f holds.

    Parameters
    ----------
    labels, distance, in_room
        As in :class:`Sight`, for S states.
    near, almost_near : int
        Largest Manhattan distance of near_goal and of almost_near_goal.
    features : sequence of str
        The features that make the abstract state; the others are left out.

    Raises
    ------
    ValueError
        If a feature is unknown, or ``0 <= near <= almost_near`` does not hold.

    Examples
    --------
    Six steps from the goal, in a room, with nothing to see: bits 9 and 10.

    >>> nothing = np.full((1, 4), NO_LABEL)
    >>> z = abstract_states(nothing, np.array([6]), np.array([True]))[0]
    >>> bin(z), describe(z)
    ('0b11000000000', 'almost_near_goal ^ in_room')
    """
    features = check_features(features)
    near = as_array("near", near, np.int64, 0)
    almost_near = as_array("almost_near", almost_near, np.int64, 0)
    if not 0 <= near <= almost_near:
        raise ValueError(
            f"0 <= near <= almost_near must hold, got {near}, {almost_near}"
        )
    holds = {label: (labels == i).any(axis=1) for i, label in enumerate(LABELS)}
    holds["near_goal"] = distance <= near
    holds["almost_near_goal"] = (near < distance) & (distance <= almost_near)
    holds["in_room"] = in_room
    rho = np.zeros(len(distance), dtype=np.int64)
    for bit, feature in enumerate(features):
        rho |= holds[feature].astype(np.int64) << bit
    return rho


def check_features(features: Sequence[str]) -> tuple[str, ...]:
    """Return known features in the order of FEATURES; refuse others by name."""
    for feature in np.ravel(features).tolist():
        if feature not in FEATURES:
            raise ValueError(f"features must be among {FEATURES}, got {feature!r}")
    return tuple(name for name in FEATURES if name in features)


def describe(z: int, features: Sequence[str] = FEATURES) -> str:
    """
    Return an abstract state in the paper's words: its true features.

    >>> describe(0b010_0010_0001, features=FEATURES)
    'see_empty_space_head_to_goal ^ see_door_far_opposite_to_goal ^ almost_near_goal'
    """
    z = int(as_array("z", z, np.int64, 0))
    if not 0 <= z < 1 << len(features):
        raise ValueError(f"z must lie in 0..{(1 << len(features)) - 1}, got {z}")
    true = [name for bit, name in enumerate(features) if z >> bit & 1]
    return " ^ ".join(true) or "(no feature holds)"


def unseen_share(rho: np.ndarray, voted: np.ndarray) -> float:
    """
    Return the share of states whose abstract state got no vote in the source.

    Parameters
    ----------
    rho : ndarray of int, shape (S,)
        Abstract states of the target; pass those of non-terminal states.
    voted : ndarray of int
        Abstract states of the source states that vote.

    Examples
    --------
    >>> unseen_share(np.array([0, 1, 1, 2]), np.array([0, 1]))
    0.25
    """
    rho = as_array("rho", rho, np.int64, 1)
    return float(np.mean(~np.isin(rho, numbers("voted", voted))))
