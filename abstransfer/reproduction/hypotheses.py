"""
The hypotheses of the second edition, judged: ``data/hypotheses.md`` says them.

They, their rules and the numbers of runs were committed before the results.
Here each has its rule, by its key in that file.  Intervals are Student's, over
runs in pairs, or over buildings where each run has its own.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

import numpy as np

from .._paths import DATA
from ..experiments.results import Results, read_results
from ..experiments.stats import Interval
from ..experiments.tuning import tune
from .catalogue import TARGETS
from .judgement import (
    HOLDS,
    REFUTED,
    UNDECIDED,
    Judged,
    Part,
    Read,
    gains,
    judge_by,
    of_count,
    of_gain,
    of_mean,
)
from .readings import judge_reading
from .verdicts import FAILS, IN_PART

ND, PROB = "nd", "prob"
FIVE = (ND, PROB, "half", "eager", "wanderer")  # robots whose measures B4 compares
LEAD = {ND: 1, PROB: -1}


class Prediction(NamedTuple):
    """A row of ``data/hypotheses.md``, or of ``hypotheses-blind.md``, in its words."""

    claim: str  #: what is claimed
    rule: str  #: how it is judged
    predicted: str  #: what was predicted
    known: str = ""  #: what was known before; nothing of drawn buildings


def predictions() -> dict[str, Prediction]:
    """
    Return the rows of ``data/hypotheses.md`` and ``hypotheses-blind.md``, by key.

    >>> predictions()["N9"].predicted
    'holds in all four'
    """
    rows = [
        [cell.strip() for cell in line.strip("| ").split(" | ")]
        for path in sorted(DATA.glob("hypotheses*.md"))
        for line in path.read_text(encoding="utf-8").splitlines()
    ]
    return {
        key: Prediction(*words)
        for key, *words in rows
        if re.fullmatch(r"[A-Z]\d+", key)
    }


# Contrasts: arms with weights, run by run, above 0 if the hypothesis is right.


class Contrast(NamedTuple):
    """What is asked of operations."""

    text: str  #: in words
    weights: Mapping[str, float]  #: by arm
    gained: Mapping[str, float] = {}  #: what is compared with a share of the lead


def _beyond(text: str, share: float, more: str, less: str, sign=1) -> Contrast:
    """Return that a gain is more than a share of ND's lead; less, if sign is -1."""
    gained, weights = {more: 1, less: -1}, {}
    for arm in {**gained, **LEAD}:
        weights[arm] = sign * (gained.get(arm, 0) - share * LEAD.get(arm, 0))
    return Contrast(text, weights, gained)


OPERATED: dict[str, tuple[Contrast, ...]] = {
    "N1": (_beyond("necessary", 0.5, ND, "nd-erased"),),
    "N2": (_beyond("sufficient", 0.5, "prob-grafted", PROB),),
    "N3": (_beyond("how good hardly matters", 0.25, "perfect-on-prob", PROB, -1),),
    "N4": (_beyond("directions alone do", 0.75, "nd-directions", PROB),),
    "N5": (_beyond("wrong directions keep some", 0.25, "nd-wrong-way", PROB),),
    "N6": (Contrast("elsewhere keeps less", {"nd-wrong-way": 1, "nd-elsewhere": -1}),),
    "N7": (
        Contrast(
            "the nearest are the least useful",
            {"prob-middle": 0.5, "prob-far": 0.5, "prob-near": -1},
        ),
    ),
    "N8": (
        Contrast("ND's number is not enough", {ND: 1, "half-thinned": -1}),
        Contrast("on ND's own states it is", {"half-on-nd": 1, ND: -1}),
    ),
    "N9": (Contrast("tiny notes count", {ND: 1, "nd-large": -1}),),
    "N10": (Contrast("the wanderer digests", {"wanderer-digested": 1, ND: -1}),),
    "N11": (
        _beyond("digestion shrinks the lead", 1, "nd-digested", "prob-digested", -1),
    ),
}


def contrast(results: Results, weights: Mapping[str, float]) -> np.ndarray:
    """
    Return the weighted sum of the goals of arms, run by run, (N,).

    Raises KeyError naming the arms there are.
    """
    return sum(weight * results.totals(arm) for arm, weight in weights.items())


def share_of_lead(results: Results, gained: Mapping[str, float]) -> float:
    """Return a gain (arms with weights) as a share of ND's lead over Prob."""
    lead = contrast(results, LEAD).mean()
    return float(contrast(results, gained).mean() / lead)


def _operated(key: str, folders: Mapping[str, str]):
    """Return the rule of contrasts of operations, in these places and folders."""

    def rule(read: Read) -> Iterable[Part]:
        for where, folder in folders.items():
            results = read(folder)
            for asked in OPERATED[key]:
                share = asked.gained and share_of_lead(results, asked.gained)
                sample = contrast(results, asked.weights)
                yield of_mean(where, asked.text, sample, share=share or None)

    return rule


def _in_each_building(rule):
    """Return the rule that asks in each of the four buildings."""

    def ask(read: Read) -> Iterable[Part]:
        for where in TARGETS:
            yield from rule(read, where)

    return ask


def _paired(*samples: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return samples cut to the runs that all have: same number, same seed."""
    n = min(map(len, samples))
    return tuple(sample[:n] for sample in samples)


# Controls


def _hint_is_worth(read: Read, where: str) -> Iterable[Part]:
    nine = read(f"goal-{where}")
    hint, none, nd = _paired(
        read(f"controls-{where}").totals("hint"),
        nine.totals("none"),
        nine.totals("nd-hard"),
    )
    text = "hint over none, less 0.9 of ND over none"
    yield of_mean(where, text, hint - none - 0.9 * (nd - none))


def _masked_lead(read: Read, where: str) -> Iterable[Part]:
    masked, nine = read(f"masked-{where}"), read(f"goal-{where}")
    pair = masked.totals("nd-hard"), masked.totals("prob-hard")
    yield of_gain(where, "masked ND over masked Prob", *pair)
    nd, prob, *pair = _paired(*pair, nine.totals("nd-hard"), nine.totals("prob-hard"))
    more = gains(*pair) / 2 - gains(nd, prob)
    yield of_mean(where, "half the lead, less the masked lead", more, "ratio")


def _little_is_left(read: Read, where: str) -> Iterable[Part]:
    masked = read(f"masked-{where}")
    pair = masked.totals("nd-hard"), masked.totals("none")
    yield of_gain(where, "masked ND over masked none", *pair, high=0.15)


def _eager_is_as_good(read: Read, where: str) -> Iterable[Part]:
    eager = read(f"controls-{where}").totals("eager-hard")
    pair = _paired(eager, read(f"goal-{where}").totals("nd-hard"))
    yield of_gain(where, "eager hard over ND hard", *pair, low=-0.1, high=0.1)


# Traps


def _needs_its_traps(read: Read, where: str) -> Iterable[Part]:
    nd, prob, worse = _trapped(read, where, "nd-prob-in-traps-hard")
    share = (nd - worse).mean() / (nd - prob).mean()
    text = "lost with Prob's rows in traps, less half the lead"
    yield of_mean(where, text, nd - worse - (nd - prob) / 2, share=float(share))


def _traps_are_not_all(read: Read, where: str) -> Iterable[Part]:
    nd, prob, better = _trapped(read, where, "prob-nd-in-traps-hard")
    gained, lead = better - prob, nd - prob
    share = float(gained.mean() / lead.mean())
    text = "gained with ND's rows in traps, less a quarter of the lead"
    yield of_mean(where, text, gained - lead / 4, share=share)
    yield of_mean(where, "the lead, less that gain", lead - gained, share=share)


def _trapped(read: Read, where: str, arm: str) -> tuple[np.ndarray, ...]:
    traps = read(f"traps-{where}")
    return tuple(traps.totals(name) for name in ("beta-0-hard", "beta-1-hard", arm))


# A learner with a compass


def _claims_at_papers_tau(read: Read, where: str) -> Iterable[Part]:
    for entry in judge_reading(read(f"compass-{where}")):
        found, key = entry.verdict, entry.claim.key
        if key == "5":
            soft = next(f for f in entry.findings if f.a == "rand-soft")
            found, as_predicted = soft.verdict, FAILS
        else:
            as_predicted = IN_PART if key in ("2", "4") else HOLDS
        verdict = HOLDS if found == as_predicted else REFUTED
        verdict = UNDECIDED if found == UNDECIDED else verdict
        yield _of_claim(where, f"claim {key}: {entry.verdict}", verdict)


def _claims_at_own_tau(read: Read, where: str) -> Iterable[Part]:
    for entry in judge_reading(read(f"compass-{where}-tuned")):
        verdict = entry.verdict if entry.verdict in (HOLDS, UNDECIDED) else REFUTED
        text = f"claim {entry.claim.key}, tau tuned in target: {entry.verdict}"
        yield _of_claim(where, text, verdict)


def _of_claim(where: str, what: str, verdict: str) -> Part:
    return Part(where, what, Interval(*[np.nan] * 3), "", verdict)


def _tau_supports(read: Read) -> Iterable[Part]:
    found = {}
    for reading, name in (("labels", "goal"), ("compass", "compass")):
        tunings = tune(read(f"{name}-target-tau"))
        found[reading] = [bool(tuning.paper_inside) for tuning in tunings]
    labels, compass = (sum(inside) for inside in found.values())
    effect = Interval(float(labels - compass), np.nan, np.nan)
    text = f"arms whose set of equals holds the paper's tau: {labels} less {compass}"
    verdict = HOLDS if labels > compass else REFUTED
    yield Part("target", text, effect, f"of {len(found['labels'])}", verdict)


def _hint_is_worth_less(read: Read, where: str) -> Iterable[Part]:
    compass = read(f"compass-{where}")
    samples = _paired(
        read(f"controls-{where}").totals("hint"),
        read(f"goal-{where}").totals("none"),
        compass.totals("hint"),
        compass.totals("none"),
    )
    less = gains(*samples[:2]) - gains(*samples[2:])
    yield of_mean(
        where, "hint over none with labels, less with a compass", less, "ratio"
    )


# Tau


def both_grids(coarse: Results, fine: Results) -> Results:
    """Return two grids of tau as one, of the arms and runs that both have."""
    n = min(coarse.goals.shape[1], fine.goals.shape[1])
    names = {arm.name for arm in fine.arms}
    kept = [i for i, arm in enumerate(coarse.arms) if arm.name in names]
    return Results(
        tuple(coarse.arms[i] for i in kept) + fine.arms,
        np.concatenate([coarse.goals[kept, :n], fine.goals[:, :n]]),
        coarse.record,
    )


def _equals(read: Read) -> Iterable[Part]:
    both = both_grids(read("goal-target-tau"), read("goal-target-tau-fine"))
    for tuning in tune(both):
        if tuning.name in ("nd-hard", "prob-hard"):
            equals = ", ".join(f"{tau / 1e6:g}" for tau in tuning.as_good)
            text = f"{tuning.name}: tau that may be the best, millions: {equals}"
            right = tuning.paper_inside and len(tuning.as_good) > 1
            effect = Interval(float(len(tuning.as_good)), np.nan, np.nan)
            yield Part("target", text, effect, "tau", HOLDS if right else REFUTED)


def _eager_soft(read: Read) -> Iterable[Part]:
    own = read("study-own")
    pair = own.totals("available-soft"), own.totals("beta-0-soft")
    yield of_gain("target", "eager soft over ND soft, own tau", *pair, low=-0.02)


def _still_leads(read: Read) -> Iterable[Part]:
    own = read("study-own")
    for strategy in ("hard", "soft"):
        pair = own.totals(f"beta-0-{strategy}"), own.totals(f"beta-1-{strategy}")
        yield of_gain("target", f"ND over Prob, {strategy}, own tau", *pair)


# Drawn buildings: the interval is over buildings


def _over(read: Read, better: str, text: str, least: int | None) -> Iterable[Part]:
    drawn, worse = read("drawn"), ND if better != ND else PROB
    logs = np.log(drawn.totals(better)) - np.log(drawn.totals(worse))
    yield of_mean("drawn", f"{text}, log of the ratio", logs, "log ratio")
    if least:
        yield of_count("drawn", f"{text}, in buildings", logs > 0, least)


def _drives(read: Read) -> Iterable[Part]:
    record = read("drawn").record
    for measure, best, text in (
        ("letters", np.argmax, "ND delivers most letters in 500,000 steps"),
        ("value", np.argmin, "ND drives worst by value at 0.99"),
    ):
        by_robot = record[measure]
        values = np.array(list(by_robot.values()))  # (robots, N)
        first = np.array(list(by_robot))[best(values, axis=0)]
        yield of_count("drawn", text, first == ND, 16)


def _ready_tells(read: Read) -> Iterable[Part]:
    from scipy.stats import kendalltau  # slow to load

    drawn = read("drawn")
    taught = np.array([drawn.totals(robot) for robot in FIVE])  # (5, N)
    tell = {}
    for measure in ("ready", "noted"):
        of = np.array([drawn.record[measure][robot] for robot in FIVE])
        pairs = zip(of.T, taught.T, strict=True)
        tell[measure] = np.array([kendalltau(*pair).statistic for pair in pairs])
    means = {name: float(each.mean()) for name, each in tell.items()}
    text = "Kendall of ready {ready:.2f}, less of noted {noted:.2f}".format(**means)
    yield of_mean("drawn", text, tell["ready"] - tell["noted"], "")


IN_FOUR = {where: f"operations-{where}" for where in TARGETS}
IN_DRAWN = {"drawn": "drawn"}
RULES: dict[str, Callable[[Read], Iterable[Part]]] = {
    **{key: _operated(key, IN_FOUR) for key in OPERATED},
    "C1": _in_each_building(_hint_is_worth),
    "C2": _in_each_building(_masked_lead),
    "C3": _in_each_building(_little_is_left),
    "C4": _in_each_building(_eager_is_as_good),
    "T1": _in_each_building(_needs_its_traps),
    "T2": _in_each_building(_traps_are_not_all),
    "K1": _in_each_building(_claims_at_papers_tau),
    "K2": _in_each_building(_claims_at_own_tau),
    "K3": _tau_supports,
    "K4": _in_each_building(_hint_is_worth_less),
    "A1": _equals,
    "A2": _eager_soft,
    "A3": _still_leads,
    "B1": lambda read: _over(read, ND, "ND over Prob", 18),
    "B2": lambda read: [
        part for key in ("N1", "N2") for part in _operated(key, IN_DRAWN)(read)
    ],
    "B3": _drives,
    "B4": _ready_tells,
    "B5": lambda read: _over(read, "half", "half ND, half eager over ND", None),
}


def judge_hypotheses(
    keys: Iterable[str] = tuple(RULES), read: Read = read_results
) -> dict[str, Judged]:
    """
    Return the verdict on hypotheses by their rules, by key.

    Parameters
    ----------
    keys : iterable of str
        As in ``data/hypotheses.md``.
    read : callable
        Returns the results of a folder by its name; by default the stored ones.

    Raises
    ------
    ValueError
        If a key is unknown.
    FileNotFoundError
        If results are missing, by name.

    Examples
    --------
    >>> judge_hypotheses(["N1"])["N1"].verdict
    'holds'
    """
    return judge_by(RULES, keys, read)


def hypotheses_table(judged: Mapping[str, Judged]) -> list[dict]:
    """Return a row for each part of each hypothesis, with what was predicted."""
    said = predictions()
    return [
        {
            "hypothesis": key,
            "claim": said[key].claim,
            "predicted": said[key].predicted,
            "verdict": found.verdict,
            "where": part.where,
            "part": part.what,
            "effect": part_text(part),
            "part_verdict": part.verdict,
        }
        for key, found in judged.items()
        for part in found.parts
    ]


def places_table(judged: Mapping[str, Judged]) -> list[dict]:
    """
    Return a row for each hypothesis: predicted, known before, and place by place.

    A part is told by its share of ND's lead, where it was asked for one, else by
    its effect, or in words where that has no interval; several parts of a place
    stand one after the other.
    """
    said, rows = predictions(), []
    for key, found in judged.items():
        claim, _, predicted, known = said[key]
        row = {"key": key, "claim": claim, "predicted": predicted}
        row |= {"known before": known or "nothing", "verdict": found.verdict}
        for part in found.parts:
            text = f"{_told(part)}: {part.verdict}"
            if np.isnan(part.effect.low):
                words = filter(None, (part.what, part_text(part)))
                came = {HOLDS: "as predicted", REFUTED: "not as predicted"}
                text = f"{': '.join(words)} ({came.get(part.verdict, part.verdict)})"
            row[part.where] = "; ".join(filter(None, (row.get(part.where), text)))
        rows.append(row)
    return rows


def _told(part: Part) -> str:
    return f"{100 * part.share:.0f} %" if part.share else part_text(part)


def part_text(part: Part) -> str:
    """
    Return the effect of a part with its interval, and its share of the lead.

    >>> part = Part("target", "", Interval(0.25, 0.24, 0.267), "ratio", HOLDS)
    >>> part_text(part)
    '+25.0 % [+24.0, +26.7]'
    """
    if np.isnan(part.effect.estimate):
        return ""
    factor, unit, digits = {
        "ratio": (100, " %", 1),
        "goals": (1, " goals", 0),
        "log ratio": (1, "", 3),
        "": (1, "", 2),
    }.get(part.unit, (1, f" {part.unit}", 0))
    sign = "" if np.isnan(part.effect.low) else "+"
    estimate, *ends = (f"{factor * x:{sign},.{digits}f}" for x in part.effect)
    text = f"{estimate}{unit}" + (f" [{', '.join(ends)}]" if sign else "")
    if part.share is not None:
        text += f"; {100 * part.share:.0f} % of the lead"
    return text
