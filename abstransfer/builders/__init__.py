"""
The three builders: from solved tasks of a source to an abstract policy (Z, A).

``induced`` counts the votes of optimal policies, ``deduced`` climbs the value of the
abstract policy itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from ..navigation import NavigationTasks, parts_of
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
    tasks: NavigationTasks | Iterable[NavigationTasks],
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
    tasks : NavigationTasks, or an iterable of them
        The solved tasks: one, those of a map, or those of several maps; or parts
        of these, which are held and solved one after the other.
    builders : iterable of {"nd", "prob", "grad"}
    ties, rng
        As for :func:`~abstransfer.policies.break_ties`.
    progress
        As for :func:`~abstransfer.builders.absprob_pi`.

    Raises
    ------
    ValueError
        If `tasks` are none, a builder is unknown, or ``"grad"`` is asked for where
        actions are masked and the features do not tell which ones.

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
    parts = list(parts_of(tasks))
    mdps, possible = [part.mdp for part in parts], parts[0].possible
    rho = np.concatenate([part.rho for part in parts])
    policies = {}
    if "nd" in builders or "prob" in builders:
        optimal = [optimal_actions(mdp, optimal_values(mdp)) for mdp in mdps]
        votes = break_ties(np.concatenate(optimal), ties, rng=rng)
        policies["nd"] = induce_nondeterministic(votes, rho, possible)
        policies["prob"] = induce_probabilistic(votes, rho, possible)
    if "grad" in builders:
        allowed = [mdp.allowed | mdp.terminal[:, None] for mdp in mdps]
        if (possible[rho] & ~np.concatenate(allowed)).any():
            raise ValueError(
                'builders must not hold "grad" where the features do not tell which '
                'actions are masked; make the tasks with unavailable="wait"'
            )
        policies["grad"] = absprob_pi(mdps, rho, possible, progress=progress).policy
    return {builder: policies[builder] for builder in builders}
