"""The still of what a robot sees: advice as arrows, in two buildings."""

from __future__ import annotations

from ...maps import read_map
from ...plotting.style import count
from ..base import Still
from ..parts.building import draw_building
from .widget import MAPS, Sights

WORDS = {"N": "north", "E": "east", "S": "south", "W": "west"}


def draw(scene: Sights) -> Still:
    """Return the robot in its cell, then the arrows in the large and small building."""
    map_, goal = read_map(MAPS[scene.size]), int(scene.tasks.goal[0])
    cell = min(scene.cell, map_.n_cells - 1)
    row, column = (1 + int(i) for i in divmod(cell, map_.shape[1]))
    alt = f"A robot in row {row}, column {column}, with the goal that counts."
    frames = [draw_building(map_, alt, robots={cell: ""}, goal=goal)]
    for size in ("large", "small"):
        other = Sights(size=size, task=scene.task)
        building = other.tasks.maps[0]
        alt = f"The {size} building: in {count(building.n_cells - 1, 'cell')} arrows."
        frames.append(
            draw_building(building, alt, arrows=other.arrows, goal=other.tasks.goal[0])
        )
    rows = [(way, *_words(scene.seen.get(letter, ""))) for letter, way in WORDS.items()]
    sights = "; ".join(f"{way}: {kind}, {side}" for way, kind, side in rows if side)
    caption = (
        f"What a robot sees from the cell in row {row}, column {column} of the "
        f"{scene.size} building. {sights[0].upper()}{sights[1:]}. The arrows are one "
        "sheet of advice, made in the small building: longer where it is surer. The "
        "same sheet makes sense in the large one, because it speaks of what is seen."
    )
    return Still(frames, caption, ("way", "sees", "the goal"), rows)


def _words(label: str) -> tuple[str, str]:
    """
    Return what is seen, and whether the way leads to the goal, of a label.

    >>> _words("see_door_far_head_to_goal")
    ('door far', 'head to goal')
    """
    for side in ("head_to_goal", "opposite_to_goal"):
        if label.endswith(side):
            kind = label.removeprefix("see_").removesuffix(f"_{side}")
            return kind.replace("_", " "), side.replace("_", " ")
    return "wall", ""
