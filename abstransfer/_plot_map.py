"""
Pictures of buildings: rooms and doors, values, arrows, abstract states.

Cell (row, column) covers the unit square whose top left corner is
(column, row); the vertical axis points down.
"""

from __future__ import annotations

import numpy as np

from ._style import COLOR, SMALL, WIDTH, new_axes, number
from .maps import CORRIDOR, DOOR, WALLS, Map
from .navigation import NavigationTasks

DOOR_SIDE = 0.18  # of a cell's side, wall on either side of a door
TINTS = ("#DCE9F3", "#F7E3C0", "#D3EEE3", "#F3DCEA", "#F3F0C2", "#E4E4E4", "#FADCCB")
HATCH = "////"


def plot_map(map_: Map, ax=None, *, goal: int | None = None, fill: bool = True):
    """
    Draw a building: walls, doors, rooms (tinted), corridor (white), goals (stars).

    Parameters
    ----------
    map_ : Map
    ax : matplotlib Axes, optional
    goal : int, optional
        Cell of the one goal to show; all goals of the map by default.
    fill : bool, default True
        Whether rooms are tinted.

    Returns
    -------
    ax : matplotlib Axes
    """
    height, width = map_.shape
    if goal is not None and goal not in map_.goals:
        raise ValueError(f"goal must be a goal cell of the map, got {goal}")
    ax = new_axes(ax, (WIDTH, WIDTH * height / width))
    if fill:
        paint_cells(ax, map_, map_.cells != CORRIDOR, COLOR["room"])
    _draw_edges(ax, map_, thick=2.0 if width <= 20 else 1.4)
    row, column = np.divmod(map_.goals if goal is None else np.array([goal]), width)
    size = (11 if width <= 20 else 8) * (1 if goal is None else 1.4)
    star = {"marker": "*", "color": COLOR["goal"], "markersize": size}
    rim = {"markeredgecolor": COLOR["ground"], "markeredgewidth": 0.5}
    ax.plot(column + 0.5, row + 0.5, linestyle="none", zorder=5, **star, **rim)
    ax.set(xlim=(-0.1, width + 0.1), ylim=(height + 0.1, -0.1), aspect="equal")
    ax.set_axis_off()
    return ax


def plot_values(
    map_: Map,
    v: np.ndarray,
    ax=None,
    *,
    goal: int | None = None,
    numbers: bool = False,
    limits: tuple[float, float] | None = None,
):
    """
    Colour each cell by its value: the brighter, the higher.

    Parameters
    ----------
    map_ : Map
    v : ndarray of float, shape (C,)
        Values of the cells of one task; cells that are nan stay white.
    goal : int, optional
        As for :func:`plot_map`.
    numbers : bool, default False
        Whether to print the values, rounded; they fit up to 20 columns.
    limits : (low, high), optional
        Values of the darkest and the brightest colour; those of v by default.
    """
    v = cell_array(v, map_, "v")
    ax = plot_map(map_, ax, goal=goal, fill=False)
    height, width = map_.shape
    low, high = limits or (np.nanmin(v), np.nanmax(v))
    mesh = ax.pcolormesh(
        np.arange(width + 1),
        np.arange(height + 1),
        np.ma.masked_invalid(v.reshape(height, width)),
        cmap="cividis",
        vmin=low,
        vmax=max(high, low + 1e-9),
        edgecolors="face",
        linewidth=0.4,
        zorder=1,
    )
    if not numbers:
        bar = ax.figure.colorbar(mesh, ax=ax, shrink=0.7, pad=0.02, aspect=14)
        bar.outline.set_visible(False)
        digits = 0 if high - low > 5 else 2
        bar.ax.yaxis.set_major_formatter(lambda x, _: number(x, digits))
        return ax
    ax.lines[-1].remove()  # a star would hide the number of its cell
    for cell in np.flatnonzero(np.isfinite(v)):
        color = "black" if mesh.norm(v[cell]) > 0.45 else "white"
        _print_in(ax, map_, cell, number(v[cell], 0), color)
    return ax


def plot_policy(tasks: NavigationTasks, policy: np.ndarray, task: int = 0, ax=None):
    """
    Draw, in each cell of a task, where a policy moves the robot.

    An arrow is as long as its direction is probable; half a cell's side is
    certain.  What is missing are bumps, failed moves and wasted steps.

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
    length = 0.48 * moves[cell, direction]
    step = np.array([[0, -1], [1, 0], [0, 1], [-1, 0]])[direction]  # (n, 2): x, y
    side = step[:, ::-1]
    start = np.stack([column, row], axis=1) + 0.5
    tip = start + length[:, None] * step
    barb = np.where(length > 0.1, np.minimum(0.13, 0.5 * length), 0.0)[:, None]
    left, right = tip - barb * (step - 0.6 * side), tip - barb * (step + 0.6 * side)
    gap = np.full_like(tip, np.nan)
    path = np.stack([start, tip, gap, left, tip, right, gap], axis=1).reshape(-1, 2)
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
        _print_in(ax, map_, cell, str(rank[cell] + 1), COLOR["ink"])
    return ax


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


def cell_array(x, map_: Map, name: str) -> np.ndarray:
    """Return x as floats (C,), at least one of them finite, or refuse it."""
    x = np.asarray(x, dtype=float)
    if x.shape != (map_.n_cells,) or not np.isfinite(x).any():
        raise ValueError(
            f"{name} must hold numbers in shape ({map_.n_cells},), got shape {x.shape}"
        )
    return x


def paint_cells(
    ax, map_: Map, chosen: np.ndarray, color: str, hatch: str | None = None
):
    """Fill the chosen cells, (C,) bool, runs of a row in one piece."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    grid = np.pad(chosen.reshape(map_.shape), ((0, 0), (1, 1))).astype(int)
    row, start = np.nonzero(np.diff(grid, axis=1) == 1)
    end = np.nonzero(np.diff(grid, axis=1) == -1)[1]
    if not len(row):
        return
    corners = np.array(
        [[start, row], [end, row], [end, row + 1], [start, row + 1], [start, row]]
    )
    codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    path = Path(corners.transpose(2, 0, 1).reshape(-1, 2), codes * len(row))
    flat = {"linewidth": 0, "zorder": 0}
    ax.add_patch(PathPatch(path, facecolor=color, **flat))
    if hatch:
        lines = {"facecolor": "none", "edgecolor": COLOR["faint"], "hatch": hatch}
        ax.add_patch(PathPatch(path, **lines, **flat))


def _draw_edges(ax, map_: Map, thick: float):
    """Draw walls as lines, and doors as hollow bars in a gap of the wall."""
    lines = []  # of walls, of doors: each (n, 2, 2), and which of them to draw how
    for kind in ("wall", "door"):
        segments = [
            ends if horizontal else ends[:, ::-1]
            for horizontal, chars in (
                (1, map_.chars[::2, 1::2]),
                (0, map_.chars[1::2, ::2].T),
            )
            for ends in _segments(chars, kind)
        ]
        lines.append(_polyline(np.array(segments).reshape(-1, 2, 2)))
    walls, doors = lines
    ax.plot(
        *walls,
        color=COLOR["ink"],
        linewidth=thick,
        solid_capstyle="projecting",
        zorder=3,
    )
    for color, width in (("door", 2.4 * thick), ("ground", 1.2 * thick)):
        ax.plot(
            *doors, color=COLOR[color], linewidth=width, solid_capstyle="butt", zorder=4
        )


def _segments(chars: np.ndarray, kind: str):
    """Yield the (x, y) ends, (2, 2), of each wall or door along rows of edges."""
    for y, line in enumerate(chars):
        if kind == "door":
            for x in np.flatnonzero(line == DOOR):
                yield np.array([[x + DOOR_SIDE, y], [x + 1 - DOOR_SIDE, y]])
        else:
            solid = np.pad(np.isin(line, (*WALLS, DOOR)), 1).astype(int)
            change = np.flatnonzero(np.diff(solid))
            for start, end in change.reshape(-1, 2):
                yield np.array([[start, y], [end, y]], dtype=float)


def _polyline(segments: np.ndarray):
    """Return x and y of segments (n, 2, 2) as one line with gaps."""
    gap = np.full((len(segments), 1, 2), np.nan)
    return np.concatenate([segments, gap], axis=1).reshape(-1, 2).T


def _print_in(ax, map_: Map, cell: int, text: str, color: str):
    row, column = divmod(int(cell), map_.shape[1])
    ax.text(
        column + 0.5,
        row + 0.52,
        text,
        color=color,
        fontsize=SMALL - 1,
        ha="center",
        va="center",
        zorder=7,
    )
