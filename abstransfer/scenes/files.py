"""
The front end of a scene as text: its script, and the style sheet.

The built book loads them as files; a widget carries them in itself.  A script is the
bundle of its scene (`bundle`) behind what Python says to it.
"""

from __future__ import annotations

import json
import re
from functools import cache

from .. import foreign
from ..driving import PAPER, ROWS
from ..experiments.arms import ARMS, PAPER_STEPS, TAUS
from ..experiments.plan import SEED
from ..maps import KNOWN, SAID, Map, read_map
from ..plotting.style import PALETTE
from .bundle import BUNDLES, COMMAND, FOLDER, BundleError, build, digest, is_fresh

SCENE = ".abstransfer-scene"
WINDOWS = 60  # of a run at full scale, as scenes show it
LIGHT = SCENE
DARK = ", ".join(
    f"{theme} {SCENE}"
    for theme in (
        'html[data-theme="dark"]',  # the built book
        'body[data-jp-theme-light="false"]',  # JupyterLab
        "body.vscode-dark",
        # High contrast on light ground has both of these names.
        "body.vscode-high-contrast:not(.vscode-high-contrast-light)",
        'html[theme="dark"]',  # Colab
    )
)
# What the palette lacks: lines, grounds of controls, the strong end of a scale.
EXTRA = {
    "line": ("#C9CDD2", "#4A525C"),
    "grid": ("#D9DDE2", "#3A424C"),
    "control": ("#767B82", "#8D959F"),
    "raised": ("#F4F6F8", "#20262E"),
    "accent": ("#0A5A8C", "#7CC4F2"),
    "focus": ("#B3007A", "#FFB3E6"),
    "high": ("#67BD86", "#1C6B43"),
    "tint": ("48% 82%", "38% 28%"),
    "lit": ("#F2CE73", "#6E5310"),  # darker than on figures: text stands on it
}


def page_script(name: str, spec: dict) -> str:
    """
    Return the script of a scene for a page: it mounts what it finds there.

    `spec` is that of its class.

    Raises
    ------
    BundleError
        If the bundle is missing, or older than its sources, and cannot be made.
    """
    return f"((python) => {{\n{script(name)}}})({said(spec=spec)});\n"


def module(name: str, spec: dict) -> str:
    """Return the module of a widget: the same script, and what shows the scene."""
    try:
        head = f"const python = {said(spec=spec, isWidget=True)};\n"
        body = script(name)
    except BundleError as error:
        return f"export default {{ render: {_sorry(error)} }};\n"
    return f"{head}{body}export default {{ render: python.render }};\n"


@cache
def style() -> str:
    """Return the style sheet, with the palette's colours as variables."""
    text = (FOLDER / "scenes.css").read_text("utf-8")
    light, dark = (_variables(shade) for shade in ("light", "dark"))
    rules = (
        f"{LIGHT}{{color-scheme:light;{light}}}\n"
        f"@media not print{{{DARK}{{color-scheme:dark;{dark}}}}}\n"
    )
    return rules + re.sub(r"/\*.*?\*/\n*", "", text, flags=re.DOTALL)


def script(name: str) -> str:
    """Return the bundle of a scene behind what its workers do, a function."""
    worker = f"python.worker = (self) => {{\n{bundled('worker')}}};\n"
    return worker + bundled(name)


def bundled(name: str) -> str:
    """Return the bundle of a scene, or of its workers; make it first if need be."""
    if not is_fresh() and (problem := _problem(digest())):
        raise BundleError(problem)
    path = BUNDLES / f"{name}.js"
    if not path.is_file():
        raise BundleError(f"there is no script scenes/{name}/{name}.js to bundle")
    return path.read_text("utf-8")


@cache
def _problem(_: str) -> str:
    """Bundle sources of this digest, once; return what hindered it, or nothing."""
    try:
        build()
    except (BundleError, OSError) as error:
        return f"the scenes must be bundled anew; run: {COMMAND} ({error})"
    return ""


def said(**more) -> str:
    """Return what Python says to a script, as JSON."""
    return json.dumps({**_said_to_all(), **more})


@cache
def _said_to_all() -> dict:
    """Return what every script hears, made once: maps are read for it."""
    maps = {name: str(read_map(name)) for name in ("source", "target")}
    said = {"palette": _small_palette(), "mapTexts": maps, "paper": _paper()}
    return {**said, "drawing": _drawing()}


def _drawing() -> dict:
    """Return how a map is drawn, and what else is read or called by its name."""
    tables = {"same": foreign.SAME, "formats": foreign.FORMATS, "posts": foreign.POSTS}
    return {"known": KNOWN, "said": SAID, "tabSizes": foreign.TAB_SIZES, **tables}


def _paper() -> dict:
    """Return what the paper compares and found."""
    arms = [
        {"name": a.name, "guide": a.guide, "strategy": a.strategy, "tau": a.tau}
        for a in ARMS
    ]
    numbers = {name: {**_counts(read_map(name)), **PAPER[name]} for name in PAPER}
    table = {"rows": ROWS, "numbers": numbers}
    runs = {"seed": SEED, "windows": WINDOWS}
    return {"arms": arms, "taus": TAUS, "steps": PAPER_STEPS, **table, **runs}


def _counts(map_: Map) -> dict:
    return {"cells": map_.n_cells, "rooms": map_.n_rooms, "goals": len(map_.goals)}


def _sorry(error: BundleError) -> str:
    """Return a function that says why a scene is not there."""
    return f"({{ el }}) => {{ el.textContent = {json.dumps(str(error))}; }}"


def _small_palette() -> dict:
    """Return what scripts read: names, markers, dashes; colours are in the style."""
    arms = {
        arm: {key: look[key] for key in ("name", "marker")}
        for arm, look in PALETTE["arms"].items()
    }
    return {"arms": arms, "strategies": PALETTE["strategies"]}


def _variables(shade: str) -> str:
    colors = {name: of[shade] for name, of in PALETTE["building"].items()}
    colors |= {f"arm-{arm}": of[shade] for arm, of in PALETTE["arms"].items()}
    colors |= {name: of[shade == "dark"] for name, of in EXTRA.items()}
    return "".join(f"--ab-{name}:{color};" for name, color in colors.items())
