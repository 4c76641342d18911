"""
Neighbours: what else one can do with the small building's knowledge, or without it.

Each method is its source, up to six settings to choose among, and a few lines that
make a learner of one of them.  ``bench`` runs them.  All that is carried from the
source to the target is in :class:`Known`; but the ceiling, no method knows more.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np

from .. import rivals  # its loops load the compiler: none is named before its use
from ..builders import abstract_policies, count_votes
from ..driving import advised
from ..experiments.problem import Problem, target_tasks
from ..experiments.surgery import best_notes
from ..navigation import navigation_tasks
from ..policies import break_ties
from ..solvers import optimal_actions, optimal_values
from .guides import make_guides

HALF = "nd-available-0.5"  # half ND, half eager


class Known:
    """What the source teaches of a problem, and the tasks to be learned."""

    def __init__(self, problem: Problem):
        self.problem, self.tasks = problem, target_tasks(problem)
        self.rho, self.shape = self.tasks.rho, self.tasks.mdp.allowed.shape
        self.options = {
            "success": problem.success,
            "unavailable": problem.unavailable,
        }

    @cached_property
    def policies(self) -> dict[str, np.ndarray]:
        """ND, and half ND half eager, (Z, A)."""
        made = make_guides(["beta-0", HALF], self.problem)
        return {"nd": made["beta-0"], "half": made[HALF]}

    def guide(self, name: str) -> np.ndarray:
        """Return one of them as the target's robot obeys it, (S, A)."""
        return advised(self.tasks, self.policies[name])

    @cached_property
    def votes(self) -> np.ndarray:
        """Votes of the source's states for their best actions, (Z, A)."""
        source = navigation_tasks(self.problem.source, **self.options)
        best = optimal_actions(source.mdp, optimal_values(source.mdp))
        return count_votes(break_ties(best, "share"), source.rho, source.n_abstract)

    @cached_property
    def library(self) -> np.ndarray:
        """One Prob for each goal of the source, (N, Z, A)."""
        n = len(self.problem.source.goals)
        return np.stack(
            [
                abstract_policies(
                    navigation_tasks(self.problem.source, keep=[i], **self.options),
                    ["prob"],
                )["prob"]
                for i in range(n)
            ]
        )

    @cached_property
    def values(self) -> dict[str, np.ndarray]:
        """
        Q* of the source by view, its mean and its largest, (Z, A) each.

        In the learner's own game; 0 for what a view rules out.  What could be done
        and was not seen has the mean of its view, or of all.
        """
        source = navigation_tasks(
            self.problem.source, reward=self.problem.reward, **self.options
        )
        there = source.available & ~source.mdp.terminal[:, None]
        best = np.where(there, best_notes(source.mdp, self.problem.gamma), 0.0)
        total, n, largest = np.zeros((3, source.n_abstract, self.shape[1]))
        np.add.at(total, source.rho, best)
        np.add.at(n, source.rho, there)
        np.maximum.at(largest, source.rho, best)
        mean = np.divide(total, n, out=np.full(n.shape, np.nan), where=n > 0)
        tables = {"mean": mean, "max": np.where(n > 0, largest, np.nan)}
        return {k: _filled(t, source.possible) for k, t in tables.items()}

    def first_notes(self, which: str, size: float) -> np.ndarray:
        """Return values by view as first notes, (S, A)."""
        return size * self.values[which][self.rho]

    @cached_property
    def ceiling(self) -> np.ndarray:
        """Q* of the target itself, (S, A)."""
        best = best_notes(self.tasks.mdp, self.problem.gamma)
        return np.where(self.tasks.mdp.allowed, best, 0.0)


@lru_cache(maxsize=2)
def known(problem: Problem) -> Known:
    """Return what is known of a problem; made once per process."""
    return Known(problem)


def _filled(table: np.ndarray, possible: np.ndarray) -> np.ndarray:
    table = np.where(possible, table, np.nan)
    n = (~np.isnan(table)).sum(axis=1, keepdims=True)
    mean = np.nansum(table, axis=1, keepdims=True) / np.maximum(n, 1)
    mean = np.where(n > 0, mean, np.nanmean(table))
    filled = np.where(possible, np.where(np.isnan(table), mean, table), 0.0)
    return np.round(filled, 6) + 0.0  # so that no machine breaks ties


class Start(NamedTuple):
    """A learner, made: the options of ``q_learning``, or a rival."""

    q0: np.ndarray | float = 0.0  #: first notes, (S, A)
    guide: np.ndarray | None = None  #: (S, A)
    strategy: str = "hard"  #: "hard" or "soft"
    tau: int = 0  #: steps in which the guide has a say
    rival: rivals.Rival | None = None  #: None: the learner of the book
    epsilon: float | None = None  #: by default the problem's


class Method(NamedTuple):
    """A method of the bench."""

    name: str  #: a plain word
    says: str  #: what it does, in some words
    source: str  #: author and year
    settings: tuple  #: from which one is chosen, by the same budget for all
    make: Callable[[Known, object, int], Start]  #: of a setting and the steps of a run
    about: str = ""  #: what a setting says


def _advice(name: str, strategy: str) -> Callable:
    def make(known: Known, tau: int, steps: int) -> Start:
        tau = round(tau * steps / 30_000_000)  # shrinks along, as in all experiments
        return Start(guide=known.guide(name), strategy=strategy, tau=tau)

    return make


def _guided(rival: Callable[..., rivals.Rival]) -> Callable:
    """Return the maker of a rival that is guided by ND."""
    return lambda known, x, _: Start(guide=known.guide("nd"), rival=rival(x))


def _potential(known: Known, size: float, _) -> Start:
    worth = known.values["mean"].max(axis=1)[known.rho]
    return Start(q0=np.repeat(size * worth[:, None], known.shape[1], axis=1))


def _prior(known: Known, setting, _) -> Start:
    alpha, epsilon = setting
    counts = known.votes + alpha
    prior = counts / counts.sum(axis=1, keepdims=True)
    rival = rivals.guided_exploration()
    return Start(guide=advised(known.tasks, prior), rival=rival, epsilon=epsilon)


def _heuristic(known: Known, eta: float, _) -> Start:
    bonus = eta * (known.policies["nd"] > 0)
    return Start(rival=rivals.heuristic(bonus, known.rho))


def _hold(known: Known, longest: int, _) -> Start:
    return Start(rival=rivals.held_label(known.rho, longest))


def _z_greedy(known: Known, setting, _) -> Start:
    mu, epsilon = setting
    return Start(rival=rivals.z_greedy(mu), epsilon=epsilon)


SHORT, LONG = "Fernandez & Veloso 2006", "Uchendu et al. 2023"
TINY = (1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2)
LOUD = (1.0, 0.3, 0.1, 0.03, 0.01, 0.001)
#: First those that are no more than first notes, or the learner of the book.
#:
#: :meta hide-value:
METHODS = (
    Method("none", "no transfer", "Watkins 1989", (None,), lambda k, x, n: Start()),
    Method(
        "ceiling",
        "Q* from the start: no transfer can know more",
        "control",
        (None,),
        lambda k, x, n: Start(q0=k.ceiling),
    ),
    Method(
        "hint",
        "first notes on what can be done",
        "control",
        TINY,
        lambda k, x, n: Start(q0=x * k.tasks.available),
        "size",
    ),
    Method(
        "whisper",
        "values by view, as first notes that only break ties",
        "this book",
        (1e-6, 1e-9, 1e-12, 1e-20, 1e-30, 1e-40),
        lambda k, x, n: Start(q0=k.first_notes("mean", x)),
        "size",
    ),
    Method(
        "values",
        "values by view as first notes",
        "Taylor & Stone 2009",
        LOUD,
        lambda k, x, n: Start(q0=k.first_notes("mean", x)),
        "size",
    ),
    Method(
        "max-values",
        "the largest value that a view had, as first notes",
        "Abel et al. 2018",
        LOUD,
        lambda k, x, n: Start(q0=k.first_notes("max", x)),
        "size",
    ),
    Method(
        "shaping",
        "the value of a view as a potential, added to the reward",
        "Ng et al. 1999",
        (1.0, 0.1, 0.01, 1e-3, 1e-6, 1e-9),
        _potential,
        "size",
    ),
    Method(
        "optimism",
        "first notes alike, large",
        "Sutton & Barto 2018",
        (1e-3, 0.01, 0.1, 0.3, 0.5, 1.0),
        lambda k, x, n: Start(q0=x),
        "q0",
    ),
    Method(
        "nd-hard",
        "ND decides for tau steps (early advising)",
        "Torrey & Taylor 2013",
        (1_000_000, 2_000_000, 3_500_000, 5_000_000, 7_000_000, 9_000_000),
        _advice("nd", "hard"),
        "tau",
    ),
    Method(
        "nd-soft",
        "ND decides less and less until tau",
        "Freire & Costa 2015",
        (2_000_000, 3_500_000, 6_000_000, 9_000_000, 11_000_000, 14_000_000),
        _advice("nd", "soft"),
        "tau",
    ),
    Method(
        "half-hard",
        "half ND, half eager, for tau steps",
        "this book",
        (1_000_000, 2_000_000, 3_000_000, 3_500_000, 5_000_000, 7_000_000),
        _advice("half", "hard"),
        "tau",
    ),
    Method(
        "prior",
        "explores by votes + alpha, for ever",
        "Rosman & Ramamoorthy 2012",
        tuple((alpha, e) for e in (0.1, 0.2) for alpha in (0.1, 1.0, 10.0)),
        _prior,
        "alpha, epsilon",
    ),
    Method(
        "reuse",
        "ND with chance psi, which fades in each episode; else epsilon-greedy",
        SHORT,
        (0.5, 0.8, 0.9, 0.95, 0.98, 0.99),
        _guided(lambda v: rivals.policy_reuse(v)),
        "v",
    ),
    Method(
        "reuse-random",
        "the same, but random with chance 1 - psi",
        SHORT,
        (0.5, 0.8, 0.9, 0.95, 0.98, 0.99),
        _guided(lambda v: rivals.policy_reuse(v, "random")),
        "v",
    ),
    Method(
        "library",
        "finds out which of eleven policies, one a goal of the source, to reuse",
        SHORT,
        tuple((v, heat) for heat in (0.05, 0.005) for v in (0.9, 0.95, 0.98)),
        lambda k, x, n: Start(rival=rivals.policy_library(k.library, k.rho, *x)),
        "v, heat",
    ),
    Method(
        "jump-random",
        "ND begins each episode, for 0..H-1 steps",
        LONG,
        (10, 20, 40, 80, 160, 320),
        _guided(lambda most: rivals.jump_start(most)),
        "H",
    ),
    Method(
        "jump-stages",
        "ND begins each episode, for H steps, and fewer as all goes well",
        LONG,
        (10, 20, 40, 80, 160, 320),
        _guided(lambda most: rivals.jump_start(most, True)),
        "H",
    ),
    Method(
        "heuristic",
        "greedy for Q + eta on what ND advises, for ever",
        "Bianchi et al. 2004",
        (1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1),
        _heuristic,
        "eta",
    ),
    Method(
        "hold",
        "a label is held until the view changes",
        "Sutton, Precup & Singh 1999",
        (2, 3, 5, 9, 20, 5000),
        _hold,
        "most steps",
    ),
    Method(
        "z-greedy",
        "who explores keeps the action for a while",
        "Dabney et al. 2021",
        tuple((mu, epsilon) for epsilon in (0.1, 0.03) for mu in (1.5, 2.0, 3.0)),
        _z_greedy,
        "mu, epsilon",
    ),
    Method(
        "decay",
        "epsilon falls in a line",
        "Sutton & Barto 2018",
        ((0.1, 0.01), (0.3, 0.01), (0.5, 0.01), (1.0, 0.01), (0.3, 0.1), (1.0, 0.1)),
        lambda k, x, n: Start(rival=rivals.decaying_epsilon(*x, n)),
        "first, last",
    ),
    Method(
        "bonus",
        "a bonus on what was tried seldom, which decays",
        "Rashid et al. 2020",
        tuple((size, power) for power in (0.5, 2.0) for size in (1e-3, 0.01, 0.1)),
        lambda k, x, n: Start(rival=rivals.count_bonus(k.shape, *x)),
        "C, M",
    ),
    Method(
        "q-lambda",
        "a surprise goes back along the trail",
        "Watkins 1989",
        (0.3, 0.5, 0.7, 0.8, 0.9, 0.95),
        lambda k, x, n: Start(rival=rivals.q_lambda(x, k.problem.gamma)),
        "lambda",
    ),
    Method(
        "replay",
        "learns again from steps that are stored",
        "Lin 1992",
        tuple((times, size) for times in (1, 2) for size in (10**4, 10**5, 10**6)),
        lambda k, x, n: Start(rival=rivals.replay(*x)),
        "times a step, stored",
    ),
)
