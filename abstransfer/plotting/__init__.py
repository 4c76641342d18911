"""
Pictures with alt text: functions that take data and ``ax`` and return ``ax``.

Each ``plot_x`` has a ``describe_x`` that makes the alt text from the same
data.  :func:`figure` brings the two together for a notebook::

    figure(plot_map, read_map("source"))

Nothing here learns, solves or shows.  Only this room imports matplotlib, and only
where something is drawn.
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature

from .buildings import describe_map, describe_values, pixels, plot_map, plot_values
from .ladder import describe_ladder, plot_ladder
from .picture import Picture, draw_picture
from .pool import describe_pool, plot_pool
from .runs import (
    describe_boxes,
    describe_curves,
    describe_tau,
    plot_boxes,
    plot_curves,
    plot_tau,
)
from .style import PALETTE, WIDTH, ArmStyle, arm_style
from .tasks import (
    describe_features,
    describe_policy,
    plot_features,
    plot_policy,
)

__all__ = [
    "PALETTE",
    "ArmStyle",
    "Picture",
    "arm_style",
    "describe_boxes",
    "describe_curves",
    "describe_features",
    "describe_ladder",
    "describe_map",
    "describe_policy",
    "describe_pool",
    "describe_tau",
    "describe_values",
    "figure",
    "pixels",
    "plot_boxes",
    "plot_curves",
    "plot_features",
    "plot_ladder",
    "plot_map",
    "plot_policy",
    "plot_pool",
    "plot_tau",
    "plot_values",
]

DESCRIBE = {
    plot_boxes: describe_boxes,
    plot_curves: describe_curves,
    plot_features: describe_features,
    plot_ladder: describe_ladder,
    plot_map: describe_map,
    plot_policy: describe_policy,
    plot_pool: describe_pool,
    plot_tau: describe_tau,
    plot_values: describe_values,
}
OF_BUILDINGS = (plot_features, plot_map, plot_policy, plot_values)


def figure(
    plot: Callable,
    *data,
    alt: str | None = None,
    size: tuple[float, float] | None = None,
    panels: tuple[int, int] = (1, 1),
    **options,
) -> Picture:
    """
    Return the picture of ``plot(*data, ax=ax, **options)``, with its alt text.

    Parameters
    ----------
    plot : callable
        A ``plot_x`` of this module, or any function that draws on ``ax``.
    *data, **options
        What `plot` takes besides ``ax``.
    alt : str, optional
        By default what ``describe_x`` makes of the same data.
    size : (width, height) in inches, optional
        White margins are cut off.
    panels : (rows, columns), default (1, 1)
        With more than one, ``ax`` is an array of axes of this shape.

    Raises
    ------
    ValueError
        If there is no alt text, or it has not 40 to 300 characters.

    Examples
    --------
    >>> from abstransfer.maps import parse_map
    >>> figure(plot_map, parse_map("+---+\\n|.d*|\\n+---+"))
    Building of 1 by 2 cells: 1 room, 1 goal, 1 door, a corridor of 1 cell.
    """
    if alt is None:
        if plot not in DESCRIBE:
            raise ValueError(f"alt must be given for {plot.__name__}, got None")
        describe = DESCRIBE[plot]
        known = signature(describe).parameters
        alt = describe(*data, **{k: v for k, v in options.items() if k in known})
    size = size or (WIDTH, WIDTH if plot in OF_BUILDINGS else 4.2)
    return draw_picture(
        lambda ax: plot(*data, ax=ax, **options), alt, size=size, panels=panels
    )
