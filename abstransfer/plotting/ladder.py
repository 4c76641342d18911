"""Table 1 as a ladder, with its alt text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..driving import PAPER, ROWS
from .style import SMALL, WIDTH, arm_style, label_gap, new_axes, number, spread

BUILDINGS = {"source": "source building", "target": "target building"}


def plot_ladder(result: Mapping, ax=None, *, paper: Mapping | None = PAPER, rows=ROWS):
    """
    Draw Table 1 as a ladder: the higher the rung, the better the policy drives.

    Parameters
    ----------
    result : dict
        From :func:`~abstransfer.driving.table1`: ``source`` and perhaps
        ``target``, each a dict from policy to mean value.
    ax : matplotlib Axes, optional
    paper : dict, optional
        Numbers to show as hollow marks, by default those of the paper; None
        for maps that are not the paper's.
    rows : sequence of str
        The policies to show.

    Returns
    -------
    ax : matplotlib Axes
    """
    columns = ladder_columns(result, rows)
    ours = np.array([[columns[c][row] for row in rows] for c in columns])
    papers = [(paper or {}).get(name, {}) for name in columns]
    theirs = np.array([[column.get(row, np.nan) for row in rows] for column in papers])
    ax = new_axes(ax, (WIDTH, 4.2))
    low, high = np.nanmin([ours, theirs]), np.nanmax([ours, theirs])
    pad = 0.08 * max(high - low, 1.0)
    ax.set(ylim=(low - pad, high + 2.2 * pad), xlim=(-0.8, len(columns) - 0.2))
    x = np.arange(len(columns))[:, None]
    outward = np.where((x == 0) & (len(columns) > 1), -1, 1)
    for name, column in zip(columns, x[:, 0], strict=True):
        ax.plot([column] * 2, [low - pad, high + pad], color="#D0D0D0", zorder=0)
        ax.text(column, high + 1.3 * pad, BUILDINGS[name], ha="center", va="bottom")
    gap = label_gap(ax)
    at = x + outward * _aside(ours, gap)
    inside = x - outward * (0.13 + _aside(theirs, gap))
    for i, row in enumerate(rows):
        style = arm_style(row)
        mark = {"marker": style.marker, "color": style.color, "markersize": 9}
        ax.plot(at[:, i], ours[:, i], linewidth=1, **mark, zorder=2)
        mark |= {"markerfacecolor": "none", "markeredgewidth": 1.4, "linestyle": "none"}
        ax.plot(inside[:, i], theirs[:, i], **mark, zorder=3)
    for column, side in enumerate(outward[:, 0]):
        places = spread(ours[column], gap)
        for i, row in enumerate(rows):
            rung = at[column, i], ours[column, i]
            _rung_label(ax, rung, (column + 0.2 * side, places[i]), row)
    ax.set(xticks=[], yticks=[])
    ax.spines[["left", "bottom"]].set_visible(False)
    marks = "; filled marks: here, hollow marks: the paper" if paper else ""
    ax.set_xlabel(f"mean value{marks}")
    return ax


def describe_ladder(
    result: Mapping, *, paper: Mapping | None = PAPER, rows: Sequence[str] = ROWS
) -> str:
    """
    Return the alt text of :func:`plot_ladder`: the rungs from the top, the order.

    >>> describe_ladder({"source": {"rand": -88.7, "nd": -44.1, "optimal": -14.0}},
    ...                 rows=("rand", "nd", "optimal"))
    "Mean value by policy, best first. Source: optimal −14.0, ND −44.1, wanderer −88.7.
    The order is the paper's."
    """
    columns = ladder_columns(result, rows)
    text, same = "Mean value by policy, best first.", []
    for name, column in columns.items():
        order = sorted(rows, key=lambda row: -column[row])
        rungs = [f"{arm_style(row).name} {number(column[row])}" for row in order]
        text += f" {name.capitalize()}: {', '.join(rungs)}."
        theirs = (paper or {}).get(name, {})
        known = [row for row in order if row in theirs]
        if len(known) > 1:
            same.append(known == sorted(known, key=theirs.get, reverse=True))
    if same:
        text += f" The order {'is' if all(same) else 'is not'} the paper's."
    return text


def ladder_columns(result: Mapping, rows) -> dict[str, dict[str, float]]:
    """Return the columns of a result of table1 that are there, checked."""
    columns = {c: result[c] for c in BUILDINGS if c in result}
    if not columns:
        raise ValueError(f"result must hold source or target, got {sorted(result)}")
    for name, column in columns.items():
        for row in rows:
            if not np.isfinite(column.get(row, np.nan)):
                raise ValueError(f"result[{name!r}] must hold a number for {row!r}")
    return columns


def _aside(y: np.ndarray, gap: float) -> np.ndarray:
    """Return how far marks, by column and row, step aside to show those behind."""
    aside = np.zeros(y.shape)
    for column, order in enumerate(np.argsort(y, axis=1)):
        for below, mark in zip(order, order[1:], strict=False):
            close = y[column, mark] - y[column, below] < 0.8 * gap
            aside[column, mark] = 0.08 if close and not aside[column, below] else 0
    return aside


def _rung_label(ax, rung: tuple, place: tuple, row: str):
    """Print name and value of a rung (x, y) at a place; a thin line joins them."""
    style = arm_style(row)
    left = place[0] < rung[0]
    words = [number(rung[1]), style.name]
    ax.annotate(
        "  ".join(words[::-1] if left else words),
        rung,
        place,
        color=style.color,
        fontsize=SMALL,
        ha="right" if left else "left",
        va="center",
        arrowprops={
            "arrowstyle": "-",
            "color": style.color,
            "linewidth": 0.6,
            "shrinkA": 1,
            "shrinkB": 5,
        },
    )
