"""
The learning loop, one plain step after another.  Page 3 of the book teaches it.

This loop says what a run is.  ``_fast`` holds one that is several times faster
and equals it to the bit; tests compare the two, compiled and as plain Python.

All chances are compared as integers, so that no rounding can differ: a field of
16 bits (0..65535) chooses the action, a word of 32 bits the outcome.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ._rng import STARTS, STEPS, compiled, inlined, next_word

GUIDED, EXPLORED, GREEDY = 0, 1, 2  # how an action was chosen
GOALS, CUTS = 0, 1  # how an episode ended: at a terminal state, or cut
LOWEST = -np.finfo(np.float64).max  # not above any value but a masked action's


class World(NamedTuple):
    """The arrays of an MDP in the form the loop reads."""

    next_state: np.ndarray  #: (S, A, K) int32
    bound: np.ndarray  #: (S, A, K) int64: outcome k takes the words below bound[k]
    reward: np.ndarray  #: (S,) for reaching a state
    terminal: np.ndarray  #: (S,) bool
    start: np.ndarray  #: (N,) int64: states an episode may start in


class Guide(NamedTuple):
    """A policy in the form the loop reads."""

    row: np.ndarray  #: (S,) int64: row of `bound` that holds the state's policy
    bound: np.ndarray  #: (R, A) int64: action a takes the fields below bound[a]


class Rule(NamedTuple):
    """How to learn."""

    alpha: float  #: learning rate
    gamma: float  #: discount
    explore: int  #: epsilon in 65536ths
    max_episode: int  #: steps after which an episode is cut
    tau: int  #: the guide has a say in steps 1..tau
    hard: bool  #: it decides alone there; soft: it fades


class Run(NamedTuple):
    """What changes while a run goes on."""

    q: np.ndarray  #: (S, W) values, W >= A; 0 in terminal states, -inf if masked
    rng: np.ndarray  #: (2, 4) uint32: the generators of steps and of starts
    place: np.ndarray  #: (2,) int64: the state, the steps left before a cut
    ended: np.ndarray  #: (2,) int64: episodes that ended at a GOAL, that were CUT


@inlined
def largest(q, s):
    """Return the largest value of state s."""
    top = q[s, 0]
    for a in range(1, q.shape[1]):
        if q[s, a] > top:
            top = q[s, a]
    return top


@inlined
def pick(q, s, floor, field):
    """Return one of the actions of value >= floor, all equally likely."""
    count = 0
    for a in range(q.shape[1]):
        if q[s, a] >= floor:
            count += 1
    skip = (field * count) >> 16
    for a in range(q.shape[1]):
        if q[s, a] >= floor:
            if skip == 0:
                return a
            skip -= 1
    return 0  # where no value is a number


@inlined
def choose(t, s, luck, q, guide, rule):
    """
    Return an action for step t and how it was chosen; `luck` is a word.

    Soft: the guide decides with probability (tau - t) / tau, else epsilon-greedy
    does (Algorithm 2).  Hard: the guide decides for t <= tau (Algorithm 1).
    """
    mode, field = luck >> 16, luck & 0xFFFF
    span = max(rule.tau, t)
    guided = (span - t) << 16  # of span << 16
    if (rule.hard and t <= rule.tau) or mode * span < guided:
        a = 0
        while field >= guide.bound[guide.row[s], a]:
            a += 1
        return a, GUIDED
    if mode * span < guided + t * rule.explore:
        return pick(q, s, LOWEST, field), EXPLORED
    return pick(q, s, largest(q, s), field), GREEDY


@inlined
def improve(s, a, s_next, world, q, rule):
    """Change Q(s, a) by what the step to s_next brought: Eq. 1 of the paper."""
    target = world.reward[s_next] + rule.gamma * largest(q, s_next)
    q[s, a] = (1.0 - rule.alpha) * q[s, a] + rule.alpha * target


@inlined
def restart(s, world, rule, run):
    """Count the episode that ended in s; return where the next begins, its steps."""
    run.ended[GOALS if world.terminal[s] else CUTS] += 1
    word = next_word(run.rng[STARTS])
    return world.start[(word * len(world.start)) >> 32], rule.max_episode


@compiled
def learn(first, last, world, guide, rule, run, who, what):
    """
    Take steps `first` to `last` of a run, counted from 1; record the first few.

    who : (T, 4) int64, written: state, action, how it was chosen, next state
    what : (T, 3) float64, written: reward, value before, value after
    """
    q, (s, left) = run.q, (run.place[0], run.place[1])
    for t in range(first, last + 1):
        luck, fate = next_word(run.rng[STEPS]), next_word(run.rng[STEPS])
        a, how = choose(t, s, luck, q, guide, rule)
        k = 0
        while fate >= world.bound[s, a, k]:
            k += 1
        s_next, old = np.int64(world.next_state[s, a, k]), q[s, a]
        improve(s, a, s_next, world, q, rule)
        i = t - first
        if i < len(who):  # by entries: rows would take most of the compiler's time
            who[i, 0], who[i, 1], who[i, 2], who[i, 3] = s, a, how, s_next
            what[i, 0], what[i, 1], what[i, 2] = world.reward[s_next], old, q[s, a]
        s, left = s_next, left - 1
        if world.terminal[s] or left == 0:
            s, left = restart(s, world, rule, run)
    run.place[0], run.place[1] = s, left
