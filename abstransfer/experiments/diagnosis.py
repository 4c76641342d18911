"""
What a guide does before the learner takes over: where it arrives, what is noted.

Page 10 of the book teaches this module.  Like the learner, it knows no grid.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.sparse.csgraph import breadth_first_order

from ..learning import Learner
from ..learning.settings import whole
from ..mdp import MDP, check_policy
from ..policies import uniform_policy
from ..solvers import (
    evaluate_policy,
    factorize,
    optimal_values,
    transition_matrix,
)


class Arrival(NamedTuple):
    """How an episode that starts in each state ends, exactly."""

    arrived: np.ndarray  #: (S,) probability to reach a terminal state in time
    steps: np.ndarray  #: (S,) expected steps, until then or until the cut

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
    from ._steps import steps  # not before it is asked for: it loads the compiler

    n_steps = whole("n_steps", n_steps)
    start = np.where(mdp.terminal, 0.0, 1.0)
    late, on_the_way = steps(transition_matrix(mdp, policy), start, n_steps)
    return Arrival(1 - late, on_the_way)


def can_arrive(mdp: MDP, policy: np.ndarray) -> np.ndarray:
    """
    Return whether a policy can reach a terminal state at all, however late, (S,).

    It depends on which actions have a chance, not on how large it is.

    >>> mdp = MDP([[[0], [1]], [[1], [1]]], np.ones((2, 2, 1)), [0, 1],
    ...           [False, True], 0.9)
    >>> can_arrive(mdp, np.array([[1.0, 0.0], [1.0, 0.0]])).tolist()
    [False, True]
    """
    moves = transition_matrix(mdp, policy).tocoo()
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
    """What a table of Q holds when the guide leaves: each (N,), a number per run."""

    goals: np.ndarray  #: goals reached so far
    tried: np.ndarray  #: share of non-terminal states' actions ever taken
    noted: np.ndarray  #: share of non-terminal states with a note above 0
    skill: np.ndarray  #: value of obeying the notes, as a share of the best value
    ready: np.ndarray  #: see :func:`ready`


def notes_after(
    mdp: MDP, guide: np.ndarray, tau: int, *, rngs: Iterable, gamma: float = 0.9
) -> Notes:
    """
    Return what is noted after `tau` steps in which the guide (S, A) decides alone.

    A number per generator in `rngs`.  For rewards of 0 and more, that is for notes
    which 0 does not flatter.  To obey the notes is to take one of the largest, all
    alike.

    >>> mdp = MDP([[[1]], [[2]], [[2]]], np.ones((3, 1, 1)), [0, 0, 1],
    ...           [False, False, True], 0.9)
    >>> notes_after(mdp, np.ones((3, 1)), 100, rngs=[0, 1]).noted
    array([1., 1.])
    """
    guide = check_policy(guide, mdp, "guide")
    if mdp.reward.min() < 0:
        raise ValueError(f"reward must not be negative, got {mdp.reward.min()}")
    way = ~mdp.terminal
    learner = Learner(mdp, rngs=rngs, guide=guide, tau=tau, gamma=gamma)
    # A zero is equal to its negative, and no step leaves a negative one: so the sign
    # of a value shows whether its action was tried.
    for part in learner._parts:
        for run in part.runs:
            run.q[run.q == 0] = -0.0
    learner.advance(tau)
    runs = learner.results()
    game, best = _game(mdp, gamma)
    tried = [(~np.signbit(run.q[way][mdp.allowed[way]])).mean() for run in runs]
    noted = [(run.q.max(axis=1) > 0)[way].mean() for run in runs]
    skill = [
        evaluate_policy(game, obeyed(run.q, mdp.allowed))[way].mean() / best
        for run in runs
    ]
    goals = [run.goals.sum() for run in runs]
    able = [ready(mdp, run.q) for run in runs]
    return Notes(*map(np.array, (goals, tried, noted, skill, able)))


@lru_cache(maxsize=1)
def _game(mdp: MDP, gamma: float) -> tuple[MDP, float]:
    """Return an MDP with another discount, and its best mean value on the way."""
    game = replace(mdp, gamma=gamma)
    return game, optimal_values(game)[~mdp.terminal].mean()


def obeyed(q: np.ndarray, allowed: np.ndarray, epsilon: float = 0.0) -> np.ndarray:
    """
    Return the policy (S, A) of obeying notes q (S, A), but for a share of luck.

    >>> obeyed(np.array([[0.5, 0.5, 0.0]]), np.ones((1, 3), bool), 0.3).round(2)
    array([[0.45, 0.45, 0.1 ]])
    """
    largest = q == q.max(axis=1, keepdims=True)
    largest = largest / largest.sum(axis=1, keepdims=True)
    return (1 - epsilon) * largest + epsilon * uniform_policy(allowed)


def ready(
    mdp: MDP, q: np.ndarray, *, epsilon: float = 0.1, n_steps: int = 1000
) -> float:
    """
    Return the share of starts that arrive in time by notes q (S, A), frozen.

    It is exact, and asks what the learner will do with the notes at first: act
    epsilon-greedily on them.

    >>> mdp = MDP([[[0], [1]], [[1], [1]]], np.ones((2, 2, 1)), [0, 1],
    ...           [False, True], 0.9)
    >>> ready(mdp, np.array([[1.0, 0.0], [0.0, 0.0]]), epsilon=0.5, n_steps=2)
    0.4375
    """
    policy = obeyed(q, mdp.allowed, epsilon)
    return float(arrival(mdp, policy, n_steps).arrived[~mdp.terminal].mean())


def stuck(mdp: MDP, policy: np.ndarray, n_steps: int = 5000) -> np.ndarray:
    """
    Return where the episodes stand that have not arrived in `n_steps`, (S,).

    Each state that is not terminal starts equally often; the sum is the share
    of episodes that are late.

    >>> mdp = MDP([[[0, 1]], [[1, 1]]], np.full((2, 1, 2), 0.5), [0, 1],
    ...           [False, True], 0.9)
    >>> stuck(mdp, np.ones((2, 1)), n_steps=3).tolist()
    [0.125, 0.0]
    """
    from ._steps import steps  # not before it is asked for: it loads the compiler

    on_the_way = np.where(mdp.terminal, 0.0, 1.0)
    moves = transition_matrix(mdp, policy).T.multiply(on_the_way[:, None]).tocsr()
    return steps(moves, on_the_way / on_the_way.sum(), n_steps)[0]


def judged(mdp: MDP, policy: np.ndarray, gamma: float) -> float:
    """
    Return how well a policy (S, A) drives for a judge of patience `gamma`.

    The mean value in percent of the worst, for a cost of 1 a step: 0 has
    arrived, -100 never will, whatever the patience.

    >>> mdp = MDP([[[1]], [[1]]], np.ones((2, 1, 1)), [-1, 0], [False, True], 0.9)
    >>> round(judged(mdp, np.ones((2, 1)), 0.5), 6)  # -1 of -2, and 0 of -2
    -25.0
    """
    if not 0 <= gamma < 1:
        raise ValueError(f"gamma must satisfy 0 <= gamma < 1, got {gamma}")
    return _judged(mdp, transition_matrix(mdp, policy), gamma)


def _judged(mdp: MDP, moves, gamma: float) -> float:
    cost = np.where(mdp.terminal, 0.0, -1.0)
    value = factorize(moves, gamma).solve(cost)
    return float(100 * (1 - gamma) * value.mean())


def change_of_mind(
    mdp: MDP, a: np.ndarray, b: np.ndarray, low: float = 0.9, high: float = 0.9999
) -> float:
    """
    Return the patience at which policies a and b (S, A) are judged alike.

    Found by halving the judge's horizon 1 / (1 - gamma), on a scale of logs, to
    three digits; nan if the same one is better at both ends.
    """

    moves = [transition_matrix(mdp, policy) for policy in (a, b)]

    def lead(log_horizon):
        gamma = 1 - np.exp(-log_horizon)
        return np.subtract(*(_judged(mdp, each, gamma) for each in moves))

    ends = [-np.log1p(-gamma) for gamma in (low, high)]
    signs = [np.sign(lead(end)) for end in ends]
    if signs[0] == signs[1]:
        return float("nan")
    while ends[1] - ends[0] > 1e-3:
        middle = sum(ends) / 2
        ends[int(np.sign(lead(middle)) != signs[0])] = middle
    return float(1 - np.exp(-sum(ends) / 2))


def return_variation(mdp: MDP, policy: np.ndarray) -> float:
    """
    Return the coefficient of variation of a policy's return, exactly.

    Over starts in all states that are not terminal, and over the luck of moves:
    standard deviation by the size of the mean.

    References
    ----------
    Fachantidis, Taylor & Vlahavas (2017), Learning to Teach Reinforcement
    Learning Agents, on what tells good advisers from good performers.

    >>> mdp = MDP([[[0, 1]], [[1, 1]]], np.full((2, 1, 2), 0.5), [-1, 0],
    ...           [False, True], 0.5)
    >>> round(return_variation(mdp, np.ones((2, 1))) ** 2, 6)  # (40/21) / (4/3)^2 - 1
    0.071429
    """
    moves = transition_matrix(mdp, policy)
    v = factorize(moves, mdp.gamma).solve(mdp.reward)
    # G = r + gamma G': so E G^2 = r^2 + 2 r gamma E G' + gamma^2 E G'^2.
    once = mdp.reward**2 + 2 * mdp.reward * mdp.gamma * (moves @ v)
    square = factorize(moves, mdp.gamma**2).solve(once)
    way = ~mdp.terminal
    mean = v[way].mean()
    return float(np.sqrt(square[way].mean() - mean**2) / abs(mean))
