"""The still of the microscope: the building after three steps of one run."""

from __future__ import annotations

import numpy as np

from ...learning import Learner, q_learning
from ...navigation import navigation_tasks
from ...plotting.style import count, number
from ..base import Still
from ..parts.building import draw_building
from .widget import BET, STARTS, STEPS, Microscope


def draw(scene: Microscope) -> Still:
    """Return three moments, and the cells visited from each start."""
    n_cells = scene.map.n_cells
    counts = {start: _explored(scene, start) for start in STARTS}
    most, least = (f(counts, key=lambda start: counts[start][1]) for f in (max, min))
    caption = (
        f"Q-learning, one step at a time. Within {BET} steps a robot with reward "
        f"{STARTS[most][2]}, has stood on {number(counts[most][1])} of "
        f"{n_cells} cells, on average over 20 seeds; with reward "
        f"{STARTS[least][2]}, on {number(counts[least][1])}. Values that start "
        "above what can be had make a robot look around."
    )
    rows = [
        (STARTS[start][2], f"{here} of {n_cells}", number(mean))
        for start, (here, mean) in counts.items()
    ]
    head = ("reward and first values", f"cells visited in {BET} steps", "mean of 20")
    moments = sorted({scene.t or 1, (scene.t + STEPS) // 2, STEPS})
    return Still([_frame(scene, t) for t in moments], caption, head, rows)


def _frame(scene: Microscope, t: int) -> str:
    tasks, (_, q0, _) = scene.tasks, STARTS[scene.start]
    if scene.trace:
        q = np.full(tasks.available.shape, q0)
        for s, a, *_, after, _ in scene.trace[:t]:
            q[s, a] = after
        robot = scene.trace[t - 1][3]
    else:
        learned = q_learning(tasks.mdp, t, rng=scene.luck, q0=q0, trace=t)
        q, robot = learned.q, learned.trace.next_state[-1]
    best = np.where(tasks.mdp.terminal, np.nan, q.max(axis=1))
    known = np.append(best[np.isfinite(best)], 0.2 if scene.start == "goal" else 0.0)
    new = np.isfinite(best) & (best != q0)
    texts = [
        number(v, 2).replace("0.", ".") if n else ""
        for v, n in zip(best, new, strict=True)
    ]
    changed = f"{count(new.sum(), 'cell')} of {len(best)} changed their value"
    return draw_building(
        scene.map,
        f"The building after step {t}: {changed}.",
        values=best,
        limits=(known.min(), known.max()),
        texts=texts,
        robots={robot: ""},
        goal=tasks.goal[0],
    )


def _explored(scene: Microscope, start: str) -> tuple[int, float]:
    """Return the cells visited with this luck, and the mean over seeds 1 to 20."""
    reward, q0, _ = STARTS[start]
    task = min(scene.task, len(scene.map.goals) - 1)
    mdp = navigation_tasks(scene.map, reward=reward, keep=[task]).mdp
    learner = Learner(mdp, rngs=[scene.luck, *range(1, 21)], q0=q0, trace=BET)
    learner.advance(BET)
    traces = [result.trace for result in learner.results()]
    cells = [len({*trace.state, *trace.next_state}) for trace in traces]
    return cells[0], float(np.mean(cells[1:]))
