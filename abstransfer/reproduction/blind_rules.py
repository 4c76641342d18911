"""
The hypotheses of the blind studies, judged: ``data/hypotheses-blind.md`` says them.

They and their rules were committed before the results.  Intervals are Student's,
over buildings: of the log of a ratio of goals, or of a difference of goals.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from ..experiments.results import Results, read_results
from ..experiments.stats import Interval, t_interval
from .claims import CLAIMS, Claim
from .hypotheses import FIVE, ND, OPERATED, PROB, contrast, predictions, share_of_lead
from .judgement import Judged, Part, Read, judge_by, of_count, of_mean, place
from .verdicts import Finding

WHERE = "drawn"
GOAL_READINGS = ("labels", "masked", "compass")
MOST = 20  # buildings of 24 in which a claim is to hold


def by_building(results: Results, arm: str) -> np.ndarray:
    """Return the goals of an arm in each building, mean of its runs, (buildings,)."""
    n = results.record["parameters"].get("runs_in_a_building", 1)
    return results.totals(arm).reshape(-1, n).mean(axis=1)


def log_ratio(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the log of a by b, in each building, (buildings,)."""
    return np.log(a) - np.log(b)


def _over(what: str, a: np.ndarray, b: np.ndarray, **bounds: float) -> Part:
    """Return the part that a's gain over b, over buildings, lies within bounds."""
    found = t_interval(log_ratio(a, b))
    effect = Interval(*(float(np.expm1(end)) for end in found))
    above = int((a > b).sum())
    text = f"{what} (above 0 in {above} of {len(a)})"
    return Part(WHERE, text, effect, "ratio", place(effect, **(bounds or {"low": 0})))


def _ratio(results: Results, a: str, b: str, reading: str = "", **bounds) -> Part:
    what = f"{a} over {b}" + (f", {reading}" if reading else "")
    return _over(what, by_building(results, a), by_building(results, b), **bounds)


# The paper's claims


def _claim(claim: Claim) -> Callable[[Read], Iterable[Part]]:
    def rule(read: Read) -> Iterable[Part]:
        results = read("blind")
        for finding in claim.findings:
            yield _finding(results, finding)

    return rule


def _finding(results: Results, finding: Finding) -> Part:
    a, b = compared(results, finding)
    side = "low" if finding.above else "high"
    if finding.kind == "driving":
        return of_mean(WHERE, finding.text, a - b, "reward", **{side: 0})
    return _over(finding.text, a, b, **{side: finding.threshold})


def compared(results: Results, finding: Finding) -> tuple[np.ndarray, np.ndarray]:
    """Return what a finding compares, in each building: two arrays (buildings,)."""
    if finding.kind == "driving":
        value = results.record["value"]
        return tuple(np.array(value[f"{p}-hard"]) for p in (finding.a, finding.b))
    return by_building(results, finding.a), by_building(results, finding.b)


def holding(results: Results, claim: Claim) -> np.ndarray:
    """Return whether all findings of a claim are as it says in a building, (B,)."""
    held = []
    for finding in claim.findings:
        a, b = compared(results, finding)
        beyond = a - b if finding.kind == "driving" else a / b - 1 - finding.threshold
        held.append(beyond > 0 if finding.above else beyond < 0)
    return np.all(held, axis=0)


def _in_most(read: Read) -> Iterable[Part]:
    results = read("blind")
    for claim in CLAIMS[:5:2]:
        held = holding(results, claim)
        least = round(len(held) * MOST / 24)
        yield of_count(WHERE, f"claim {claim.key} holds in", held, least)


# The explanations of page 10


def _yardstick(read: Read) -> Iterable[Part]:
    letters = read("blind-operations").record["letters"]
    nd, prob, grad = (np.array(letters[robot]) for robot in (ND, PROB, "grad"))
    yield _over("letters of ND over Prob", nd, prob)
    most = nd > np.maximum(prob, grad)
    yield of_count(WHERE, "ND delivers most", most, round(len(most) * MOST / 24))


def _no_lead(folder: str) -> Callable[[Read], Iterable[Part]]:
    def rule(read: Read) -> Iterable[Part]:
        for strategy in ("hard", "soft"):
            pair = f"nd-{strategy}", f"prob-{strategy}"
            yield _ratio(read(folder), *pair, high=0.01)

    return rule


def _coverage(read: Read) -> Iterable[Part]:
    for arm in ("half-hard", "eager-hard", "rand-hard"):
        yield _ratio(read("blind"), arm, "nd-hard")


def _waste(read: Read) -> Iterable[Part]:
    yield _ratio(read("blind"), "prob-noise-hard", "prob-hard", high=0)


def _traps(read: Read) -> Iterable[Part]:
    arms = "nd-hard", "prob-hard", "nd-prob-in-traps-hard", "prob-nd-in-traps-hard"
    nd, prob, worse, better = (by_building(read("blind"), arm) for arm in arms)
    lead, lost, gained = nd - prob, nd - worse, better - prob
    share = float(lost.mean() / lead.mean())
    text = "lost with Prob's rows in traps, less half the lead"
    yield of_mean(WHERE, text, lost - lead / 2, share=share)
    share = float(gained.mean() / lead.mean())
    text = "gained with ND's rows in traps, less a quarter of the lead"
    yield of_mean(WHERE, text, gained - lead / 4, share=share)
    yield of_mean(WHERE, "the lead, less that gain", lead - gained, share=share)


def _variation(read: Read) -> Iterable[Part]:
    results = read("blind")
    varies = results.record["variation"]
    taught = np.array([by_building(results, arm) for arm in varies])
    order = _kendall(np.array(list(varies.values())), taught)
    yield of_mean(WHERE, "Kendall of variation with goals", order, "")


def _kendall(measure: np.ndarray, taught: np.ndarray) -> np.ndarray:
    """Return Kendall's rank correlation in each building, of two (robots, B)."""
    from scipy.stats import kendalltau  # slow to load

    pairs = zip(measure.T, taught.T, strict=True)
    return np.array([kendalltau(*pair).statistic for pair in pairs])


def _operated(key: str) -> Callable[[Read], Iterable[Part]]:
    """Return the rule of an operation of page 10, over buildings."""

    def rule(read: Read) -> Iterable[Part]:
        results = read("blind-operations")
        for asked in OPERATED[key]:
            share = share_of_lead(results, asked.gained)
            sample = contrast(results, asked.weights)
            yield of_mean(WHERE, asked.text, sample, share=share)

    return rule


def _thirds(read: Read) -> Iterable[Part]:
    results = read("blind-operations")
    prob, near, far = (results.totals(n) for n in (PROB, "prob-near", "prob-far"))
    yield of_mean(WHERE, "the nearest third helps", near - prob)
    yield of_mean(WHERE, "the farthest third harms", far - prob, high=0)


def _ready_tells(read: Read) -> Iterable[Part]:
    results = read("blind-operations")
    taught = np.array([results.totals(robot) for robot in FIVE])
    ready, noted = (
        _kendall(np.array([results.record[m][robot] for robot in FIVE]), taught)
        for m in ("ready", "noted")
    )
    text = f"Kendall of ready {ready.mean():.2f}, less of noted {noted.mean():.2f}"
    yield of_mean(WHERE, text, ready - noted, "")


def _hint(read: Read) -> Iterable[Part]:
    results = read("blind")
    hint, none, nd = (by_building(results, a) for a in ("hint", "none", "nd-hard"))
    text = "hint over none, less 0.9 of ND over none"
    yield of_mean(WHERE, text, hint - none - 0.9 * (nd - none))


def _eager(read: Read) -> Iterable[Part]:
    yield _ratio(read("blind"), "eager-hard", "nd-hard", low=-0.1, high=0.1)


# Whispers: arms compared, with bounds, in some readings

Pair = tuple[str, str, Mapping[str, float]]
ABOVE, BELOW, ALIKE = {"low": 0}, {"high": 0}, {"low": -0.02, "high": 0.02}
COMPARED: dict[str, tuple[tuple[tuple[str, ...], Pair], ...]] = {
    "W1": ((GOAL_READINGS, ("values", "nd-hard", ABOVE)),),
    "W2": ((GOAL_READINGS, ("values", "half-hard", ABOVE)),),
    "W3": ((GOAL_READINGS, ("values", "exists", ABOVE)),),
    "W4": (
        (("labels",), ("values 1", "nd-hard", BELOW)),
        (("labels",), ("values 0.001", "values 1e-06", BELOW)),
        (("labels",), ("values 1e-40", "values 1e-06", ALIKE)),
    ),
    "W5": (
        (("labels",), ("values", "half", ABOVE)),
        (("labels",), ("half", "prob", ABOVE)),
        (("labels",), ("prob", "nd", ABOVE)),
    ),
    "W6": tuple(
        (GOAL_READINGS, ("values", f"values-{wrong}", ABOVE))
        for wrong in ("elsewhere", "wrong", "dealt")
    ),
    "W7": ((("labels",), ("values-other", "values", ALIKE)),),
    "W8": tuple(
        (("labels",), (f"values-{wrong}", "exists", BELOW))
        for wrong in ("wrong", "elsewhere")
    ),
    "W9": (
        (GOAL_READINGS, ("values-best fades", "values-best steady", {"low": 0.05})),
        (("labels", "masked"), ("exists fades", "exists steady", ABOVE)),
    ),
    "W10": ((GOAL_READINGS, ("values-best fades", "values", {"low": -0.05})),),
    "W12": (
        (("cost",), ("values 1e-09", "none", ALIKE)),
        (("cost",), ("values 1", "none", ABOVE)),
    ),
}


def _whispers(key: str) -> Callable[[Read], Iterable[Part]]:
    def rule(read: Read) -> Iterable[Part]:
        for readings, (a, b, bounds) in COMPARED[key]:
            for reading in readings:
                yield _ratio(read(f"whisper-{reading}"), a, b, reading, **bounds)

    return rule


def _gap(read: Read) -> Iterable[Part]:
    for reading in ("labels", "masked"):
        results = read(f"whisper-{reading}")
        values, nd, best = (
            by_building(results, arm) for arm in ("values", "nd-hard", "ceiling")
        )
        closed = (values - nd).mean() / (best - nd).mean()
        text = f"of the gap {closed:.0%} is closed; less 0.4 of it, {reading}"
        yield of_mean(WHERE, text, values - nd - 0.4 * (best - nd))


# Teachers


def _teaches(*pairs: Pair) -> Callable[[Read], Iterable[Part]]:
    def rule(read: Read) -> Iterable[Part]:
        for a, b, bounds in pairs:
            yield _ratio(read("teacher"), a, b, **bounds)

    return rule


def best_shares(results: Results) -> np.ndarray:
    """Return the share of the eager robot that taught best, in each building, (B,)."""
    names = [arm.name for arm in results.arms]
    taught = np.array([by_building(results, name) for name in names])
    return np.array([float(name.split("-")[1]) for name in names])[taught.argmax(0)]


def _grows(read: Read) -> Iterable[Part]:
    small, large = (best_shares(read(f"teacher-{s}")) for s in ("small", "large"))
    text = f"best share {large.mean():.2f} in large buildings, {small.mean():.2f} small"
    yield of_mean(WHERE, text, large - small, "")


def _whisper_and_teacher(read: Read) -> Iterable[Part]:
    whispered = by_building(read("whisper-labels"), "values")
    taught = by_building(read("teacher"), "grid-target")
    yield _over("values whispered over grid-target", whispered, taught)


RULES: dict[str, Callable[[Read], Iterable[Part]]] = {
    **{f"P{claim.key}": _claim(claim) for claim in CLAIMS[:5]},
    "P6": _in_most,
    "X1": _yardstick,
    "X2": _no_lead("blind"),
    "X3": _coverage,
    "X4": _waste,
    "X5": _no_lead("blind-cost"),
    "X6": _traps,
    "X7": _variation,
    **{f"Y{i}": _operated(f"N{i}") for i in range(1, 5)},
    "Y5": _thirds,
    "Y6": _ready_tells,
    "Y7": _hint,
    "Y8": _eager,
    **{key: _whispers(key) for key in COMPARED},
    "W11": _gap,
    "M1": _teaches(("half", "nd", ABOVE)),
    "M2": _teaches(("grid-target", "half", ALIKE)),
    "M3": _teaches(("search-target", "grid-target", ALIKE)),
    "M4": _teaches(
        ("grid-source", "half", BELOW),
        ("search-source", "half", BELOW),
    ),
    "M5": _grows,
    "M6": _whisper_and_teacher,
}

#: What the folders of a study can judge; M6 needs those of two.
OF_STUDY = {
    "blind": tuple(key for key in RULES if key[0] in "PXY"),
    "whisper": tuple(key for key in RULES if key[0] == "W"),
    "teacher": tuple(key for key in RULES if key[0] == "M" and key != "M6"),
}


def judge_blind(
    keys: Iterable[str] = tuple(RULES), read: Read = read_results
) -> dict[str, Judged]:
    """
    Return the verdict on hypotheses by their rules, by key.

    Parameters
    ----------
    keys : iterable of str
        As in ``data/hypotheses-blind.md``.
    read : callable
        Returns the results of a folder by its name; by default the stored ones.

    Raises
    ------
    ValueError
        If a key is unknown.
    FileNotFoundError
        If results are missing, by name.
    """
    return judge_by(RULES, keys, read)


def as_predicted(found: Judged) -> bool:
    """Return whether a verdict is the one that was predicted."""
    return re.split("[:;]", predictions()[found.key].predicted)[0] == found.verdict
