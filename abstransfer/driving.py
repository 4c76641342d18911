"""
How well a policy drives: values of executed policies, and Table 1 of the paper.

Page 7 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from .abstraction import LABELS, unseen_share
from .builders import BUILDERS, abstract_policies
from .navigation import NavigationTasks
from .policies import ground, restrict_policy, uniform_policy
from .solvers import evaluate_policy, optimal_values

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


def advised(tasks: NavigationTasks, advice: np.ndarray) -> np.ndarray:
    """
    Return the policy (S, A) of a robot that obeys advice (Z, A), or (Z, labels).

    Advice over a compass robot's own four moves is obeyed as it stands; advice
    over labels is grounded in the moves that carry them.
    """
    if tasks.actions != LABELS and advice.shape[1] == len(LABELS):
        return ground(advice, tasks.rho, tasks.labels)
    return restrict_policy(advice[tasks.rho], tasks.mdp.allowed)


def executed_values(
    tasks: NavigationTasks, policies: Mapping[str, np.ndarray]
) -> dict[str, float]:
    """
    Return how well abstract policies (Z, A) drive in tasks, by name.

    The value of a policy is the mean of V over all cells of all tasks, goals
    included, in discounted reward.  Actions that are masked are left out.

    >>> from abstransfer.maps import parse_map
    >>> from abstransfer.navigation import navigation_tasks
    >>> tasks = navigation_tasks(parse_map("+---+\\n|.d*|\\n+---+"), success=1)
    >>> go = abstract_policies(tasks, ["nd"])  # the cell costs 1, the goal nothing
    >>> executed_values(tasks, go)
    {'nd': -0.5}
    """
    return {
        name: _mean_value(tasks, advised(tasks, policy))
        for name, policy in policies.items()
    }


def column(
    tasks: NavigationTasks, policies: Mapping[str, np.ndarray]
) -> dict[str, int | float]:
    """
    Return one column of Table 1, with the counts of its maps.

    Values are those of :func:`executed_values`; ``abstract_states`` counts those
    of non-goal cells.
    """
    mdp = tasks.mdp
    counts = {
        "cells": sum(map_.n_cells for map_ in tasks.maps),
        "rooms": sum(map_.n_rooms for map_ in tasks.maps),
        "goals": len(tasks.goal),
        "abstract_states": len(np.unique(tasks.rho[~mdp.terminal])),
    }
    return {
        **counts,
        "rand": _mean_value(tasks, uniform_policy(mdp.allowed)),
        **executed_values(tasks, policies),
        "uniform_available": _mean_value(tasks, uniform_policy(tasks.available)),
        "optimal": float(optimal_values(mdp).mean()),
    }


def _mean_value(tasks: NavigationTasks, policy: np.ndarray) -> float:
    return float(evaluate_policy(tasks.mdp, policy).mean())


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
