"""
How well a policy drives: values of executed policies, and Table 1 of the paper.

Page 7 of the book teaches this module.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain

import numpy as np

from .abstraction import LABELS
from .builders import BUILDERS, abstract_policies
from .mdp import as_array, check_rows
from .navigation import NavigationTasks, parts_of
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
    over labels is grounded in the moves that carry them.  Raises ValueError where
    `advice` is no abstract policy of `tasks`.
    """
    (tasks,) = parts_of(tasks)
    moves = tasks.actions != LABELS and np.shape(advice)[1:] == (len(LABELS),)
    shape = tasks.n_abstract, len(LABELS if moves else tasks.actions)
    advice = as_array("advice", advice, np.float64, 2, shape)
    check_rows(advice, "advice")
    if moves:
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
    tasks: NavigationTasks | Iterable[NavigationTasks],
    policies: Mapping[str, np.ndarray],
) -> dict[str, int | float]:
    """
    Return one column of Table 1, with the counts of its maps.

    Values are those of :func:`executed_values`; ``abstract_states`` counts those
    of non-goal cells.  The tasks may come in parts, of which one is held at a time.
    """
    return _column(tasks, policies)[0]


def _column(tasks, policies) -> tuple[dict[str, int | float], np.ndarray]:
    """Return a column, and how many non-goal states each abstract state has, (Z,)."""
    total, n_states, goals, seen = Counter(), 0, 0, 0
    for part in parts_of(tasks):
        mdp = part.mdp
        values = {
            "rand": _mean_value(part, uniform_policy(mdp.allowed)),
            **executed_values(part, policies),
            "uniform_available": _mean_value(part, uniform_policy(part.available)),
            "optimal": float(optimal_values(mdp).mean()),
        }
        total.update({name: mdp.n_states * value for name, value in values.items()})
        n_states += mdp.n_states
        goals += len(part.goal)
        seen += np.bincount(part.rho[~mdp.terminal], minlength=part.n_abstract)
    counts = {
        "cells": sum(map_.n_cells for map_ in part.maps),
        "rooms": sum(map_.n_rooms for map_ in part.maps),
        "goals": goals,
        "abstract_states": int(np.count_nonzero(seen)),
    }
    return counts | {name: sum_ / n_states for name, sum_ in total.items()}, seen


def _mean_value(tasks: NavigationTasks, policy: np.ndarray) -> float:
    return float(evaluate_policy(tasks.mdp, policy).mean())


def table1(
    source: NavigationTasks | Sequence[NavigationTasks],
    target: NavigationTasks | Iterable[NavigationTasks] | None = None,
    *,
    progress: Callable[[Iterable], Iterable] = iter,
) -> dict:
    """
    Return Table 1: policies of the source, executed in source and target.

    Both may come in parts, as :func:`~abstransfer.navigation.tasks_in_parts`
    makes them: those of the source are held, those of the target one at a time.

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
    source = list(parts_of(source, "source"))
    if target is not None:
        target = parts_of(target, "target")
        first = next(target)
        if (source[0].features, source[0].actions) != (first.features, first.actions):
            raise ValueError("target must have the same features and actions as source")
        target = chain([first], target)
    policies = abstract_policies(source, progress=progress)
    result = {}
    result["source"], known = _column(source, policies)
    if target is not None:
        result["target"], met = _column(target, policies)
        result["unseen"] = float(met[known == 0].sum() / met.sum())
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
        "uniform_available": ("eager", ".2f"),
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
