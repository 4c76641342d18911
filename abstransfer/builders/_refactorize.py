"""Factors of I - gamma P for one policy of an MDP after another, to the same bit."""

from __future__ import annotations

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from ..mdp import MDP, check_policy

_MATRICES = WeakKeyDictionary()  # by MDP: what stays as it is from policy to policy


class Factors(NamedTuple):
    """Factors of a matrix whose columns were put into another order."""

    inner: object  #: SciPy's SuperLU
    order: np.ndarray  #: (S,) column of the matrix that became the first, the second...
    rank: np.ndarray  #: (S,) the place that each column got

    def solve(self, b: np.ndarray, trans: str = "N") -> np.ndarray:
        """Return x (S,) of M x = b, or of M^T x = b where `trans` is "T"."""
        if trans == "T":
            return self.inner.solve(b[self.order], "T")
        return self.inner.solve(b)[self.rank]


def refactorize(mdp: MDP, policy: np.ndarray) -> Factors:
    """
    Return what ``factorize(transition_matrix(mdp, policy), mdp.gamma)`` would.

    Which entries are not zero, and in which order of columns they fill up least, is
    found once: a policy that uses the same actions as the one before has the same.
    """
    matrix = _MATRICES.get(mdp)
    if matrix is None:
        matrix = _MATRICES[mdp] = _Matrix(mdp)
    return matrix.factors(check_policy(policy, mdp))


class _Layout(NamedTuple):
    """Which entries are not zero, and in which order they are factorized."""

    used: np.ndarray  #: (entries,) of all that any policy can use
    take: np.ndarray  #: those used, in their order
    row: np.ndarray  #: of each
    first: np.ndarray  #: (S + 1,) where each column begins
    order: np.ndarray  #: (S,)
    rank: np.ndarray  #: (S,)


class _Matrix:
    """I - gamma P of an MDP, column by column: all of it but the policy."""

    def __init__(self, mdp: MDP):
        # No reference to the MDP itself: it would keep both for ever.
        state, action, next_state, self.prob = mdp.transitions
        self.terminal, self.gamma, self.n_states = mdp.terminal, mdp.gamma, mdp.n_states
        self.entry = state.astype(np.intp) * mdp.n_actions + action
        place = next_state.astype(np.int64) * mdp.n_states + state
        diagonal = np.arange(mdp.n_states) * (mdp.n_states + 1)
        places, slot = np.unique(np.append(place, diagonal), return_inverse=True)
        self.slot, self.diagonal = np.split(slot, [len(place)])
        column, row = np.divmod(places, mdp.n_states)
        self.column, self.row = column, row.astype(np.int32)
        self.layout = None

    def factors(self, policy: np.ndarray) -> Factors:
        policy[self.terminal] = 0.0
        weight = policy.ravel()[self.entry] * self.prob
        data = -(self.gamma * np.bincount(self.slot, weight, len(self.row)))
        data[self.diagonal] += 1
        used, layout = data != 0, self.layout
        if layout is None or not np.array_equal(used, layout.used):
            plain = self._lay_out(used, np.arange(self.n_states))
            rank = _splu(data, plain, "COLAMD").perm_c
            self.layout = layout = self._lay_out(used, rank)
        return Factors(_splu(data, layout, "NATURAL"), layout.order, layout.rank)

    def _lay_out(self, used: np.ndarray, rank: np.ndarray) -> _Layout:
        here = np.flatnonzero(used)
        column = rank[self.column[here]]
        take = here[np.argsort(column, kind="stable")]
        size = np.bincount(column, minlength=self.n_states)
        first = np.append(0, np.cumsum(size)).astype(np.int32)
        return _Layout(used, take, self.row[take], first, np.argsort(rank), rank)


def _splu(data: np.ndarray, layout: _Layout, order: str):
    """Return SuperLU's factors, of columns in an order that it finds or takes."""
    from scipy.sparse import csc_array
    from scipy.sparse.linalg import splu

    entries = data[layout.take], layout.row, layout.first
    matrix = csc_array(entries, shape=layout.rank.shape * 2)
    return splu(matrix, order, relax=1, panel_size=1)
