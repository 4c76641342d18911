"""
Thousands of steps of a Markov chain, made fast: the same to the bit.

The chain of a building has two forms of order.  Its moves lead a few distances far, so
it is a few diagonals; and it falls into parts, one a task, that no move leaves.  A part
stays in the nearest cache while all of its steps are made, one part after the other.
"""

from __future__ import annotations

from functools import partial
from hashlib import sha256
from pathlib import Path

import numpy as np
from scipy.sparse import csr_array

from ..learning import _rng

STAMP = sha256(Path(__file__).read_bytes()).digest()


def steps(moves: csr_array, x: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
    """
    Return ``moves^n @ x``, and the sum of x and all that follow it, but the last.

    >>> two, all_two = steps(csr_array(np.array([[0.5, 0.5], [0, 0]])), np.ones(2), 2)
    >>> two.tolist(), all_two.tolist()
    ([0.5, 0.0], [2.0, 1.0])
    """
    row, column = moves.tocoo().coords
    distance, total = np.unique(column - row), np.zeros(len(x))
    if len(distance) * len(x) <= 2 * moves.nnz:  # most of each diagonal is filled
        share = np.zeros((len(distance), len(x)))
        share[np.searchsorted(distance, column - row), row] = moves.data
        turns = x.copy(), np.zeros(len(x))
        _by_parts(distance, share, _parts(row, column, len(x)), *turns, total, n)
        return turns[n % 2], total
    for _ in range(n):
        total += x
        x = moves @ x
    return x, total


def _parts(row: np.ndarray, column: np.ndarray, n: int) -> np.ndarray:
    """
    Return where the parts begin that no entry of a matrix (n, n) leaves, and n.

    >>> _parts(np.array([0, 1, 2]), np.array([0, 2, 1]), 3).tolist()
    [0, 1, 3]
    """
    over = np.zeros(n + 1, np.int64)  # entries that join s - 1 to s, as differences
    np.add.at(over, np.minimum(row, column) + 1, 1)
    np.add.at(over, np.maximum(row, column) + 1, -1)
    return np.append(np.flatnonzero(over.cumsum()[:n] == 0), n)


@partial(_rng.compiled, stamp=STAMP)
def _by_parts(distance, share, first, x, other, total, n):
    """
    Take n steps from x (S,), by turns into `other` and into x; add up in `total`.

    share : (K, S), of state s + distance[k] in what s comes to
    """
    for part in range(len(first) - 1):
        low, high = first[part], first[part + 1]
        now, then, sums = x[low:high], other[low:high], total[low:high]
        size = high - low
        for _ in range(n):
            # Counted by the length of what is read: so several are done at once.
            for i in range(len(now)):
                sums[i] += now[i]
                then[i] = 0.0
            for k in range(len(distance)):
                far = distance[k]
                a = max(0, -far)
                b = max(a, min(size, size - far))
                weight, here = share[k, low + a : low + b], then[a:b]
                there = now[a + far : b + far]
                for i in range(len(here)):
                    here[i] += weight[i] * there[i]
            now, then = then, now
