"""
The three abstract policies of a source, and Table 1 of the paper.

Page 7 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from .abstraction import unseen_share
from .builders.deduced import absprob_pi
from .navigation import NavigationTasks
from .policies import (
    break_ties,
    induce_nondeterministic,
    induce_probabilistic,
    restrict_policy,
    uniform_policy,
)
from .solvers import evaluate_policy, optimal_actions, optimal_values

BUILDERS = ("nd", "prob", "grad")
ROWS = ("rand", *BUILDERS, "optimal")
NAMES = {
    "rand": "pi_rand",
    "nd": "pi_AbsND",
    "prob": "pi_AbsProb",
    "grad": "pi_AbsGrad",
    "optimal": "pi*",
}
PAPER = {
    "source": dict(zip(ROWS, (-88.97, -44.61, -36.91, -30.65, -14.86), strict=True)),
    "target": dict(zip(ROWS, (-97.07, -80.41, -70.03, -70.34, -29.13), strict=True)),
}


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
        As for :func:`~abstransfer.builders.deduced.absprob_pi`.

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


def column(
    tasks: NavigationTasks, policies: dict[str, np.ndarray]
) -> dict[str, int | float]:
    """
    Return one column of Table 1, with the counts of its maps.

    Values are the mean of V over all cells of all tasks, goals included, in
    discounted reward; ``abstract_states`` counts those of non-goal cells.
    """
    mdp = tasks.mdp
    guides = {"rand": uniform_policy(mdp.allowed)}
    for name, policy in policies.items():
        guides[name] = restrict_policy(policy[tasks.rho], mdp.allowed)
    guides["uniform_available"] = uniform_policy(tasks.available)
    counts = {
        "cells": sum(map_.n_cells for map_ in tasks.maps),
        "rooms": sum(map_.n_rooms for map_ in tasks.maps),
        "goals": len(tasks.goal),
        "abstract_states": len(np.unique(tasks.rho[~mdp.terminal])),
    }
    values = {
        name: float(evaluate_policy(mdp, guide).mean())
        for name, guide in guides.items()
    }
    return counts | values | {"optimal": float(optimal_values(mdp).mean())}


def table1(
    source: NavigationTasks,
    target: NavigationTasks | None = None,
    *,
    progress: Callable[[Iterable], Iterable] = iter,
) -> dict:
    """
    Return Table 1: policies of the source, executed in source and target.

    Returns
    -------
    dict
        ``source`` and ``target``, each a :func:`column`, and ``unseen``, the
        share of non-goal target states whose abstract state the source has
        not.  Without `target`, only ``source``.

    References
    ----------
    Freire & Costa (2015), Table 1.

    Examples
    --------
    >>> from abstransfer.maps import read_map
    >>> from abstransfer.navigation import navigation_tasks
    >>> result = table1(navigation_tasks(read_map("source")))
    >>> round(result["source"]["optimal"], 2)
    -14.0
    """
    if target is not None and (source.features, source.actions) != (
        target.features,
        target.actions,
    ):
        raise ValueError("source and target must have the same features and actions")
    policies = abstract_policies(source, progress=progress)
    result = {"source": column(source, policies)}
    if target is not None:
        result["target"] = column(target, policies)
        result["unseen"] = unseen_share(
            target.rho[~target.mdp.terminal], source.rho[~source.mdp.terminal]
        )
    return result


def format_table1(result: dict) -> str:
    """
    Return a :func:`table1` as text: here, the paper, and the difference.

    Three columns for each building; the difference in percent of the paper.
    """
    columns = [name for name in ("source", "target") if name in result]
    lines = [
        " " * 20 + "".join(f"{name:^30}" for name in columns).rstrip(),
        f"{'':20}" + f"{'here':>10}{'paper':>10}{'differs':>10}" * len(columns),
    ]
    for row in ROWS:
        line = f"{NAMES[row]:20}"
        for name in columns:
            here, paper = result[name][row], PAPER[name][row]
            line += (
                f"{here:10.2f}{paper:10.2f}{100 * (here - paper) / abs(paper):+8.1f} %"
            )
        lines.append(line)
    extra = {
        "uniform_available": ("uniform, available", ".2f"),
        "cells": ("cells", "d"),
        "rooms": ("rooms", "d"),
        "goals": ("goals", "d"),
        "abstract_states": ("abstract states", "d"),
    }
    for key, (label, form) in extra.items():
        values = "".join(f"{result[name][key]:10{form}}{'':20}" for name in columns)
        lines.append(f"{label:20}{values}".rstrip())
    if "unseen" in result:
        lines.append("")
        lines.append(
            f"{100 * result['unseen']:.1f} % of the target's states are in an abstract "
            "state that the source has not."
        )
    lines.append("Mean discounted reward over all cells and tasks; higher is better.")
    return "\n".join(lines)
