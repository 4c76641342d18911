"""
The learning loop made fast: equal to ``loop.learn`` to the bit.

What it does differently, each measured (benchmarks/NOTES.md):

- Beside each state's values it keeps what a step asks of them: the target they
  give to whoever arrives (reward + gamma * largest) and the set of largest ones.
  A step changes one value, so both are renewed once, off the critical path.
- Nothing is decided by a branch except the end of an episode: what would be
  guessed wrong half of the time is looked up instead.
- Three independent runs take turns, so that one computes while another waits
  for memory: all move, then all learn.  None depends on its company.
- Words are drawn in blocks, and the tables are small (``_tables``).

`guide` and `tau` may be None.  The compiler then leaves out what asks for them:
no guide: epsilon-greedy; a guide alone: it decides; guide and tau: it fades.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ._rng import STARTS, STEPS, WORD, compiled, fill, inlined, next_word
from ._simd import MIDDLE, WIDTH, count_below, put
from .loop import CUTS, GOALS

BLOCK = 256  # steps whose words are drawn at once: 4 KB, stays in the nearest cache


class FastRun(NamedTuple):
    """What changes while a run goes on."""

    q: np.ndarray  #: (8 S,) values, -inf where there is no action
    target: np.ndarray  #: (S,) reward + gamma * largest value: what arriving gives
    sets: np.ndarray  #: (2 S,) uint8, a bit an action: [2s] best, [2s + 1] allowed
    rng: np.ndarray  #: (2, 4) as in loop.Run, and so the next two
    place: np.ndarray  #: (2,)
    ended: np.ndarray  #: (2,)
    words: np.ndarray  #: (2 BLOCK,) int64


@inlined
def guided(s, field, guide):
    """Return the action that a field of 16 bits draws from the guide."""
    return count_below(guide.last, int(guide.row[s]) << 3, field)


@inlined
def choose(t, s, luck, guide, tau, tables, rule, sets):
    """Return an action; the same choice as loop.choose makes."""
    mode, field = luck >> 16, luck & 0xFFFF
    if guide is not None and tau is None:
        return guided(s, field, guide)
    faded = 0
    explore = rule.explore
    if tau is not None:
        faded = (tau - t) << 16
        explore = faded + t * explore
        mode = mode * tau
    chosen = int(sets[(s << 1) | (mode < explore)]) << 4
    size = int(tables.member[chosen + WIDTH])
    a = int(tables.member[chosen + ((field * size) >> 16)])
    if tau is not None:
        # Not a choice of two but a mask: a branch would often be guessed wrong.
        a ^= (a ^ guided(s, field, guide)) & -np.int64(mode < faded)
    return a


@inlined
def move(t, s, i, guide, tau, tables, rule, run):
    """Take step t from s with words 2i and 2i+1; return the entry of q, and s_next."""
    s &= WORD  # known not to be negative: saves the checks of negative indices
    a = choose(t, s, run.words[2 * i], guide, tau, tables, rule, run.sets)
    entry, fate, outcome = (s << 3) | a, run.words[2 * i + 1], tables.outcome
    r = int(tables.row[entry]) << 4
    k = count_below(outcome, r, fate - MIDDLE)
    return entry, (s + int(outcome[r + 8 + k])) & WORD


@inlined
def learn(entry, s_next, left, tables, rule, run):
    """Change the entry of q that led to s_next; return the place to go on from."""
    s, a = entry >> 3, entry & 7
    x = (1.0 - rule.alpha) * run.q[entry] + rule.alpha * run.target[s_next]
    largest, ties = put(run.q, s << 3, a, x)
    run.target[s] = tables.reward[s] + rule.gamma * largest
    run.sets[s << 1] = ties
    # No action is best in a terminal state.
    if run.sets[s_next << 1] == 0 or left == 1:
        return restart(s_next, tables, rule, run)
    return s_next, left - 1


@compiled
def restart(s, tables, rule, run):
    """Count the episode that ended in s; return the place where the next begins."""
    run.ended[GOALS if run.sets[s << 1] == 0 else CUTS] += 1
    word = next_word(run.rng[STARTS])
    return tables.start[(word * len(tables.start)) >> 32], rule.max_episode


@compiled
def advance_one(first, last, guide, tau, tables, rule, x):
    """Take steps `first` to `last` of one run, counted from 1."""
    s, left = x.place[0], x.place[1]
    for t in range(first, last + 1, BLOCK):
        n = min(BLOCK, last + 1 - t)
        fill(x.rng[STEPS], x.words[: 2 * n])
        for i in range(n):
            entry, s = move(t + i, s, i, guide, tau, tables, rule, x)
            s, left = learn(entry, s, left, tables, rule, x)
    x.place[0], x.place[1] = s, left


@compiled
def advance_three(first, last, guide, tau, tables, rule, x, y, z):
    """Take steps `first` to `last` of three runs, which take turns."""
    s_x, left_x = x.place[0], x.place[1]
    s_y, left_y = y.place[0], y.place[1]
    s_z, left_z = z.place[0], z.place[1]
    for t in range(first, last + 1, BLOCK):
        n = min(BLOCK, last + 1 - t)
        fill(x.rng[STEPS], x.words[: 2 * n])
        fill(y.rng[STEPS], y.words[: 2 * n])
        fill(z.rng[STEPS], z.words[: 2 * n])
        for i in range(n):
            entry_x, s_x = move(t + i, s_x, i, guide, tau, tables, rule, x)
            entry_y, s_y = move(t + i, s_y, i, guide, tau, tables, rule, y)
            entry_z, s_z = move(t + i, s_z, i, guide, tau, tables, rule, z)
            s_x, left_x = learn(entry_x, s_x, left_x, tables, rule, x)
            s_y, left_y = learn(entry_y, s_y, left_y, tables, rule, y)
            s_z, left_z = learn(entry_z, s_z, left_z, tables, rule, z)
    x.place[0], x.place[1] = s_x, left_x
    y.place[0], y.place[1] = s_y, left_y
    z.place[0], z.place[1] = s_z, left_z


@compiled
def refresh(terminal, tables, rule, run):
    """Write `target` and `sets` of all states anew from the values."""
    for s in range(len(terminal)):
        largest, ties = put(run.q, s << 3, 0, run.q[s << 3])
        run.target[s] = tables.reward[s] + rule.gamma * largest
        run.sets[s << 1] = 0 if terminal[s] else ties
