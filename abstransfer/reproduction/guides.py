"""
The guides of page 10, which asks what makes advice teach well, by name.

They are made of the paper's by two dials.  `beta` raises the probabilities to a
power (0 makes ND of Prob); `share` mixes in a robot that draws uniformly, among
the available actions or among all.  Some exchange rows in Prob's traps.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ..experiments.problem import Problem, build_guides
from ..navigation import navigation_tasks
from ..policies import beta_policy, uniform_policy
from .traps import EXCHANGED, exchange_rows

TAU = {"hard": 3_500_000, "soft": 6_000_000}  # the paper's, of Prob
BETAS = (0, 0.25, 0.5, 1, 2, 4, 8)
SHARES = (0.1, 0.25, 0.5, 0.75)
TINY = 1e-12  # a first note that says no more than: this can be done


class Advice(NamedTuple):
    """How a guide is made: (1 - share) base^beta + share x uniform."""

    base: str  #: a builder: "prob", "grad"
    beta: float = 1  #: 0 keeps which actions, and forgets how often
    into: str = "available"  #: what the uniform part draws from: "available", "all"
    share: float = 0  #: of the uniform part


def _diluted(name: str, base: str, beta: float, into: str) -> dict[str, Advice]:
    return {f"{name}-{into}-{w}": Advice(base, beta, into, w) for w in SHARES}


ADVICE = {
    **{f"beta-{beta}": Advice("prob", beta) for beta in BETAS},
    **_diluted("prob", "prob", 1, "available"),
    **_diluted("prob", "prob", 1, "all"),
    **_diluted("nd", "prob", 0, "available"),
    **_diluted("nd", "prob", 0, "all"),
    **_diluted("grad", "grad", 1, "available"),
    "grad": Advice("grad"),
    "available": Advice("prob", 1, "available", 1),
    "all": Advice("prob", 1, "all", 1),
}


def make_guides(
    names: Iterable[str] = tuple(ADVICE), problem: Problem | None = None
) -> dict[str, np.ndarray]:
    """
    Return the abstract policies (Z, A) of these names in `ADVICE` or `EXCHANGED`.

    Raises KeyError for a name that is in neither.

    >>> guides = make_guides(["beta-0", "beta-1"])
    >>> bool(((guides["beta-0"] > 0) == (guides["beta-1"] > 0)).all())
    True
    """
    problem, names = problem or Problem(), list(names)
    if set(names) & set(EXCHANGED):
        plain = [name for name in names if name not in EXCHANGED]
        made = make_guides({"beta-0", "beta-1", "available", *plain}, problem)
        made |= exchange_rows(
            problem, *(made[n] for n in ("beta-0", "beta-1", "available"))
        )
        return {name: made[name] for name in names}
    wanted = {name: ADVICE[name] for name in names}
    built = build_guides(problem, {advice.base for advice in wanted.values()})
    source = navigation_tasks(problem.source)
    uniform = {
        "available": uniform_policy(source.possible),
        "all": uniform_policy(np.ones_like(source.possible)),
    }
    return {
        name: (1 - share) * beta_policy(built[base], beta) + share * uniform[into]
        for name, (base, beta, into, share) in wanted.items()
    }
