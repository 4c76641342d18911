"""
What the blind studies found, as rows: by claim, by whisper, by teacher.

Page 9 shows the claims, the page on neighbours the others.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from ..experiments.results import Results, read_results
from ..experiments.stats import t_interval
from .blind import READINGS
from .blind_rules import (
    as_predicted,
    best_shares,
    by_building,
    compared,
    holding,
    judge_blind,
    log_ratio,
)
from .claims import CLAIMS, Claim
from .hypotheses import predictions
from .judgement import Judged, Read


def claims_table(read: Read = read_results) -> list[dict]:
    """
    Return a row for each of five claims: in how many buildings it holds, the verdict.

    The verdict is over buildings, by the interval of each finding.
    """
    results = read("blind")
    judged = judge_blind([f"P{claim.key}" for claim in CLAIMS[:5]], read)
    rows = []
    for claim, found in zip(CLAIMS[:5], judged.values(), strict=True):
        held = holding(results, claim)
        rows.append(
            {
                "claim": f"{claim.key}. {claim.title}",
                "holds in": f"{held.sum()} of {len(held)}",
                "over buildings": found.verdict,
                "as predicted": "yes" if as_predicted(found) else "no",
            }
        )
    return rows


def verdicts_table(judged: Mapping[str, Judged]) -> list[dict]:
    """Return a row for each hypothesis: what was predicted and known, what came."""
    said, rows = predictions(), []
    for key, found in judged.items():
        claim, _, predicted, known = said[key]
        rows.append(
            {
                "key": key,
                "claim": claim,
                "predicted": predicted,
                "known before": known,
                "verdict": found.verdict,
                "as predicted": "yes" if as_predicted(found) else "**no**",
            }
        )
    return rows


def weakest(results: Results, claim: Claim) -> np.ndarray:
    """
    Return by how much the weakest finding of a claim is as claimed, (buildings,).

    A share of goals beyond the finding's threshold; below 0 it is not as claimed.
    How advice drives is no share of goals, and is left out.
    """
    beyond = []
    for finding in claim.findings:
        if finding.kind == "goals":
            a, b = compared(results, finding)
            gain = a / b - 1 - finding.threshold
            beyond.append(gain if finding.above else -gain)
    return np.min(beyond, axis=0)


def whispers_table(
    readings: Iterable[str] = tuple(READINGS), read: Read = read_results
):
    """
    Return a row for each whisper or arm: goals, and gain over ND's hard advice.

    Mean thousands of goals in the drawn buildings, and the gain over buildings with
    its interval, by reading; in brackets the size, where it was tuned.
    """
    found, rows = {reading: read(f"whisper-{reading}") for reading in readings}, {}
    for reading, results in found.items():
        told = results.record["parameters"]["arms"]
        base = by_building(results, "nd-hard")
        for arm in told:
            goals = by_building(results, arm["name"])
            row = rows.setdefault(arm["name"], {"whispered": arm["name"]})
            size = f" (x {arm['size']:.3g})" if arm.get("size") else ""
            row[reading] = f"{goals.mean() / 1000:.0f}{size}: {gain(goals, base)}"
    return [{"whispered": ""} | dict.fromkeys(found, "") | row for row in rows.values()]


def teachers_table(read: Read = read_results) -> list[dict]:
    """Return a row for each teacher: its shares and tau, goals, gain over half."""
    results = read("teacher")
    base = by_building(results, "half")
    return [
        {
            "teacher": arm.name,
            "advice": arm.guide,
            "tau, millions": f"{arm.tau / 1e6:g}",
            "thousands of goals": f"{by_building(results, arm.name).mean() / 1000:.0f}",
            "over half": gain(by_building(results, arm.name), base),
        }
        for arm in results.arms
    ]


def shares_table(
    sizes: Iterable[str] = ("small", "middle", "large"), read: Read = read_results
) -> list[dict]:
    """Return a row for each size of building: thousands of goals by share, the best."""
    rows = []
    for size in sizes:
        results = read(f"teacher-{size}")
        best = t_interval(best_shares(results))
        row = {"size": size}
        for arm in results.arms:
            goals = by_building(results, arm.name).mean() / 1000
            row[arm.name.removeprefix("mix-")] = f"{goals:.1f}"
        ends = f"[{best.low:.2f}, {best.high:.2f}]"
        rows.append(row | {"best share": f"{best.estimate:.2f} {ends}"})
    return rows


def gain(a: np.ndarray, b: np.ndarray) -> str:
    """
    Return a's gain over b over buildings, both (B,), with its interval.

    >>> gain(np.array([1.1] * 5), np.ones(5))
    '+10.0 % [+10.0, +10.0]'
    """
    mean, low, high = (100 * np.expm1(x) for x in t_interval(log_ratio(a, b)))
    return f"{mean:+.1f} % [{low:+.1f}, {high:+.1f}]"
