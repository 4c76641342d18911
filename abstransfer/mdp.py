"""
A finite Markov decision process as arrays.

S states, A actions, K outcomes of an action.  Page 1 of the book teaches this
module; nothing here knows what a building is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

LARGEST = 1e290  # of a reward: so that no sum of discounted ones is infinite


@dataclass(frozen=True, eq=False)
class MDP:
    """
    A finite MDP <S, A, T, R> with terminal states and a discount.

    Every array is checked and copied, and its copy is read-only.

    Parameters
    ----------
    next_state : ndarray of int, shape (S, A, K)
        State that outcome k of action a in state s leads to.
    prob : ndarray of float, shape (S, A, K)
        Probability of that outcome; each ``prob[s, a]`` sums to 1.
    reward : ndarray of float, shape (S,)
        Reward for *reaching* a state (the paper's R), within -1e290..1e290.
    terminal : ndarray of bool, shape (S,)
        States that end the episode; their value is 0.
    gamma : float
        Discount, 0 <= gamma < 1.
    allowed : ndarray of bool, shape (S, A), optional
        Actions an agent may choose; all of them by default.

    Raises
    ------
    ValueError
        Naming the argument, the state and the action at fault.

    Examples
    --------
    A corridor of three cells; the last is the goal.

    >>> corridor = MDP(
    ...     next_state=[[[1]], [[2]], [[2]]],
    ...     prob=np.ones((3, 1, 1)),
    ...     reward=[0, 0, 1],
    ...     terminal=[False, False, True],
    ...     gamma=0.5,
    ... )
    >>> corridor.n_states, corridor.n_actions
    (3, 1)
    """

    next_state: np.ndarray
    prob: np.ndarray
    reward: np.ndarray
    terminal: np.ndarray
    gamma: float
    allowed: np.ndarray | None = None

    def __post_init__(self):
        next_state = as_array("next_state", self.next_state, np.int32, 3)
        n_states, n_actions, _ = next_state.shape
        prob = as_array("prob", self.prob, np.float64, 3, next_state.shape)
        reward = as_array("reward", self.reward, np.float64, 1, (n_states,))
        reward = reward + 0.0  # no -0.0: which of two zeros is larger is not defined
        terminal = as_array("terminal", self.terminal, np.bool_, 1, (n_states,))
        allowed = np.ones((n_states, n_actions), bool)
        if self.allowed is not None:
            allowed = as_array("allowed", self.allowed, np.bool_, 2, allowed.shape)
        check_rows(prob)
        outside = (next_state < 0) | (next_state >= n_states)
        _refuse_first(outside, f"next_state must lie in 0..{n_states - 1}", next_state)
        too_large = ~(np.abs(reward) <= LARGEST)
        rule = f"reward must lie in -{LARGEST:g}..{LARGEST:g}"
        _refuse_first(too_large, rule, reward)
        stuck = ~terminal & ~allowed.any(axis=1)
        _refuse_first(stuck, "allowed must leave every state an action", ~stuck)
        gamma = float(as_array("gamma", self.gamma, np.float64, 0))
        if not 0 <= gamma < 1:
            raise ValueError(f"gamma must satisfy 0 <= gamma < 1, got {self.gamma}")
        object.__setattr__(self, "gamma", gamma)
        for name, array in (
            ("next_state", next_state),
            ("prob", prob),
            ("reward", reward),
            ("terminal", terminal),
            ("allowed", allowed),
        ):
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @cached_property
    def transitions(self) -> tuple[np.ndarray, ...]:
        """Outcomes that can happen: arrays state, action, next_state, prob (E,)."""
        here = np.nonzero(self.prob)
        state, action, _ = (index.astype(np.int32) for index in here)
        arrays = state, action, self.next_state[here], self.prob[here]
        for array in arrays:
            array.flags.writeable = False
        return arrays

    @property
    def n_states(self) -> int:
        """Number of states S."""
        return self.next_state.shape[0]

    @property
    def n_actions(self) -> int:
        """Number of actions A."""
        return self.next_state.shape[1]


def check_policy(policy: np.ndarray, mdp: MDP, name: str = "policy") -> np.ndarray:
    """
    Return a policy (S, A) as floats; refuse what is none of `mdp`.

    Rows of terminal states are not read.  Raises ValueError where the shape is
    wrong, a row does not sum to 1, or an action is not allowed.
    """
    check_mdp(mdp)
    policy = as_array(name, policy, np.float64, 2, (mdp.n_states, mdp.n_actions))
    check_rows(np.where(mdp.terminal[:, None], 1 / mdp.n_actions, policy), name)
    forbidden = (policy > 0) & ~mdp.allowed & ~mdp.terminal[:, None]
    _refuse_first(forbidden, f"{name} must use allowed actions only", policy)
    return policy


def check_mdp(mdp: MDP) -> None:
    """Refuse what is no MDP: tasks, say, for their ``mdp``."""
    if not isinstance(mdp, MDP):
        kind = type(mdp).__name__
        raise ValueError(f"mdp must be an MDP, as in tasks.mdp, got {kind}")


def numbers(name: str, value) -> np.ndarray:
    """Return `value` as an array of real numbers, or refuse it by name."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        raise ValueError(f"{name} must be an array, got rows that differ") from None
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name} must hold numbers, got {array.dtype}")
    return array


def as_array(name: str, value, dtype, ndim: int, shape=None) -> np.ndarray:
    """Return a copy of `value` of this type and shape, or refuse it by name."""
    array = numbers(name, value)
    if array.ndim != ndim or 0 in array.shape or (shape and array.shape != shape):
        wanted = shape or f"{ndim} axes, none of length 0"
        raise ValueError(f"{name} must have shape {wanted}, got {array.shape}")
    with np.errstate(invalid="ignore", over="ignore"):
        converted = array.astype(dtype, order="C")
    if dtype is not np.float64 and not np.array_equal(converted, array):
        raise ValueError(f"{name} must hold {np.dtype(dtype).name}, got {array.dtype}")
    return converted


def as_weights(name: str, value, shape=None) -> np.ndarray:
    """Return a copy of `value` (N, A) as floats; refuse negative, infinite and nan."""
    weights = as_array(name, value, np.float64, 2, shape)
    bad = ~((weights >= 0) & (weights < np.inf))
    _refuse_first(bad, f"{name} must be finite and not negative", weights)
    return weights


def check_choice(name: str, weights: np.ndarray) -> None:
    """Refuse an abstract state, a row of (Z, A), that is left without an action."""
    stuck = np.flatnonzero(~weights.any(axis=1))
    if stuck.size:
        rule = f"{name} must leave every abstract state an action"
        raise ValueError(f"{rule}, but abstract state {stuck[0]} has none")


def check_rows(prob: np.ndarray, name: str = "prob") -> None:
    """Refuse the first entry below 0 or nan, and the first row not summing to 1."""
    _refuse_first(~(prob >= 0), f"{name} must not be negative or nan", prob)
    with np.errstate(over="ignore"):
        total = prob.sum(axis=-1)
    _refuse_first(np.abs(total - 1) > 1e-9, f"{name} must sum to 1 in each row", total)


def _refuse_first(bad: np.ndarray, rule: str, array: np.ndarray) -> None:
    if bad.any():
        place = tuple(np.argwhere(bad)[0].tolist())
        axes = ("state", "action", "outcome")
        where = ", ".join(f"{axis} {i}" for axis, i in zip(axes, place, strict=False))
        raise ValueError(f"{rule}: at {where} it was {array[place]}")
