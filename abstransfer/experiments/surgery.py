"""
Surgery on notes: change what a robot has noted, and nothing else.

When hard advice ends, the rest of a run depends on Q alone.  So Q can be erased,
grafted or shuffled, and the robot goes on from there with the same luck.
Notes are Q, (S, A), of a learner whose rewards are 0 or more: 0 is blank.
Page 10 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array

from ..learning import Trace, q_learning, q_learning_runs
from ..mdp import MDP
from ..solvers import action_values, optimal_values


def noted(notes: np.ndarray) -> np.ndarray:
    """
    Return which states have a note above 0, (S,).

    >>> noted(np.array([[0.0, 0.1], [0.0, 0.0]])).tolist()
    [True, False]
    """
    return notes.max(axis=1) > 0


def erase(notes: np.ndarray, where: np.ndarray) -> np.ndarray:
    """
    Return the notes, blank in the states `where` (S,) is True.

    >>> erase(np.array([[0.0, 0.1], [0.2, 0.0]]), np.array([True, False])).tolist()
    [[0.0, 0.0], [0.2, 0.0]]
    """
    return graft(notes, np.where(np.isneginf(notes), notes, 0.0), where)


def graft(notes: np.ndarray, donor: np.ndarray, where: np.ndarray) -> np.ndarray:
    """
    Return the notes, with those of `donor` in the states `where` (S,) is True.

    >>> graft(np.zeros((2, 1)), np.ones((2, 1)), np.array([True, False])).tolist()
    [[1.0], [0.0]]
    """
    return np.where(np.asarray(where)[:, None], donor, notes)


def drawn(where: np.ndarray, n: int, rng: np.random.Generator) -> np.ndarray:
    """
    Return n of the states `where` (S,) is True, drawn at random, as a mask (S,).

    >>> where = np.array([True, True, False])
    >>> bool(drawn(where, 2, np.random.default_rng(0)).tolist() == where.tolist())
    True
    """
    states = np.flatnonzero(where)
    if not 0 <= n <= len(states):
        raise ValueError(f"n must lie in 0..{len(states)}, got {n}")
    mask = np.zeros(len(where), dtype=bool)
    mask[rng.choice(states, n, replace=False)] = True
    return mask


def shuffle_actions(
    notes: np.ndarray, available: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """
    Return the notes, those of each state dealt anew to its available actions.

    The directions become wrong; where there are notes, and how large, stays.

    >>> notes, available = np.array([[0.1, 0.2, 0.0]]), np.array([[1, 1, 0]], bool)
    >>> shuffle_actions(notes, available, np.random.default_rng(3)).tolist()
    [[0.2, 0.1, 0.0]]
    """
    dealt = notes.copy()
    for s in np.flatnonzero(noted(notes)):
        there = np.flatnonzero(available[s])
        dealt[s, there] = notes[s, rng.permutation(there)]
    return dealt


def shuffle_states(notes: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """
    Return the notes, whole rows dealt anew to the states that have one.

    >>> notes = np.array([[0.1], [0.0], [0.2]])
    >>> sorted(shuffle_states(notes, np.random.default_rng(0)).ravel().tolist())
    [0.0, 0.1, 0.2]
    """
    states = np.flatnonzero(noted(notes))
    dealt = notes.copy()
    dealt[states] = notes[rng.permutation(states)]
    return dealt


def directions(notes: np.ndarray, size: float = 1e-6) -> np.ndarray:
    """
    Return notes that say which actions are largest in a state, and no more.

    >>> directions(np.array([[0.1, 0.9], [0.0, 0.0]]), 1.0).tolist()
    [[0.0, 1.0], [0.0, 0.0]]
    """
    largest = (notes == notes.max(axis=1, keepdims=True)) & (notes > 0)
    return np.where(np.isneginf(notes), notes, largest * size)


@lru_cache(maxsize=2)
def best_notes(mdp: MDP, gamma: float = 0.9) -> np.ndarray:
    """
    Return Q* (S, A) of the learner's own game: what perfect notes would be.

    They are worked out once for a world, and cannot be written into.

    >>> mdp = MDP([[[1]], [[2]], [[2]]], np.ones((3, 1, 1)), [0, 0, 1],
    ...           [False, False, True], 0.99)
    >>> best_notes(mdp, 0.5).ravel().tolist()
    [0.5, 1.0, 0.0]
    """
    game = replace(mdp, gamma=gamma)
    notes = action_values(game, optimal_values(game))
    notes.flags.writeable = False
    return notes


def digest(mdp: MDP, trace: Trace, gamma: float = 0.9) -> np.ndarray:
    """
    Return the notes (S, A) of a robot that thinks its experience through.

    The steps of a trace are counted, and the values of the world so counted are
    worked out completely: what one-step learning would note if it went over the
    same experience for ever.  What was not tried stays 0.

    Examples
    --------
    The goal was reached once, at the end of three steps; one-step learning would
    note the last of them only.

    >>> mdp = MDP([[[1]], [[2]], [[3]], [[3]]], np.ones((4, 1, 1)), [0, 0, 0, 1],
    ...           [False, False, False, True], 0.99)
    >>> seen = q_learning(mdp, 3, rng=0, start=[0], trace=3)
    >>> seen.q.ravel().tolist()
    [0.0, 0.0, 0.1, 0.0]
    >>> digest(mdp, seen.trace, 0.5).ravel().tolist()
    [0.25, 0.5, 1.0, 0.0]
    """
    shape = mdp.n_states, mdp.n_actions
    pair = trace.state * mdp.n_actions + trace.action
    seen = csr_array(
        (np.ones(len(pair)), (pair, trace.next_state)),
        shape=(shape[0] * shape[1], shape[0]),
    )
    seen.sum_duplicates()
    times = seen.sum(axis=1)
    seen = seen.multiply(1 / np.maximum(times, 1)[:, None]).tocsr()
    notes, before = np.zeros(shape), None
    while before is None or not np.allclose(notes, before, rtol=1e-9, atol=0):
        before = notes
        notes = (seen @ (mdp.reward + gamma * notes.max(axis=1))).reshape(shape)
        notes[mdp.terminal] = 0.0
    return np.where(mdp.allowed | mdp.terminal[:, None], notes, -np.inf)


class Left(NamedTuple):
    """What one run's robots have noted when their advice ends; same luck for all."""

    notes: dict[str, np.ndarray]  #: Q (S, A) by guide
    digested: dict[str, np.ndarray]  #: the same experience, thought through
    best: np.ndarray  #: Q* (S, A)
    available: np.ndarray  #: (S, A) bool
    rng: np.random.Generator  #: the surgeon's luck


def leave(
    mdp: MDP,
    available: np.ndarray,
    guides: Mapping[str, np.ndarray],
    tau: int,
    *,
    seed,
    gamma: float = 0.9,
    max_episode: int = 5000,
    think: Iterable[str] = (),
    rng=0,
) -> Left:
    """
    Return what robots have noted after `tau` steps of hard advice, one a guide.

    Parameters
    ----------
    available : ndarray of bool, shape (S, A)
        Handed on to the surgeon.
    guides : dict from name to policy (S, A)
    seed : int or SeedSequence
        The luck of every robot.
    think : iterable of names
        Guides whose experience is thought through as well; it takes memory.
    rng : int, SeedSequence or Generator
        The luck of the surgeon.
    """
    think, notes, digested = set(think), {}, {}
    options = {"gamma": gamma, "tau": tau, "max_episode": max_episode}
    for name, guide in guides.items():
        trace = tau if name in think else 0
        run = q_learning(mdp, tau, rng=seed, guide=guide, trace=trace, **options)
        notes[name] = run.q
        if name in think:
            digested[name] = digest(mdp, run.trace, gamma)
    best = best_notes(mdp, gamma)
    return Left(notes, digested, best, available, np.random.default_rng(rng))


def go_on(
    mdp: MDP, tables: Iterable[np.ndarray], n_steps: int, *, seed, **options
) -> list[int]:
    """
    Return the goals of robots that go on alone, each from its notes (S, A).

    All have the same luck.  Options: see :func:`~abstransfer.learning.q_learning`.
    """
    q0s = [np.where(mdp.allowed, notes, 0.0) for notes in tables]
    seeds = [seed] * len(q0s)
    runs = q_learning_runs(mdp, n_steps, rngs=seeds, q0s=q0s, **options)
    return [int(run.goals.sum()) for run in runs]
