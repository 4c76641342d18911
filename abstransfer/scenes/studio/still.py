"""The still of Map Studio: a building, its task under ND, and under the best policy."""

from __future__ import annotations

from functools import lru_cache

from ...builders import BUILDERS, abstract_policies
from ...driving import PAPER, ROWS, column
from ...maps import Map
from ...navigation import navigation_tasks
from ...plotting.style import arm_style, count, number
from ...solvers import evaluate_policy, optimal_values
from ..base import Still
from ..parts.building import draw_building
from .widget import Studio

MANY = 2000  # states: from here on, Python would be slow to climb to Grad


def draw(scene: Studio) -> Still:
    """Return the building three times, twice with values of its cells."""
    map_, tasks = scene.map, scene.tasks
    policies = _policies(map_)
    row = column(tasks, policies)
    task = min(scene.task, len(map_.goals) - 1)
    one = navigation_tasks(map_, keep=[task])
    size = (
        f"{count(map_.n_cells, 'cell')}, {count(map_.n_rooms, 'room')}, "
        f"{count(map_.n_doors, 'door')} and {count(len(map_.goals), 'goal')}"
    )
    looks = {
        "robots": {min(scene.start, map_.n_cells - 1): ""},
        "goal": int(map_.goals[task]),
    }
    values = {
        "ND": evaluate_policy(one.mdp, policies["nd"][one.rho]),
        "the best policy": optimal_values(one.mdp),
    }
    frames = [draw_building(map_, f"A building with {size}.", **looks)]
    for name, v in values.items():
        alt = f"Values of {name}, from {number(v.min())} to 0 at the goal."
        frames.append(draw_building(map_, alt, values=v, limits=(-100, 0), **looks))
    names = {name: arm_style(name).name for name in ROWS}
    worth = ", ".join(
        f"{names[name]} {number(row[name])}" for name in ROWS if name in row
    )
    caption = (
        f"Map Studio: a building with {size}, which makes "
        f"{count(tasks.mdp.n_states, 'state')} and "
        f"{count(row['abstract_states'], 'abstract state')}. What a cell is worth, "
        f"on average, to policies built in it: {worth}."
    )
    is_source = (map_.n_cells, map_.n_rooms, len(map_.goals)) == (135, 11, 11)
    paper = PAPER["source"] if is_source else {}
    rows = [
        (names[name], _rounded(row.get(name)), _rounded(paper.get(name)))
        for name in ROWS
    ]
    return Still(frames, caption, ("policy", "here", "the paper"), rows)


@lru_cache(maxsize=2)
def _policies(map_: Map) -> dict:
    """Return the policies built in a building; climbing to Grad is slow."""
    tasks = navigation_tasks(map_)
    small = tasks.mdp.n_states < MANY
    return abstract_policies(tasks, BUILDERS if small else BUILDERS[:2])


def _rounded(x: float | None) -> str:
    return "\u2013" if x is None else number(x, 2)
