"""What scenes share in which the reader draws a building."""

from __future__ import annotations

import traitlets

from ...maps import Map, parse_map
from ..base import Scene, as_map


class DrawnScene(Scene):
    """
    A scene with a drawing, legal or not, and the last legal map of it.

    A subclass has the drawing in its trait `text`, and the map in the trait that
    `drawn` names; whichever changes, the other follows.
    """

    drawn = "map"

    def __init__(self, map_=None, **options):
        if map_ is not None:
            options[self.drawn] = map_
        if self.drawn in options:
            if "text" in options:
                raise ValueError(f"{self.drawn} must not be given together with text")
            options["text"] = str(as_map(options.pop(self.drawn)))
        super().__init__(**options)
        self.observe(self._write, self.drawn)

    @traitlets.observe("text")
    def _read(self, _):
        map_, _ = read_drawing(self.text)
        if map_ is not None:
            setattr(self, self.drawn, map_)

    def _write(self, _):
        map_ = getattr(self, self.drawn)
        if read_drawing(self.text)[0] != map_:
            self.text = str(map_)


def read_drawing(text: str) -> tuple[Map | None, str]:
    """Return the map that a text draws and "", or None and why it draws none."""
    try:
        return parse_map(text), ""
    except ValueError as error:
        return None, str(error)
