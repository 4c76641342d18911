"""Table 1 as a ladder, with its alt text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ._style import SMALL, WIDTH, arm_style, label_gap, new_axes, number, spread
from .table1 import PAPER, ROWS

BUILDINGS = {"source": "source building", "target": "target building"}


def plot_ladder(result: Mapping, ax=None, *, paper: Mapping | None = PAPER, rows=ROWS):
    """
    Draw Table 1 as a ladder: the higher the rung, the better the policy drives.

    Parameters
    ----------
    result : dict
        From :func:`~abstransfer.table1.table1`: ``source`` and perhaps
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
    ax = new_axes(ax, (WIDTH, 4.2))
    ours = np.array([[columns[c][row] for row in rows] for c in columns])
    theirs = [
        [(paper or {}).get(c, {}).get(row, np.nan) for row in rows] for c in columns
    ]
    low, high = np.nanmin([ours, theirs]), np.nanmax([ours, theirs])
    pad = 0.08 * max(high - low, 1.0)
    ax.set_ylim(low - pad, high + 2.2 * pad)
    gap = label_gap(ax)
    for x, column in enumerate(columns):
        ax.plot([x, x], [low - pad, high + pad], color="#D0D0D0", linewidth=1, zorder=0)
        ax.text(x, high + 1.3 * pad, BUILDINGS[column], ha="center", va="bottom")
        left = x == 0 and len(columns) > 1
        for row, place, y in zip(rows, spread(ours[x], gap), ours[x], strict=True):
            _rung_label(ax, x, y, place, row, left)
    for i, row in enumerate(rows):
        style = arm_style(row)
        mark = {"marker": style.marker, "color": style.color, "markersize": 9}
        x = np.arange(len(columns))
        ax.plot(x, ours[:, i], linewidth=1, **mark, zorder=2)
        inside = x + np.where(x == 0, 0.13, -0.13) * (len(columns) > 1 or -1)
        hollow = {
            "markerfacecolor": "none",
            "markeredgewidth": 1.4,
            "linestyle": "none",
        }
        ax.plot(inside, np.array(theirs)[:, i], **mark | hollow, zorder=3)
    ax.set_xlim(-0.75, len(columns) - 0.25)
    ax.set_xticks([])
    ax.set_yticks([])
    ax.spines[["left", "bottom"]].set_visible(False)
    if paper:
        ax.set_xlabel("mean value; filled marks: here, hollow marks: the paper")
    else:
        ax.set_xlabel("mean value of all cells and tasks")
    return ax


def describe_ladder(
    result: Mapping, *, paper: Mapping | None = PAPER, rows: Sequence[str] = ROWS
) -> str:
    """
    Return the alt text of :func:`plot_ladder`: the rungs from the top, the order.

    >>> describe_ladder({"source": {"rand": -88.7, "nd": -44.1, "optimal": -14.0}},
    ...                 rows=("rand", "nd", "optimal"))
    "Mean value by policy, best first. Source: optimal −14.0, ND −44.1, random −88.7.
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


def _rung_label(ax, x, y, place, row, left):
    """Print name and value beside a rung; a thin line leads there if they moved."""
    style = arm_style(row)
    text = (style.name, number(y)) if left else (number(y), style.name)
    side = -1 if left else 1
    ax.annotate(
        "  ".join(text),
        (x, y),
        (x + 0.16 * side, place),
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
