"""
Navigation tasks: what a robot in a building can do, as one MDP.

This is the only module that knows what a wall is and what an MDP is.
Page 1 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from numbers import Real

import numpy as np

from .abstraction import (
    FEATURES,
    LABELS,
    NO_LABEL,
    abstract_states,
    check_features,
    look,
)
from .maps import DIRECTIONS, Map
from .mdp import MDP

REWARDS = ("cost", "goal")
ACTIONS = ("relational", "compass")
UNAVAILABLE = ("wait", "masked")


@dataclass(frozen=True, eq=False)
class NavigationTasks:
    """
    All tasks of one building or several, as one union MDP.

    Made by :func:`navigation_tasks`.  A state is a task and a cell; the states
    of a task are consecutive.  Z = 2^F abstract states, F features.
    """

    mdp: MDP
    rho: np.ndarray  #: (S,) abstract state: bit f is 1 iff feature f holds
    available: np.ndarray  #: (S, A) bool: the action has a direction to go in
    labels: np.ndarray  #: (S, 4) index into LABELS of what is seen, or NO_LABEL
    task: np.ndarray  #: (S,) number of the task
    cell: np.ndarray  #: (S,) cell of its map
    maps: tuple[Map, ...]  #: one per building
    building: np.ndarray  #: (N,) index into maps, by task
    goal: np.ndarray  #: (N,) goal cell, by task
    actions: tuple[str, ...]  #: A names
    features: tuple[str, ...]  #: F names

    @property
    def n_abstract(self) -> int:
        """Number of abstract states that the features can tell apart, Z = 2^F."""
        return 1 << len(self.features)

    @property
    def possible(self) -> np.ndarray:
        """
        Actions that an abstract state does not rule out, shape (Z, A).

        Feature "see x" is 0 where action "go to x" is unavailable; where that
        feature is left out, the action counts as possible.
        """
        code = np.arange(self.n_abstract)
        possible = np.ones((self.n_abstract, len(self.actions)), bool)
        for bit, feature in enumerate(self.features):
            if feature in self.actions:
                possible[:, self.actions.index(feature)] = code >> bit & 1
        possible[~possible.any(axis=1)] = True  # sees nothing: is no state of a map
        return possible


def navigation_tasks(
    maps: Map | Sequence[Map],
    *,
    success: float = 0.9,
    reward: str = "cost",
    gamma: float = 0.99,
    actions: str = "relational",
    unavailable: str = "wait",
    near: int = 5,
    almost_near: int = 8,
    features: Sequence[str] = FEATURES,
    keep: Sequence[int] | None = None,
) -> NavigationTasks:
    """
    Return all goals of one map, or of several, as one union MDP.

    Parameters
    ----------
    maps : Map or sequence of Map
    success : float, default 0.9
        Probability that a move succeeds; else the robot stays where it is.
    reward : {"cost", "goal"}
        ``"cost"``: -1 on reaching any cell but the goal, 0 on the goal (the
        paper's rule).  ``"goal"``: 1 on reaching the goal, else 0.
    gamma : float, default 0.99
        Discount for solving and evaluating; learning has its own.
    actions : {"relational", "compass"}
        ``"relational"``: the 8 LABELS; a move goes in a direction drawn
        uniformly among those that carry the label.  ``"compass"``: N, E, S, W.
    unavailable : {"wait", "masked"}
        What an action does where nothing carries its label, or a wall stands:
        spend a step, or it may not be chosen.
    near, almost_near : int, default 5 and 8
        Largest Manhattan distance of near_goal and of almost_near_goal.
    features : sequence of str, default FEATURES
        The features that make the abstract state; the others are left out.
    keep : sequence of int, optional
        Tasks to keep, numbered over the goals of all maps; all by default.

    Raises
    ------
    ValueError
        Naming the argument, what it must be and what it was.

    See Also
    --------
    tasks_in_parts : the same tasks a few at a time, where a union would be too large.

    Examples
    --------
    >>> from abstransfer.maps import read_map
    >>> tasks = navigation_tasks(read_map("source"))
    >>> tasks.mdp.n_states, tasks.mdp.n_actions  # 11 tasks of 135 cells
    (1485, 8)
    """
    check_options(
        success=success, reward=reward, actions=actions, unavailable=unavailable
    )
    features = check_features(features)
    maps, building, goal = _select_tasks(maps, keep)

    sizes = [maps[b].n_cells for b in building]
    task = np.repeat(np.arange(len(goal)), sizes)
    cell = np.concatenate([np.arange(size) for size in sizes])
    seen = [look(maps[b], g) for b, g in zip(building, goal, strict=True)]
    neighbors, labels, distance, in_room = map(np.concatenate, zip(*seen, strict=True))
    rho = abstract_states(
        labels, distance, in_room, near=near, almost_near=almost_near, features=features
    )
    first_state = np.arange(len(cell)) - cell
    neighbors = np.where(neighbors < 0, -1, neighbors + first_state[:, None])
    terminal = cell == goal[task]

    ways = _ways(labels, actions)
    available = ways.any(axis=2)
    next_state, prob = _outcomes(neighbors, ways, success)
    mdp = MDP(
        next_state=next_state,
        prob=prob,
        reward=terminal - 1.0 if reward == "cost" else terminal * 1.0,
        terminal=terminal,
        gamma=gamma,
        allowed=available if unavailable == "masked" else None,
    )
    names = DIRECTIONS if actions == "compass" else LABELS
    return NavigationTasks(
        mdp, rho, available, labels, task, cell, maps, building, goal, names, features
    )


def tasks_in_parts(maps, *, states=10_000, **options) -> Iterator[NavigationTasks]:
    """
    Yield the tasks of one map or of several, a few at a time.

    Each part is a union of its own, of about `states` states and one task at least;
    what is not kept is forgotten, so a large building takes the memory of one part.
    The union of all is block-diagonal: values of the parts are values of the union.
    Options are those of :func:`navigation_tasks`.

    >>> from abstransfer.maps import read_map
    >>> [part.mdp.n_states for part in tasks_in_parts(read_map("target"))]
    [10260, 8640]
    """
    maps, building, _ = _select_tasks(maps, None)
    before = np.cumsum([0, *(maps[b].n_cells for b in building[:-1])])
    cuts = np.flatnonzero(np.diff(before // states)) + 1
    for keep in np.split(np.arange(len(building)), cuts):
        yield navigation_tasks(maps, keep=keep, **options)


def parts_of(tasks, name: str = "tasks") -> Iterator[NavigationTasks]:
    """Yield the parts of tasks, which may come in one; refuse what is no tasks."""
    part = None
    whole = isinstance(tasks, NavigationTasks) or not isinstance(tasks, Iterable)
    for part in (tasks,) if whole else tasks:
        if not isinstance(part, NavigationTasks):
            kind = type(part).__name__
            raise ValueError(f"{name} must be NavigationTasks, got {kind}")
        yield part
    if part is None:
        raise ValueError(f"{name} must be NavigationTasks, got no part of any")


def check_options(
    *,
    success: float = 0.9,
    reward: str = "cost",
    actions: str = "relational",
    unavailable: str = "wait",
) -> None:
    """
    Refuse an option of :func:`navigation_tasks` by name, before a task is made.

    >>> check_options(success=1.5)
    Traceback (most recent call last):
        ...
    ValueError: success must satisfy 0 < success <= 1, got 1.5
    """
    if not isinstance(success, Real) or not 0 < success <= 1:
        raise ValueError(f"success must satisfy 0 < success <= 1, got {success!r}")
    for name, value, known in (
        ("reward", reward, REWARDS),
        ("actions", actions, ACTIONS),
        ("unavailable", unavailable, UNAVAILABLE),
    ):
        if value not in known:
            raise ValueError(f"{name} must be one of {known}, got {value!r}")


def _select_tasks(maps, keep) -> tuple[tuple[Map, ...], np.ndarray, np.ndarray]:
    """Return the maps, and building (N,) and goal cell (N,) of the tasks to keep."""
    maps = tuple(maps) if isinstance(maps, Iterable) else (maps,)
    if not maps or not all(isinstance(map_, Map) for map_ in maps):
        raise ValueError(f"maps must be one Map or several, got {maps!r}")
    building = np.repeat(np.arange(len(maps)), [len(map_.goals) for map_ in maps])
    goal = np.concatenate([map_.goals for map_ in maps])
    if keep is None:
        return maps, building, goal
    keep = np.asarray(keep)
    if (
        keep.ndim != 1
        or not keep.size
        or keep.dtype.kind not in "iu"
        or not np.isin(keep, range(len(goal))).all()
    ):
        raise ValueError(f"keep must name tasks among 0..{len(goal) - 1}, got {keep}")
    return maps, building[keep], goal[keep]


def _ways(labels: np.ndarray, actions: str) -> np.ndarray:
    """Return the directions each action chooses from, shape (S, A, 4) bool."""
    if actions == "relational":
        return labels[:, None, :] == np.arange(len(LABELS))[:, None]
    return (labels != NO_LABEL)[:, None, :] & np.eye(len(DIRECTIONS), dtype=bool)


def _outcomes(neighbors, ways, success) -> tuple[np.ndarray, np.ndarray]:
    """Return next_state and prob, (S, A, 5): a move N, E, S, W, or staying."""
    state = np.arange(len(ways))[:, None, None]
    n_ways = ways.sum(axis=2, keepdims=True)
    prob = np.zeros((*ways.shape[:2], 5))
    prob[:, :, :4] = ways * success / np.maximum(n_ways, 1)
    prob[:, :, 4] = np.where(n_ways[:, :, 0] > 0, 1 - success, 1.0)
    next_state = np.where(ways, neighbors[:, None, :], state)
    return np.concatenate([next_state, state + 0 * n_ways], axis=2), prob
