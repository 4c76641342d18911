"""Figures and tables made from stored results, without learning."""

import csv
import shutil
from dataclasses import replace

import numpy as np
import pytest

from abstransfer._paths import DATA
from abstransfer.experiments import store
from abstransfer.experiments.arms import ARMS, Arm, Scale, tau_cells
from abstransfer.experiments.plan import make_plan, parameters
from abstransfer.experiments.problem import Problem
from abstransfer.experiments.results import (
    Results,
    load_results,
    read_results,
    save_results,
    stored_results,
)
from abstransfer.experiments.stats import Interval
from abstransfer.reproduction import figures
from abstransfer.reproduction.claims import CLAIMS, ledger
from abstransfer.reproduction.figures import (
    effect_text,
    findings_table,
    make_figures,
    verdicts_table,
)
from abstransfer.reproduction.verdicts import KINDS, Finding

SCALE = Scale(30_000_000, 1_000_000)
EXECUTED = {"rand": -97.0, "nd": -81.0, "prob": -70.0, "grad": -71.0}


def made_up(arms, n_runs, problem):
    """Results of arms whose goals jump at tau, by a level that is their own."""
    rng, steps = np.random.default_rng(0), np.arange(30) * 1_000_000
    goals = np.array(
        [
            rng.poisson(np.where(steps < arm.tau + 5e6, 20, 300 + 9 * i), (n_runs, 30))
            for i, arm in enumerate(arms)
        ]
    )
    plan = make_plan(arms, problem, SCALE, n_runs, guides=GUIDES)
    record = {"parameters": parameters(plan), "executed": EXECUTED}
    return Results(tuple(arms), goals, record)


GUIDES = dict.fromkeys(("rand", "nd", "prob", "grad"), np.full((2048, 8), 1 / 8))


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A folder with two experiments, a grid, and one that has not finished."""
    folder = tmp_path_factory.mktemp("results")
    goal = Problem()
    save_results(folder / "goal", made_up(ARMS, 8, goal))
    save_results(folder / "cost", made_up(ARMS, 8, replace(goal, reward="cost")))
    save_results(folder / "grid", made_up(tau_cells(), 4, goal))
    with store.claim(folder / "unfinished", {}, (1, 1, 1)):
        pass
    return folder


@pytest.fixture(scope="module")
def made(results, tmp_path_factory):
    folder = tmp_path_factory.mktemp("figures")
    written = make_figures(results, folder)
    assert sorted(written) == sorted(folder.iterdir())
    return folder


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_each_experiment_gets_its_figures_and_the_grid_its_own(made):
    names = {path.name for path in made.iterdir()}
    pictures = {
        "figure3-goal",
        "figure4-goal",
        "figure3-cost",
        "figure4-cost",
        "tau-grid",
    }
    files = {f"{p}.{suffix}" for p in pictures for suffix in ("svg", "png", "txt")}

    assert files <= names
    assert {
        "ledger.md",
        "ledger.csv",
        "tau.md",
        "tau.csv",
        "measures-goal.csv",
    } <= names


def test_figure_3_as_numbers_is_what_the_runs_say(made, results):
    rows = {row["arm"]: row for row in read(made / "figure3-goal.csv")}
    totals = made_up(ARMS, 8, Problem()).totals("nd-soft")

    assert list(rows) == [arm.name for arm in ARMS]
    assert float(rows["nd-soft"]["mean"]) == pytest.approx(totals.mean(), abs=0.1)
    assert float(rows["nd-soft"]["median"]) == np.median(totals)
    assert float(rows["none"]["gain_over_q_learning"]) == 0
    low, high = (float(rows["nd-soft"][f"mean_{end}"]) for end in ("low", "high"))
    assert low < totals.mean() < high


def test_figure_4_as_numbers_has_a_row_per_arm_and_window(made):
    rows = read(made / "figure4-goal.csv")

    goals = made_up(ARMS, 8, Problem()).goals.mean(axis=1)
    assert [(row["arm"], int(row["steps"])) for row in rows] == [
        (arm.name, i * 1_000_000) for arm in ARMS for i in range(1, 31)
    ]
    means = [float(row["goals"]) for row in rows]
    np.testing.assert_allclose(means, goals.ravel(), atol=0.0051)


def test_the_measures_of_transfer_see_the_jump(made):
    """Q-learning jumps after 5 million steps, wanderer hard after 14."""
    rows = {row["arm"]: row for row in read(made / "measures-goal.csv")}

    assert float(rows["none"]["critical_point"]) == 5_000_000
    assert float(rows["rand-hard"]["critical_point"]) == 14_000_000
    assert float(rows["none"]["transfer_ratio"]) == 1
    assert float(rows["none"]["jumpstart"]) == 0
    assert float(rows["rand-hard"]["steps_to_threshold"]) == 15_000_000


def test_the_ledger_has_every_claim_under_every_convention(made):
    rows = read(made / "ledger.csv")
    text = (made / "ledger.md").read_text(encoding="utf-8")

    assert {row["experiment"] for row in rows} == {"goal, target", "cost, target"}
    assert {row["claim"] for row in rows} == {claim.key for claim in CLAIMS}
    for claim in CLAIMS:
        assert f"> {claim.quote}" in text
    assert text.count("| goal, target | cost, target |") == 1 + len(CLAIMS)


def test_each_reading_has_a_ledger_and_a_finer_grid_its_name(monkeypatch, tmp_path):
    """Controls beside the nine arms are left out, and what lacks arms or curves."""
    monkeypatch.setattr(figures, "SUFFIXES", ())  # their texts and numbers will do
    goal, compass = Problem(), Problem(actions="compass")
    hint = Arm("hint", None, "hard", 0, 1e-12)
    made = {
        "goal": made_up(ARMS, 5, goal),
        "compass": made_up((*ARMS, hint), 5, compass),
        "few": made_up((ARMS[0], hint), 5, Problem(unavailable="masked")),
        "fine": made_up(tau_cells(ARMS[3:4], (3_000_000, 4_000_000)), 5, goal),
    }
    whole = make_plan(ARMS, goal, Scale(30_000_000, 30_000_000), 5, guides=GUIDES)
    totals = made["goal"].goals.sum(axis=2, keepdims=True)
    made["curveless"] = Results(ARMS, totals, {"parameters": parameters(whole)})
    for name, each in made.items():
        save_results(tmp_path / name, each)
    written = {path.name for path in make_figures(tmp_path, tmp_path / "out")}

    assert {name for name in written if name.startswith("ledger")} == {
        *("ledger.csv", "ledger.md", "ledger-compass.csv", "ledger-compass.md")
    }
    rows = read(tmp_path / "out" / "figure3-compass.csv")
    assert [row["arm"] for row in rows] == [arm.name for arm in ARMS]
    assert not any("few" in name or "curveless" in name for name in written)
    names = {row["experiment"] for row in read(tmp_path / "out" / "tau.csv")}
    assert names == {"goal, target, finer grid"}
    first = read(tmp_path / "out" / "ledger-compass.csv")[0]
    assert first["experiment"] == "goal, target, compass"


def test_verdicts_and_findings_stand_side_by_side(results):
    ledgers = {name: ledger(load_results(results / name)) for name in ("goal", "cost")}

    verdicts, findings = verdicts_table(ledgers), findings_table(ledgers, "2")

    for i, (row, claim) in enumerate(zip(verdicts, CLAIMS, strict=True)):
        assert row["claim"] == f"{claim.key}. {claim.title}"
        assert row["cost"] == ledgers["cost"][i].verdict
    assert list(findings[0]) == ["finding", "goal", "cost"]
    assert [row["finding"].endswith("(condition)") for row in findings] == [0, 0, 0, 1]
    assert findings[1]["goal"].endswith(f": {ledgers['goal'][1].findings[1].verdict}")
    with pytest.raises(KeyError, match="no claim '7'"):
        findings_table(ledgers, "7")


def test_stored_results_are_read_by_name(results, monkeypatch, tmp_path):
    monkeypatch.setattr("abstransfer.experiments.results.DATA", tmp_path)
    with pytest.raises(FileNotFoundError, match="package: none"):
        read_results("goal")
    shutil.copytree(results, tmp_path / "results")

    assert stored_results() == ("cost", "goal", "grid")
    expected = load_results(results / "goal").goals
    np.testing.assert_array_equal(read_results("goal").goals, expected)
    with pytest.raises(FileNotFoundError, match="'unfinished'.* cost, goal, grid"):
        read_results("unfinished")


def test_the_table_of_tau_has_every_guided_arm(made):
    rows = read(made / "tau.csv")

    assert [row["arm"] for row in rows] == [arm.name for arm in ARMS if arm.guide]
    assert [row["paper_tau"] for row in rows] == [
        "9",
        "19",
        "3.5",
        "11",
        "3.5",
        "6",
    ] + [*("3.5", "6")]


def test_figures_are_the_same_bytes_each_time(made, results, monkeypatch, tmp_path):
    monkeypatch.setattr(figures, "SUFFIXES", (".svg",))
    make_figures(results, tmp_path)
    for path in made.iterdir():
        if path.suffix != ".png":  # stores the version of matplotlib
            assert path.read_bytes() == (tmp_path / path.name).read_bytes(), path.name


def test_a_folder_of_one_experiment_will_do(results, monkeypatch, tmp_path):
    monkeypatch.setattr(figures, "SUFFIXES", (".svg",))
    written = make_figures(results / "goal", tmp_path)

    assert tmp_path / "figure3-goal.svg" in written


def test_tables_are_made_of_all_that_is_stored(monkeypatch, tmp_path):
    """The command of the README; its pictures, which take long, are left out."""
    for name in ("figure3", "figure4", "tau_figure"):
        monkeypatch.setattr(figures, name, lambda found: found)
    monkeypatch.setattr(figures, "_write_picture", lambda *arguments: None)
    written = {path.name for path in make_figures(DATA / "results", tmp_path)}

    assert {"measures-goal-target.csv", "measures-cost-target.csv"} <= written
    assert {"tau.csv", "ledger.md", "ledger-compass.md", "ledger-masked.md"} <= written


def test_no_results_is_an_error_that_says_how_to_make_some(tmp_path):
    with pytest.raises(FileNotFoundError, match="abstransfer experiment --out DIR"):
        make_figures(tmp_path, tmp_path / "out")


@pytest.mark.parametrize(
    ("effect", "unit", "text"),
    [
        ((0.25, 0.24, 0.267), "ratio", "+25.0 % [24.0, 26.7]"),
        ((-5.5e6, -6e6, -5e6), "steps", "-5.5 million steps [-6.0, -5.0]"),
        (
            (1234.5, 1200.4, 1300.0),
            "goals per window",
            "+1234 goals per window [1200, 1300]",
        ),
        ((-0.52, -0.62, -0.43), "", "-0.52 [-0.62, -0.43]"),
        ((10.83, 10.83, 10.83), "reward", "+10.8 reward"),
    ],
)
def test_an_effect_is_printed_in_its_unit(effect, unit, text):
    kind = next(name for name, kind in KINDS.items() if kind.unit == unit)
    assert effect_text(Finding(kind, effect=Interval(*effect))) == text
