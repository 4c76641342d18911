"""What a class found, building by building, with its alt text."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .style import PALETTE, SMALL, WIDTH, new_axes


def plot_pool(gains: Sequence[float], interval, ax=None, *, robot="", over=""):
    """
    Draw the gain in each building, in order, and the interval of their mean.

    Parameters
    ----------
    gains : sequence of float
        Of each building, as a share: 0.1 is 10 % more goals.
    interval : Interval
        Of their mean; no band is drawn where its ends are nan.
    ax : matplotlib Axes, optional
    robot, over : str
        Who is compared with whom.

    Returns
    -------
    ax : matplotlib Axes
    """
    ax = new_axes(ax, (WIDTH, 3.2))
    percent = 100 * np.sort(np.asarray(gains, float))
    ax.plot(np.arange(1, 1 + len(percent)), percent, "o", color="#0072B2")
    ax.axhline(0, color="black", linewidth=0.8)
    ax.axhline(100 * interval.estimate, color="#D55E00")
    if np.isfinite(interval.low):
        ax.axhspan(100 * interval.low, 100 * interval.high, color="#D55E00", alpha=0.2)
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.35 * (high - low))  # room for the words
    place = {"xy": (0.02, 0.98), "xycoords": "axes fraction", "va": "top"}
    ax.annotate(_found(percent / 100, interval), size=SMALL, **place)
    ax.xaxis.get_major_locator().set_params(integer=True)
    ax.set_xlabel("buildings, one a student, in order of the gain")
    ax.set_ylabel(f"goals of {_name(robot)} over {_name(over)}, in %")
    return ax


def _name(robot: str) -> str:
    """Return the name of a robot of the cards as the book writes it."""
    if robot == "none":
        return "no advice"
    return PALETTE["arms"].get(robot, {"name": robot})["name"]


def _found(gains: Sequence[float], interval) -> str:
    """Return in words what the points, the line and the band say."""
    mean, low, high = (100 * end for end in interval)
    band = "too few buildings for an interval"
    if np.isfinite(low):
        band = f"band: its 95 % interval, {low:+.1f} to {high:+.1f} %"
    above = f"points: {sum(g > 0 for g in gains)} of {len(gains)} above 0"
    return f"line: mean {mean:+.1f} %\n{band}\n{above}"


def describe_pool(gains: Sequence[float], interval, *, robot="", over="") -> str:
    """
    Return alt text for :func:`plot_pool`.

    >>> from ..experiments.stats import Interval
    >>> text = describe_pool([0.1, 0.3], Interval(0.2, 0.1, 0.3), robot="nd")
    >>> text.partition(": ")[2]
    'mean +20.0 %, 95 % interval from +10.0 to +30.0 %; above 0 in 2 of them.'
    """
    mean, low, high = (100 * end for end in interval)
    between = f", 95 % interval from {low:+.1f} to {high:+.1f} %"
    return (
        f"Goals of {robot} over {over} in {len(gains)} buildings: mean {mean:+.1f} %"
        f"{between if np.isfinite(low) else ', too few for an interval'}; "
        f"above 0 in {sum(g > 0 for g in gains)} of them."
    )
