"""The still of the slider for tau: Q-learning, the paper's tau, and the slider's."""

from __future__ import annotations

from collections.abc import Mapping

from ...experiments.arms import ARMS, STRATEGIES
from ..base import Still
from ..parts.charts import learning_curves
from ..parts.runs import NAMES, scaled
from .widget import TauSlider, millions


def draw(scene: TauSlider) -> Still:
    """Return the curves without advice, and twice with hard and soft advice, too."""
    grid = {arm.name: arm.tau for arm in ARMS}
    paper = {strategy: grid[f"{scene.guide}-{strategy}"] for strategy in STRATEGIES}
    here = dict.fromkeys(STRATEGIES, scene.tau)
    name, none = NAMES[scene.guide], f"{scene.learn(scene.arm(None)).sum():,}"
    rows = [
        (f"{name} {strategy}", millions(tau), f"{goals.sum():,}")
        for taus in (paper, here)
        for strategy, tau in taus.items()
        for goals in [scene.learn(scene.arm(strategy, tau))]
    ]
    totals = [goals for *_, goals in rows]
    caption = (
        f"How long should a guide advise? With {name}, {millions(scene.tau)} steps "
        f"of advice lead to {totals[2]} goals if it advises in all of them (hard), "
        f"to {totals[3]} if ever less often (soft); the paper's choices, "
        f"{rows[0][1]} and {rows[1][1]}, to {totals[0]} and {totals[1]}; plain "
        f"Q-learning, to {none}."
    )
    frames = [_frame(scene, taus) for taus in ({}, paper, here)]
    head = ("advice", "until step \u03c4", "goals of a whole run")
    return Still(frames, caption, head, [(NAMES["none"], "\u2013", none), *rows])


def _frame(scene: TauSlider, taus: Mapping[str, int]) -> str:
    """Return the curves with these tau, by strategy, and without advice."""
    curves = {NAMES["none"]: ("none", scene.learn(scene.arm(None)))}
    alt = "Goals by step, without advice"
    for strategy, tau in taus.items():
        arm = scene.arm(strategy, tau)
        curves[strategy] = arm.name, scene.learn(arm)
        alt += f", and with {NAMES[scene.guide]} {strategy} until step {millions(tau)}"
    same = len(set(taus.values())) == 1
    line = scaled(scene.arm("hard"), scene.steps) if same else None
    return learning_curves(curves, f"{alt}.", steps=scene.scale.steps, line=line)
