"""
Pictures with alt text: functions that take data and ``ax`` and return ``ax``.

Each ``plot_x`` has a ``describe_x`` that makes the alt text from the same
data.  :func:`figure` brings the two together for a notebook::

    figure(plot_map, read_map("source"))

Nothing here learns, solves or shows; matplotlib is imported by nothing else.
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature

from ._alt import describe_ladder, describe_map
from ._charts import plot_ladder
from ._figure import Picture, draw_picture
from ._plot_map import plot_features, plot_map, plot_policy, plot_values
from ._style import PALETTE, WIDTH, ArmStyle, arm_style

__all__ = [
    "PALETTE",
    "ArmStyle",
    "Picture",
    "arm_style",
    "describe_ladder",
    "describe_map",
    "figure",
    "plot_features",
    "plot_ladder",
    "plot_map",
    "plot_policy",
    "plot_values",
]

DESCRIBE = {plot_map: describe_map, plot_ladder: describe_ladder}
HEIGHT = {plot_ladder: 4.2, plot_map: WIDTH, plot_values: WIDTH, plot_policy: WIDTH}


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
    A building of 1 by 2 cells: 1 room with 1 goal, 1 door, and a corridor of 1 cell.
    """
    if alt is None:
        if plot not in DESCRIBE:
            raise ValueError(f"alt must be given for {plot.__name__}, got None")
        describe = DESCRIBE[plot]
        known = signature(describe).parameters
        alt = describe(*data, **{k: v for k, v in options.items() if k in known})
    size = size or (WIDTH, HEIGHT.get(plot, 3.4))
    return draw_picture(
        lambda ax: plot(*data, ax=ax, **options), alt, size=size, panels=panels
    )
