"""
The hypotheses of the bench, judged: ``data/hypotheses-bench.md`` says them.

They, their rules and the numbers of runs were committed before the results.  Here
each has its rule, by its key in that file; intervals are over the drawn buildings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from ..experiments.results import read_results
from ..experiments.stats import rank_interval
from .bench import BEST_OF_PAPER, CEILING, DRAWN, NAMES, TARGET
from .judgement import Judged, Part, Read, judge_by, of_mean, place

UNINFORMED = (
    *("optimism", "hold", "z-greedy", "decay", "bonus", "q-lambda", "replay"),
)
OTHERS = tuple(name for name in NAMES if name not in ("whisper", CEILING))


def _over(*pairs: tuple[str, str]) -> Callable[[Read], Iterable[Part]]:
    """Return the rule that the first of each pair reaches more goals."""

    def rule(read: Read) -> Iterable[Part]:
        goals = read(DRAWN)
        for more, less in pairs:
            logs = np.log(goals.totals(more)) - np.log(goals.totals(less))
            yield of_mean("drawn", f"{more} over {less}", logs, "log ratio")

    return rule


def _short(name: str, **bounds: float) -> Callable[[Read], Iterable[Part]]:
    """Return the rule that the shortfall of a method lies within bounds."""

    def rule(read: Read) -> Iterable[Part]:
        goals = read(DRAWN)
        missed = 1 - goals.totals(name) / goals.totals(CEILING)
        yield of_mean("drawn", f"shortfall of {name}", missed, "ratio", **bounds)

    return rule


def _same_ladder(read: Read) -> Iterable[Part]:
    from scipy.stats import kendalltau  # slow to load

    means = [
        [read(folder).totals(name).mean() for name in NAMES]
        for folder in (TARGET, DRAWN)
    ]
    effect = rank_interval(float(kendalltau(*means).statistic), len(NAMES))
    text = "Kendall of both ladders"
    yield Part("drawn", text, effect, "", place(effect, low=0.7))


RULES: dict[str, Callable[[Read], Iterable[Part]]] = {
    "R1": _over(*(("whisper", x) for x in (BEST_OF_PAPER, "nd-soft", "half-hard"))),
    "R2": _over(*(("whisper", other) for other in OTHERS)),
    "R3": _over(("whisper", "values"), ("whisper", "max-values")),
    "R4": _over(("hint", "shaping")),
    "R5": _over(("heuristic", BEST_OF_PAPER)),
    "R6": _over((BEST_OF_PAPER, "jump-random"), (BEST_OF_PAPER, "reuse")),
    "R7": _over(("prior", "none"), (BEST_OF_PAPER, "prior")),
    "R8": _over(*(("hint", other) for other in UNINFORMED)),
    "R9": _over(("reuse", "library")),
    "R10": _over(("reuse", "reuse-random")),
    "R11": _over(("jump-stages", "jump-random")),
    "R12": _short("whisper", high=0.15),
    "R13": _short("none", low=0.5),
    "R14": _same_ladder,
}


def judge_bench(
    keys: Iterable[str] = tuple(RULES), read: Read = read_results
) -> dict[str, Judged]:
    """
    Return the verdict on hypotheses of the bench by their rules, by key.

    Parameters
    ----------
    keys : iterable of str
        As in ``data/hypotheses-bench.md``.
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
