"""
Transfer learning by abstract policies: buildings, abstraction, policies, learning.

======  ====================  =================================================
symbol  code                  shape and meaning
======  ====================  =================================================
s       state                 0..S-1, a task and a cell
a       action                0..A-1, go to what I see
rho     ``rho``               (S,), abstract state 0..Z-1 of each state
R       ``mdp.reward``        (S,), reward for reaching a state
T       ``mdp.next_state``,   (S, A, K), the K outcomes of an action
        ``mdp.prob``
gamma   ``gamma``             discount
pi      ``policy``            (S, A), or (Z, A) for an abstract policy
V       ``v``                 (S,), expected discounted reward
Q       ``q``                 (S, A), expected V of the state reached
======  ====================  =================================================
"""

from .abstraction import FEATURES, LABELS, describe, unseen_share
from .builders import (
    abstract_policies,
    count_votes,
    induce_nondeterministic,
    induce_probabilistic,
)
from .builders.deduced import (
    Climb,
    absprob_pi,
    abstract_gradient,
    natural_ascent,
    random_starts,
)
from .driving import format_table1, table1
from .maps import Map, parse_map, read_map
from .mdp import MDP
from .navigation import NavigationTasks, navigation_tasks
from .policies import beta_policy, break_ties, restrict_policy, uniform_policy
from .solvers import (
    action_values,
    evaluate_policy,
    optimal_actions,
    optimal_values,
    transition_matrix,
    value_iteration,
)

__version__ = "0.1.0"

__all__ = [
    "FEATURES",
    "LABELS",
    "MDP",
    "Climb",
    "Map",
    "NavigationTasks",
    "absprob_pi",
    "abstract_gradient",
    "abstract_policies",
    "action_values",
    "beta_policy",
    "break_ties",
    "count_votes",
    "describe",
    "evaluate_policy",
    "format_table1",
    "induce_nondeterministic",
    "induce_probabilistic",
    "natural_ascent",
    "navigation_tasks",
    "optimal_actions",
    "optimal_values",
    "parse_map",
    "random_starts",
    "read_map",
    "restrict_policy",
    "table1",
    "transition_matrix",
    "uniform_policy",
    "unseen_share",
    "value_iteration",
]
