"""
Three studies whose rules came first, as data: what is run in which buildings.

All three are judged in 24 drawn buildings that nobody had looked at.  `BLIND` asks
there for the paper's claims and the explanations of page 10.  `WHISPER` asks for
transfer by first notes alone, `TEACHER` for the best mixture of ND and the eager
robot; what they tune is tuned in the target, or in the source, with other seeds.
What is predicted stands in ``data/hypotheses-blind.md``.
"""

from __future__ import annotations

from ..experiments.arms import ARMS
from .folders import Operated, Searched, Survey
from .guides import TAU, TINY
from .operations import MAIN
from .surveys import Told, told
from .teachers import SHARES, START, TAUS
from .whispers import CEILING, EXISTS, SIZES, STEADY, TEACH

SEEDS = tuple(range(100, 124))  # of the 24 buildings
SIZED = tuple(range(200, 208))  # of those in three sizes
BLOCKS = {"small": (3, 10), "middle": (6, 10), "large": (9, 10)}
HALF = "nd-available-0.5"  # half ND, half eager
_HARD = TAU["hard"]

#: The eleven arms of page 9: nine, a hint of what exists, the eager robot.
#:
#: :meta hide-value:
ELEVEN = (
    *map(Told, ARMS),
    Told(ARMS[0]._replace(name="hint", hint=TINY)),
    told("eager-hard", "available", _HARD),
)
#: For the explanations of page 10: half eager; Prob and noise; rows in traps.
EXPLAIN = (
    told("half-hard", HALF, _HARD),
    told("prob-noise-hard", "prob-all-0.5", _HARD),
    told("prob-nd-in-traps-hard", "prob-nd-in-traps", _HARD),
    told("nd-prob-in-traps-hard", "nd-prob-in-traps", _HARD),
)
DRIVERS = ("nd-hard", "prob-hard", "grad-hard", "half-hard", "eager-hard", "rand-hard")
BLIND = (
    Survey("blind", 3, ELEVEN + EXPLAIN, seeds=SEEDS, drives=DRIVERS),
    Survey(
        "blind-cost",
        3,
        tuple(map(Told, ARMS[3:7])),
        seeds=SEEDS,
        problem={"reward": "cost"},
    ),
    Operated(
        "blind-operations",
        len(SEEDS),
        None,
        SEEDS[0],
        (
            *MAIN,
            *("perfect", "perfect-on-prob", "nd-directions", "prob-near", "prob-far"),
        ),
    ),
)

READINGS = {
    "labels": {},
    "masked": {"unavailable": "masked"},
    "compass": {"actions": "compass"},
    "cost": {"reward": "cost"},
}
GUIDES = {"nd-hard": "beta-0", "half-hard": HALF}
SWEPT = (
    *(
        told(f"{table} {size:g}", table=table, size=size)
        for table in (EXISTS, *TEACH)
        for size in SIZES
    ),
    *(told(n, guide, tau) for n, guide in GUIDES.items() for tau in (*TAUS, 6_000_000)),
)
CONTROLS = ("elsewhere", "wrong", "dealt", "other")
#: The same notes, of a size that fades where they are obeyed in vain, or cannot.
FADE = {"fades": 1e-9, "steady": STEADY}


def _whispers(reading: str) -> tuple[Told, ...]:
    """Return the arms of a reading in the 24 buildings; sizes and tau are its own."""
    own = f"whisper-sweep-{reading}"
    sizes = {"labels": (1, 1e-3, 1e-6, 1e-20, 1e-40), "cost": (1, 1e-9)}
    return (
        told("none"),
        *(told(name, guide, own=own) for name, guide in GUIDES.items()),
        *(told(table, table=table, own=own) for table in (EXISTS, *TEACH)),
        *(told(f"values-{c}", table=f"values-{c}", own=own) for c in CONTROLS),
        *(
            told(f"{table} {word}", table=table, size=size)
            for table in ("values-best", EXISTS)
            for word, size in FADE.items()
        ),
        *(
            told(f"values {size:g}", table="values", size=size)
            for size in sizes.get(reading, ())
        ),
        told("ceiling", table=CEILING),
    )


WHISPER = (
    *(
        Survey(
            f"whisper-sweep-{reading}",
            3,
            SWEPT,
            target="target",
            problem=problem,
            stream="tune",
        )
        for reading, problem in READINGS.items()
    ),
    *(
        Survey(
            f"whisper-{reading}", 1, _whispers(reading), seeds=SEEDS, problem=problem
        )
        for reading, problem in READINGS.items()
    ),
)

_MIXED = tuple(
    told(f"{START}{share:g}", f"{START}{share:g}", tau)
    for share in SHARES
    for tau in TAUS
)
TEACHER = (
    Survey(
        "teacher-grid-source",
        12,
        _MIXED,
        target="source",
        stream="tune",
        per_state=True,
    ),
    Survey("teacher-grid-target", 3, _MIXED, target="target", stream="tune"),
    Searched("teacher-search-source", 12, "source"),
    Searched("teacher-search-target", 3, "target"),
    Survey(
        "teacher",
        3,
        (
            told("nd", "beta-0", _HARD),
            told("eager", "available", _HARD),
            told("half", HALF, 2_000_000),
            *(
                told(f"{how}-{where}", START, own=f"teacher-{how}-{where}")
                for how in ("grid", "search")
                for where in ("source", "target")
            ),
        ),
        seeds=SEEDS,
    ),
    *(
        Survey(
            f"teacher-{size}",
            3,
            tuple(told(f"{START}{s:g}", f"{START}{s:g}", 2_000_000) for s in SHARES),
            seeds=SIZED,
            blocks=blocks,
            per_state=True,
        )
        for size, blocks in BLOCKS.items()
    ),
)
