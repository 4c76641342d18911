"""
Rivals: what else one can do with the small building's knowledge, or without it.

A rival is the loop of page 3 with other parts: who chooses, what is learned from a
step, what happens between two episodes.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules=["choosing", "improving"],
    submod_attrs={
        "loops": ["PLAIN", "Rival", "learn_as"],
        "choosing": [
            "decaying_epsilon",
            "guided_exploration",
            "heuristic",
            "held_label",
            "jump_start",
            "policy_library",
            "policy_reuse",
            "z_greedy",
        ],
        "improving": ["count_bonus", "q_lambda", "replay", "shaping"],
    },
)
