"""Verdicts follow from intervals: constructed results for every verdict."""

import numpy as np
import pytest

from abstransfer.experiments.arms import ARMS
from abstransfer.experiments.results import Results
from abstransfer.experiments.stats import Interval, rank_interval
from abstransfer.reproduction.claims import CLAIMS, ledger
from abstransfer.reproduction.verdicts import (
    FAILS,
    HOLDS,
    IN_PART,
    UNDECIDED,
    Finding,
    combine,
    judge,
)

N_RUNS, N_WINDOWS, WINDOW = 20, 30, 500
LEVELS = {  # final goals per window under which claims 1 to 5 hold
    **{"none": 150, "rand-hard": 500, "rand-soft": 300},
    **{"nd-hard": 600, "nd-soft": 650, "prob-hard": 400, "prob-soft": 450},
    **{"grad-hard": 370, "grad-soft": 425},
}
JUMPS = {  # windows before the jump: under which 6a to 6c hold
    **{"none": 17, "rand-hard": 20, "rand-soft": 19},
    **{"nd-hard": 4, "nd-soft": 3, "prob-hard": 10, "prob-soft": 8},
    **{"grad-hard": 11, "grad-soft": 9},
}
EXECUTED = {"rand": -97.0, "nd": -81.0, "prob": -70.0, "grad": -71.0}


def experiment(levels=(), jumps=(), executed=(), noise=0.01, n_runs=N_RUNS):
    """Results whose curves jump by a level (None: climb steadily), with noise in it."""
    levels, jumps = LEVELS | dict(levels), JUMPS | dict(jumps)
    rng = np.random.default_rng(7)
    goals = np.empty((len(ARMS), n_runs, N_WINDOWS))
    for a, arm in enumerate(ARMS):
        after, jump = np.arange(N_WINDOWS), jumps[arm.name]
        after = after if jump is None else 1 * (after >= jump)
        luck = 1 + noise * rng.normal(size=(n_runs, 1))
        goals[a] = 20 + (1000 * levels[arm.name] / after.sum() * luck) * after
    record = {"executed": EXECUTED | dict(executed), "parameters": {"window": WINDOW}}
    return Results(ARMS, goals.round().astype(int), record)


def verdict(key, **changes):
    entries = {entry.claim.key: entry for entry in ledger(experiment(**changes))}
    return entries[key].verdict


@pytest.mark.parametrize(
    ("low", "high", "above", "expected"),
    [
        (0.1, 0.2, True, HOLDS),
        (-0.2, -0.1, True, FAILS),
        (-0.1, 0.1, True, UNDECIDED),
        (0.1, 0.2, False, FAILS),
        (-0.2, -0.1, False, HOLDS),
        (0.0, 0.2, True, UNDECIDED),
        (np.nan, np.nan, True, UNDECIDED),
    ],
)
def test_a_finding_is_judged_by_the_ends_of_its_interval(low, high, above, expected):
    assert judge(Interval(0.05, low, high), 0.0, above) == expected


@pytest.mark.parametrize(
    ("main", "conditions", "expected"),
    [
        ([HOLDS, HOLDS], [], HOLDS),
        ([HOLDS, HOLDS], [HOLDS], HOLDS),
        ([HOLDS, HOLDS], [FAILS], IN_PART),
        ([HOLDS, HOLDS], [UNDECIDED], UNDECIDED),
        ([HOLDS, UNDECIDED], [FAILS], IN_PART),
        ([UNDECIDED, UNDECIDED], [FAILS], FAILS),
        ([HOLDS, FAILS], [], IN_PART),
        ([HOLDS, FAILS, UNDECIDED], [HOLDS], IN_PART),
        ([FAILS, FAILS], [HOLDS], FAILS),
        ([FAILS, UNDECIDED], [HOLDS], FAILS),
        ([HOLDS, UNDECIDED], [HOLDS], UNDECIDED),
        ([UNDECIDED, UNDECIDED], [HOLDS], UNDECIDED),
        ([], [], UNDECIDED),
    ],
)
def test_findings_combine_into_one_verdict(main, conditions, expected):
    effects = {HOLDS: (1, 1, 1), FAILS: (-1, -1, -1), UNDECIDED: (0, -1, 1)}
    findings = [Finding("goals", effect=Interval(*effects[v])) for v in main]
    findings += [
        Finding("goals", main=False, effect=Interval(*effects[v])) for v in conditions
    ]

    assert combine(findings) == expected


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.key)
def test_each_claim_holds_where_it_should(claim):
    assert verdict(claim.key) == HOLDS


SAME = dict.fromkeys(LEVELS, 400)
UPSIDE_DOWN = {name: 900 - level for name, level in LEVELS.items()}
LATE_IS_BETTER = {name: 100 * (1 + JUMPS[name]) for name in JUMPS}


@pytest.mark.parametrize(
    ("key", "changes", "expected"),
    [
        ("1", {"levels": {"grad-soft": 700}}, IN_PART),
        ("1", {"levels": {"nd-hard": 100, "nd-soft": 100}}, FAILS),
        ("1", {"levels": SAME, "noise": 0.05}, UNDECIDED),
        ("1", {"executed": {"nd": -60.0}}, IN_PART),  # the condition fails
        ("2", {"levels": {"nd-soft": 500}}, IN_PART),
        ("2", {"levels": {"rand-soft": 520}}, IN_PART),  # the condition fails
        ("2", {"levels": UPSIDE_DOWN}, FAILS),
        ("2", {"levels": SAME, "noise": 0.05}, UNDECIDED),
        ("3", {"levels": {"none": 450}}, IN_PART),
        ("3", {"levels": {"none": 700}}, FAILS),
        ("3", {"levels": SAME, "noise": 0.05}, UNDECIDED),
        ("4", {"levels": {"prob-soft": 550}}, IN_PART),
        ("4", {"levels": {"rand-hard": 300}}, FAILS),
        ("4", {"levels": SAME, "noise": 0.05}, UNDECIDED),
        ("4", {"levels": SAME, "noise": 0.001}, HOLDS),  # equal is no better
        ("5", {"levels": {"none": 320}}, IN_PART),
        ("5", {"levels": {"none": 700}}, FAILS),
        ("5", {"levels": SAME, "noise": 0.05}, UNDECIDED),
        ("6a", {"jumps": {"none": None}}, IN_PART),  # a straight line
        ("6a", {"jumps": dict.fromkeys(JUMPS)}, FAILS),
        ("6a", {"jumps": dict.fromkeys(JUMPS, 0)}, UNDECIDED),  # flat
        ("6b", {"levels": LATE_IS_BETTER}, FAILS),
        ("6b", {"jumps": dict.fromkeys(JUMPS, 9)}, UNDECIDED),
        ("6c", {"levels": {"rand-soft": 30}}, IN_PART),
        ("6c", {"levels": {"rand-soft": 30, "rand-hard": 30}}, FAILS),
        ("6c", {"jumps": {"rand-hard": 5}, "levels": {"rand-hard": 700}}, IN_PART),
    ],
)
def test_each_claim_gets_the_verdict_that_its_data_were_made_for(
    key, changes, expected
):
    assert verdict(key, **changes) == expected


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.key)
def test_a_single_run_decides_nothing(claim):
    assert verdict(claim.key, n_runs=1) == UNDECIDED


def test_arms_that_never_reach_a_goal_decide_nothing():
    results = experiment()
    entries = ledger(results._replace(goals=0 * results.goals))

    assert {e.verdict for e in entries} == {UNDECIDED}


def test_intervals_widen_with_the_level():
    results = experiment()
    for usual, wide in zip(ledger(results), ledger(results, level=0.999), strict=True):
        for a, b in zip(usual.findings, wide.findings, strict=True):
            assert (a.text, a.effect.estimate) == (b.text, b.effect.estimate)
            assert b.effect.low <= a.effect.low <= a.effect.high <= b.effect.high


def test_the_order_of_arms_is_judged_by_the_number_of_arms():
    """All 21 pairs are in order, with ten runs and with more: the interval is one."""
    few, many = (
        {e.claim.key: e for e in ledger(experiment(n_runs=n))}["6b"] for n in (10, 50)
    )

    assert few.findings[0].effect == many.findings[0].effect == rank_interval(-1.0, 7)
    assert "n = 7" in few.findings[0].text


def test_of_four_runs_no_comparison_is_decided():
    third = ledger(experiment(n_runs=4))[2]

    assert {finding.verdict for finding in third.findings} == {UNDECIDED}
