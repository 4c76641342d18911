"""The still of the race: its start, the robots on their way, and all steps."""

from __future__ import annotations

from ...experiments.problem import Problem, target_tasks
from ...experiments.results import read_results
from ...plotting.buildings import place
from ..base import Still
from ..parts.building import draw_building
from ..parts.charts import learning_curves
from ..parts.runs import NAMES
from .widget import LETTERS, Race

GOT = {
    "none": "got no advice",
    "rand": "the wanderer advised",
    "yours": "your policy advised",
}


def draw(scene: Race) -> Still:
    """Return two moments of the building, and the curves of all."""
    runs = {arm.guide or "none": scene.learn(arm) for arm in scene.arms}
    order = sorted(runs, key=lambda name: -runs[name].sum())
    best, steps = order[0], scene.scale.steps
    each = ", ".join(f"{NAMES[name]} {runs[name].sum():,}" for name in order)
    caption = (
        f"The race: robots that differ only in the advice they get. In "
        f"{steps / 1e6:g} million steps, with the luck of run {scene.luck}, the robot "
        f"that {GOT.get(best, f'{NAMES[best]} advised')} reached most goals: {each}."
    )
    if scene.problem == Problem():
        told = read_results("controls-target").totals("eager-hard").mean()
        caption += (
            " Before you take that for the worth of another building: a robot that is "
            "told only what can be done here reaches, in 30 million steps, "
            f"{told:,.0f} on average."
        )
    curves = {NAMES[name]: (name, goals) for name, goals in runs.items()}
    alt = f"Goals in {steps / 1e6:g} million steps: {each}."
    frames = [*_moments(scene), learning_curves(curves, alt, steps=steps)]
    rows = [
        (
            f"{NAMES[name]} ({LETTERS[name]})",
            f"{runs[name][: len(runs[name]) // 2].sum():,}",
            f"{runs[name].sum():,}",
        )
        for name in order
    ]
    half = f"{steps // 2 / 1e6:g}"
    head = ("advice", f"goals in the first {half} million", "goals in all")
    return Still(frames, caption, head, rows)


def _moments(scene: Race) -> list[str]:
    """Return the building at the start, and at the step that is looked at."""
    map_, t = scene.map, max(scene.t, 1)
    traces = {arm.guide or "none": scene.first_steps(arm) for arm in scene.arms}
    task, start = divmod(int(traces["none"].state[0]), map_.n_cells)
    goal = int(target_tasks(scene.problem).goal[task])
    robots = {}
    for name, trace in traces.items():
        cell = int(trace.next_state[t - 1]) % map_.n_cells
        robots[cell] = robots.get(cell, "") + LETTERS[name]
    begin = f"All robots start in{place(map_, start, '')}, with one goal."
    key = ", ".join(f"{LETTERS[name]} {NAMES[name]}" for name in traces)
    later = f"Where the robots are after step {t}: {key}."
    return [
        draw_building(map_, begin, robots={start: ""}, goal=goal),
        draw_building(map_, later, robots=robots, goal=goal),
    ]
