"""
The paper's claims as data: its words, and the test in words and as a function.

Page 9 of the book teaches this module.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from ..experiments.results import Results
from .findings import (
    all_beat_q_learning,
    critical_point_exists,
    earlier_is_better,
    hard_beats_epsilon_greedy,
    nd_is_best,
    no_better_than_random,
    random_is_late_but_competes,
    soft_beats_hard,
)
from .verdicts import Finding


class Claim(NamedTuple):
    """A claim as data."""

    key: str
    title: str
    quote: str  # the paper's words
    test: str  # in words
    findings: Callable[[Results, np.random.Generator], Iterable[Finding]]


CLAIMS = (
    Claim(
        "1",
        "ND transfers best, though it drives worst",
        "Despite the policy pi_AbsND has shown the worst performance when executed "
        "in the environment [...], it proved better than the other policies when it "
        "was used for transfer learning",
        "ND reaches more goals than random, Prob and Grad, under either strategy; on "
        "condition that it drives worse than Prob and Grad.",
        nd_is_best,
    ),
    Claim(
        "2",
        "Soft beats hard, but not for random",
        "among abstract policies, the soft strategy is better than the hard strategy; "
        "but not for random policy",
        "Soft reaches more goals than hard for ND, Prob and Grad; on condition that "
        "for random it does not reach 1 % more.",
        soft_beats_hard,
    ),
    Claim(
        "3",
        "A hard phase of exploration beats eps-greedy",
        "usually eps-greedy is considered a good strategy for the "
        "exploration-exploitation dilemma for learning, but our experiments show that "
        "the hard strategy was a better option",
        "Each hard arm, random first of all, reaches more goals than Q-learning, "
        "which is eps-greedy from the first step.",
        hard_beats_epsilon_greedy,
    ),
    Claim(
        "4",
        "Grad and Prob transfer no better than random",
        "abstract policies pi_AbsGrad and pi_AbsProb did not prove to be better than "
        "random policy for transfer learning",
        "Neither, under either strategy, reaches 1 % more goals than random does "
        "under its better strategy, the hard one.",
        no_better_than_random,
    ),
    Claim(
        "5",
        "Every transfer beats Q-learning",
        "all of the policies transfered proved to be better than Q-Learning with "
        "fixed eps",
        "Each of the eight arms reaches more goals than Q-learning.",
        all_beat_q_learning,
    ),
    Claim(
        "6a",
        "Every curve has a critical point",
        "All of the experiments show the same learning behavior: there is a critical "
        "point, when performance improves faster",
        "In each arm the steepest rise, found in half of the runs and measured in the "
        "others, is over twice that of a steady climb.",
        critical_point_exists,
    ),
    Claim(
        "6b",
        "The earlier the critical point, the better the end",
        "Excepting random policy, the earlier the critical point, the better the "
        "performance in the final steps of the experiment",
        "Over the seven arms without random, critical point and final level are "
        "negatively rank-correlated.",
        earlier_is_better,
    ),
    Claim(
        "6c",
        "Random is late, but competes in the end",
        "Even if the critical point occurs late when transferring random policy, the "
        "final performance competes with the best final performance",
        "Random ends at most 5 % below the abstract arm that ends best; on condition "
        "that its critical point is later than theirs under the same strategy.",
        random_is_late_but_competes,
    ),
)
