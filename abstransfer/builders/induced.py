"""
The two induced abstract policies, pi_AbsProb and pi_AbsND: counting votes.

Every state of every solved task votes for its optimal actions; the votes are counted
by abstract state.  Page 5 of the book teaches this module.
"""

from __future__ import annotations

import numpy as np

from ..mdp import as_array, as_weights
from ..policies import check_rho, uniform_policy


def induce_probabilistic(
    policy: np.ndarray, rho: np.ndarray, fallback: np.ndarray
) -> np.ndarray:
    """
    Return pi_AbsProb: how often each action is optimal in an abstract state.

    Every state of every task has one vote; a row of `policy` that is 0 (the
    goal) has none.  One task or the union of many makes no difference.

    Parameters
    ----------
    policy : ndarray of float, shape (S, A)
        Optimal policy of the source tasks: :func:`~abstransfer.policies.break_ties`.
    rho : ndarray of int, shape (S,)
        Abstract state of each state, in 0..Z-1.
    fallback : ndarray of bool, shape (Z, A)
        Abstract states without a vote draw uniformly from these actions.

    Returns
    -------
    abstract_policy : ndarray of float, shape (Z, A)

    Raises
    ------
    ValueError
        If the shapes do not match.

    References
    ----------
    Freire & Costa (2015), the equation of pi_AbsProb.

    Examples
    --------
    Three states look alike; two of them want the first action.

    >>> votes = np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> induce_probabilistic(votes, np.zeros(3, int), np.ones((1, 2))).round(2)
    array([[0.67, 0.33]])
    """
    votes = count_votes(policy, rho, len(fallback))
    return _normalized(votes, fallback)


def induce_nondeterministic(
    policy: np.ndarray, rho: np.ndarray, fallback: np.ndarray
) -> np.ndarray:
    """
    Return pi_AbsND: uniform over the actions that are optimal at least once.

    Arguments, shapes and errors as for :func:`induce_probabilistic`.

    References
    ----------
    Freire & Costa (2015), the equation of pi_AbsND.

    Examples
    --------
    >>> votes = np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> induce_nondeterministic(votes, np.zeros(3, int), np.ones((1, 2)))
    array([[0.5, 0.5]])
    """
    votes = count_votes(policy, rho, len(fallback))
    return _normalized((votes > 0).astype(float), fallback)


def count_votes(policy: np.ndarray, rho: np.ndarray, n_abstract: int) -> np.ndarray:
    """
    Return the votes (Z, A): the sum of policy rows (S, A) by abstract state.

    >>> count_votes(np.array([[1.0, 0.0], [0.5, 0.5]]), np.array([1, 1]), 2)
    array([[0. , 0. ],
           [1.5, 0.5]])
    """
    policy = as_weights("policy", policy)
    rho = check_rho(rho, len(policy), n_abstract)
    votes = np.zeros((n_abstract, policy.shape[1]))
    np.add.at(votes, rho, policy)
    return votes


def _normalized(votes: np.ndarray, fallback: np.ndarray) -> np.ndarray:
    fallback = as_array("fallback", fallback, np.bool_, 2, votes.shape)
    total = votes.sum(axis=1, keepdims=True)
    share = votes / np.where(total > 0, total, 1)
    return np.where(total > 0, share, uniform_policy(fallback))
