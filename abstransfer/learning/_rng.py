"""
The random words of a run: two xoshiro128++ generators of 32 bits.

Step t (counted from 1) uses words 2t-2 and 2t-1 of the first generator; episode
e (counted from 0) starts with word e of the second.  So the luck of a step does
not depend on how earlier episodes went, and two arms with one seed share it.

Only 32-bit operations: the same lines run compiled, as plain Python (where the
masks keep the integers short), and in JavaScript.

Source: Blackman & Vigna (2021), Scrambled Linear Pseudorandom Number Generators,
ACM Transactions on Mathematical Software 47(4).
"""

from __future__ import annotations

from functools import partial
from hashlib import sha256
from pathlib import Path

import numpy as np
from numba import njit

# A loop holds what it calls, in whatever file that is: one stamp for all of them.
SOURCES = sorted(Path(__file__).parent.glob("*.py"))
STAMP = sha256(b"".join(map(Path.read_bytes, SOURCES))).digest()


def compiled(function, stamp=STAMP, **options):
    """
    Compile a loop when it is first called; keep it where a folder can be written.

    `stamp` says of which sources: with another one it is compiled anew.
    """
    made = njit(nogil=True, **options)(function)
    if made is not function:  # else numba is told to compile nothing
        try:
            made.enable_caching()
        except RuntimeError:  # nowhere: it is compiled at each start
            return made
        made._cache._cache_file._source_stamp = stamp  # numba's own: of one file
    return made


inlined = partial(compiled, forceinline=True)  # for the parts of a loop

WORD = 0xFFFFFFFF  # the largest word
STEPS, STARTS = 0, 1  # rows of the state of a run


def seed_state(rng) -> np.ndarray:
    """
    Return the state of both generators of a run, uint32 of shape (2, 4).

    `rng` is an int, a SeedSequence (not changed: it gives the same state again)
    or a Generator (drawn from: it gives another state each time).

    >>> seed_state(7).tolist() == seed_state(np.random.SeedSequence(7)).tolist()
    True
    """
    if isinstance(rng, np.random.Generator):
        words = rng.integers(0, WORD, size=8, dtype=np.uint32, endpoint=True)
    elif isinstance(rng, np.random.SeedSequence):
        words = rng.generate_state(8, np.uint32)
    elif isinstance(rng, (int, np.integer)) and not isinstance(rng, bool) and rng >= 0:
        words = np.random.SeedSequence(int(rng)).generate_state(8, np.uint32)
    else:
        wanted = "an int >= 0, a SeedSequence or a Generator"
        raise ValueError(f"rng must be {wanted}, got {rng!r}")
    state = words.reshape(2, 4)
    state[~state.any(axis=1), 0] = 1  # all zeros would stay zeros
    return state


@inlined
def rotate(x, k):
    """Return the 32 bits of x rotated to the left by k."""
    return np.uint32(((int(x) << k) | (int(x) >> (32 - k))) & WORD)


@inlined
def add(x, y):
    """Return x + y, of which 32 bits are kept."""
    return np.uint32((int(x) + int(y)) & WORD)


@inlined
def turn(a, b, c, d):
    """Return the word of the state (a, b, c, d) and the state after it."""
    word = add(rotate(add(a, d), 7), a)
    shifted = np.uint32((int(b) << 9) & WORD)
    c = np.uint32(c ^ a)
    d = np.uint32(d ^ b)
    b, a = np.uint32(b ^ c), np.uint32(a ^ d)
    return word, a, b, np.uint32(c ^ shifted), rotate(d, 11)


@compiled
def next_word(state):
    """
    Return the next word of a generator as an int64, and advance its state (4,).

    >>> state = np.array([1, 2, 3, 4], np.uint32)
    >>> [int(next_word(state)) for _ in range(3)]
    [641, 1573767, 3222811527]
    """
    word, a, b, c, d = turn(state[0], state[1], state[2], state[3])
    state[0], state[1], state[2], state[3] = a, b, c, d
    return np.int64(word)


@compiled
def fill(state, words):
    """Write the next words of a generator, as many as `words` (N,) holds."""
    a, b, c, d = state[0], state[1], state[2], state[3]
    for i in range(words.size):
        words[i], a, b, c, d = turn(a, b, c, d)
    state[0], state[1], state[2], state[3] = a, b, c, d
