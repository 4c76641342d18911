"""
What a guide does before the learner takes over: where it arrives, what is noted.

Page 10 of the book teaches this module.  Like the learner, it knows no grid.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.sparse.csgraph import breadth_first_order

from ..learning import q_learning_runs
from ..learning.settings import whole
from ..mdp import MDP, check_policy
from ..solvers import evaluate_policy, optimal_values, transition_matrix


class Arrival(NamedTuple):
    """How an episode that starts in each state ends, exactly."""

    arrived: np.ndarray  # (S,) probability to reach a terminal state in time
    steps: np.ndarray  # (S,) expected steps, until then or until the cut

    def goals_per_step(self, start: np.ndarray) -> float:
        """Return the goals per step if all states in `start` begin equally often."""
        return float(self.arrived[start].sum() / self.steps[start].sum())


def arrival(mdp: MDP, policy: np.ndarray, n_steps: int = 5000) -> Arrival:
    """
    Return where a policy (S, A) arrives within `n_steps`, with no simulation.

    Examples
    --------
    Two cells, the second is the goal; a step succeeds half of the time.

    >>> mdp = MDP([[[0, 1]], [[1, 1]]], np.full((2, 1, 2), 0.5), [0, 1],
    ...           [False, True], 0.9)
    >>> found = arrival(mdp, np.ones((2, 1)), n_steps=3)
    >>> found.arrived.tolist(), found.steps.tolist()  # 1 - 1/8; 1 + 1/2 + 1/4
    ([0.875, 1.0], [1.75, 0.0])
    """
    moves = transition_matrix(mdp, check_policy(policy, mdp))
    n_steps = whole("n_steps", n_steps)
    on_the_way = np.where(mdp.terminal, 0.0, 1.0)
    steps = np.zeros(mdp.n_states)
    for _ in range(n_steps):
        steps += on_the_way
        on_the_way = moves @ on_the_way
    return Arrival(1 - on_the_way, steps)


def can_arrive(mdp: MDP, policy: np.ndarray) -> np.ndarray:
    """
    Return whether a policy can reach a terminal state at all, however late, (S,).

    It depends on which actions have a chance, not on how large it is.

    >>> mdp = MDP([[[0], [1]], [[1], [1]]], np.ones((2, 2, 1)), [0, 1],
    ...           [False, True], 0.9)
    >>> can_arrive(mdp, np.array([[1.0, 0.0], [1.0, 0.0]])).tolist()
    [False, True]
    """
    moves = transition_matrix(mdp, check_policy(policy, mdp)).tocoo()
    n, ends = mdp.n_states, np.flatnonzero(mdp.terminal)
    # From one more state, which stands for "arrived", against the moves.
    backward = type(moves)(
        (
            np.ones(moves.nnz + len(ends)),
            (
                np.concatenate([moves.coords[1], np.full(len(ends), n)]),
                np.concatenate([moves.coords[0], ends]),
            ),
        ),
        shape=(n + 1, n + 1),
    ).tocsr()
    reached = np.zeros(n + 1, dtype=bool)
    reached[breadth_first_order(backward, n, return_predecessors=False)] = True
    return reached[:n]


class Notes(NamedTuple):
    """What a table of Q holds when the guide leaves, mean over runs."""

    goals: float  # goals reached so far
    tried: float  # share of non-terminal states' actions ever taken
    informed: float  # share of non-terminal states with a note above 0
    skill: float  # value of obeying the notes, as a share of the best value


def notes_after(
    mdp: MDP, guide: np.ndarray, tau: int, *, rngs: Iterable, gamma: float = 0.9
) -> Notes:
    """
    Return what is noted after `tau` steps in which the guide (S, A) decides alone.

    For rewards of 0 and more, that is for notes which 0 does not flatter.  To
    obey the notes is to take one of the largest, all alike.

    >>> mdp = MDP([[[1]], [[2]], [[2]]], np.ones((3, 1, 1)), [0, 0, 1],
    ...           [False, False, True], 0.9)
    >>> notes_after(mdp, np.ones((3, 1)), 100, rngs=[0]).informed
    1.0
    """
    guide = check_policy(guide, mdp, "guide")
    if mdp.reward.min() < 0:
        raise ValueError(f"reward must not be negative, got {mdp.reward.min()}")
    rngs, way = list(rngs), ~mdp.terminal
    options = {"rngs": rngs, "guide": guide, "tau": tau, "gamma": gamma}
    runs = q_learning_runs(mdp, tau, **options)
    # While the guide decides alone, what is noted changes no step: the same
    # walk again, from notes that every update lowers, shows what was tried.
    above = 2 * mdp.reward.max() / (1 - gamma) + 1
    walks = q_learning_runs(mdp, tau, q0=above, **options)
    game = replace(mdp, gamma=gamma)
    best = optimal_values(game)[way].mean()
    tried = [(run.q != above)[way][mdp.allowed[way]].mean() for run in walks]
    informed = [(run.q.max(axis=1) > 0)[way].mean() for run in runs]
    skill = [evaluate_policy(game, _obeyed(run.q))[way].mean() / best for run in runs]
    goals = [run.goals.sum() for run in runs]
    return Notes(*(float(np.mean(x)) for x in (goals, tried, informed, skill)))


def _obeyed(q: np.ndarray) -> np.ndarray:
    largest = q == q.max(axis=1, keepdims=True)
    return largest / largest.sum(axis=1, keepdims=True)
