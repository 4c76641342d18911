"""What figures show of the cells of one task, as arrays."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from ..maps import Map
from ..navigation import NavigationTasks


def walking_distance(map_: Map, goal: int) -> np.ndarray:
    """Return the steps from each cell to the goal, shape (C,)."""
    cell, direction = np.nonzero(map_.neighbors >= 0)
    links = (np.ones(len(cell)), (cell, map_.neighbors[cell, direction]))
    graph = coo_array(links, shape=(map_.n_cells, map_.n_cells)).tocsr()
    return dijkstra(graph, indices=goal, unweighted=True)


def task_parts(tasks: NavigationTasks, task: int) -> tuple[Map, int, np.ndarray]:
    """Return the map of a task, its goal cell and its states (C,)."""
    if not 0 <= task < len(tasks.goal):
        raise ValueError(f"task must lie in 0..{len(tasks.goal) - 1}, got {task}")
    map_ = tasks.maps[tasks.building[task]]
    return map_, int(tasks.goal[task]), np.flatnonzero(tasks.task == task)


def move_probabilities(tasks, policy, states) -> np.ndarray:
    """Return the probability of moving N, E, S, W, shape (C, 4)."""
    policy = np.asarray(policy, dtype=float)
    if policy.shape != tasks.available.shape:
        raise ValueError(
            f"policy must have shape {tasks.available.shape}, got {policy.shape}"
        )
    moves = np.einsum("sa,sak->sk", policy[states], tasks.mdp.prob[states])
    return moves[:, :4]


def abstract_ranks(tasks: NavigationTasks, task: int) -> np.ndarray:
    """Return 0 for cells of the commonest abstract state, ..., -1 at the goal."""
    _, goal, states = task_parts(tasks, task)
    seen, index, count = np.unique(
        np.delete(tasks.rho[states], goal), return_inverse=True, return_counts=True
    )
    rank = np.empty(len(seen), dtype=int)
    rank[np.argsort(-count, kind="stable")] = np.arange(len(seen))
    return np.insert(rank[index], goal, -1)


def lit_cells(tasks: NavigationTasks, states, feature, z) -> np.ndarray:
    """Return in which cells a feature holds, or abstract state z is, (C,) bool."""
    if feature is not None and z is not None:
        raise ValueError("give feature or z, not both")
    if feature is None:
        return tasks.rho[states] == z
    if feature not in tasks.features:
        raise ValueError(f"feature must be one of {tasks.features}, got {feature!r}")
    return (tasks.rho[states] >> tasks.features.index(feature) & 1).astype(bool)
