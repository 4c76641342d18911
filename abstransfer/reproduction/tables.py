"""
Tables of results: rows as dicts, written as CSV and as Markdown.

Page 9 of the book shows them.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping

import numpy as np

from ..experiments.arms import ARMS
from ..experiments.curves import (
    asymptotic_level,
    critical_point,
    jumpstart,
    time_to_threshold,
)
from ..experiments.results import Results
from ..experiments.stats import (
    Interval,
    gain_interval,
    iqm_interval,
    probability_of_improvement,
    t_interval,
)
from ..experiments.tuning import Tuning
from .claims import Entry

MILLION = 1_000_000


def experiment_name(results: Results) -> str:
    """Return reward and target of an experiment, as in "goal, target_b"."""
    problem = results.record["parameters"]["reading"]
    parts = [problem["reward"], problem["target"]["name"], reading_name(results)]
    taus = {arm.name: arm.tau for arm in ARMS}
    own = any(arm.tau != taus.get(arm.name, arm.tau) for arm in results.arms)
    if is_grid(results):
        of_paper = any(arm.tau == taus.get(arm.name) for arm in results.arms)
        parts.append("grid" if of_paper else "finer grid")
    elif own:
        parts.append("own tau")
    return ", ".join(filter(None, parts))


def reading_name(results: Results) -> str:
    """Return how the learner of an experiment is read: "" is as in the book."""
    problem = results.record["parameters"]["reading"]
    if problem.get("actions", "relational") != "relational":
        return problem["actions"]
    return "masked" if problem["unavailable"] == "masked" else ""


def is_grid(results: Results) -> bool:
    """Return whether results are those of a grid of tau."""
    return len({arm.name for arm in results.arms}) < len(results.arms)


def totals_table(results: Results) -> list[dict]:
    """Return Figure 3 as numbers: goals of a run, by arm; gains over Q-learning."""
    plain, rows = results.totals("none"), []
    for arm in results.arms:
        x = results.totals(arm.name)
        row = {"arm": arm.name, "tau": arm.tau, "runs": len(x)}
        row |= _ends("mean", t_interval(x), 1)
        row |= _ends("iqm", iqm_interval(x), 1)
        row |= {"standard_deviation": round(float(x.std(ddof=min(1, len(x) - 1))), 1)}
        quartiles = np.percentile(x, (0, 25, 50, 75, 100)).tolist()
        names = ("lowest", "quartile_1", "median", "quartile_3", "highest")
        row |= dict(zip(names, quartiles, strict=True))
        row |= _ends("gain_over_q_learning", gain_interval(x, plain), 4)
        chance = probability_of_improvement(x, plain)
        rows.append(row | {"probability_of_improvement": round(chance, 4)})
    return rows


def curves_table(results: Results) -> list[dict]:
    """Return Figure 4 as numbers: mean goals by arm and window, with intervals."""
    rows, window = [], _window(results)
    for arm in results.arms:
        mean = t_interval(results.curves(arm.name))
        for w, ends in enumerate(zip(*mean, strict=True)):
            row = {"arm": arm.name, "steps": (w + 1) * window}
            rows.append(row | _ends("goals", Interval(*ends), 2))
    return rows


def measures_table(results: Results) -> list[dict]:
    """
    Return the measures of transfer by arm, each with its interval.

    The threshold is half of the final level of Q-learning; a run that does not
    reach it counts with all its steps.
    """
    window = _window(results)
    plain = results.curves("none")
    threshold = asymptotic_level(plain).mean() / 2
    last = plain.shape[1] * window
    rows = []
    for arm in results.arms:
        curves = results.curves(arm.name)
        steps = time_to_threshold(curves, threshold, window=window)
        ratio = gain_interval(curves.sum(axis=1), plain.sum(axis=1))
        measures = {
            "jumpstart": t_interval(jumpstart(curves, plain)),
            "final_level": t_interval(asymptotic_level(curves)),
            "transfer_ratio": Interval(*(1 + x for x in ratio)),
            "steps_to_threshold": t_interval(np.minimum(steps, last)),
            "critical_point": t_interval(critical_point(curves) * window),
        }
        row = {"arm": arm.name}
        for name, interval in measures.items():
            row |= _ends(name, interval, 3)
        rows.append(row)
    return rows


def tau_table(tunings: Iterable[Tuning]) -> list[dict]:
    """Return what the grid says of each arm; tau in million steps, at paper scale."""
    return [
        {
            "arm": t.name,
            "best_tau": f"{t.best / MILLION:g}",
            "as_good": " ".join(f"{tau / MILLION:g}" for tau in t.as_good),
            "paper_tau": t.paper and f"{t.paper / MILLION:g}",
            "paper_inside": t.paper and ("no", "yes")[t.paper_inside],
            "best_at_edge": ("no", "yes")[t.at_edge],
            "goals_at_best": round(float(t.goals.estimate.max()), 1),
        }
        | _ends("gain_of_paper_tau", t.paper_gain or Interval(*[np.nan] * 3), 4)
        for t in tunings
    ]


def ledger_table(entries: Iterable[Entry]) -> list[dict]:
    """Return every finding of a ledger as a row, with the verdict on its claim."""
    return [
        {
            "claim": entry.claim.key,
            "verdict": entry.verdict,
            "finding": finding.text,
            "role": "main" if finding.main else "condition",
        }
        | _ends("effect", finding.effect, 4)
        | {"unit": finding.unit, "finding_verdict": finding.verdict}
        for entry in entries
        for finding in entry.findings
    ]


def to_csv(rows: list[Mapping]) -> str:
    """Return rows as CSV text with a header."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def to_markdown(rows: list[Mapping]) -> str:
    """
    Return rows as a Markdown table.

    >>> print(to_markdown([{"arm": "none", "mean": 1.5}]), end="")
    | arm | mean |
    |---|---|
    | none | 1.5 |
    """
    lines = [
        list(rows[0]),
        *(["" if v is None else v for v in r.values()] for r in rows),
    ]
    text = ["| " + " | ".join(map(str, line)) + " |" for line in lines]
    text.insert(1, "|---" * len(rows[0]) + "|")
    return "\n".join(text) + "\n"


def _ends(name: str, interval: Interval, digits: int) -> dict:
    """Return an interval as three columns; empty where a number is unknown."""
    numbers = [round(float(x), digits) if np.isfinite(x) else None for x in interval]
    return dict(zip((name, f"{name}_low", f"{name}_high"), numbers, strict=True))


def _window(results: Results) -> int:
    return results.record["parameters"]["window"]
