"""
Q-learning, alone or guided by a policy.  Pages 3, 8 and 9 of the book teach it.

Every step changes one value (Eq. 1 of Freire & Costa, 2015; the sums in this order):

    Q(s, a) <- (1 - alpha) Q(s, a) + alpha (r + gamma max_b Q(s', b))

Without a guide the action is epsilon-greedy, ties between largest values broken
at random, all alike.  A guide is any policy; it decides in steps t = 1..tau,
alone (``hard``, Algorithm 1) or with probability (tau - t) / tau, else
epsilon-greedy does (``soft``, Algorithm 2).  Nothing here knows a grid.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from ..mdp import MDP
from .settings import MOST_STEPS, QLearningResult, Settings, Trace, whole

__all__ = ["Learner", "QLearningResult", "Trace", "q_learning", "q_learning_runs"]


def q_learning(
    mdp: MDP,
    n_steps: int,
    *,
    rng,
    guide=None,
    strategy=Settings.strategy,
    tau=Settings.tau,
    alpha=Settings.alpha,
    epsilon=Settings.epsilon,
    gamma=Settings.gamma,
    q0=Settings.q0,
    start=None,
    max_episode=Settings.max_episode,
    window=Settings.window,
    trace=Settings.trace,
    checkpoints=(),
) -> QLearningResult:
    """
    Return what one run of Q-learning learns in `n_steps` steps.

    Parameters
    ----------
    mdp : MDP
        Its own discount is not read: `gamma` below is the learner's.
    n_steps : int
    rng : int, SeedSequence or Generator
        The same seed gives the same run to the bit, on any machine.
    guide : ndarray of float, shape (S, A)
        Any policy; ``abstract_policy[rho]`` for instance.
    strategy : {"hard", "soft"}
    tau : int
        Last step in which the guide has a say.
    alpha : float
        Learning rate, 0 < alpha <= 1.
    epsilon : float
        Share of random actions, rounded to 1/65536 as the guide's probabilities.
    gamma : float
        Discount, 0 <= gamma <= 1.
    q0 : float or ndarray of shape (S, A)
        Values to start from, within -1e290..1e290 as rewards.  A step adds at most
        the largest reward r to the largest value: ``|Q| <= |q0| + 2^36 |r| < 1e301``,
        whatever alpha and gamma, and Q stays finite.
    start : ndarray of int
        States an episode starts in, all equally likely; by default, all states
        that are not terminal.
    max_episode : int
        Steps after which an episode is cut.  That is no goal, and its last step
        is learned from as any other.
    window : int
        Steps that are counted together.
    trace : int
        How many first steps to record.
    checkpoints : increasing ints
        Steps after which to keep a copy of Q.

    Raises
    ------
    ValueError
        Naming the argument, what it must be and what it was, before any step.
        Limits and defaults stand in ``learning.settings``.

    Examples
    --------
    Three cells in a row, the last is the goal: from the first it takes two steps,
    so steps 1..5 hold two goals and steps 6..10 three.

    >>> corridor = MDP(
    ...     next_state=[[[1]], [[2]], [[2]]],
    ...     prob=np.ones((3, 1, 1)),
    ...     reward=[0, 0, 1],
    ...     terminal=[False, False, True],
    ...     gamma=0.5,
    ... )
    >>> result = q_learning(corridor, 10, start=[0], alpha=1, window=5, rng=0)
    >>> result.goals.tolist()
    [2, 3]
    >>> result.q.ravel().tolist()
    [0.9, 1.0, 0.0]
    """
    options = {
        name: value
        for name, value in locals().items()
        if name not in ("mdp", "n_steps", "rng")
    }
    return q_learning_runs(mdp, n_steps, rngs=[rng], **options)[0]


def q_learning_runs(
    mdp: MDP,
    n_steps: int,
    *,
    rngs: Iterable,
    q0s: Iterable[float | np.ndarray] | None = None,
    on_progress: Callable[[int], None] | None = None,
    **options,
) -> list[QLearningResult]:
    """
    Return what independent runs learn, one for each of `rngs`.

    A run's result does not depend on its company, but three runs take half the
    time together: give them by threes.  `q0s` are the values to start from, one
    number or table (S, A) a run, in place of `q0`.  Options: see :func:`q_learning`.
    """
    learner = Learner(mdp, rngs=rngs, q0s=q0s, **options)
    learner.advance(n_steps, on_progress=on_progress)
    return learner.results()


class Learner:
    """
    Runs of Q-learning that advance together, as far and as often as asked.

    However the steps are divided among calls of :meth:`advance`, the results are
    the same to the bit.  Options: see :func:`q_learning`.

    >>> mdp = MDP([[[1]], [[1]]], np.ones((2, 1, 1)), [0, 1], [False, True], 0.5)
    >>> learner = Learner(mdp, rngs=[1, 2])
    >>> learner.advance(3)
    >>> learner.advance(4)
    >>> [int(result.goals.sum()) for result in learner.results()]
    [7, 7]
    """

    def __init__(self, mdp: MDP, *, rngs: Iterable, q0s=None, **options):
        self.settings = Settings(mdp, **options)
        self.n_steps = 0  # that each run has taken, or still owes
        seeds = list(rngs) if np.iterable(rngs) else []
        if not seeds:
            raise ValueError(f"rngs must hold at least one seed, got {rngs!r}")
        tables = [self.settings.q0] * len(seeds)
        if q0s is not None:
            tables = [replace(self.settings, q0=table).q0 for table in q0s]
        if len(tables) != len(seeds):
            raise ValueError(
                f"q0s must hold one table a run, {len(seeds)}, got {len(tables)}"
            )
        from . import _runs  # not before the first run: it loads the compiler

        _runs.say_if_compiling()
        setup, runs = _runs.set_up(self.settings), list(zip(seeds, tables, strict=True))
        parts = [runs[i : i + 3] for i in range(0, len(runs), 3)]
        self._parts = [_runs.Together(setup, part) for part in parts]

    def advance(
        self, n_steps: int, *, on_progress: Callable[[int], None] | None = None
    ) -> None:
        """
        Let each run take `n_steps` further steps.

        `on_progress` is called now and then with the number of steps just taken,
        summed over the runs.  If it raises, ``advance(0)`` takes the steps owed.
        """
        self.n_steps += whole("n_steps", n_steps, 0, MOST_STEPS - self.n_steps)
        for part in self._parts:
            while part.n_steps < self.n_steps:
                taken = part.advance(self.n_steps)
                if on_progress:
                    on_progress(taken)

    def results(self) -> list[QLearningResult]:
        """Return what each run learned so far."""
        runs = [(part.n_steps, run) for part in self._parts for run in part.runs]
        return [self._result(*run) for run in runs]

    def _result(self, n_steps: int, run) -> QLearningResult:
        shape = self.settings.mdp.allowed.shape
        goals, cuts = np.array(run.counts, np.int64).reshape(-1, 2).T.copy()
        traced = min(n_steps, self.settings.trace)
        state, action, how, next_state = run.who[:traced].T.copy()
        return QLearningResult(
            goals,
            cuts,
            n_steps,
            self.settings.window,
            run.q[:, : shape[1]].copy(),
            Trace(state, action, how, next_state, *run.what[:traced].T.copy()),
            np.array(run.copies).reshape(-1, *shape),
        )
