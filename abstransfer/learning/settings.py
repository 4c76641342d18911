"""
What a learning run is asked for, and what it gives back.

The one home of its defaults and limits: each option is a field of ``Settings``, and
``LIMITS`` holds what is known of it, for whoever asks people for it (a command line,
a scene).  A wrong setting is refused by its name.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from numbers import Integral, Real
from typing import NamedTuple

import numpy as np

from ..mdp import LARGEST, MDP, check_policy, numbers

STRATEGIES = ("hard", "soft")
MOST_STEPS = 1 << 36  # so that 65536 times a number of steps is exact in a double


def whole(name: str, value, least: int = 0, most: int = MOST_STEPS) -> int:
    """
    Return a whole number within bounds, or refuse it by name; 30e6 is one.

    >>> whole("tau", 3.5e6)
    3500000
    """
    if _is_number(value) and least <= value <= most and value == int(value):
        return int(value)
    wanted = f"a whole number from {least:,} to {most:,}"
    raise ValueError(f"{name} must be {wanted}, got {value!r}")


def number(name: str, value, least: float, most: float, above: bool = False) -> float:
    """
    Return a number within bounds, or refuse it by name; `above`: least is outside.

    >>> number("alpha", 2, 0, 1, above=True)
    Traceback (most recent call last):
        ...
    ValueError: alpha must be a number above 0 and at most 1, got 2
    """
    if _is_number(value) and least <= value <= most and not (above and value == least):
        return float(value)
    wanted = f"above {least} and at most {most}" if above else f"from {least} to {most}"
    raise ValueError(f"{name} must be a number {wanted}, got {value!r}")


def choice(name: str, value, choices: tuple[str, ...]) -> str:
    """Return one of the choices, or refuse it by name."""
    if isinstance(value, str) and value in choices:
        return value
    raise ValueError(f"{name} must be one of {choices}, got {value!r}")


def exact_seed(name: str, value) -> int:
    """
    Return a seed, of any size, or refuse it by name; no float, which may be rounded.

    >>> exact_seed("seed", 2**53 + 1)
    9007199254740993
    """
    if isinstance(value, Integral) and not isinstance(value, bool) and value >= 0:
        return int(value)
    raise ValueError(f"{name} must be an int >= 0, not a float, got {value!r}")


def check(name: str, value):
    """
    Return a setting as it is kept, or refuse it by name.

    >>> check("max_episode", 1e3)
    1000
    """
    known = LIMITS[name]
    checks = {"whole": whole, "number": number, "choice": choice}
    return checks[known["kind"]](name, value, **known["limits"])


class Trace(NamedTuple):
    """The first T steps of a run."""

    state: np.ndarray  #: (T,)
    action: np.ndarray  #: (T,)
    how: np.ndarray  #: (T,) 0 the guide chose, 1 explored, 2 a largest value
    next_state: np.ndarray  #: (T,)
    reward: np.ndarray  #: (T,)
    before: np.ndarray  #: (T,) Q(state, action) before the step
    after: np.ndarray  #: (T,) and after it


class QLearningResult(NamedTuple):
    """What a run of Q-learning learned, and how often it arrived."""

    goals: np.ndarray  #: (B,) episodes that reached a terminal state, by window
    cuts: np.ndarray  #: (B,) episodes cut short, by window
    n_steps: int  #: steps of the run
    window: int  #: steps of a window; the last one may be shorter
    q: np.ndarray  #: (S, A); 0 in terminal states, -inf for masked actions
    trace: Trace  #: of the first steps
    checkpoints: np.ndarray  #: (C, S, A) Q after the steps asked for


def _option(default, kind: str, meaning: str, **limits):
    """Return a field of Settings, and what is known of it; see LIMITS."""
    known = {"default": default, "kind": kind, "limits": limits, "meaning": meaning}
    return field(default=default, metadata=known)


def _whole(default, meaning, *, least=0, most=MOST_STEPS):
    return _option(default, "whole", meaning, least=least, most=most)


def _number(default, meaning, *, least=0, most=1, above=False):
    return _option(default, "number", meaning, least=least, most=most, above=above)


@dataclass(frozen=True, eq=False)
class Settings:
    """What a run of Q-learning is, but for its luck: see ``learning.q_learning``."""

    mdp: MDP
    guide: np.ndarray | None = None  #: (S, A)
    strategy: str = _option(
        "hard", "choice", "the guide decides alone, or fades", choices=STRATEGIES
    )
    tau: int = _whole(0, "last step in which the guide has a say")
    alpha: float = _number(0.1, "learning rate", above=True)
    epsilon: float = _number(0.1, "probability of exploring")
    gamma: float = _number(0.9, "discount")
    q0: float | np.ndarray = _number(  # becomes (S, A)
        0.0, "value that all actions start from", least=-LARGEST, most=LARGEST
    )
    start: Sequence[int] | None = None  #: becomes (N,) int64
    max_episode: int = _whole(5000, "steps after which an episode is cut", least=1)
    window: int = _whole(500_000, "steps that are counted together", least=1)
    trace: int = _whole(0, "first steps that are recorded", most=10_000_000)
    checkpoints: Sequence[int] = ()

    def __post_init__(self):
        if not isinstance(self.mdp, MDP):
            kind = type(self.mdp).__name__
            raise ValueError(f"mdp must be an MDP, as in tasks.mdp, got {kind}")
        for name in LIMITS:
            if name != "q0":  # which may be an array
                self._set(name, check(name, getattr(self, name)))
        if self.guide is not None:
            self._set("guide", check_policy(self.guide, self.mdp, "guide"))
        elif self.tau:
            raise ValueError(f"tau must be 0 without a guide, got {self.tau}")
        self._set("checkpoints", _marks(self.checkpoints))
        self._set("q0", _values(self.mdp, self.q0))
        self._set("start", _start(self.mdp, self.start))

    def _set(self, name, value):
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


# What is known of each option, for JSON: its default, kind ("whole", "number" or
# "choice"), limits (least, most, above: least itself is outside; choices), meaning.
LIMITS = {f.name: dict(f.metadata) for f in fields(Settings) if f.metadata}


def _is_number(value) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)


def _marks(checkpoints) -> tuple[int, ...]:
    """Return the steps after which to keep a copy of Q."""
    if not np.iterable(checkpoints):
        raise ValueError(f"checkpoints must be a list of steps, got {checkpoints!r}")
    marks = tuple(whole("checkpoints", mark, 1) for mark in checkpoints)
    if any(a >= b for a, b in zip(marks, marks[1:], strict=False)):
        raise ValueError(f"checkpoints must increase, got {marks}")
    return marks


def _values(mdp: MDP, q0) -> np.ndarray:
    """Return the values to start from, (S, A)."""
    shape = mdp.n_states, mdp.n_actions
    values = numbers("q0", q0).astype(np.float64) + 0.0  # as rewards: no -0.0
    if values.shape not in ((), shape):
        raise ValueError(
            f"q0 must be a number or have shape {shape}, got {values.shape}"
        )
    for value in values[~(np.abs(values) <= LARGEST)].tolist():
        check("q0", value)
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
    states = numbers("start", start)
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
