"""
Policies as arrays: uniform, restricted, optimal with ties broken, and the dial beta.

A policy is an array (S, A) of probabilities, an abstract policy an array
(Z, A) over abstract states.  With rho (S,), the abstract state of each state,
``abstract_policy[rho]`` is a policy: grounding is indexing.
Pages 2 and 5 of the book teach this module.
"""

from __future__ import annotations

import numpy as np

from .mdp import as_array, as_weights, check_choice


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
    mask = as_array("mask", mask, np.bool_, 2)
    weight = np.where(mask.any(axis=1, keepdims=True), mask, True).astype(float)
    return weight / weight.sum(axis=1, keepdims=True)


def restrict_policy(policy: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """
    Return a policy (S, A) kept where mask (S, A) is True, rows summing to 1.

    A row that keeps nothing becomes uniform over the mask.

    >>> restrict_policy(np.array([[0.2, 0.2, 0.6]]), np.array([[True, True, False]]))
    array([[0.5, 0.5, 0. ]])
    """
    policy = as_weights("policy", policy)
    mask = as_array("mask", mask, np.bool_, 2, policy.shape)
    kept = np.where(mask, policy, 0.0)
    total = kept.sum(axis=1, keepdims=True)
    return np.where(
        total > 0, kept / np.where(total > 0, total, 1), uniform_policy(mask)
    )


def ground(advice: np.ndarray, rho: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """
    Return the policy (S, M) over moves that advice over labels asks for.

    A label's chance is shared by the moves that carry it; labels that nothing
    carries are left out, and the rest sums to 1.  Where nothing remains, the
    moves that carry a label share the chance.

    Parameters
    ----------
    advice : ndarray of float, shape (Z, L)
        An abstract policy whose actions are labels.
    rho : ndarray of int, shape (S,)
        Abstract state of each state.
    labels : ndarray of int, shape (S, M)
        The label that each move carries, below 0 for a move that leads nowhere.

    Raises
    ------
    ValueError
        If a label is not one of the advice's.

    References
    ----------
    The experiment files of the paper's group (2012) hold their abstract policies
    in this form: chances of North, South, East and West.

    Examples
    --------
    Two moves carry label 0, one carries label 1, and the fourth is a wall.

    >>> ground(np.array([[0.5, 0.5]]), np.array([0]), np.array([[0, 0, 1, -1]]))
    array([[0.25, 0.25, 0.5 , 0.  ]])
    """
    advice = as_weights("advice", advice)
    labels = as_array("labels", labels, np.int64, 2)
    rho = check_rho(rho, len(labels), len(advice))
    if labels.max(initial=-1) >= advice.shape[1]:
        raise ValueError(f"labels must lie below {advice.shape[1]}, got {labels.max()}")
    carries = labels[:, :, None] == np.arange(advice.shape[1])  # (S, M, L)
    carriers = np.maximum(carries.sum(axis=1), 1)  # (S, L)
    moves = (carries * (advice[rho] / carriers)[:, None, :]).sum(axis=2)
    return restrict_policy(moves, labels >= 0)


def spoken(policy: np.ndarray, labels: np.ndarray, n_labels: int) -> np.ndarray:
    """
    Return what a policy (S, M) over moves says in labels, (S, L).

    Each move hands its chance to the label (S, M) it carries.  So the best moves
    of a robot with a compass can vote for advice that needs none.

    >>> spoken(np.array([[0.5, 0.0, 0.5, 0.0]]), np.array([[0, 0, 1, -1]]), 2)
    array([[0.5, 0.5]])
    """
    policy = as_weights("policy", policy)
    labels = as_array("labels", labels, np.int64, 2, policy.shape)
    carries = labels[:, :, None] == np.arange(n_labels)
    return (carries * policy[:, :, None]).sum(axis=1)


def check_rho(rho: np.ndarray, n_states: int, n_abstract: int) -> np.ndarray:
    """Return the abstract state of each state, (S,); refuse any outside 0..Z-1."""
    rho = as_array("rho", rho, np.int64, 1, (n_states,))
    outside = rho[(rho < 0) | (rho >= n_abstract)]
    if outside.size:
        raise ValueError(f"rho must lie in 0..{n_abstract - 1}, got {outside[0]}")
    return rho


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
    optimal = as_array("optimal", optimal, np.bool_, 2)
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
    beta = as_array("beta", beta, np.float64, 0)
    if not beta >= 0:
        raise ValueError(f"beta must be at least 0, got {beta}")
    p = as_weights("abstract_policy", abstract_policy)
    check_choice("abstract_policy", p)
    ratio = p / p.max(axis=1, keepdims=True)  # in 0..1: no overflow, however large beta
    ratio[ratio > 1 - 1e-9] = 1.0  # sums of votes that differ by rounding tie
    weight = np.where(ratio > 0, ratio**beta, 0.0)
    return weight / weight.sum(axis=1, keepdims=True)
