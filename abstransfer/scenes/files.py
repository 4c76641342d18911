"""
The front end of the scenes as text: one script and one style sheet.

The built book loads them as files; a widget carries them in itself.
"""

from __future__ import annotations

import json
import re
from functools import cache
from importlib.resources import files

from ..maps import read_map
from ..plotting.style import PALETTE

FOLDER = files("abstransfer") / "scenes"
SCENE = ".abstransfer-scene"
LIGHT = SCENE
DARK = ", ".join(
    f"{theme} {SCENE}"
    for theme in (
        'html[data-theme="dark"]',  # the built book
        'body[data-jp-theme-light="false"]',  # JupyterLab
        "body.vscode-dark",
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


@cache
def script() -> str:
    """Return all parts and scenes as one classic script, as legible as its files."""
    maps = {name: str(read_map(name)) for name in ("source", "target")}
    data = json.dumps({"palette": _small_palette(), "mapTexts": maps})
    head = f"Object.assign((globalThis.abstransfer ??= {{}}), {data});"
    return "\n".join([head, *_scripts()])


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


@cache
def page_script() -> str:
    """
    Return the script of the built book: it mounts what it finds.

    Comments go, and names inside functions get short, where `minify` is installed.
    """
    text = script() + "abstransfer.mountAll();\n"
    try:
        import minify
    except ImportError:
        return text
    return minify.string("application/javascript", text)


def module(name: str) -> str:
    """Return the module of a widget: the same script, and what shows one scene."""
    return f'{script()}export default {{ render: abstransfer.renderer("{name}") }};\n'


def _scripts():
    """Yield the scripts: the engine, the parts, the scenes, their own parts first."""
    for folder in (FOLDER / "engine", FOLDER / "ui", FOLDER):
        paths = [path for path in folder.iterdir() if path.name.endswith(".js")]
        for path in sorted(paths, key=lambda path: ("_" not in path.name, path.name)):
            yield path.read_text("utf-8")


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
