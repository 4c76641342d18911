"""
Rivals that learn more of a step, or something else, each with its source.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..learning import loop
from ..learning._rng import next_word
from ..learning.loop import EXPLORED, GREEDY, LOWEST, largest, pick
from ..learning.settings import number, whole
from .choosing import epsilon_greedy, pick_sum
from .loops import Rival, part

TRAIL = 64  # steps back that q_lambda learns; a power of 2


class Shaping(NamedTuple):
    potential: np.ndarray  #: (S,)


@part
def improve_shaped(s, a, s_next, world, q, rule):
    """Add gamma Phi(s') - Phi(s) to the reward."""
    phi = rule.own.potential
    reward = world.reward[s_next] + rule.gamma * phi[s_next] - phi[s]
    target = reward + rule.gamma * largest(q, s_next)
    q[s, a] = (1.0 - rule.alpha) * q[s, a] + rule.alpha * target


def shaping(potential: np.ndarray) -> Rival:
    """
    Return potential-based shaping; `potential` (S,) is 0 in terminal states.

    It is the learner that starts from q0 = potential, step by step, but that its Q is
    less by the potential: so the bench runs that one.

    References
    ----------
    Ng, Harada & Russell (1999), Policy invariance under reward transformations, ICML.
    Wiewiora (2003), Potential-based shaping and Q-value initialization are
    equivalent, JAIR 19.
    """
    return Rival(improve=improve_shaped, memory=lambda luck: Shaping(potential))


class Trail(NamedTuple):
    steps: np.ndarray  #: (TRAIL, 2) int64: state and action, step i in row i % TRAIL
    length: np.ndarray  #: (1,) int64
    fade: float  #: gamma lambda


@part
def choose_cutting(t, s, luck, q, guide, rule):
    """Forget the trail where what is explored is not a best action."""
    a, how = epsilon_greedy(luck >> 16, luck & 0xFFFF, s, q, rule.explore)
    if how == EXPLORED and q[s, a] < largest(q, s):
        rule.own.length[0] = 0
    return a, how


@part
def improve_trail(s, a, s_next, world, q, rule):
    """Change the values of all steps of the trail, older ones less."""
    own, last = rule.own, rule.own.length[0]
    own.steps[last & (TRAIL - 1), 0], own.steps[last & (TRAIL - 1), 1] = s, a
    own.length[0] = last + 1
    surprise = world.reward[s_next] + rule.gamma * largest(q, s_next) - q[s, a]
    weight = rule.alpha
    for i in range(last, max(last - TRAIL, -1), -1):
        row = i & (TRAIL - 1)
        q[own.steps[row, 0], own.steps[row, 1]] += weight * surprise
        weight *= own.fade


@part
def restart_trail(s, world, rule, run):
    rule.own.length[0] = 0
    return loop.restart(s, world, rule, run)


def q_lambda(trace: float, gamma: float = 0.9) -> Rival:
    """
    Return Watkins's Q(lambda), lambda `trace`: a surprise goes back along the trail.

    Traces add up, fade by gamma lambda, and are cut where the action is not greedy.
    The last 64 steps have one.

    References
    ----------
    Watkins (1989), Learning from delayed rewards; as in Sutton & Barto (2018), 12.10.
    """
    fade = number("trace", trace, 0, 1) * gamma
    return Rival(
        choose_cutting,
        improve_trail,
        restart_trail,
        lambda luck: Trail(np.zeros((TRAIL, 2), np.int64), np.zeros(1, np.int64), fade),
    )


class Replay(NamedTuple):
    steps: np.ndarray  #: (M, 3) int32: state, action, next state
    count: np.ndarray  #: (1,) int64: steps stored so far, the oldest overwritten
    times: int  #: stored steps that are learned from after each step
    luck: np.ndarray  #: (4,)


@part
def improve_again(s, a, s_next, world, q, rule):
    """Learn from the step, and again from some that are stored."""
    own, n = rule.own, rule.own.count[0]
    loop.improve(s, a, s_next, world, q, rule)
    row = n % len(own.steps)
    own.steps[row, 0], own.steps[row, 1], own.steps[row, 2] = s, a, s_next
    own.count[0] = n + 1
    for _ in range(own.times):
        i = (next_word(own.luck) * min(n + 1, len(own.steps))) >> 32
        s, a, s_next = own.steps[i, 0], own.steps[i, 1], own.steps[i, 2]
        loop.improve(s, a, s_next, world, q, rule)


def replay(times: int = 1, size: int = 1_000_000) -> Rival:
    """
    Return the learner that keeps `size` steps and goes over `times` of them a step.

    They are drawn uniformly.  Its steps in the world are counted, not its thoughts.

    References
    ----------
    Lin (1992), Self-improving reactive agents, Machine Learning 8; Sutton (1990),
    Integrated architectures for learning, planning, and reacting (Dyna), ICML.
    """
    times, size = whole("times", times, 0, 1000), whole("size", size, 1, 1 << 30)
    return Rival(
        improve=improve_again,
        memory=lambda luck: Replay(
            np.zeros((size, 3), np.int32), np.zeros(1, np.int64), times, luck
        ),
    )


class Bonus(NamedTuple):
    bonus: np.ndarray  #: (S, A)
    times: np.ndarray  #: (S, A) how often each was tried
    size: float  #: C
    power: float  #: M


@part
def choose_untried(t, s, luck, q, guide, rule):
    """Be greedy for Q and a bonus, but for the share of random actions."""
    mode, field = luck >> 16, luck & 0xFFFF
    if mode < rule.explore:
        return pick(q, s, LOWEST, field), EXPLORED
    return pick_sum(q, s, rule.own.bonus, s, field), GREEDY


@part
def improve_counting(s, a, s_next, world, q, rule):
    own = rule.own
    loop.improve(s, a, s_next, world, q, rule)
    own.times[s, a] += 1
    own.bonus[s, a] = own.size / (own.times[s, a] + 1) ** own.power


def count_bonus(shape: tuple[int, int], size: float, power: float = 0.5) -> Rival:
    """
    Return the learner whose optimism decays: Q is seen as Q + C / (n + 1)^M.

    n is how often the action was tried in the state; the optimism chooses and is not
    learned.  `shape` is (S, A), C is `size`, M is `power`.

    References
    ----------
    Rashid, Peng, Boehmer & Whiteson (2020), Optimistic exploration even with a
    pessimistic initialisation, ICLR.
    """
    size, power = number("size", size, 0, 1e6), number("power", power, 0, 100)
    return Rival(
        choose_untried,
        improve_counting,
        memory=lambda luck: Bonus(np.full(shape, size), np.zeros(shape), size, power),
    )
