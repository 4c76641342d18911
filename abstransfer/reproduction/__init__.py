"""
This one paper: its claims, all experiments of the book, verdicts, tables, figures.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules=[
        "bench",
        "blind_rules",
        "blind_tables",
        "figures",
        "hypotheses",
        "neighbours",
        "traps",
    ],
    submod_attrs={
        "catalogue": ["EXPERIMENTS", "reproduce"],
        "guides": ["BETAS", "SHARES", "make_guides"],
        "claims": ["CLAIMS", "ledger"],
        "controls": ["controls_table"],
        "evidence": ["evidence_table"],
        "verdicts": ["combine", "judge"],
        "tables": ["measures_table", "to_markdown", "totals_table"],
    },
)
