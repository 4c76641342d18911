"""
The three builders: from solved tasks of a source to an abstract policy (Z, A).

``induced`` counts the votes of optimal policies, ``deduced`` climbs the value of the
abstract policy itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from ..navigation import NavigationTasks
from ..policies import break_ties
from ..solvers import optimal_actions, optimal_values
from .deduced import (
    Climb,
    absprob_pi,
    abstract_gradient,
    natural_ascent,
    random_starts,
)
from .induced import count_votes, induce_nondeterministic, induce_probabilistic

__all__ = [
    "BUILDERS",
    "Climb",
    "absprob_pi",
    "abstract_gradient",
    "abstract_policies",
    "count_votes",
    "induce_nondeterministic",
    "induce_probabilistic",
    "natural_ascent",
    "random_starts",
]

BUILDERS = ("nd", "prob", "grad")


def abstract_policies(
    tasks: NavigationTasks,
    builders: Iterable[str] = BUILDERS,
    *,
    ties: str = "share",
    rng=None,
    progress: Callable[[Iterable], Iterable] = iter,
) -> dict[str, np.ndarray]:
    """
    Return abstract policies (Z, A) built from source tasks, by builder.

    Parameters
    ----------
    tasks : NavigationTasks
        The solved tasks: one, those of a map, or those of several maps.
    builders : iterable of {"nd", "prob", "grad"}
    ties, rng
        As for :func:`~abstransfer.policies.break_ties`.
    progress
        As for :func:`~abstransfer.builders.absprob_pi`.

    Raises
    ------
    ValueError
        If a builder is unknown, or ``"grad"`` is asked for where actions are
        masked and the features do not tell which ones.

    Examples
    --------
    Behind the only door lies the goal: both builders say "go to the room".

    >>> from abstransfer.maps import parse_map
    >>> from abstransfer.abstraction import describe
    >>> from abstransfer.navigation import navigation_tasks
    >>> tasks = navigation_tasks(parse_map("+---+\\n|.d*|\\n+---+"))
    >>> describe(tasks.rho[0])
    'see_room_head_to_goal ^ near_goal'
    >>> policies = abstract_policies(tasks, ("nd", "prob"))
    >>> tasks.actions[policies["prob"][tasks.rho[0]].argmax()]
    'see_room_head_to_goal'
    """
    builders = tuple(builders)
    for builder in builders:
        if builder not in BUILDERS:
            raise ValueError(f"builders must be among {BUILDERS}, got {builder!r}")
    mdp, rho, possible = tasks.mdp, tasks.rho, tasks.possible
    policies = {}
    if "nd" in builders or "prob" in builders:
        optimal = optimal_actions(mdp, optimal_values(mdp))
        votes = break_ties(optimal, ties, rng=rng)
        policies["nd"] = induce_nondeterministic(votes, rho, possible)
        policies["prob"] = induce_probabilistic(votes, rho, possible)
    if "grad" in builders:
        if (possible[rho] & ~mdp.allowed)[~mdp.terminal].any():
            raise ValueError(
                'builders must not hold "grad" where the features do not tell which '
                'actions are masked; make the tasks with unavailable="wait"'
            )
        policies["grad"] = absprob_pi(mdp, rho, possible, progress=progress).policy
    return {builder: policies[builder] for builder in builders}
