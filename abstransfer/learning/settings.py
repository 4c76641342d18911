"""
What a learning run is asked for, and what it gives back.

A wrong setting is refused by its name.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..mdp import MDP, check_policy

STRATEGIES = ("hard", "soft")
MOST_STEPS = 1 << 36  # so that 65536 times a number of steps is exact in a double


class Trace(NamedTuple):
    """The first T steps of a run."""

    state: np.ndarray  # (T,)
    action: np.ndarray  # (T,)
    how: np.ndarray  # (T,) 0 the guide chose, 1 explored, 2 a largest value
    next_state: np.ndarray  # (T,)
    reward: np.ndarray  # (T,)
    before: np.ndarray  # (T,) Q(state, action) before the step
    after: np.ndarray  # (T,) and after it


class QLearningResult(NamedTuple):
    """What a run of Q-learning learned, and how often it arrived."""

    goals: np.ndarray  # (B,) episodes that reached a terminal state, by window
    cuts: np.ndarray  # (B,) episodes cut short, by window
    n_steps: int
    window: int  # steps of a window; the last one may be shorter
    q: np.ndarray  # (S, A); 0 in terminal states, -inf for masked actions
    trace: Trace  # of the first steps
    checkpoints: np.ndarray  # (C, S, A) Q after the steps asked for


@dataclass(frozen=True, eq=False)
class Settings:
    """What a run of Q-learning is, but for its luck: see ``learning.q_learning``."""

    mdp: MDP
    guide: np.ndarray | None = None  # (S, A)
    strategy: str = "hard"
    tau: int = 0
    alpha: float = 0.1
    epsilon: float = 0.1
    gamma: float = 0.9
    q0: float | np.ndarray = 0.0  # becomes (S, A)
    start: Sequence[int] | None = None  # becomes (N,) int64
    max_episode: int = 5000
    window: int = 500_000
    trace: int = 0
    checkpoints: Sequence[int] = ()

    def __post_init__(self):
        if self.strategy not in STRATEGIES:
            raise ValueError(
                f"strategy must be one of {STRATEGIES}, got {self.strategy!r}"
            )
        self._set(tau=whole("tau", self.tau, 0))
        if self.guide is not None:
            self._set(guide=check_policy(self.guide, self.mdp, "guide"))
        elif self.tau:
            raise ValueError(f"tau must be 0 without a guide, got {self.tau}")
        for name in ("alpha", "epsilon", "gamma"):
            self._set(**{name: _share(name, getattr(self, name))})
        if self.alpha == 0:
            raise ValueError("alpha must be above 0, or nothing is learned, got 0")
        for name, least in (("max_episode", 1), ("window", 1), ("trace", 0)):
            self._set(**{name: whole(name, getattr(self, name), least)})
        marks = tuple(whole("checkpoints", mark, 1) for mark in self.checkpoints)
        if any(a >= b for a, b in zip(marks, marks[1:], strict=False)):
            raise ValueError(f"checkpoints must increase, got {marks}")
        start = _start(self.mdp, self.start)
        self._set(checkpoints=marks, q0=_values(self.mdp, self.q0), start=start)

    def _set(self, **values):
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def explore(self) -> int:
        """Epsilon in 65536ths."""
        return int(self.epsilon * 65536 + 0.5)

    def next_stop(self, steps: int, last: int) -> int:
        """Return up to which step all is alike: one window, one phase, no copy."""
        marks = (self.tau, self.trace, *self.checkpoints, last)
        next_window = (steps // self.window + 1) * self.window
        return min(next_window, *(mark for mark in marks if mark > steps))


def whole(name: str, value, least: int) -> int:
    """Return a whole number within bounds, or refuse it by name; 30e6 is one."""
    number = isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
    if number and least <= value <= MOST_STEPS and value == int(value):
        return int(value)
    raise ValueError(
        f"{name} must be a whole number from {least} to 2^36, got {value!r}"
    )


def _share(name: str, value) -> float:
    """Return a number from 0 to 1, or refuse it by name."""
    if isinstance(value, (int, float, np.number)) and 0 <= value <= 1:
        return float(value)
    raise ValueError(f"{name} must be a number from 0 to 1, got {value!r}")


def _values(mdp: MDP, q0) -> np.ndarray:
    """Return the values to start from, (S, A)."""
    shape = mdp.n_states, mdp.n_actions
    values = np.asarray(q0, np.float64)
    if values.shape not in ((), shape):
        raise ValueError(
            f"q0 must be a number or have shape {shape}, got {values.shape}"
        )
    if not np.isfinite(values).all():
        raise ValueError(f"q0 must be finite, got {values[~np.isfinite(values)][0]}")
    values = np.where(mdp.allowed, values, -np.inf)
    values[mdp.terminal] = 0.0
    return values


def _start(mdp: MDP, start) -> np.ndarray:
    """Return the states an episode may start in, int64 (N,)."""
    if start is None:
        start = np.flatnonzero(~mdp.terminal)
        if not len(start):
            raise ValueError("mdp must have a state that is not terminal")
        return start
    states = np.asarray(start)
    if states.ndim != 1 or not states.size or states.dtype.kind not in "iu":
        raise ValueError(f"start must be a list of states, got {start!r}")
    outside = (states < 0) | (states >= mdp.n_states)
    if outside.any():
        wanted = f"states in 0..{mdp.n_states - 1}"
        raise ValueError(f"start must hold {wanted}, got {states[outside][0]}")
    if mdp.terminal[states].any():
        state = states[mdp.terminal[states]][0]
        raise ValueError(f"start must not hold terminal states, got {state}")
    return states.astype(np.int64)
