"""The scene of page 9: box plots fill run by run; when would you sign?"""

from __future__ import annotations

from functools import lru_cache

import traitlets

from ...experiments.arms import ARMS
from ...experiments.results import read_results
from ...reproduction.catalogue import TARGETS
from ...reproduction.claims import CLAIMS
from ...reproduction.optional_stopping import (
    FIRST_LOOK,
    KEYS,
    Stops,
    comparisons,
    orders,
    read_along,
    tracks,
)
from ...reproduction.verdicts import Finding
from ..base import Scene
from ..parts.student import STUDENT

RUNS = 50
BETS = {  # at most so many runs
    "few": (5, "5 runs"),
    "some": (15, "6 to 15"),
    "many": (30, "16 to 30"),
    "most": (RUNS, "more than 30"),
}
NINE = tuple(
    f"{reward}-{target}"
    for reward in ("cost", "goal")
    for target in ("target", "target-tuned", *TARGETS[1:])
)


class Filling(Scene):
    """
    Box plots that fill run by run: sign a claim when you would.

    Parameters
    ----------
    results : str
        Name of stored results of the nine arms, as ``read_results`` takes it.
    claim : {"1", "2", "3", "4", "5", "same"}
        What is judged; "same" compares one half of each arm's runs with the other.
    order : int, 0 to 4
        0: the runs as they ran; else a shuffle of them.
    n : int, 5 to 50
        Runs that are shown; fewer have no interval.
    signed : int
        Runs after which the reader signed; 0 before.

    Examples
    --------
    >>> scene = Filling(claim="2", n=10)
    >>> scene
    Filling(claim='2', n=10)
    >>> scene.verdict()  # after 10 runs
    'fails in part'
    >>> scene.reading("2").settled  # runs from which on no order says otherwise
    5
    """

    scene = "filling"
    constants = {
        "student": STUDENT,
        "settled": {name: most for name, (most, _) in BETS.items()},
        "bets": {
            "bet": {
                "question": "Bet first: after how many runs of each arm would you sign "
                "claim 1?",
                "options": {name: text for name, (_, text) in BETS.items()},
            }
        },
    }
    results = traitlets.Enum(NINE, "goal-target").tag(sync=True)
    claim = traitlets.Enum(KEYS, "1").tag(sync=True)
    order = traitlets.Int(0, min=0, max=4).tag(sync=True)
    n = traitlets.Int(FIRST_LOOK, min=FIRST_LOOK, max=RUNS).tag(sync=True)
    signed = traitlets.Int(0, min=0, max=RUNS).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    data = traitlets.Dict().tag(sync=True, local=True)  # follows `results`

    @traitlets.default("data")
    def _first_data(self) -> dict:
        return _data(self.results)

    @traitlets.observe("results")
    def _other_data(self, _) -> None:
        self.data = _data(self.results)

    @property
    def changed(self) -> dict:
        """The state where it is not the default; the data follow from `results`."""
        return {k: v for k, v in super().changed.items() if k != "data"}

    def options(self) -> dict:
        """Return the state of the built page, with the goals of all runs."""
        return self.changed | {"data": self.data}

    def verdict(self, n: int | None = None) -> str:
        """Return the verdict on `claim` after `n` runs, in the order of the scene."""
        track = _verdicts(self.results, self.claim)[self.order]
        return track[min((n or self.n) - FIRST_LOOK, len(track) - 1)]

    def reading(self, key: str) -> Stops:
        """Return what a reader does who looks after each run, in five orders."""
        return read_along(_verdicts(self.results, key))


@lru_cache(maxsize=4)
def _data(name: str) -> dict:
    """Return all that the browser needs of stored results."""
    results = read_results(name)
    titles = {claim.key: claim.title for claim in CLAIMS}
    return {
        "arms": [arm.name for arm in ARMS],
        "totals": [results.totals(arm.name).tolist() for arm in ARMS],
        "lives": orders(results.goals.shape[1]).tolist(),
        "firstLook": FIRST_LOOK,
        "readings": {key: read_along(_verdicts(name, key))._asdict() for key in KEYS},
        "claims": {
            key: {
                "title": titles.get(key, ""),
                "compared": [_compared(f) for f in comparisons(results, key)],
            }
            for key in KEYS
        },
    }


def _compared(finding: Finding) -> list:
    """Return text, arms, threshold, side, role, and an effect no run changes."""
    pair, fixed = (finding.a, finding.b), None
    if finding.kind != "goals":
        pair, fixed = ("", ""), finding.effect.estimate
    return [
        *(finding.text, *pair, finding.threshold),
        *(finding.above, finding.main, fixed),
    ]


@lru_cache(maxsize=16)
def _verdicts(name: str, key: str) -> list[list[str]]:
    return tracks(read_results(name), key)
