"""The scene of page 11: a race in one's own building, and a card to hand in."""

from __future__ import annotations

from functools import lru_cache

import traitlets

from ...abstraction import FEATURES
from ...builders import BUILDERS
from ...plotting.style import count, number
from ...project.card import card_text
from ...project.racing import Race
from ...project.setup import ADVICE, GUIDES, Setup, drives, run
from ..base import MapTrait, Still
from ..parts.drawn import DrawnScene
from ..parts.stills import building_svg
from .still import bars_svg, dots_svg

TOOLS = ("wall", "door", "room", "corridor", "goal")
NAMES = {
    "nd": "ND",
    "prob": "Prob",
    "grad": "Grad",
    "eager": "eager",
    "rand": "random",
    "optimal": "optimal",
}
FROM = {"source": "the source", "target": "the target", "own": "it"}
SCHOOL = """\
+-----+-----+-----+
|     |     |     |
|     |     |     |
|  *  |  *  d  *  |
|     |     |     |
|     |     |     |
+--d--+-----+--d--+
|. . . . . . . . .|
+--d--+--d--+-----+
|     |     |     |
|     |     |     |
|  *  |  *  d  *  |
|     |     |     |
|     |     |     |
+-----+-----+-----+"""


class Project(DrawnScene):
    """
    Your turn: draw a building, choose what robots see, race, and hand in a card.

    Parameters
    ----------
    map : Map, text or name, default the school of page 11
        Where the robots learn; later, the last legal building that was drawn.
    text : str
        The drawing of it, legal or not.
    features : list of str, among FEATURES
        What the robots see.
    guides : list of {"nd", "prob", "grad", "eager", "rand"}
        Who races, beside the robot without advice.
    advice : {"source", "target", "own"}
        The building in which the pages are written; "own" is the map itself.
    strategy : {"hard", "soft"}
    lives : int, 1 to 20
    tool : {"wall", "door", "room", "corridor", "goal"}

    Examples
    --------
    >>> scene = Project(guides=["nd"], lives=2)
    >>> scene
    Project(guides=['nd'], lives=2)
    >>> scene.goals  # of each life, by robot, after a race in the browser
    {}
    >>> scene.run().goals["nd"]  # the same race in Python
    array([43689, 44120])
    >>> print(scene.card().splitlines()[4])
    - Features: all
    """

    scene = "project"
    map = MapTrait(SCHOOL).tag(sync=False)
    text = traitlets.Unicode(SCHOOL).tag(sync=True)
    tool = traitlets.Enum(TOOLS, "wall").tag(sync=True)
    features = traitlets.List(traitlets.Enum(FEATURES), list(FEATURES)).tag(sync=True)
    guides = traitlets.List(traitlets.Enum(GUIDES), [*BUILDERS, "eager"]).tag(sync=True)
    advice = traitlets.Enum(ADVICE, "source").tag(sync=True)
    strategy = traitlets.Enum(("hard", "soft"), "hard").tag(sync=True)
    lives = traitlets.Int(5, min=1, max=20).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True)
    goals = traitlets.Dict().tag(sync=True)

    @property
    def setup(self) -> Setup:
        """All that the race depends on."""
        features = tuple(name for name in FEATURES if name in self.features)
        guides = tuple(name for name in GUIDES if name in self.guides)
        return Setup(self.map, features, guides, self.advice, self.strategy, self.lives)

    def run(self) -> Race:
        """Run the race in Python: the goals are those of the browser."""
        return _run(self.setup)

    def card(self) -> str:
        """Return the text to hand in, as the browser writes it."""
        return card_text(self.setup, self.run().goals)

    def still(self) -> Still:
        """Return the building, how the pages drive in it, and the race."""
        setup, goals = self.setup, self.run().goals
        none, values = goals["none"], drives(setup)
        map_, words, rows = self.map, [], [("none", "", f"{none.mean():,.0f}", "")]
        for name in setup.guides:
            more = goals[name] - none
            hurts = goals[name].sum() < none.sum()
            n = int((more < 0).sum() if hurts else (more > 0).sum())
            share = _signed(100 * more.sum() / max(none.sum(), 1), 1)
            what = "hurt" if hurts else "helped"
            words.append(f"{NAMES[name]} {what} in {n} ({share} %)")
            drive, mean = number(values[name], 2), f"{goals[name].mean():,.0f}"
            rows.append((NAMES[name], drive, mean, _signed(more.mean())))
        lives = "1 life" if self.lives == 1 else f"{self.lives} lives"
        rooms = f"{count(map_.n_rooms, 'room')} and {count(len(map_.goals), 'goal')}"
        caption = (
            f"A race in a building with {rooms}; the pages were written in "
            f"{FROM[self.advice]}. A life without advice reaches {none.mean():,.0f} "
            f"goals. Of {lives} with the same luck, {', '.join(words)}: "
            f"{self.strategy} advice."
        )
        best = max(setup.guides, key=values.get, default="optimal")
        told = f"How pages drive: {NAMES[best]} best, {number(values[best])}."
        race = {name: goals[name] - none for name in setup.guides}
        frames = [
            building_svg(map_, f"A building with {rooms}."),
            bars_svg({NAMES[name]: (name, v) for name, v in values.items()}, told),
            dots_svg({NAMES[name]: (name, m) for name, m in race.items()}, caption),
        ]
        head = ("robot", "drives", "goals of a life", "more than without advice")
        return Still(frames, caption, head, rows)

    def __repr__(self) -> str:
        return super().__repr__().replace("text=...", f"map={self.map!r}")


def _signed(x: float, digits: int = 0) -> str:
    return f"{x:+,.{digits}f}".replace("-", "\u2212")


@lru_cache(maxsize=16)
def _run(setup: Setup) -> Race:
    return run(setup)
