"""
Exact values and optimal actions of any finite MDP.

As in the paper, V(s) counts the reward of s itself and of all states reached
from it; Q(s, a) is the expected V of the state that action a leads to.
So V(s) = R(s) + gamma sum_a pi(s, a) Q(s, a), and V = R in terminal states.
Page 2 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from .mdp import MDP, as_array, check_mdp, check_policy

if TYPE_CHECKING:  # SciPy takes longer to load than all else: only where it is used
    from scipy.sparse import csr_array

TIE = 1e-9  # actions whose values differ by less, in rewards, are equally good
NEAR, SWEEPS = 0.01, 1000  # sweep until no value moves by more, in rewards; at most


def transition_matrix(mdp: MDP, policy: np.ndarray) -> csr_array:
    """
    Return P (S, S) under a policy (S, A); rows of terminal states are empty.

    Raises ValueError if `policy` is no policy of `mdp`.

    >>> import numpy as np
    >>> both_ways = MDP([[[0], [1]], [[1], [1]]], np.ones((2, 2, 1)), [0, 1],
    ...                 [False, True], 0.9)
    >>> transition_matrix(both_ways, np.full((2, 2), 0.5)).toarray()
    array([[0.5, 0.5],
           [0. , 0. ]])
    """
    policy = check_policy(policy, mdp)
    policy[mdp.terminal] = 0.0
    state, action, next_state, prob = mdp.transitions
    weight = policy.ravel()[state * mdp.n_actions + action] * prob
    used = np.flatnonzero(weight)
    matrix = _rows(
        weight[used], state[used], next_state[used], mdp.n_states, mdp.n_states
    )
    matrix.sum_duplicates()
    return matrix


def _rows(weight, row, column, n_rows: int, n_columns: int) -> csr_array:
    """Return a matrix whose entries come row by row, in the order they come."""
    from scipy.sparse import csr_array

    first = np.concatenate([[0], np.cumsum(np.bincount(row, minlength=n_rows))])
    return csr_array((weight, column, first), shape=(n_rows, n_columns))


def factorize(transitions: csr_array, gamma: float):
    """Return the sparse LU factors of I - gamma P, for P (S, S)."""
    from scipy.sparse import eye_array
    from scipy.sparse.linalg import splu

    n_states = transitions.shape[0]
    matrix = eye_array(n_states, format="csc") - gamma * transitions.tocsc()
    return splu(matrix, relax=1, panel_size=1)  # few entries: no dense blocks to find


def evaluate_policy(mdp: MDP, policy: np.ndarray) -> np.ndarray:
    """
    Return the value of every state under a stochastic policy.

    Solves V = R + gamma P V as a sparse linear system: there is no tolerance
    to choose.

    Parameters
    ----------
    mdp : MDP
    policy : ndarray of float, shape (S, A)
        ``policy[s, a]`` is the probability of action a in state s.

    Returns
    -------
    v : ndarray of float, shape (S,)
        Expected discounted reward, that of s included.

    Raises
    ------
    ValueError
        If `policy` is no policy of `mdp`.

    References
    ----------
    Freire & Costa (2015), the unnumbered equation of V under "Deduced Policy".

    Examples
    --------
    Three cells in a row, the last the goal, discounted by a half.

    >>> corridor = MDP([[[1]], [[2]], [[2]]], np.ones((3, 1, 1)), [0, 0, 1],
    ...                [False, False, True], 0.5)
    >>> evaluate_policy(corridor, np.ones((3, 1)))
    array([0.25, 0.5 , 1.  ])
    """
    return factorize(transition_matrix(mdp, policy), mdp.gamma).solve(mdp.reward)


def action_values(mdp: MDP, v: np.ndarray) -> np.ndarray:
    """
    Return Q (S, A): the expected value v (S,) of the state each action leads to.

    Zero in terminal states, minus infinity where an action is not allowed.
    Raises ValueError unless `v` is one finite number a state.
    """
    check_mdp(mdp)
    v = as_array("v", v, np.float64, 1, (mdp.n_states,))
    if not np.isfinite(v).all():
        raise ValueError(f"v must be finite, got {v}")
    state, action, next_state, prob = mdp.transitions
    entry, size = state * mdp.n_actions + action, mdp.n_states * mdp.n_actions
    q = np.bincount(entry, prob * v[next_state], size).reshape(mdp.allowed.shape)
    q[~mdp.allowed] = -np.inf
    q[mdp.terminal] = 0.0
    return q


def value_iteration(mdp: MDP) -> Iterator[np.ndarray]:
    """
    Yield the values (S,) before the first sweep, and after each, without end.

    >>> from itertools import islice
    >>> corridor = MDP([[[1]], [[2]], [[2]]], np.ones((3, 1, 1)), [0, 0, 1],
    ...                [False, False, True], 0.5)
    >>> [v.tolist() for v in islice(value_iteration(corridor), 3)]
    [[0.0, 0.0, 1.0], [0.0, 0.5, 1.0], [0.25, 0.5, 1.0]]
    """
    check_mdp(mdp)
    state, action, next_state, prob = mdp.transitions
    order = np.argsort(action, kind="stable")  # action by action: max is fast
    row = (action * mdp.n_states + state)[order]
    shape = mdp.n_actions, mdp.n_states
    outcomes = _rows(
        prob[order], row, next_state[order], mdp.allowed.size, mdp.n_states
    )
    barred = None if mdp.allowed.all() else ~mdp.allowed.T
    v = mdp.reward
    while True:
        yield v
        q = (outcomes @ v).reshape(shape)
        if barred is not None:
            q[barred] = -np.inf
        best = q.max(axis=0)
        v = mdp.reward + mdp.gamma * np.where(mdp.terminal, 0.0, best)


def optimal_values(mdp: MDP) -> np.ndarray:
    """
    Return the optimal value of every state, exact, shape (S,).

    Policy iteration, started from what is best after some sweeps of value
    iteration: a sweep is far cheaper than a round, and carries news as far.  An
    action is changed only for one better by more than `TIE` times the largest
    reward: equally good ones would swap for ever on rounding.

    >>> corridor = MDP([[[0], [1]], [[0], [2]], [[2], [2]]], np.ones((3, 2, 1)),
    ...                [0, 0, 1], [False, False, True], 0.5)
    >>> optimal_values(corridor)
    array([0.25, 0.5 , 1.  ])
    """
    sweeps = value_iteration(mdp)
    v = next(sweeps)
    for new in islice(sweeps, SWEEPS):
        moved, v = np.abs(new - v).max(), new
        if moved <= NEAR * np.abs(mdp.reward).max():
            break
    states = np.arange(mdp.n_states)
    best = action_values(mdp, v).argmax(axis=1)
    while True:
        v = evaluate_policy(mdp, np.eye(mdp.n_actions)[best])
        q = action_values(mdp, v)
        better = q.max(axis=1) > q[states, best] + _tie(mdp)
        if not better.any():
            return v
        best = np.where(better, q.argmax(axis=1), best)


def optimal_actions(mdp: MDP, v: np.ndarray) -> np.ndarray:
    """
    Return which actions are optimal given the optimal values v (S,).

    Returns
    -------
    optimal : ndarray of bool, shape (S, A)
        Every action within `TIE` times the largest reward of the best; none in
        a terminal state.

    Examples
    --------
    Staying and leaving are worth the same where there is nothing to win.

    >>> idle = MDP([[[0], [1]], [[1], [1]]], np.ones((2, 2, 1)), [0, 0],
    ...            [False, True], 0.9)
    >>> optimal_actions(idle, optimal_values(idle))
    array([[ True,  True],
           [False, False]])
    """
    q = action_values(mdp, v)
    optimal = q >= q.max(axis=1, keepdims=True) - _tie(mdp)
    optimal[mdp.terminal] = False
    return optimal


def _tie(mdp: MDP) -> float:
    return TIE * np.abs(mdp.reward).max()
