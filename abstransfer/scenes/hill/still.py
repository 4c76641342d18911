"""The still of the hill: first iterations, the whole climb, where 100 starts end."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from contourpy import FillType, contour_generator

from ...plotting.style import number
from ..base import Still
from ..parts.svg import at, dots, path, picture, text, through
from .widget import LAST, STARTS, WORDS, Hill, side, values_at

SQUARES = 24  # along a side of the land
LEVELS = (-20, -10, -7, -5, -4.5, -4, -3.5, -3, -2.5, -2.2)
LEFT, TOP, SIDE = 34, 22, 200  # of the drawing
RIGHT, BOTTOM = LEFT + SIDE, TOP + SIDE
RING = "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0-9 0"
MOMENTS = (0, 1, 2, 3, 4, 6, 10, 20, 50, LAST)  # iterations that a path shows


def draw(scene: Hill) -> Still:
    """Return three climbs on the same land, the last with the sides of 100 starts."""
    history, heights = scene.climb().history, _heights(scene.start)
    n_left = int(scene.ends.sum())
    left, right = (number(scene.value(knob, knob), 2) for knob in (1, 0))
    low, now, high = (number(history[t], 2) for t in (0, scene.t, LAST))
    caption = (
        f"Climbing with two knobs; the robot starts {WORDS[scene.start]}. From "
        f"p = {scene.p:g}, q = {scene.q:g} AbsProb-PI climbs from {low} to {high} in "
        f"{LAST} iterations and ends {side(*_after(scene, LAST))}; the best is "
        f"worth {number(heights.max(), 2)}. Of 100 starts, {n_left} end at left and up "
        f"(worth {left}), {100 - n_left} at right and down ({right}): a climb does not "
        "know of the other top."
    )
    rows = [
        (t, *(number(knob, 3) for knob in _after(scene, t)), number(history[t], 3))
        for t in sorted({*MOMENTS, scene.t})
    ]
    land = [
        *_levels(heights),
        path(f"M{LEFT} {TOP}H{RIGHT}V{BOTTOM}H{LEFT}z", "faint"),
        text(RIGHT, TOP - 7, f"left and up {left}", "end"),
        text(LEFT, BOTTOM + 13, f"right and down {right}"),
        text(RIGHT, BOTTOM + 13, "1", "end"),
        text(LEFT - 5, TOP + 9, "1", "end"),
        text(LEFT + SIDE / 2, BOTTOM + 29, "p: left in the hall", "middle"),
        text(LEFT - 22, TOP - 7, "q: up on a landing"),
    ]
    earlier = [Hill(p=p, q=q, start=scene.start) for p, q in scene.earlier]
    whole = [_way(each, LAST) for each in (*earlier, scene)]
    pictures = {
        f"The first {scene.t} iterations of a climb, from {low} to {now}.": [
            _way(scene, scene.t)
        ],
        f"All {LAST} iterations of a climb, from {low} to {high}.": whole,
        f"A climb, and 100 starts by where they end: {n_left} left and up.": [
            *_sides(scene.ends),
            *whole,
        ],
    }
    frames = [
        picture(land + more, alt, RIGHT + 16, BOTTOM + 36)
        for alt, more in pictures.items()
    ]
    return Still(frames, caption, ("iteration", "p", "q", "value"), rows)


@lru_cache(maxsize=len(STARTS))
def _heights(start: str) -> np.ndarray:
    """Return the values of the advice over the knobs, q from below, (n, n)."""
    knobs = np.linspace(0, 1, SQUARES + 1)
    return np.array([[values_at(p, q) @ STARTS[start] for p in knobs] for q in knobs])


def _after(scene: Hill, t: int) -> list[float]:
    """Return the knobs p and q after t iterations."""
    return scene.climb(t).policy[:2, 0].tolist()


def _place(p: float, q: float) -> tuple[float, float]:
    return LEFT + SIDE * p, TOP + SIDE * (1 - q)


def _levels(heights: np.ndarray) -> list[str]:
    """Return one shape per level: where the land is at least as high."""
    knobs = np.linspace(0, 1, len(heights))
    land = contour_generator(knobs, knobs, heights, fill_type=FillType.OuterOffset)
    return [
        path(
            "".join(
                f"{through(_place(*knobs) for knobs in rim)}z"
                for points, offsets in zip(*land.filled(level, np.inf), strict=True)
                for rim in np.split(points, offsets[1:-1])
            ),
            "faint",
            0.5,
            fill="high",
            more="fill-opacity:.13",
        )
        for level in LEVELS
    ]


def _way(scene: Hill, last: int) -> str:
    """Return a climb: its path, a dot for some iterations, a ring at its start."""
    shown = [t for t in MOMENTS if t < last] + [last]
    places = [_place(*_after(scene, t)) for t in shown]
    ring = path(RING, "ink", fill="ground", move=places[0])
    return path(through(places), "ink", 1.4) + dots(places, "ink", 4) + ring


def _sides(ends: np.ndarray) -> list[str]:
    """Return triangles at the starts: up where the climb ends at left and up."""
    looks = {True: ("faint", "m-3 2h6l-3-5z"), False: ("ground", "m-3-2h6l-3 5z")}
    starts = {of: (np.argwhere(ends == of)[:, ::-1] + 0.5) / 10 for of in looks}
    return [
        path(
            "".join(f"M{at(*_place(*knobs))}{shape}" for knobs in starts[is_left]),
            "faint",
            fill=fill,
        )
        for is_left, (fill, shape) in looks.items()
    ]
