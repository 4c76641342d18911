"""The still of whispered advice: no advice, ND's advice, and values at two sizes."""

from __future__ import annotations

from ..base import Still
from ..parts.charts import learning_curves
from .widget import Whisper

LOOKS = {"no advice": "none", "ND's advice": "nd-hard"}


def draw(scene: Whisper) -> Still:
    """Return the curves of both rivals, then with values whispered, then said aloud."""
    quiet = f"values x 1e-{scene.power}"
    whispers = scene.goals_of([("values", scene.power), ("values", 0)])
    curves = {
        "no advice": scene.goals("none"),
        "ND's advice": scene.goals("advice"),
        quiet: whispers[0],
        "values x 1": whispers[1],
    }
    none, advice, soft, loud = (f"{int(goals.sum()):,}" for goals in curves.values())
    caption = (
        f"Whispered advice. Without advice a robot reaches {none} goals, with ND's "
        f"hard advice {advice}. Started from the small building's values, times 1e-"
        f"{scene.power}, and never advised, it reaches {soft}; from the values as "
        f"they are, {loud}."
    )
    looks = LOOKS | {quiet: "prob-hard", "values x 1": "prob-soft"}
    names = [*curves]
    frames = [
        learning_curves(
            {name: (looks[name], curves[name]) for name in shown},
            f"Goals by step: {'; '.join(shown)}.",
            steps=scene.scale.steps,
        )
        for shown in (names[:2], names[:3], names)
    ]
    rows = [(name, f"{goals.sum():,}") for name, goals in curves.items()]
    return Still(frames, caption, ("robot", "goals of a whole run"), rows)
