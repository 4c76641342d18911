"""
Many runs of many arms, on as many workers as there are, and what they say.

Nothing here belongs to one paper: another one's arms and problem do as well.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules=["stats", "surgery"],
    submod_attrs={
        "arms": [
            "ARMS",
            "Arm",
            "PAPER_STEPS",
            "SCALES",
            "STRATEGIES",
            "Scale",
            "tau_cells",
        ],
        "problem": [
            "GUIDES",
            "Problem",
            "build_guides",
            "driving_tasks",
            "target_tasks",
        ],
        "run": ["run_experiment"],
        "results": ["Results", "load_results", "read_results", "stored_results"],
        "curves": [
            "asymptotic_level",
            "critical_point",
            "jumpstart",
            "time_to_threshold",
        ],
        "tuning": ["tune", "tuned_arms"],
        "diagnosis": [
            "arrival",
            "can_arrive",
            "change_of_mind",
            "judged",
            "notes_after",
            "ready",
            "return_variation",
            "stuck",
        ],
    },
)
