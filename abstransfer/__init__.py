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

Names stand in the order of the pages.  Each is loaded when it is first
used, so that a command line can answer Ctrl-C before anything is.
"""

import lazy_loader

__version__ = "0.1.0"

_CORE = {
    "maps": ["Map", "parse_map", "read_map"],
    "mdp": ["MDP"],
    "abstraction": ["FEATURES", "LABELS", "describe", "unseen_share"],
    "navigation": ["NavigationTasks", "navigation_tasks"],
    "solvers": [
        "action_values",
        "evaluate_policy",
        "optimal_actions",
        "optimal_values",
        "transition_matrix",
        "value_iteration",
    ],
    "policies": ["beta_policy", "break_ties", "restrict_policy", "uniform_policy"],
    "builders": [
        "Climb",
        "absprob_pi",
        "abstract_gradient",
        "abstract_policies",
        "count_votes",
        "induce_nondeterministic",
        "induce_probabilistic",
        "natural_ascent",
        "random_starts",
    ],
    "driving": ["executed_values", "format_table1", "table1"],
}
_LEARNING = ["q_learning", "q_learning_runs"]
_ROOMS = [
    "learning",
    "rivals",
    "experiments",
    "plotting",
    "reproduction",
    "project",
    "scenes",
    "exercises",
]
__getattr__, __dir__, _ = lazy_loader.attach(
    __name__,
    submodules=[*_CORE, *_ROOMS],
    submod_attrs=_CORE | {"learning": _LEARNING},
)

__all__ = [
    # page 1: a building as a decision problem
    "Map",
    "parse_map",
    "read_map",
    "MDP",
    "NavigationTasks",
    "navigation_tasks",
    # page 2: solving what is known
    "transition_matrix",
    "evaluate_policy",
    "action_values",
    "value_iteration",
    "optimal_values",
    "optimal_actions",
    "uniform_policy",
    "restrict_policy",
    # page 3: learning by bumping
    *_LEARNING,
    # page 4: forgetting on purpose
    "LABELS",
    "FEATURES",
    "describe",
    "unseen_share",
    # page 5: inducing
    "break_ties",
    "count_votes",
    "induce_probabilistic",
    "induce_nondeterministic",
    "beta_policy",
    # page 6: deducing
    "absprob_pi",
    "Climb",
    "abstract_gradient",
    "natural_ascent",
    "random_starts",
    # page 7: the driving test
    "abstract_policies",
    "executed_values",
    "table1",
    "format_table1",
]
