"""
Scenes: interactive pictures for notebooks, and for the built page.

One line shows one::

    from abstransfer import widgets

    widgets.Microscope()

Each runs in the browser.  In a notebook its state is in traits: read them after a
click (``scene.t``), assign them to change the picture (``scene.start = "cost"``).

Pages of the book show the scenes named here; ``scenes/README.md`` says how to write
another.
"""

from ._widget import ArrayTrait, MapTrait, Scene, Still, as_map
from ._widget_ballot import Ballot
from ._widget_dial import Dial
from ._widget_filling import Filling
from ._widget_hill import Hill
from ._widget_ladder import Ladder
from ._widget_microscope import Microscope
from ._widget_paint import Paint
from ._widget_project import Project
from ._widget_race import Race
from ._widget_ripple import Ripple
from ._widget_studio import Studio
from ._widget_tau import TauSlider

__all__ = [
    "ArrayTrait",
    "Ballot",
    "Dial",
    "Filling",
    "Hill",
    "Ladder",
    "MapTrait",
    "Microscope",
    "Paint",
    "Project",
    "Race",
    "Ripple",
    "Scene",
    "Still",
    "Studio",
    "TauSlider",
    "as_map",
]
