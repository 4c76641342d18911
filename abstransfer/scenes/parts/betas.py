"""The dial beta, from ND to winner-takes-all: its policies, and how each drives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from ...driving import executed_values
from ...experiments.problem import Problem, build_guides, driving_tasks
from ...maps import Map
from ...policies import beta_policy
from .charts import Axis, Curve, line_chart, tens

LAST, STEP = 8.0, 0.25
BETAS = tuple(float(beta) for beta in np.arange(0, LAST + STEP, STEP))
DIAL = Axis(0, LAST, {beta: f"{beta}" for beta in (0, 2, 4, 6, 8)}, "dial \u03b2")
HEIGHT = 130  # of a chart


@lru_cache(maxsize=8)
def policy_at(source: Map, beta: float) -> np.ndarray:
    """Return the abstract policy (Z, A) of a building at beta."""
    prob = build_guides(Problem(source=source), ["prob"])["prob"]
    return beta_policy(prob, beta)


@lru_cache(maxsize=256)
def driving_at(source: Map, target: Map, beta: float) -> float:
    """Return the mean value of a cell of the target under that policy: exact."""
    guides = {"policy": policy_at(source, beta)}
    return executed_values(driving_tasks(Problem(target=target)), guides)["policy"]


def driving_chart(
    lines: Mapping[str, Sequence[tuple[float, float]]], peak: float, name: str
) -> list[str]:
    """Return a chart of (beta, value): the source dashed, the target whole."""
    values = [value for points in lines.values() for _, value in points]
    dashes = {"source": "5 2", "target": ""}
    curves = [Curve(where, lines[where], dash=dashes[where]) for where in lines]
    note = f"peak {peak:g}"
    return line_chart(
        curves, DIAL, tens(values, name), line=peak, note=note, height=HEIGHT
    )
