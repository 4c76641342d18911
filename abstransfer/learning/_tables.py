"""
Tables for the loops: chances as integers, and an MDP made small.

Nothing here knows a grid.  The fast loop reads one small number per state and
action: which of the distinct outcome rows applies.  A row holds up to eight
outcomes as *differences* of state numbers; in a building, where every cell has
its neighbours at the same distances, a few rows serve all tasks.
"""

from __future__ import annotations

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from ..mdp import MDP
from ._rng import WORD
from ._simd import MIDDLE, WIDTH
from .loop import Guide, World


class Tables(NamedTuple):
    """The arrays of an MDP in the form the fast loop reads."""

    row: np.ndarray  #: (8 S,) which outcome row each action has
    outcome: np.ndarray  #: (16 rows,) int32: last word - 2^31 of 8 outcomes; s_next - s
    reward: np.ndarray  #: (S,)
    start: np.ndarray  #: (N,) int64
    member: np.ndarray  #: (4096,) uint8: [16 set + i] is its i-th action, 8: its size


class FastGuide(NamedTuple):
    """A policy in the form the fast loop reads."""

    row: np.ndarray  #: (S,) which row of `last`
    last: np.ndarray  #: (8 rows,) int32: the last field that chooses each action


def integer_bounds(prob: np.ndarray, bits: int) -> np.ndarray:
    """
    Return cumulative chances in units of 2^-bits, int64 of the same shape (..., K).

    Number u in 0..2^bits-1 chooses the first k with u < bound[k].  What cannot
    happen gets no number; the last that can happen gets all the rest.

    >>> integer_bounds(np.array([0.25, 0.0, 0.75, 0.0]), 16).tolist()
    [16384, 16384, 65536, 65536]
    """
    full = 1 << bits
    bound = np.floor(np.cumsum(prob, axis=-1) * full + 0.5).astype(np.int64)
    possible = prob > 0
    later = possible[..., ::-1].cumsum(axis=-1)[..., ::-1] - possible
    return np.where(later == 0, full, np.minimum(bound, full))


def make_world(mdp: MDP, start: np.ndarray) -> World:
    """Return the tables of the plain loop; `start` holds state numbers (N,)."""
    bound = integer_bounds(mdp.prob, 32)
    return World(mdp.next_state, bound, mdp.reward, mdp.terminal, start)


def make_guide(policy: np.ndarray, terminal: np.ndarray) -> Guide:
    """Return a policy (S, A) as its distinct rows; those of terminal states go."""
    policy = np.where(terminal[:, None], 1 / policy.shape[1], policy)
    policies, which = distinct(policy)  # few: what follows is done for each once
    rows, row = distinct(integer_bounds(policies, 16))
    return Guide(row[which], rows)


def pack(mdp: MDP, start: np.ndarray) -> tuple[World, Tables | None]:
    """Return the tables of both loops; the work is done once for each MDP."""
    if mdp not in _packed:
        world = make_world(mdp, start)
        _packed[mdp] = world, pack_world(world)
    world, tables = _packed[mdp]
    return world._replace(start=start), tables and tables._replace(start=start)


_packed: WeakKeyDictionary = WeakKeyDictionary()


def pack_world(world: World) -> Tables | None:
    """Return the tables of the fast loop, or None where the MDP does not fit."""
    n_states, n_actions, _ = world.next_state.shape
    happens = np.diff(world.bound, axis=-1, prepend=0) > 0
    if n_actions > WIDTH or happens.sum(axis=-1).max() > WIDTH:
        return None
    order = np.argsort(~happens, axis=-1, kind="stable")[..., :WIDTH]
    happens, bound, next_state = (  # what happens first, the rest is not read
        np.take_along_axis(array, order, axis=-1)
        for array in (happens, world.bound, world.next_state)
    )
    rows = np.full((n_states, n_actions, 2, WIDTH), WORD - MIDDLE, np.int32)
    last, move = rows[:, :, 0, : order.shape[2]], rows[:, :, 1, : order.shape[2]]
    last[:] = np.where(happens, bound - 1, WORD) - MIDDLE
    move[:] = np.where(happens, next_state - np.arange(n_states)[:, None, None], 0)
    outcome, number = distinct(rows.reshape(-1, 2 * WIDTH))
    row = np.zeros((n_states, WIDTH), small_type(len(outcome)))
    row[:, :n_actions] = number.reshape(n_states, n_actions)
    flat = row.ravel(), outcome.ravel()
    return Tables(*flat, world.reward, world.start, _members())


def pack_guide(guide: Guide) -> FastGuide:
    """Return a guide in the form the fast loop reads."""
    last = np.full((len(guide.bound), WIDTH), (1 << 16) - 1, np.int32)
    last[:, : guide.bound.shape[1]] = guide.bound - 1
    return FastGuide(guide.row.astype(small_type(len(last))), last.ravel())


def distinct(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """
    Return the different rows of an array (N, M) and the number of each row (N,).

    >>> rows, number = distinct(np.array([[1, 2], [3, 4], [1, 2]]))
    >>> rows.tolist(), number.tolist()
    ([[1, 2], [3, 4]], [0, 1, 0])
    """
    rows = np.ascontiguousarray(rows)
    keys = rows.view(f"V{rows.shape[1] * rows.itemsize}").ravel().tolist()
    numbers = {key: number for number, key in enumerate(dict.fromkeys(keys))}
    number = np.fromiter(map(numbers.__getitem__, keys), np.int64, len(keys))
    first = np.diff(np.maximum.accumulate(number), prepend=-1) > 0
    return rows[first], number


def small_type(count: int) -> type:
    """Return a type that holds 0..count-1: two to choose from, as each compiles."""
    return np.uint8 if count <= 256 else np.int32


def _members() -> np.ndarray:
    """Return the actions of each set (a mask of 8 bits), and how many they are."""
    inside = (np.arange(256)[:, None] >> np.arange(WIDTH)) & 1
    table = np.zeros((256, 2 * WIDTH), np.uint8)
    table[:, :WIDTH] = np.argsort(1 - inside, axis=1, kind="stable")
    table[:, WIDTH] = inside.sum(axis=1)
    return table.ravel()
