"""
The deduced abstract policy: climbing the value of an abstract policy.

AbsProb-PI looks for an abstract policy (Z, A) with a high value from a start
distribution over states (S,).  On the union MDP of several tasks it is
AbsProb-PI-multiple.  Page 6 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from ..mdp import MDP, as_array, check_choice, check_mdp
from ..policies import check_rho, uniform_policy
from ..solvers import TIE, action_values
from ._refactorize import refactorize


class Climb(NamedTuple):
    """An abstract policy that was climbed to, and the values on the way."""

    policy: np.ndarray  #: (Z, A)
    history: np.ndarray  #: (iterations + 1,) value before the first step, after each


def abstract_gradient(
    mdp: MDP,
    abstract_policy: np.ndarray,
    rho: np.ndarray,
    start: np.ndarray | None = None,
) -> tuple[float, np.ndarray, np.ndarray]:
    """
    Return the value of an abstract policy, its gradient, and visits.

    Two solves with the same matrix: V = (I - gamma P)^-1 R, and the discounted
    number of visits d^T = start^T (I - gamma P)^-1.  An abstract state gathers
    G(z, a) = gamma * sum over its states s of d(s) Q(s, a).

    Parameters
    ----------
    mdp : MDP, or a sequence of them
        Blocks of one union, whose states follow one another: their sums add up.
    abstract_policy : ndarray of float, shape (Z, A)
    rho : ndarray of int, shape (S,)
    start : ndarray of float, shape (S,), optional
        Probability of starting in each state (the paper's beta); uniform over
        all states by default.

    Returns
    -------
    value : float
        Expected discounted reward from `start`.
    gradient : ndarray of float, shape (Z, A)
        Derivative of `value` by each probability, the others held fixed.
    visits : ndarray of float, shape (Z,)
        Discounted steps spent in each abstract state, terminal states excluded.

    References
    ----------
    da Silva, Pereira & Costa (2012); Freire & Costa (2015), "Deduced Policy".

    Examples
    --------
    One step to the goal: V = -1 + 0.5 p * 0 + 0.5 (1 - p) V.

    >>> bump = MDP([[[1], [0]], [[1], [1]]], np.ones((2, 2, 1)), [-1, 0],
    ...            [False, True], 0.5)
    >>> rho, start = np.array([0, 0]), np.array([1.0, 0.0])
    >>> abstract_gradient(bump, np.array([[1.0, 0.0]]), rho, start)
    (-1.0, array([[ 0. , -0.5]]), array([1.]))
    """
    blocks = tuple(mdp) if isinstance(mdp, Iterable) else (mdp,)
    for block in blocks or (None,):
        check_mdp(block)
    ends = np.cumsum([block.n_states for block in blocks])
    abstract_policy = as_array("policy", abstract_policy, np.float64, 2)
    n_abstract, n_actions = abstract_policy.shape
    start = _start(start, int(ends[-1]))
    rho = check_rho(rho, len(start), n_abstract)
    value, gradient, visits = 0.0, np.zeros(abstract_policy.shape), np.zeros(n_abstract)
    parts = (np.split(array, ends[:-1]) for array in (rho, start))
    for block, z, begin in zip(blocks, *parts, strict=True):
        factors = refactorize(block, abstract_policy[z])
        v = factors.solve(block.reward)
        d = factors.solve(begin, "T") * ~block.terminal
        q = np.where(block.allowed, action_values(block, v), 0.0)
        entry = z[:, None] * n_actions + np.arange(n_actions)
        gain = np.bincount(entry.ravel(), (d[:, None] * q).ravel(), gradient.size)
        value += float(begin @ v)
        gradient += block.gamma * gain.reshape(gradient.shape)
        visits += np.bincount(z, d, n_abstract)
    return value, gradient, visits


def absprob_pi(
    mdp: MDP,
    rho: np.ndarray,
    possible: np.ndarray,
    *,
    initial: np.ndarray | None = None,
    start: np.ndarray | None = None,
    iterations: int = 300,
    softness: float = 0.05,
    progress: Callable[[Iterable], Iterable] = iter,
) -> Climb:
    """
    Return pi_AbsGrad, climbed by the rule of the paper's group.

    Iteration i = 1, 2, ... moves each abstract state by 1 / (1 + i) of the way
    towards its best action, made soft: `softness` is spread over all actions,
    and what falls on impossible ones is given back to the others.

    Parameters
    ----------
    mdp : MDP, or a sequence of them
        One task, the union of several, or blocks of that union.
    rho : ndarray of int, shape (S,)
    possible : ndarray of bool, shape (Z, A)
        Actions that an abstract state may use.
    initial : ndarray of float, shape (Z, A), optional
        Policy to start from; uniform over `possible` by default.
    start : ndarray of float, shape (S,), optional
        As for :func:`abstract_gradient`.
    iterations : int, default 300
    softness : float, default 0.05
    progress : callable, optional
        Wraps the iterations, for instance ``tqdm.tqdm``.

    Returns
    -------
    Climb
        Abstract states that are never visited keep their row of `initial`.

    Raises
    ------
    ValueError
        If `iterations` is negative, `softness` is outside 0..1, or `initial`
        gives no policy.

    References
    ----------
    da Silva, Pereira & Costa (2012), AbsProb-PI; Koga, Freire & Costa (2014),
    AbsProb-PI-multiple.

    Examples
    --------
    The first action leads to the goal; half the way there in one iteration.

    >>> bump = MDP([[[1], [0]], [[1], [1]]], np.ones((2, 2, 1)), [-1, 0],
    ...            [False, True], 0.5)
    >>> climb = absprob_pi(bump, np.zeros(2, int), np.ones((1, 2), bool),
    ...                    iterations=1, softness=0)
    >>> climb.policy
    array([[0.75, 0.25]])
    """
    if as_array("iterations", iterations, np.int64, 0) < 0:
        raise ValueError(f"iterations must not be negative, got {iterations}")
    if not 0 <= as_array("softness", softness, np.float64, 0) <= 1:
        raise ValueError(f"softness must lie in 0..1, got {softness}")
    possible = _possible(possible)
    policy = _initial(initial, possible)
    history = []
    for i in progress(range(1, iterations + 1)):
        value, gradient, visits = abstract_gradient(mdp, policy, rho, start)
        history.append(value)
        rows = np.flatnonzero(visits > 0)  # all others stay as they are
        ranked = np.where(possible[rows], gradient[rows], -np.inf)
        most = ranked.max(axis=1, keepdims=True)
        # The first of equally good actions: rounding must not choose among them.
        best = (ranked >= most - TIE * np.abs(most)).argmax(axis=1)
        target = possible[rows] * (softness / possible.shape[1])
        target[np.arange(len(rows)), best] += 1 - softness
        target /= target.sum(axis=1, keepdims=True)
        policy[rows] += 1 / (1 + i) * (target - policy[rows])
    history.append(abstract_gradient(mdp, policy, rho, start)[0])
    return Climb(policy, np.array(history))


def natural_ascent(
    mdp: MDP,
    rho: np.ndarray,
    possible: np.ndarray,
    *,
    initial: np.ndarray | None = None,
    start: np.ndarray | None = None,
    iterations: int = 100,
    floor: float = 0.005,
) -> Climb:
    """
    Return the policy that exact natural-gradient ascent climbs to.

    The natural gradient of a soft-max policy is the mean advantage of each
    action where it is used: p is multiplied by exp(step * advantage), up to a
    factor that the sum of 1 takes out.  The step
    grows by a fifth after a gain and halves until the value grows; no possible
    action falls below about `floor`, from which it could not return.  Arguments
    as for :func:`absprob_pi`; the history ends when no step gains any more.
    It finds local optima, so start it from several policies.

    References
    ----------
    Kakade (2001), A natural policy gradient.
    """
    possible = _possible(possible)
    if not 0 <= as_array("floor", floor, np.float64, 0) * possible.shape[1] < 1:
        raise ValueError(f"floor must lie in 0..1/A, got {floor}")
    policy = _initial(initial, possible)
    value, gradient, visits = abstract_gradient(mdp, policy, rho, start)
    history, step = [value], 0.1
    for _ in range(int(as_array("iterations", iterations, np.int64, 0))):
        mean_q = gradient / np.where(visits > 0, visits, 1)[:, None]
        used = np.where(policy > 0, mean_q, -np.inf)
        behind = used - used.max(axis=1, keepdims=True)  # <= 0: exp cannot overflow
        while step > 1e-9:
            raised = policy * np.exp(step * behind)
            raised /= raised.sum(axis=1, keepdims=True)
            raised = np.where(possible, np.maximum(raised, floor), 0.0)
            raised /= raised.sum(axis=1, keepdims=True)
            new = abstract_gradient(mdp, raised, rho, start)
            if new[0] > value:
                break
            step /= 2
        else:
            break
        policy, (value, gradient, visits), step = raised, new, 1.2 * step
        history.append(value)
    return Climb(policy, np.array(history))


def random_starts(possible: np.ndarray, n: int, *, rng) -> np.ndarray:
    """
    Return n abstract policies, uniform on the simplex of possible actions, (n, Z, A).

    Climb from each, and keep the best: AbsProb-PI finds local optima.

    >>> starts = random_starts(np.array([[True, False]]), 2, rng=0)
    >>> starts.tolist()
    [[[1.0, 0.0]], [[1.0, 0.0]]]
    """
    possible = _possible(possible)
    n = int(as_array("n", n, np.int64, 0))
    weight = np.random.default_rng(rng).exponential(size=(n, *possible.shape))
    weight *= possible
    return weight / weight.sum(axis=2, keepdims=True)


def _start(start, n_states: int) -> np.ndarray:
    """Return where episodes start, (S,); refuse what is no distribution."""
    if start is None:
        return np.full(n_states, 1 / n_states)
    start = as_array("start", start, np.float64, 1, (n_states,))
    if not (start >= 0).all() or abs(start.sum() - 1) > 1e-9:
        raise ValueError(f"start must be probabilities that sum to 1, got {start}")
    return start


def _possible(possible) -> np.ndarray:
    """Return which actions are possible, (Z, A); refuse a row without any."""
    possible = as_array("possible", possible, np.bool_, 2)
    check_choice("possible", possible)
    return possible


def _initial(initial, possible: np.ndarray) -> np.ndarray:
    """Return the policy (Z, A) to climb from; refuse what cannot be climbed."""
    if initial is None:
        return uniform_policy(possible)
    return as_array("initial", initial, np.float64, 2, possible.shape)
