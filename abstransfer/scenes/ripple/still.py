"""The still of the ripples: the values after three numbers of sweeps."""

from __future__ import annotations

import numpy as np

from ...plotting.style import count, number
from ..base import Still
from ..parts.building import draw_building
from .widget import Ripple, wave_of


def draw(scene: Ripple) -> Still:
    """Return the sweep that is looked at, a later one, and the last."""
    tasks = range(len(scene.map.goals))
    waves = [wave_of(scene.map, task, scene.success) for task in tasks]
    here = waves[min(scene.task, len(waves) - 1)]
    last, far = len(here.sweeps) - 1, int(scene.news.max())
    cells = scene.map.n_cells - 1
    moments = sorted({min(scene.k, last), min((scene.k + far) // 2, last), last})
    moments = moments[:1] * (3 - len(moments)) + moments
    caption = (
        f"Values ripple out from the goal: its news reaches the farthest cell, "
        f"{count(far, 'step')} away, in sweep {far}, and every value is right to "
        f"within a hundredth after {count(last, 'sweep')} (moves succeed with "
        f"probability {scene.success:g}). More than one action is best in "
        f"{here.n_ties} of {cells} cells. In all {count(len(waves), 'task')} "
        f"it takes at most {max(len(wave.sweeps) - 1 for wave in waves)} sweeps, "
        f"and {sum(wave.n_ties for wave in waves)} of {cells * len(waves)} cells "
        "have more than one best action."
    )
    rows = [
        (k, f"{(scene.news <= k).sum()} of {cells + 1}", number(scene.errors[k], 3))
        for k in sorted({0, *moments, min(far, last)})
    ]
    head = ("sweeps", "cells that have heard", "largest error")
    return Still([_frame(scene, k) for k in moments], caption, head, rows)


def _frame(scene: Ripple, k: int) -> str:
    """Return the values after k sweeps, a dot where no news has come yet."""
    heard, sweep = scene.news <= k, scene.sweeps[k]
    texts = [
        "" if n == 0 else number(v, 1 if v > -10 else 0) if n <= k else "\u00b7"
        for n, v in zip(scene.news, sweep, strict=True)
    ]
    alt = (
        f"Values after {count(k, 'sweep')}: {heard.sum()} of {len(heard)} cells "
        f"have heard of the goal; the largest error is {number(scene.errors[k], 2)}."
    )
    return draw_building(
        scene.map,
        alt,
        values=np.where(heard, sweep, np.nan),
        limits=(scene.sweeps[-1].min(), 0.0),
        texts=texts,
        goal=int(np.flatnonzero(scene.news == 0)[0]),
    )
