"""
What robots do that were told nothing of another building: beside every "over none".

The eager robot is advised to do anything that can be done; a hint is a tiny first
note on what exists; a masked robot cannot choose what does not.  Pages 8 and 9 and
the ledger show it.
"""

from __future__ import annotations

from collections.abc import Callable

from ..experiments.results import Results, read_results
from ..experiments.stats import gain_interval
from .catalogue import TARGETS

#: Columns: folder of results, and arm.
TOLD = {
    "ND hard": ("goal-{}", "nd-hard"),
    "eager hard": ("controls-{}", "eager-hard"),
    "hint": ("controls-{}", "hint"),
    "masked": ("masked-{}", "none"),
    "masked, ND hard": ("masked-{}", "nd-hard"),
}


def controls_table(read: Callable[[str], Results] = read_results) -> list[dict]:
    """
    Return a row for each building: thousands of goals, and gains over no advice.

    Runs are compared in pairs, as many as both have.

    >>> row = controls_table()[0]
    >>> row["building"], row["no advice"], row["ND hard"]
    ('target', '270', '557: +106 % [104, 109]')
    """
    rows = []
    for where in TARGETS:
        none = read(f"goal-{where}").totals("none")
        row = {"building": where, "no advice": f"{none.mean() / 1000:.0f}"}
        for name, (folder, arm) in TOLD.items():
            x = read(folder.format(where)).totals(arm)
            n = min(len(x), len(none))
            gain = gain_interval(x[:n], none[:n])
            low, high = (f"{100 * end:.0f}" for end in gain[1:])
            more = f"{100 * gain.estimate:+.0f} % [{low}, {high}]"
            row[name] = f"{x.mean() / 1000:.0f}: {more}"
        rows.append(row)
    return rows
