"""
Policies as arrays, and the two induced abstract policies of the paper.

A policy is an array (S, A) of probabilities, an abstract policy an array
(Z, A) over abstract states.  With rho (S,), the abstract state of each state,
``abstract_policy[rho]`` is a policy: grounding is indexing.
Page 5 of the book teaches this module.
"""

from __future__ import annotations

import numpy as np


def uniform_policy(mask: np.ndarray) -> np.ndarray:
    """
    Return the policy (S, A) that draws uniformly where mask (S, A) is True.

    ``mdp.allowed`` gives the paper's pi_rand, ``tasks.available`` the policy
    that wastes no step.  Rows without any True become uniform over all actions.

    >>> uniform_policy(np.array([[True, True], [False, True], [False, False]]))
    array([[0.5, 0.5],
           [0. , 1. ],
           [0.5, 0.5]])
    """
    mask = np.asarray(mask, dtype=bool)
    weight = np.where(mask.any(axis=1, keepdims=True), mask, True).astype(float)
    return weight / weight.sum(axis=1, keepdims=True)


def restrict_policy(policy: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """
    Return a policy (S, A) kept where mask (S, A) is True, rows summing to 1.

    A row that keeps nothing becomes uniform over the mask.

    >>> restrict_policy(np.array([[0.2, 0.2, 0.6]]), np.array([[True, True, False]]))
    array([[0.5, 0.5, 0. ]])
    """
    kept = np.where(mask, policy, 0.0)
    total = kept.sum(axis=1, keepdims=True)
    return np.where(
        total > 0, kept / np.where(total > 0, total, 1), uniform_policy(mask)
    )


def break_ties(optimal: np.ndarray, ties: str = "share", *, rng=None) -> np.ndarray:
    """
    Return an optimal policy (S, A), given which actions are optimal (S, A).

    Parameters
    ----------
    optimal : ndarray of bool, shape (S, A)
        From :func:`~abstransfer.solvers.optimal_actions`.
    ties : {"share", "first", "random"}
        Equally good actions share the probability, or the first of them takes
        it all, or one drawn uniformly does.
    rng : int, SeedSequence or Generator
        Needed by ``"random"``.

    Returns
    -------
    policy : ndarray of float, shape (S, A)
        Rows without optimal action (terminal states) are 0: they do not vote.

    Raises
    ------
    ValueError
        If `ties` is unknown, or ``"random"`` comes without `rng`.

    Examples
    --------
    >>> optimal = np.array([[True, False, True], [False, False, False]])
    >>> break_ties(optimal)
    array([[0.5, 0. , 0.5],
           [0. , 0. , 0. ]])
    >>> break_ties(optimal, "first")
    array([[1., 0., 0.],
           [0., 0., 0.]])
    """
    optimal = np.asarray(optimal, dtype=bool)
    if ties == "share":
        return optimal / np.maximum(optimal.sum(axis=1, keepdims=True), 1)
    if ties == "first":
        score = optimal
    elif ties == "random":
        if rng is None:
            raise ValueError('ties="random" needs rng, got None')
        score = optimal * np.random.default_rng(rng).random(optimal.shape)
    else:
        raise ValueError(f"ties must be 'share', 'first' or 'random', got {ties!r}")
    return optimal * np.eye(optimal.shape[1])[score.argmax(axis=1)]


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
        Optimal policy of the source tasks, from :func:`break_ties`.
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
    policy, rho = np.asarray(policy, dtype=float), np.asarray(rho)
    if policy.ndim != 2 or rho.shape != policy.shape[:1]:
        raise ValueError(
            "policy must have shape (S, A) and rho shape (S,), "
            f"got {policy.shape} and {rho.shape}"
        )
    outside = rho[(rho < 0) | (rho >= n_abstract)]
    if outside.size:
        raise ValueError(f"rho must lie in 0..{n_abstract - 1}, got {outside[0]}")
    votes = np.zeros((n_abstract, policy.shape[1]))
    np.add.at(votes, rho, policy)
    return votes


def beta_policy(abstract_policy: np.ndarray, beta: float) -> np.ndarray:
    """
    Return the policy proportional to p^beta where p > 0, row by row.

    beta = 0 forgets how often (ND from Prob), 1 changes nothing, infinity
    keeps the most frequent actions only.

    >>> beta_policy(np.array([[0.75, 0.25, 0.0]]), 0)
    array([[0.5, 0.5, 0. ]])
    >>> beta_policy(np.array([[0.75, 0.25, 0.0]]), 2)
    array([[0.9, 0.1, 0. ]])
    """
    if not beta >= 0:
        raise ValueError(f"beta must be at least 0, got {beta}")
    p = np.asarray(abstract_policy, dtype=float)
    ratio = p / p.max(axis=1, keepdims=True)  # in 0..1: no overflow, however large beta
    ratio[ratio > 1 - 1e-9] = 1.0  # sums of votes that differ by rounding tie
    weight = np.where(ratio > 0, ratio**beta, 0.0)
    return weight / weight.sum(axis=1, keepdims=True)


def _normalized(votes: np.ndarray, fallback: np.ndarray) -> np.ndarray:
    if np.shape(fallback) != votes.shape:
        raise ValueError(
            f"fallback must have shape {votes.shape}, got {np.shape(fallback)}"
        )
    total = votes.sum(axis=1, keepdims=True)
    share = votes / np.where(total > 0, total, 1)
    return np.where(total > 0, share, uniform_policy(fallback))
