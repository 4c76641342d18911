"""
Pictures of buildings, with the alt texts that go with them.

Cell (row, column) covers the unit square whose top left corner is
(column, row); the vertical axis points down.
"""

from __future__ import annotations

import numpy as np

from ..maps import CORRIDOR, DOOR, WALLS, Map
from .style import COLOR, SMALL, WIDTH, count, new_axes, number

N_SHADES = 40
BLACK_ON = 19  # the first shade on which black reads better than white
DOOR_SIDE = 0.18  # of a cell's side, wall on either side of a door


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
    draw_edges(ax, map_, thick=2.0 if width <= 20 else 1.4)
    row, column = np.divmod(map_.goals if goal is None else np.array([goal]), width)
    size = (11 if width <= 20 else 8) * (1 if goal is None else 1.4)
    star = {"marker": "*", "color": COLOR["goal"], "markersize": size}
    rim = {"markeredgecolor": COLOR["ground"], "markeredgewidth": 0.5}
    ax.plot(column + 0.5, row + 0.5, linestyle="none", zorder=5, **star, **rim)
    ax.set(xlim=(-0.1, width + 0.1), ylim=(height + 0.1, -0.1), aspect="equal")
    ax.set_axis_off()
    return ax


def pixels(map_: Map, goal: int, robot: int) -> np.ndarray:
    """
    Return a picture of a building, one of its goals, and a robot in a cell.

    Parameters
    ----------
    map_ : Map
    goal, robot : int
        Cells.

    Returns
    -------
    (height, width, 3) ndarray of uint8

    Examples
    --------
    >>> from abstransfer.maps import parse_map
    >>> pixels(parse_map("+---+\\n|.d*|\\n+---+"), goal=1, robot=0).shape[2]
    3
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    height, width = map_.shape
    figure = Figure((WIDTH, WIDTH * height / width), facecolor=COLOR["ground"])
    canvas = FigureCanvasAgg(figure)
    ax = plot_map(map_, figure.add_axes((0, 0, 1, 1)), goal=goal)
    row, column = divmod(robot, width)
    ax.plot(column + 0.5, row + 0.5, "o", color=COLOR["ink"], zorder=6)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


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
    shades = _shades(*(limits or (np.nanmin(v), np.nanmax(v))))
    level = np.where(np.isnan(v), -1, shades.norm(v) * N_SHADES // 1)
    level = np.minimum(level, N_SHADES - 1)
    for shade in np.unique(level[level >= 0]):
        paint_cells(ax, map_, level == shade, shades.cmap(int(shade)), linewidth=0.4)
    if not numbers:
        bar = ax.figure.colorbar(shades, cax=ax.inset_axes([1.02, 0.05, 0.03, 0.9]))
        bar.outline.set_visible(False)
        whole = shades.norm.vmax - shades.norm.vmin > 5
        digits = 0 if whole else 2
        bar.ax.locator_params(axis="y", nbins=5, integer=whole)
        bar.ax.yaxis.set_major_formatter(lambda x, _: number(x, digits))
        return ax
    ax.lines[-1].remove()  # a star would hide the number of its cell
    for cell in np.flatnonzero(np.isfinite(v)):
        color = "black" if level[cell] >= BLACK_ON else "white"
        print_in(ax, map_, cell, number(v[cell], 0), color)
    return ax


def _shades(low: float, high: float):
    """Return the scale from values to one of N_SHADES colours."""
    import matplotlib
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    scale = Normalize(low, max(high, low + 1e-9), clip=True)
    return ScalarMappable(scale, matplotlib.colormaps["cividis"].resampled(N_SHADES))


def describe_map(map_: Map, *, goal: int | None = None) -> str:
    """
    Return the alt text of :func:`plot_map`: what is in the building.

    >>> from abstransfer.maps import read_map
    >>> describe_map(read_map("source"))
    'Building of 9 by 15 cells: 11 rooms, 11 goals, 11 doors, a corridor of 36 cells.'
    """
    height, width = map_.shape
    corridor = int((map_.cells == CORRIDOR).sum())
    inside = f"a corridor of {count(corridor, 'cell')}" if corridor else "no corridor"
    task = f", {place(map_, goal, 'goal in')}" if goal is not None else ""
    return (
        f"Building of {height} by {width} cells{task}: {count(map_.n_rooms, 'room')}, "
        f"{count(len(map_.goals), 'goal')}, {count(map_.n_doors, 'door')}, {inside}."
    )


def describe_values(map_: Map, v: np.ndarray, *, goal: int | None = None) -> str:
    """
    Return the alt text of :func:`plot_values`: the range, and where its ends are.

    >>> from abstransfer.maps import parse_map
    >>> building = parse_map("+---+\\n|.d*|\\n+---+")
    >>> describe_values(building, np.array([-1.1, 0.0]))
    'Building of 1 by 2 cells: values rise from −1.100 in row 1, column 1 to 0.000 in
    row 1, column 2; half of them lie below −0.550.'
    """
    v = cell_array(v, map_, "v")
    height, width = map_.shape
    low, high = np.nanargmin(v), np.nanargmax(v)
    digits = 1 if v[high] - v[low] > 5 else 3
    task = f", {place(map_, goal, 'goal in')}" if goal is not None else ""
    n_blank = int(np.isnan(v).sum())
    blank = f" {count(n_blank, 'cell')} without a value." if n_blank else ""
    if v[low] == v[high]:
        found = f"all values are {number(v[low], digits)}."
    else:
        found = (
            f"values rise from {number(v[low], digits)} {place(map_, low, 'in')} to "
            f"{number(v[high], digits)} {place(map_, high, 'in')}; half of them lie "
            f"below {number(np.nanmedian(v), digits)}."
        )
    return f"Building of {height} by {width} cells{task}: {found}{blank}"


def place(map_: Map, cell: int, what: str) -> str:
    """Return where a cell is, rows and columns counted from 1."""
    row, column = divmod(int(cell), map_.shape[1])
    return f"{what} row {row + 1}, column {column + 1}"


def cell_array(x, map_: Map, name: str) -> np.ndarray:
    """Return x as floats (C,), at least one of them finite, or refuse it."""
    x = np.asarray(x, dtype=float)
    if x.shape != (map_.n_cells,) or not np.isfinite(x).any():
        raise ValueError(
            f"{name} must hold numbers in shape ({map_.n_cells},), got shape {x.shape}"
        )
    return x


def strips(map_: Map, chosen: np.ndarray) -> tuple[np.ndarray, ...]:
    """
    Return row, first column and end of the runs of chosen cells, each (n,).

    >>> from abstransfer.maps import parse_map
    >>> strips(parse_map("+---+\\n|.d*|\\n+---+"), np.array([False, True]))
    (array([0]), array([1]), array([2]))
    """
    grid = np.pad(chosen.reshape(map_.shape), ((0, 0), (1, 1))).astype(int)
    row, start = np.nonzero(np.diff(grid, axis=1) == 1)
    return row, start, np.nonzero(np.diff(grid, axis=1) == -1)[1]


def edge_lines(map_: Map, kind: str) -> np.ndarray:
    """
    Return where walls, or doors, run: the (x, y) of two ends each, (n, 2, 2).

    Walls go on behind doors; a door leaves a piece of wall at either side.
    """
    ends = [
        line if flat else line[:, ::-1]
        for flat, chars in (
            (True, map_.chars[::2, 1::2]),
            (False, map_.chars[1::2, ::2].T),
        )
        for line in _segments(chars, kind)
    ]
    return np.array(ends).reshape(-1, 2, 2)


def paint_cells(
    ax,
    map_: Map,
    chosen: np.ndarray,
    color,
    hatch: str | None = None,
    linewidth: float = 0,
):
    """Fill the chosen cells, (C,) bool, runs of a row in one piece."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    row, start, end = strips(map_, chosen)
    if not len(row):
        return
    corners = np.array(
        [[start, row], [end, row], [end, row + 1], [start, row + 1], [start, row]]
    )
    codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    path = Path(corners.transpose(2, 0, 1).reshape(-1, 2), codes * len(row))
    ax.add_patch(
        PathPatch(path, facecolor=color, edgecolor=color, linewidth=linewidth, zorder=0)
    )
    if hatch:
        lines = {"facecolor": "none", "edgecolor": COLOR["faint"], "hatch": hatch}
        ax.add_patch(PathPatch(path, linewidth=0, zorder=0, **lines))


def draw_edges(ax, map_: Map, thick: float):
    """Draw walls as lines, and doors as hollow bars in a gap of the wall."""
    walls, doors = (_polyline(edge_lines(map_, kind)) for kind in ("wall", "door"))
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


def print_in(ax, map_: Map, cell: int, text: str, color: str):
    """Print a short text in the middle of a cell."""
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
