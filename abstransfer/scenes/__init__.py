"""
Scenes: interactive pictures for notebooks, and for the built page.

One line shows one::

    import abstransfer as at

    at.scenes.Microscope()

Each runs in the browser.  In a notebook its state is in traits: read them after a
click (``scene.t``), assign them to change the picture (``scene.start = "cost"``).

A scene is a folder with a ``widget.py``, found by listing; ``scenes/README.md`` says
how to write another.
"""

from importlib import import_module
from pathlib import Path

from .base import ArrayTrait, MapTrait, Scene, Still, as_map

__all__ = ["ArrayTrait", "MapTrait", "Scene", "Still", "as_map"]


def _found():
    """Yield the classes of the scenes, folder by folder."""
    for path in sorted(Path(__file__).parent.glob("[a-z]*/widget.py")):
        module = import_module(f".{path.parent.name}.widget", __name__)
        for kind in vars(module).values():
            is_class = isinstance(kind, type) and kind.__module__ == module.__name__
            if is_class and issubclass(kind, Scene):
                yield kind


KINDS = {kind.scene: kind for kind in _found()}  # by the name of their folder
for _kind in KINDS.values():
    globals()[_kind.__name__] = _kind
    __all__.append(_kind.__name__)
