"""
Rivals that choose otherwise, each a few lines, with its source.

`luck` is a word of 32 bits: its upper half, `mode`, says who decides, its lower
half, `field`, which action.  Values are learned as in ``loop.improve``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..learning import loop
from ..learning._rng import next_word
from ..learning._tables import integer_bounds
from ..learning.loop import EXPLORED, GREEDY, GUIDED, LOWEST, largest, pick
from ..learning.settings import choice, number, whole
from .loops import Rival, part

HELD = 3  # how an action was chosen: before, and it is kept
ALL = 1 << 16  # numbers that a mode can be
LONGEST = 1000  # steps for which z_greedy may hold an action


@part
def epsilon_greedy(mode, field, s, q, explore):
    """Return an action: any if mode < explore, else one of largest value."""
    if mode < explore:
        return pick(q, s, LOWEST, field), EXPLORED
    return pick(q, s, largest(q, s), field), GREEDY


@part
def obey(field, bound):
    """Return the action that a field draws from a row of chances (A,)."""
    a = 0
    while field >= bound[a]:
        a += 1
    return a


@part
def pick_sum(q, s, extra, row, field):
    """Return one of the actions for which q[s] + extra[row] is largest."""
    top, count = q[s, 0] + extra[row, 0], 0
    for a in range(extra.shape[1]):
        top = max(top, q[s, a] + extra[row, a])
    for a in range(extra.shape[1]):
        count += q[s, a] + extra[row, a] == top
    skip = (field * count) >> 16
    for a in range(extra.shape[1]):
        if q[s, a] + extra[row, a] == top:
            if skip == 0:
                return a
            skip -= 1
    return 0  # where no value is a number


# The guide explores, for ever.


@part
def choose_by_prior(t, s, luck, q, guide, rule):
    """Explore as the guide says."""
    mode, field = luck >> 16, luck & 0xFFFF
    if mode < rule.explore:
        return obey(field, guide.bound[guide.row[s]]), EXPLORED
    return pick(q, s, largest(q, s), field), GREEDY


def guided_exploration() -> Rival:
    """
    Return the learner that draws from an action prior when it explores, for ever.

    References
    ----------
    Rosman & Ramamoorthy (2012), What good are actions? Accelerating learning using
    learned action priors, ICDL.
    """
    return Rival(choose_by_prior)


# A policy is reused at the start of each episode.


class Reuse(NamedTuple):
    psi: np.ndarray  #: (1,) chance that the policy decides in this step
    fade: float  #: v, which psi is multiplied by in every step


@part
def choose_reusing(t, s, luck, q, guide, rule):
    """With chance psi obey, else be epsilon-greedy; psi fades."""
    mode, field, psi = luck >> 16, luck & 0xFFFF, rule.own.psi[0]
    rule.own.psi[0] = psi * rule.own.fade
    if mode < psi * ALL:
        return obey(field, guide.bound[guide.row[s]]), GUIDED
    return epsilon_greedy(mode, field, s, q, psi * ALL + (1 - psi) * rule.explore)


@part
def choose_reusing_or_any(t, s, luck, q, guide, rule):
    """With chance psi obey, else explore with chance 1 - psi, which grows."""
    mode, field, psi = luck >> 16, luck & 0xFFFF, rule.own.psi[0]
    rule.own.psi[0] = psi * rule.own.fade
    if mode < psi * ALL:
        return obey(field, guide.bound[guide.row[s]]), GUIDED
    return epsilon_greedy(mode, field, s, q, psi * ALL + (1 - psi) * (1 - psi) * ALL)


@part
def restart_reusing(s, world, rule, run):
    rule.own.psi[0] = 1.0
    return loop.restart(s, world, rule, run)


def policy_reuse(fade: float = 0.95, rest: str = "greedy") -> Rival:
    """
    Return pi-reuse of the guide: psi is 1 when an episode starts, and fades.

    The rest is epsilon-greedy (``"greedy"``), or random with chance 1 - psi
    (``"random"``): the sources can be read either way.

    References
    ----------
    Fernandez & Veloso (2006), Probabilistic policy reuse in a reinforcement learning
    agent, AAMAS.
    """
    fade = number("fade", fade, 0, 1)
    choosers = {"greedy": choose_reusing, "random": choose_reusing_or_any}
    return Rival(
        choosers[choice("rest", rest, tuple(choosers))],
        restart=restart_reusing,
        memory=lambda luck: Reuse(np.ones(1), fade),
    )


class Library(NamedTuple):
    psi: np.ndarray  #: (1,) as in Reuse
    fade: float  #: v, as in Reuse
    rho: np.ndarray  #: (S,) abstract state
    bound: np.ndarray  #: (N, Z, A) chances of N policies, in 65536ths
    who: np.ndarray  #: (2,) policy of this episode, N for none; steps in it
    worth: np.ndarray  #: (N + 1,) mean return of its episodes
    used: np.ndarray  #: (N + 1,) number of its episodes
    share: np.ndarray  #: (N + 1,) exp of its worth times heat
    heat: np.ndarray  #: (2,) how much the worth counts; by how much that grows
    luck: np.ndarray  #: (4,)


@part
def choose_from_library(t, s, luck, q, guide, rule):
    own, mode, field = rule.own, luck >> 16, luck & 0xFFFF
    own.who[1] += 1
    if own.who[0] == len(own.bound):
        return epsilon_greedy(mode, field, s, q, rule.explore)
    psi = own.psi[0]
    own.psi[0] = psi * own.fade
    a = obey(field, own.bound[own.who[0], own.rho[s]])
    if mode < psi * ALL and q[s, a] >= LOWEST:
        return a, GUIDED
    return epsilon_greedy(mode, field, s, q, psi * ALL + (1 - psi) * rule.explore)


@part
def restart_from_library(s, world, rule, run):
    """Note what the policy's episode returned; draw the next by softmax of worth."""
    own, k = rule.own, rule.own.who[0]
    gained = rule.gamma ** (own.who[1] - 1) if world.terminal[s] else 0.0
    own.used[k] += 1
    own.worth[k] += (gained - own.worth[k]) / own.used[k]
    own.heat[0] += own.heat[1]
    best = total = 0.0
    for k in range(len(own.worth)):
        best = max(best, own.worth[k])
    for k in range(len(own.worth)):
        own.share[k] = np.exp(own.heat[0] * (own.worth[k] - best))
        total += own.share[k]
    left, k = total * next_word(own.luck) / 2.0**32, 0
    while k < len(own.share) - 1 and left >= own.share[k]:
        left -= own.share[k]
        k += 1
    own.who[0], own.who[1], own.psi[0] = k, 0, 1.0
    return loop.restart(s, world, rule, run)


def policy_library(
    policies: np.ndarray, rho: np.ndarray, fade: float = 0.95, heat: float = 0.05
) -> Rival:
    """
    Return PRQ-learning: it finds out which policy of a library to reuse.

    Each episode reuses one of `policies` (N, Z, A), or none, drawn by softmax of
    the mean discounted return of their episodes so far; how much that counts grows
    by `heat` an episode.  Without one it is epsilon-greedy; the source is greedy.
    `rho` is the abstract state of each state, (S,).

    References
    ----------
    Fernandez & Veloso (2006), Probabilistic policy reuse in a reinforcement learning
    agent, AAMAS.
    """
    fade, heat = number("fade", fade, 0, 1), number("heat", heat, 0, 1e6)
    bound, n = integer_bounds(policies, 16), len(policies)
    return Rival(
        choose_from_library,
        restart=restart_from_library,
        memory=lambda luck: Library(
            *(np.ones(1), fade, rho, bound, np.array([n, 0])),
            *np.zeros((3, n + 1)),
            *(np.array([0.0, heat]), luck),
        ),
    )


# The guide begins each episode.


class Jump(NamedTuple):
    left: np.ndarray  #: (1,) steps that the guide still has in this episode
    most: int  #: H
    stage: np.ndarray  #: (1,) stages still to come; 0: the guide has no say
    stages: int  #: in all
    arrived: np.ndarray  #: (3,) episodes and goals since the last look; best share
    luck: np.ndarray  #: (4,)


EPISODES, TOLERANCE = 100, 0.05  # between two looks; how much worse is as good


@part
def choose_jumping(t, s, luck, q, guide, rule):
    mode, field, left = luck >> 16, luck & 0xFFFF, rule.own.left
    if left[0] > 0:
        left[0] -= 1
        return obey(field, guide.bound[guide.row[s]]), GUIDED
    return epsilon_greedy(mode, field, s, q, rule.explore)


@part
def restart_at_random(s, world, rule, run):
    """Give the guide 0..H-1 steps, all equally likely."""
    own = rule.own
    own.left[0] = (next_word(own.luck) * own.most) >> 32
    return loop.restart(s, world, rule, run)


@part
def restart_by_stage(s, world, rule, run):
    """Give the guide fewer steps once arrivals are about as good as they were."""
    own, seen = rule.own, rule.own.arrived
    seen[0] += 1
    seen[1] += world.terminal[s]
    if seen[0] == EPISODES:
        if seen[1] >= (1 - TOLERANCE) * seen[2]:
            own.stage[0] = max(own.stage[0] - 1, 0)
        seen[0], seen[1], seen[2] = 0, 0, max(seen[1], seen[2])
    own.left[0] = own.most * own.stage[0] // own.stages
    return loop.restart(s, world, rule, run)


def jump_start(most: int, curriculum: bool = False, stages: int = 10) -> Rival:
    """
    Return jump-start: in each episode the guide acts first, then the learner.

    For a number of steps drawn from 0..most-1; or, in a curriculum, for `most` at
    first and one stage less whenever, of 100 episodes, no fewer arrived than 0.95
    of the best such share.  The source looks at 100 episodes without exploring,
    which cost it nothing; here they are the learner's own.

    References
    ----------
    Uchendu et al. (2023), Jump-start reinforcement learning, ICML.
    """
    most, stages = whole("most", most, 1), whole("stages", stages, 1)
    return Rival(
        choose_jumping,
        restart=restart_by_stage if curriculum else restart_at_random,
        memory=lambda luck: Jump(
            *(np.array([most]), most, np.array([stages]), stages, np.zeros(3), luck)
        ),
    )


# A bonus on what is advised.


class Heuristic(NamedTuple):
    rho: np.ndarray  #: (S,) abstract state
    bonus: np.ndarray  #: (Z, A)


@part
def choose_by_heuristic(t, s, luck, q, guide, rule):
    mode, field, own = luck >> 16, luck & 0xFFFF, rule.own
    if mode < rule.explore:
        return pick(q, s, LOWEST, field), EXPLORED
    return pick_sum(q, s, own.bonus, own.rho[s], field), GREEDY


def heuristic(bonus: np.ndarray, rho: np.ndarray) -> Rival:
    """
    Return HAQL: greedy for Q + H, where H is `bonus` (Z, A) by abstract state rho (S,).

    H is written once, while Q is 0: max Q - Q + eta is eta on what is advised.

    References
    ----------
    Bianchi, Ribeiro & Costa (2004), Heuristically accelerated Q-learning: a new
    approach to speed up reinforcement learning, SBIA.
    """
    return Rival(choose_by_heuristic, memory=lambda luck: Heuristic(rho, bonus))


# An action is held.


class Held(NamedTuple):
    kept: np.ndarray  #: (3,) action, steps that it is kept for, view it was chosen in
    rho: np.ndarray  #: (S,) abstract state
    longest: int  #: steps for which an action is kept at most
    bound: np.ndarray  #: (N,) words below bound[n] hold for n further steps, or fewer
    luck: np.ndarray  #: (4,)


@part
def choose_holding(t, s, luck, q, guide, rule):
    """Keep what was chosen until the view changes."""
    kept, rho = rule.own.kept, rule.own.rho
    if kept[1] > 0 and rho[s] == kept[2] and q[s, kept[0]] >= LOWEST:
        kept[1] -= 1
        return kept[0], HELD
    a, how = epsilon_greedy(luck >> 16, luck & 0xFFFF, s, q, rule.explore)
    kept[0], kept[1], kept[2] = a, rule.own.longest - 1, rho[s]
    return a, how


@part
def choose_z_greedy(t, s, luck, q, guide, rule):
    """Keep what was explored for a number of steps."""
    own, kept = rule.own, rule.own.kept
    if kept[1] > 0 and q[s, kept[0]] >= LOWEST:
        kept[1] -= 1
        return kept[0], HELD
    a, how = epsilon_greedy(luck >> 16, luck & 0xFFFF, s, q, rule.explore)
    if how == EXPLORED:
        word, n = next_word(own.luck), 0
        while word >= own.bound[n]:
            n += 1
        kept[0], kept[1] = a, n
    return a, how


@part
def restart_free(s, world, rule, run):
    rule.own.kept[1] = 0
    return loop.restart(s, world, rule, run)


def held_label(rho: np.ndarray, longest: int = 5000) -> Rival:
    """
    Return the learner with options: a label is held until the view, rho (S,), changes.

    Or for `longest` steps: a label that is not there would change no view.  Every
    step is learned from as any other (no value of whole options).

    References
    ----------
    Sutton, Precup & Singh (1999), Between MDPs and semi-MDPs, Artificial
    Intelligence 112.
    """
    longest = whole("longest", longest, 1)
    nothing = np.zeros(0, np.int64)
    return Rival(
        choose_holding,
        restart=restart_free,
        memory=lambda luck: Held(np.zeros(3, np.int64), rho, longest, nothing, luck),
    )


def z_greedy(mu: float = 2.0) -> Rival:
    """
    Return epsilon-z-greedy: who explores keeps the action for n steps.

    n is drawn with chances that fall as n^-mu, up to 1,000.

    References
    ----------
    Dabney, Ostrovski & Barreto (2021), Temporally-extended epsilon-greedy
    exploration, ICLR.
    """
    chance = np.arange(1, LONGEST + 1) ** -number("mu", mu, 0, 100)
    bound = integer_bounds(chance / chance.sum(), 32)
    nothing = np.zeros(0, np.int64)
    return Rival(
        choose_z_greedy,
        restart=restart_free,
        memory=lambda luck: Held(np.zeros(3, np.int64), nothing, 0, bound, luck),
    )


# Epsilon falls.


class Decay(NamedTuple):
    first: float  #: epsilon of the first step
    last: float  #: epsilon of step `until` and later
    until: int  #: step from which epsilon stays


@part
def choose_decaying(t, s, luck, q, guide, rule):
    own = rule.own
    epsilon = own.first + (own.last - own.first) * min(t / own.until, 1.0)
    return epsilon_greedy(luck >> 16, luck & 0xFFFF, s, q, epsilon * ALL)


def decaying_epsilon(first: float, last: float, until: int) -> Rival:
    """
    Return the learner whose epsilon goes in a line from `first` to `last`.

    References
    ----------
    Sutton & Barto (2018), Reinforcement learning, 2nd ed.
    """
    ends = number("first", first, 0, 1), number("last", last, 0, 1)
    until = whole("until", until, 1)
    return Rival(choose_decaying, memory=lambda luck: Decay(*ends, until))
