"""
What all figures share: the palette, sizes, marks, numbers, and room for labels.

Figures stand on a white card of their own, so one set of colours serves every
place they are shown in; scenes use the palette's dark colours too.
"""

from __future__ import annotations

import json
from importlib.resources import files
from typing import NamedTuple

import numpy as np

PALETTE = json.loads((files("abstransfer") / "palette.json").read_text("utf-8"))
COLOR = {name: shades["light"] for name, shades in PALETTE["building"].items()}
MARKS = {
    "circle": "o",
    "cross": "X",
    "square": "s",
    "triangle": "^",
    "diamond": "D",
    "star": "*",
    "plus": "P",
}
WIDTH = 5.0  # inches: on a phone it shrinks to three quarters
FONT, SMALL = 11, 10  # points
RC = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial"],
    "font.size": FONT,
    "axes.labelsize": FONT,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "text.color": COLOR["ink"],
    "axes.labelcolor": COLOR["ink"],
    "axes.edgecolor": COLOR["faint"],
    "xtick.color": COLOR["ink"],
    "ytick.color": COLOR["ink"],
    "figure.facecolor": COLOR["ground"],
    "axes.facecolor": COLOR["ground"],
    "path.simplify": False,
    "svg.fonttype": "none",  # letters stay letters: small files, readable changes
    "svg.hashsalt": "abstransfer",
}


class ArmStyle(NamedTuple):
    """How one arm looks in every figure."""

    name: str  #: as written beside its mark
    color: str  #: as matplotlib takes it
    marker: str  #: as matplotlib takes it
    dash: tuple  #: matplotlib's line style
    filled: bool  #: whether its marks and boxes are

    @property
    def face(self) -> str:
        """Colour inside its marks."""
        return self.color if self.filled else COLOR["ground"]


def arm_style(arm: str) -> ArmStyle:
    """
    Return the style of an arm: a builder, and a strategy if it has one.

    Builder and strategy may be joined by a blank, a hyphen or an underscore.

    >>> arm_style("nd-soft").name
    'ND soft'
    >>> arm_style("uniform_available").name
    'eager'
    """
    builder, strategy = str(arm), None
    for name in PALETTE["strategies"]:
        if builder.endswith((f" {name}", f"-{name}", f"_{name}")):
            builder, strategy = builder[: -len(name) - 1], name
    if builder not in PALETTE["arms"]:
        known = ", ".join(PALETTE["arms"])
        raise ValueError(
            f"arm must be one of {known}, with or without hard or soft, got {arm!r}"
        )
    look = PALETTE["arms"][builder]
    line = PALETTE["strategies"][strategy or "hard"]
    name = look["name"] + (f" {line['name']}" if strategy else "")
    dash = (0, tuple(line["dash"])) if line["dash"] else "solid"
    marker = MARKS[look["marker"]]
    return ArmStyle(name, look["light"], marker, dash, line["filled"])


def number(x: float, digits: int = 1) -> str:
    """
    Return a number as figures and alt texts print it, with a true minus sign.

    >>> number(-81.03)
    '\u221281.0'
    """
    text = f"{x:.{digits}f}"
    if not float(text):
        text = text.removeprefix("-")
    return text.replace("-", "\u2212")


def count(n: int, noun: str) -> str:
    """
    Return how many there are.

    >>> count(1, "door"), count(2, "door")
    ('1 door', '2 doors')
    """
    return f"{n} {noun}{'' if n == 1 else 's'}"


def spread(y: np.ndarray, gap: float) -> np.ndarray:
    """
    Return places (n,) near y (n,), in the same order and at least gap apart.

    The sum of squared moves is the least possible.

    >>> spread(np.array([0.0, 1.0, 9.0]), 2.0)
    array([-0.5,  1.5,  9. ])
    """
    from scipy.optimize import isotonic_regression  # slow to load

    y = np.asarray(y, dtype=float)
    if not y.size:
        return y
    order = np.argsort(y, kind="stable")
    steps = gap * np.arange(len(y))
    places = np.empty(len(y))
    places[order] = isotonic_regression(y[order] - steps).x + steps
    return places


def label_gap(ax, size: float = SMALL) -> float:
    """Return the height of a line of text in the units of the vertical axis."""
    low, high = sorted(ax.get_ylim())
    inches = ax.get_position().height * ax.figure.get_figheight()
    return (high - low) * 1.35 * size / (72 * inches)


def new_axes(ax, size: tuple[float, float] = (WIDTH, 3.4)):
    """Return ax, or the axes of a new pyplot figure where there is none."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    with plt.rc_context(RC):
        return plt.subplots(figsize=size, layout="constrained")[1]
