"""Pictures of tasks: where a policy goes, and which cells look alike."""

from __future__ import annotations

import numpy as np

from ..abstraction import describe
from ..maps import CORRIDOR, Map
from ..navigation import NavigationTasks
from .buildings import paint_cells, place, plot_map, print_in
from .style import COLOR, count

TINTS = ("#DCE9F3", "#F7E3C0", "#D3EEE3", "#F3DCEA", "#F3F0C2", "#E4E4E4", "#FADCCB")
HATCH = "////"


def plot_policy(tasks: NavigationTasks, policy: np.ndarray, task: int = 0, ax=None):
    """
    Draw, in each cell of a task, where a policy moves the robot.

    From the middle of the cell, an arrow is as long as its direction is
    probable; a needle without a head stands for less than 0.4.  What is missing
    are failed moves and wasted steps.  Above 20 columns, ask for a wider figure.

    Parameters
    ----------
    tasks : NavigationTasks
    policy : ndarray of float, shape (S, A)
        Over the states of all tasks; an abstract policy is ``policy[tasks.rho]``.
    task : int, default 0
    """
    map_, goal, states = task_parts(tasks, task)
    moves = move_probabilities(tasks, policy, states)
    ax = plot_map(map_, ax, goal=goal)
    cell, direction = np.nonzero(
        (moves > 0.005) & (np.arange(len(moves)) != goal)[:, None]
    )
    row, column = np.divmod(cell, map_.shape[1])
    length = 0.52 * moves[cell, direction]
    step = np.array([[0, -1], [1, 0], [0, 1], [-1, 0]])[direction]  # (n, 2): x, y
    side = step[:, ::-1]
    start = np.stack([column, row], axis=1) + 0.5
    tip = start + length[:, None] * step
    barb = np.where(length > 0.2, 0.13, 0.0)[:, None]
    left, right = tip - barb * (step - 0.6 * side), tip - barb * (step + 0.6 * side)
    gap = np.full_like(tip, np.nan)
    path = np.stack([start, tip, left, tip, right, gap], axis=1).reshape(-1, 2)
    ax.plot(*path.T, color=COLOR["ink"], linewidth=1.0, zorder=6)
    return ax


def plot_features(
    tasks: NavigationTasks,
    task: int = 0,
    ax=None,
    *,
    feature: str | None = None,
    z: int | None = None,
):
    """
    Show which cells of a task look alike to the robot.

    Without `feature` and `z`, each abstract state is a number, the commonest
    is 1, and a tint.  With one of them, the cells where the feature holds, or
    that are in abstract state z, are lit and hatched.

    Parameters
    ----------
    tasks : NavigationTasks
    task : int, default 0
    feature : str, optional
        One of ``tasks.features``.
    z : int, optional
        An abstract state, 0..Z-1.
    """
    map_, goal, states = task_parts(tasks, task)
    ax = plot_map(map_, ax, goal=goal, fill=feature is not None or z is not None)
    if feature is not None or z is not None:
        lit = lit_cells(tasks, states, feature, z)
        paint_cells(ax, map_, lit, COLOR["lit"], HATCH)
        return ax
    rank = abstract_ranks(tasks, task)
    for i, tint in enumerate(TINTS):
        paint_cells(ax, map_, (rank >= 0) & (rank % len(TINTS) == i), tint)
    for cell in np.flatnonzero(rank >= 0):
        print_in(ax, map_, cell, str(rank[cell] + 1), COLOR["ink"])
    return ax


def describe_policy(tasks: NavigationTasks, policy: np.ndarray, task: int = 0) -> str:
    """
    Return the alt text of :func:`plot_policy`: how often a step helps.

    Nearer and farther are measured along the shortest walk through the doors.

    >>> from abstransfer.maps import parse_map
    >>> from abstransfer.navigation import navigation_tasks
    >>> tasks = navigation_tasks(parse_map("+---+\\n|.d*|\\n+---+"))
    >>> describe_policy(tasks, np.full((2, 8), 1 / 8))
    'Arrows of a policy, goal in row 1, column 2. Mean over 1 cell: a step leads
    farther away with probability 0.00, nowhere with 0.89, nearer to the goal with
    0.11. It can in every cell.'
    """
    map_, goal, states = task_parts(tasks, task)
    moves = np.delete(move_probabilities(tasks, policy, states), goal, axis=0)
    walk = walking_distance(map_, goal)
    gain = np.delete(walk[:, None] - walk[map_.neighbors], goal, axis=0)
    nearer = np.sum(moves * (gain > 0), axis=1).mean()
    farther = np.sum(moves * (gain < 0), axis=1).mean()
    lost = int(np.sum(np.sum(moves * (gain > 0), axis=1) < 0.005))
    cells = count(len(moves), "cell")
    never = (
        f"In {count(lost, 'cell')} it never does." if lost else "It can in every cell."
    )
    return (
        f"Arrows of a policy, {place(map_, goal, 'goal in')}. Mean over {cells}: a "
        f"step leads farther away with probability {farther:.2f}, nowhere with "
        f"{abs(1 - nearer - farther):.2f}, nearer to the goal with {nearer:.2f}. "
        f"{never}"
    )


def describe_features(
    tasks: NavigationTasks,
    task: int = 0,
    *,
    feature: str | None = None,
    z: int | None = None,
) -> str:
    """
    Return the alt text of :func:`plot_features`: how many cells look alike.

    >>> from abstransfer.maps import read_map
    >>> from abstransfer.navigation import navigation_tasks
    >>> describe_features(navigation_tasks(read_map("source")), feature="in_room")
    'Task with the goal in row 2, column 2: in_room holds in 99 of 135 cells, 0 of them
    in the corridor.'
    """
    map_, goal, states = task_parts(tasks, task)
    where = place(map_, goal, "goal in")
    if feature is not None or z is not None:
        lit = lit_cells(tasks, states, feature, z)
        what = feature or f"abstract state {describe(z, tasks.features)}"
        corridor = int((lit & (map_.cells == CORRIDOR)).sum())
        return (
            f"Task with the {where}: {what} holds in {lit.sum()} of "
            f"{count(len(lit), 'cell')}, {corridor} of them in the corridor."
        )
    sizes = np.bincount(abstract_ranks(tasks, task) + 1)[1:]
    return (
        f"Task with the {where}: to the robot the {count(sizes.sum(), 'other cell')} "
        f"look like {count(len(sizes), 'abstract state')}. The commonest takes "
        f"{count(sizes.max(), 'cell')}, {np.sum(sizes == 1)} are seen in one cell only."
    )


def walking_distance(map_: Map, goal: int) -> np.ndarray:
    """Return the steps from each cell to the goal, shape (C,)."""
    from scipy.sparse import coo_array  # slow to load
    from scipy.sparse.csgraph import dijkstra

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
