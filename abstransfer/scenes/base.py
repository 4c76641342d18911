"""
What all scenes share as widgets: traits, the still picture, the outputs of a cell.

A scene keeps its state in synced traits: what the reader changes in the browser
is there in Python, and what Python assigns shows in the browser.  On the built
page no widget runs; there a scene mounts on the HTML that the cell's output holds.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape
from importlib import import_module
from typing import NamedTuple

import anywidget
import numpy as np
import traitlets

from ..maps import Map, parse_map, read_map
from .files import module, style

VIEW = "application/vnd.jupyter.widget-view+json"
MANY = 9999  # where a trait has no largest number: the map will say


class Still(NamedTuple):
    """What stands for a scene where no script runs."""

    frames: Sequence[str]  #: SVG; the last is shown on a screen, all in print
    caption: str  #: what is to be seen
    head: Sequence[str]  #: of the table of numbers
    rows: Sequence[Sequence[object]]  #: of the table

    def html(self) -> str:
        """Return the picture, the caption and the table."""

        def line(tag, cells):
            return "".join(f"<{tag}>{escape(str(cell))}</{tag}>" for cell in cells)

        body = "".join(f"<tr>{line('td', row)}</tr>" for row in self.rows)
        return (
            '<figure class="ab-still"><div class="ab-frames">'
            + "".join(f"<div>{frame}</div>" for frame in self.frames)
            + f"</div><figcaption>{escape(self.caption)}</figcaption>"
            f"<table><thead><tr>{line('th', self.head)}</tr></thead>"
            f"<tbody>{body}</tbody></table></figure>"
        )


class MapTrait(traitlets.TraitType):
    """A trait that holds a Map; a name or the text of a map become one."""

    info_text = "a Map, the text of one, or the name of one that comes along"

    def __init__(self, default="source", **options):
        super().__init__(as_map(default), **options)
        self.tag(sync=True, to_json=lambda map_, _: str(map_), from_json=_from_text)

    def validate(self, obj, value):
        """Return the map that was meant; refuse what draws none."""
        return as_map(value)


class ArrayTrait(traitlets.TraitType):
    """A trait that holds an array of numbers, or None; lists become one."""

    info_text = "an array of numbers"

    def __init__(self, **options):
        super().__init__(None, allow_none=True, **options)
        self.tag(sync=True, to_json=_to_list, from_json=_to_array)

    def validate(self, obj, value):
        """Return the value as an array of floats."""
        return _to_array(value, obj)

    def _validate(self, obj, value):
        return value if value is None else self.validate(obj, value)

    def set(self, obj, value):
        """Assign, and tell those who listen: arrays cannot be compared as one."""
        new = self._validate(obj, value)
        old = obj._trait_values.get(self.name)
        obj._trait_values[self.name] = new
        if not np.array_equal(old, new):
            obj._notify_trait(self.name, old, new)


class Scene(anywidget.AnyWidget):
    """A scene of the book; each kind is a class of its own."""

    scene = ""  # its name among the scripts, and of its folder
    constants = {}  # more that its script reads; JSON
    # Traits: of a property, the widget's base class asks three times.
    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)

    def __init__(self, **options):
        known = self.state_names()
        unknown = sorted(options.keys() - set(known) - {"layout"})
        if unknown:
            raise ValueError(
                f"{unknown[0]} must be one of {', '.join(known)}, which a "
                f"{type(self).__name__} has"
            )
        super().__init__(**options)

    @traitlets.default("_esm")
    def _module(self) -> str:
        return module(self.scene, self.spec())

    @traitlets.default("_css")
    def _style(self) -> str:
        return style()

    @classmethod
    def state_names(cls) -> list[str]:
        """Return the names of the traits that are the state of the scene."""
        inherited = Scene.class_trait_names(sync=True)
        names = cls.class_trait_names(sync=True)
        return [n for n in names if n not in inherited and not n.startswith("_")]

    @classmethod
    def defaults(cls) -> dict:
        """Return the state that a scene starts in, as JSON would hold it."""
        traits = cls.class_traits()
        return {
            name: _plain(traits[name], traits[name].default())
            for name in cls.state_names()
        }

    @classmethod
    def spec(cls) -> dict:
        """
        Return what the script reads: the fields of the state, and constants.

        >>> from abstransfer.scenes import Race
        >>> Race.spec()["fields"]["t"]
        {'start': 39, 'isLocal': False, 'kind': 'whole', 'bounds': [0, 1000]}
        """
        traits = cls.class_traits()
        fields = {name: _field(traits[name]) for name in cls.state_names()}
        return {"fields": fields, **cls.constants}

    @property
    def changed(self) -> dict:
        """The state where it is not the default, as JSON holds it."""
        now = {
            name: _plain(self.traits()[name], getattr(self, name))
            for name in self.state_names()
        }
        default = self.defaults()
        return {name: value for name, value in now.items() if value != default[name]}

    def options(self) -> dict:
        """Return the state that the built page starts in, where not the default."""
        return self.changed

    def still(self) -> Still:
        """Return what stands for the scene where no script runs: its `still.py`."""
        return import_module(f".{self.scene}.still", __package__).draw(self)

    def __repr__(self) -> str:
        inside = [
            f"{name}={getattr(self, name)!r}"
            if len(str(value)) < 60 or name == "map"
            else f"{name}=..."
            for name, value in self.changed.items()
        ]
        return f"{type(self).__name__}({', '.join(inside)})"

    def html(self) -> str:
        """Return what the built page shows, and where its script finds the scene."""
        still = self.still().html()  # first: what it has learned, options need not
        options = escape(json.dumps(self.options(), ensure_ascii=False))
        return (
            f'<div class="abstransfer-scene" data-scene="{self.scene}" '
            f'data-options="{options}">{still}</div>'
        )

    def _repr_mimebundle_(self, include=None, exclude=None, **_):
        view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
        return {"text/plain": repr(self), "text/html": self.html(), VIEW: view}


def as_map(value) -> Map:
    """
    Return the map that is meant by a Map, by a text that draws one, or by a name.

    >>> as_map("target")
    Map(18 x 30 cells, 35 rooms, 35 goals)
    """
    if isinstance(value, Map):
        return value
    return parse_map(value) if "\n" in str(value) else read_map(value)


def _from_text(text: str, _) -> Map:
    return parse_map(text)


def _to_list(array, _=None):
    return None if array is None else np.asarray(array).tolist()


def _to_array(values, _=None):
    return None if values is None else np.asarray(values, dtype=float)


def _field(trait) -> dict:
    """
    Return what a script must know of a trait to read a value of it.

    `kind` is "map", "choice", "flag", "whole", "number", "text", "list" or "json";
    `bounds` are the least and the largest number, or all values.  Metadata of the
    trait go before: `bounds`, and `local`, for what is no part of an address.
    """
    kind, bounds = _kind_and_bounds(trait)
    field = {
        "start": _plain(trait, trait.default()),
        "isLocal": trait.metadata.get("local", False),
        "kind": kind,
    }
    bounds = trait.metadata.get("bounds", bounds)
    return field if bounds is None else {**field, "bounds": list(bounds)}


def _kind_and_bounds(trait) -> tuple[str, list | None]:
    if "bounds" in trait.metadata and not isinstance(trait, traitlets.Float):
        return "whole", None
    if isinstance(trait, traitlets.Enum):
        return "choice", trait.values
    if isinstance(trait, traitlets.Bool):
        return "flag", None
    if isinstance(trait, traitlets.Float | traitlets.Int):
        kind = "number" if isinstance(trait, traitlets.Float) else "whole"
        return kind, [trait.min, MANY if trait.max is None else trait.max]
    if isinstance(trait, MapTrait):
        return "map", None
    if isinstance(trait, traitlets.Unicode):
        return "text", None
    if isinstance(trait, traitlets.List) and isinstance(trait._trait, traitlets.Enum):
        return "list", trait._trait.values
    return "json", None


def _plain(trait, value):
    """Return the value of a trait as JSON holds it."""
    to_json = trait.metadata.get("to_json")
    return to_json(value, None) if to_json else value
