"""The scene of page 12: a race in one's own building, and a card to hand in."""

from __future__ import annotations

from functools import lru_cache

import traitlets

from ...abstraction import FEATURES
from ...builders import BUILDERS
from ...project.card import card_text
from ...project.prediction import DIRECTIONS, Prediction
from ...project.racing import Race
from ...project.setup import ADVICE, GUIDES, PAPER_ENTRIES, PAPER_TAU, Setup, run
from ..base import MapTrait
from ..parts.drawn import DrawnScene
from ..parts.student import STUDENT
from ..parts.svg import look_of

TOOLS = ("wall", "door", "room", "corridor", "goal")
NAMES = {name: look_of(name).name for name in (*GUIDES, "optimal")}
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
    map : Map, text or name, default the school of page 12
        Where the robots learn; later, the last legal building that was drawn.
    text : str
        The drawing of it, legal or not.
    features : list of str, among FEATURES
        What the robots see.
    guides : list of {"nd", "prob", "grad", "eager", "rand"}
        Who races, beside the robot without advice.
    advice : {"source", "target", "own"}
        The building in which the advice is made; "own" is the map itself.
    strategy : {"hard", "soft"}
    lives : int, 1 to 20
        Runs of each robot; addresses of old keep the word.
    tool : {"wall", "door", "room", "corridor", "goal"}
    student : str
        Whose race it is; the seed follows from the name.
    predicted : str
        The robot that something is predicted of, of `guides`; "" if nothing is.
    direction : {"+", "-", "0"}
    percent : int, 0 to 100
        What is predicted; see :class:`~abstransfer.project.prediction.Prediction`.
    races : int
        How many races the reader has begun.

    Examples
    --------
    >>> scene = Project(guides=["nd"], lives=2)
    >>> scene
    Project(guides=['nd'], lives=2)
    >>> scene.goals  # of each run, by robot, after a race in the browser
    {}
    >>> scene.run().goals["nd"]  # the same race in Python
    array([43689, 44120])
    >>> print(scene.card().splitlines()[4])
    - Features: all
    """

    scene = "project"
    constants = {"entries": PAPER_ENTRIES, "tauShare": PAPER_TAU, "student": STUDENT}
    map = MapTrait(SCHOOL).tag(sync=False)
    text = traitlets.Unicode(SCHOOL).tag(sync=True)
    tool = traitlets.Enum(TOOLS, "wall").tag(sync=True)
    features = traitlets.List(traitlets.Enum(FEATURES), list(FEATURES)).tag(sync=True)
    guides = traitlets.List(traitlets.Enum(GUIDES), [*BUILDERS, "eager"]).tag(sync=True)
    advice = traitlets.Enum(ADVICE, "source").tag(sync=True)
    strategy = traitlets.Enum(("hard", "soft"), "hard").tag(sync=True)
    lives = traitlets.Int(5, min=1, max=20).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    student = traitlets.Unicode("").tag(sync=True, local=True)
    predicted = traitlets.Enum(("", *GUIDES), "").tag(sync=True, local=True)
    direction = traitlets.Enum(DIRECTIONS, "+").tag(sync=True, local=True)
    percent = traitlets.Int(5, min=0, max=100).tag(sync=True, local=True)
    races = traitlets.Int(0, min=0).tag(sync=True, local=True)
    goals = traitlets.Dict().tag(sync=True, local=True)

    @property
    def setup(self) -> Setup:
        """All that the race depends on."""
        features = tuple(name for name in FEATURES if name in self.features)
        guides = tuple(name for name in GUIDES if name in self.guides)
        name = " ".join(self.student.split())
        how = (self.advice, self.strategy, self.lives, name if name.strip(".") else "")
        return Setup(self.map, features, guides, *how)

    def run(self) -> Race:
        """Run the race in Python: the goals are those of the browser."""
        return _run(self.setup)

    def card(self) -> str:
        """Return the text to hand in, as the browser writes it."""
        said = (max(self.races, 1), self.predicted, self.direction, self.percent)
        return card_text(self.setup, self.run().goals, prediction=Prediction(*said))

    def __repr__(self) -> str:
        return super().__repr__().replace("text=...", f"map={self.map!r}")


@lru_cache(maxsize=16)
def _run(setup: Setup) -> Race:
    return run(setup)
