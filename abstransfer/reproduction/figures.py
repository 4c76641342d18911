"""
Figures 3 and 4, the table of tau and the ledger, from stored results.

Page 9 of the book shows what this module writes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from ..experiments.arms import ARMS
from ..experiments.problem import GUIDES
from ..experiments.results import RECORD, Results, load_results
from ..experiments.stats import t_interval
from ..experiments.tuning import tune
from ..plotting import figure, plot_boxes, plot_curves, plot_tau
from .claims import Entry, ledger
from .tables import (
    curves_table,
    experiment_name,
    is_grid,
    ledger_table,
    measures_table,
    reading_name,
    tau_table,
    to_csv,
    to_markdown,
    totals_table,
)

Ledgers = Mapping[str, tuple[Entry, ...]]  # by experiment
SUFFIXES = (".svg", ".png")  # of pictures
SCALES = {"ratio": (100, " %"), "steps": (1e-6, " million steps")}


def make_figures(
    results: str | Path, out: str | Path, on_file: Callable[[Path], None] | None = None
) -> list[Path]:
    """
    Make all figures and tables from the results in a folder, or in its folders.

    An experiment in folder ``x`` becomes figure3-x, figure4-x and measures-x, a
    grid of tau tau-x; tau collects all grids, and a ledger for each reading of the
    learner all others.  Controls beside the nine arms are left out.

    Returns the files written.  Raises FileNotFoundError where no experiment
    has finished.
    """
    experiments, out = finished_experiments(results), Path(out)
    out.mkdir(parents=True, exist_ok=True)
    written, ledgers, taus = [], {}, []

    def write(name: str, content) -> None:
        path = out / name
        if isinstance(content, str):
            path.write_text(content, encoding="utf-8", newline="\n")
        else:
            content.save(path)
        written.append(path)
        if on_file:
            on_file(path)

    for name, found in experiments.items():
        if is_grid(found):
            if any(arm.guide not in GUIDES for arm in found.arms):
                continue  # guides of its own: page 10 draws it
            tunings = tune(found)
            rows = tau_table(tunings)
            taus += [{"experiment": experiment_name(found)} | row for row in rows]
            picture = tau_figure(found)
            _write_picture(write, f"tau-{name}", picture)
            continue
        found = nine_arms(found)
        if found is None:
            continue
        boxes, curves = figure3(found), figure4(found)
        _write_picture(write, f"figure3-{name}", boxes)
        write(f"figure3-{name}.csv", to_csv(totals_table(found)))
        _write_picture(write, f"figure4-{name}", curves)
        write(f"figure4-{name}.csv", to_csv(curves_table(found)))
        write(f"measures-{name}.csv", to_csv(measures_table(found)))
        of_reading = ledgers.setdefault(reading_name(found), {})
        of_reading[experiment_name(found)] = ledger(found)
    if taus:
        write("tau.csv", to_csv(taus))
        write("tau.md", to_markdown(taus))
    for reading, entries in ledgers.items():
        rows = [
            {"experiment": name} | row
            for name, judged in entries.items()
            for row in ledger_table(judged)
        ]
        of = reading and f"-{reading}"
        write(f"ledger{of}.csv", to_csv(rows))
        write(f"ledger{of}.md", ledger_text(entries))
    return written


def finished_experiments(folder: str | Path) -> dict[str, Results]:
    """Return the finished experiments in a folder, or in its folders, "goal" first."""
    folder = Path(folder)
    records = [folder / RECORD, *sorted(folder.glob(f"*/{RECORD}"))]
    found = {}
    for record in records:
        if record.is_file():
            try:
                found[record.parent.resolve().name] = load_results(record.parent)
            except FileNotFoundError:  # it has not finished
                continue
    if not found:
        raise FileNotFoundError(
            f"{folder}: no finished experiment here; make one with: "
            "abstransfer experiment --out DIR"
        )
    return dict(sorted(found.items(), key=lambda item: _place(item[1])))


def nine_arms(results: Results) -> Results | None:
    """Return the nine arms of Figures 3 and 4 alone; None without them or curves."""
    names = [arm.name for arm in results.arms]
    if not {arm.name for arm in ARMS} <= set(names) or results.goals.shape[2] == 1:
        return None
    places = [names.index(arm.name) for arm in ARMS]
    arms = tuple(results.arms[i] for i in places)
    return results._replace(arms=arms, goals=results.goals[places])


def _place(results: Results) -> tuple:
    """Return what experiments are sorted by."""
    name = experiment_name(results)
    return not name.startswith("goal"), name


def figure3(results: Results):
    """Return the picture of Figure 3: box plots of the goals of a run."""
    return figure(plot_boxes, {a.name: results.totals(a.name) for a in results.arms})


def figure4(results: Results):
    """Return the picture of Figure 4: goals per window, means with bands."""
    curves = {arm.name: results.curves(arm.name) for arm in results.arms}
    bands = {name: t_interval(x)[1:] for name, x in curves.items()}
    window = results.record["parameters"]["window"]
    return figure(plot_curves, curves, bands=bands, window=window)


def tau_figure(results: Results):
    """Return the picture of the grid: goals of a run by tau, with bands."""
    tunings = tune(results)
    totals = {
        t.name: (t.taus, np.stack([results.totals(t.name, tau) for tau in t.taus]))
        for t in tunings
    }
    bands = {t.name: (t.goals.low, t.goals.high) for t in tunings}
    paper = {t.name: t.paper for t in tunings if t.paper}
    return figure(plot_tau, totals, bands=bands, paper=paper)


def ledger_text(ledgers: Ledgers) -> str:
    """Return ledgers, by experiment, as Markdown: verdicts first, then findings."""
    lines = ["# Ledger of claims", "", to_markdown(verdicts_table(ledgers))]
    for entry in next(iter(ledgers.values())):
        claim = entry.claim
        lines += [f"## {claim.key}. {claim.title}", "", f"> {claim.quote}", ""]
        lines += [f"Test: {claim.test}", ""]
        lines.append(to_markdown(findings_table(ledgers, claim.key)))
    return "\n".join(lines).rstrip() + "\n"


def verdicts_table(ledgers: Ledgers) -> list[dict]:
    """Return a row for each claim: the verdict on it in each experiment."""
    first = next(iter(ledgers.values()))
    return [
        {"claim": f"{entry.claim.key}. {entry.claim.title}"}
        | {name: judged[i].verdict for name, judged in ledgers.items()}
        for i, entry in enumerate(first)
    ]


def findings_table(ledgers: Ledgers, key: str) -> list[dict]:
    """Return a row for each finding on a claim: its effect in each experiment."""
    judged = {
        name: entry.findings
        for name, entries in ledgers.items()
        for entry in entries
        if entry.claim.key == key
    }
    if not judged:
        raise KeyError(f"no claim {key!r} in the ledgers")
    return [
        {"finding": finding.text + ("" if finding.main else " (condition)")}
        | {
            name: f"{effect_text(found[j])}: {found[j].verdict}"
            for name, found in judged.items()
        }
        for j, finding in enumerate(next(iter(judged.values())))
    ]


def effect_text(finding) -> str:
    """
    Return an effect with its interval, in its unit.

    >>> from abstransfer.experiments.stats import Interval
    >>> from abstransfer.reproduction.verdicts import Finding
    >>> effect_text(Finding("goals", effect=Interval(0.25, 0.24, 0.267)))
    '+25.0 % [24.0, 26.7]'
    """
    factor, unit = SCALES.get(finding.unit, (1, f" {finding.unit}".rstrip()))
    estimate, low, high = (factor * x for x in finding.effect)
    digits = 0 if abs(estimate) >= 100 else 1 if abs(estimate) >= 1 or factor > 1 else 2
    if finding.unit == "":
        digits = 2
    ends = f" [{low:.{digits}f}, {high:.{digits}f}]" if low < high else ""
    return f"{estimate:+.{digits}f}{unit}{ends}"


def _write_picture(write, name: str, picture) -> None:
    for suffix in SUFFIXES:
        write(name + suffix, picture)
    write(name + ".txt", picture.alt + "\n")
