"""The still of surgery on notes: two robots as left, one erased, one grafted."""

from __future__ import annotations

from ..base import Still
from ..parts.charts import learning_curves
from .widget import Surgery

OPERATED = {
    "ND": ("nd", "none"),
    "Prob": ("prob", "none"),
    "ND, blank where Prob is": ("nd", "erase"),
    "Prob + ND's notes": ("prob", "graft"),
}


def draw(scene: Surgery) -> Still:
    """Return the curves after the advice: as left, then with either operation."""
    names, goals = [*OPERATED], scene.goals_of(OPERATED.values())
    curves = dict(zip(names, goals, strict=True))
    nd, prob, erased, grafted = (int(goals.sum()) for goals in curves.values())
    caption = (
        f"Surgery on notes. After 3.5 of 30 million steps of advice ND's robot reaches "
        f"{nd:,} goals, Prob's {prob:,}. Erase ND's notes where Prob has none, and it "
        f"reaches {erased:,}; give Prob just these notes, and it reaches {grafted:,}."
    )
    rows = [
        (name, f"{scene.noted(*pair):.0%}", f"{curves[name].sum():,}")
        for name, pair in OPERATED.items()
    ]
    frames = [
        _frame(scene, curves, shown) for shown in (names[:2], names[:3], names[1::2])
    ]
    head = ("robot", "states with a note", "goals after the advice")
    return Still(frames, caption, head, rows)


def _frame(scene: Surgery, curves, names) -> str:
    """Return the curves of some robots."""
    looks = ("nd-hard", "prob-hard", "nd-soft", "prob-soft")
    arms = dict(zip(OPERATED, looks, strict=True))
    steps = scene.scale.window * len(curves[names[0]])
    alt = f"Goals by step after the advice: {'; '.join(names)}."
    return learning_curves({n: (arms[n], curves[n]) for n in names}, alt, steps=steps)
