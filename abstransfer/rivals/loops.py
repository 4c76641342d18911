"""
The loop of page 3 with other parts in the place of its own.

``learning.loop.learn`` calls three parts by name: `choose`, `improve` and `restart`.
A rival brings those that it does otherwise, and what they remember.  Its loop is the
same code with other functions under these names, compiled for itself: it has no
switch, and the learner of the book knows of no rival.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from types import FunctionType
from typing import NamedTuple

import numpy as np

from ..learning import _rng, loop
from ..learning._runs import RunState, set_up
from ..learning.settings import QLearningResult, Settings, Trace, whole

SOURCES = sorted(Path(__file__).parent.glob("*.py"))
STAMP = sha256(_rng.STAMP + b"".join(map(Path.read_bytes, SOURCES))).digest()
# A rival makes no array while it learns: left uncounted, who holds which, the loops
# take a half to a third of the time.
compiled = partial(_rng.compiled, stamp=STAMP, _nrt=False)
part = partial(compiled, forceinline=True)  # of a rival's loop


class Rival(NamedTuple):
    """A learner, as what differs from the loop of page 3."""

    choose: Callable = loop.choose  #: (t, s, luck, q, guide, rule) -> action, how
    improve: Callable = loop.improve  #: (s, a, s_next, world, q, rule)
    restart: Callable = loop.restart  #: (s, world, rule, run) -> state, steps left
    #: makes ``rule.own``, what the parts know and remember, from luck of its own
    memory: Callable[[np.ndarray], tuple] = lambda luck: ()


PLAIN = Rival()


class Rule(NamedTuple):
    """How to learn: ``loop.Rule``, and what is the rival's own."""

    alpha: float  #: learning rate
    gamma: float  #: discount
    explore: int  #: epsilon in 65536ths
    max_episode: int  #: steps after which an episode is cut
    tau: int  #: not read by a rival that chooses otherwise
    hard: bool  #: nor this
    own: tuple  #: a NamedTuple of numbers and arrays; arrays may change


@cache
def loop_of(choose, improve, restart) -> Callable:
    """Return ``loop.learn`` with these parts in the place of its own."""
    parts = {"choose": choose, "improve": improve, "restart": restart}
    plain = getattr(loop.learn, "py_func", loop.learn)
    # A name of its own, by which the compiler keeps it apart from all others.
    name = "_".join(["learn", *(each.__name__ for each in parts.values())])
    copy = FunctionType(plain.__code__, {**plain.__globals__, **parts}, name)
    copy.__qualname__ = name
    return compiled(copy)


def learn_as(
    rival: Rival,
    mdp,
    n_steps: int,
    *,
    rng,
    on_progress: Callable[[int], None] | None = None,
    **options,
) -> QLearningResult:
    """
    Return what one run of a rival learns in `n_steps` steps.

    Luck is shared with :func:`~abstransfer.learning.q_learning`: step t draws the
    same words whoever learns.  A rival that draws more has a generator of its own.

    Parameters
    ----------
    rival : Rival
    mdp, n_steps, rng, options
        As for :func:`~abstransfer.learning.q_learning`.  A guide is handed to the
        rival, which says when it has a say.
    on_progress : callable, optional
        Called now and then with the number of steps just taken.

    Raises
    ------
    ValueError
        Naming the argument, what it must be and what it was.

    Examples
    --------
    >>> from abstransfer import MDP
    >>> mdp = MDP([[[1]], [[1]]], np.ones((2, 1, 1)), [0, 1], [False, True], 0.5)
    >>> learn_as(PLAIN, mdp, 7, rng=1).goals.tolist()
    [7]
    """
    settings, n_steps = Settings(mdp, **options), whole("n_steps", n_steps)
    setup = set_up(settings)
    run = RunState(setup, rng, settings.q0)
    seeds = np.random.SeedSequence(run.plain.rng.ravel().tolist())
    rule = Rule(*setup.rule, rival.memory(_rng.seed_state(seeds)[0]))
    learn, steps = loop_of(*rival[:3]), 0
    while steps < n_steps:
        stop = settings.next_stop(steps, n_steps)
        record = run.who[steps:], run.what[steps:]
        learn(steps + 1, stop, setup.world, setup.guide, rule, run.plain, *record)
        run.note(steps + 1, stop, settings)
        if on_progress:
            on_progress(stop - steps)
        steps = stop
    goals, cuts = np.array(run.counts, np.int64).reshape(-1, 2).T.copy()
    traced, shape = min(n_steps, settings.trace), mdp.allowed.shape
    return QLearningResult(
        goals,
        cuts,
        n_steps,
        settings.window,
        run.q[:, : shape[1]].copy(),
        Trace(*run.who[:traced].T.copy(), *run.what[:traced].T.copy()),
        np.array(run.copies).reshape(-1, *shape),
    )
