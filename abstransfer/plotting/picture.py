"""
A drawn figure with its alt text, the same bytes every time.

A notebook stores a :class:`Picture` as two things: its alt text, which is what
is printed where pictures are not shown, and an SVG on a white card, which is
legible on any page.  Coordinates are rounded to a hundredth of a point, so
that rounding errors of the machine do not show.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from zlib import crc32

from .style import RC, WIDTH

SHORTEST, LONGEST = 40, 300  # characters of an alt text
NO_METADATA = dict.fromkeys(("Creator", "Date", "Format", "Type"))
TAG = re.compile(r"<[^>]*>")
ID = re.compile(r'( id="|url\(#|href="#)([^"\)]*)')
LONG_NUMBER = re.compile(r"-?\d+\.\d{3,}(?![\d.])")


@dataclass(frozen=True)
class Picture:
    """
    A figure that notebooks show as SVG, and read aloud as its alt text.

    ``save`` writes it to a file of any kind matplotlib knows: svg, png, pdf.
    """

    alt: str
    svg: str = field(repr=False)
    drawn: object = field(repr=False, compare=False)  #: the matplotlib Figure

    def __repr__(self) -> str:
        return self.alt

    def _repr_mimebundle_(self, include=None, exclude=None):
        data = {"text/plain": self.alt, "image/svg+xml": self.svg}
        return data, {"image/svg+xml": {"alt": self.alt}}

    def save(self, path: str | Path) -> Path:
        """Write the figure to a file, in the format that its name ends in."""
        path = Path(path)
        if path.suffix == ".svg":
            path.write_text(self.svg + "\n", encoding="utf-8", newline="\n")
            return path
        import matplotlib

        dates = {".pdf": "CreationDate", ".ps": "CreationDate", ".eps": "CreationDate"}
        no_date = {dates[path.suffix]: None} if path.suffix in dates else None
        with matplotlib.rc_context(RC):
            self.drawn.savefig(path, dpi=200, metadata=no_date, bbox_inches="tight")
        return path


def draw_picture(
    draw: Callable,
    alt: str,
    *,
    size: tuple[float, float] = (WIDTH, 3.4),
    panels: tuple[int, int] = (1, 1),
) -> Picture:
    """
    Return the picture that ``draw(ax)`` makes on new axes.

    Parameters
    ----------
    draw : callable
        Gets one axes, or an array of them of shape `panels`.
    alt : str
        What the picture shows, stating the finding, in 40 to 300 characters.
    size : (width, height) in inches
    panels : (rows, columns), default (1, 1)

    Examples
    --------
    >>> alt = "A line that rises from 0 to 1, drawn to show how this is used."
    >>> draw_picture(lambda ax: ax.plot([0, 1]), alt)
    A line that rises from 0 to 1, drawn to show how this is used.
    """
    if not SHORTEST <= len(alt) <= LONGEST:
        raise ValueError(
            f"alt must have {SHORTEST} to {LONGEST} characters, got {len(alt)}: {alt!r}"
        )
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(RC):
        figure = Figure(figsize=size, layout="constrained")
        axes = figure.subplots(*panels, squeeze=False)
        draw(axes if axes.size > 1 else axes[0, 0])
        file = io.StringIO()
        figure.savefig(
            file,
            format="svg",
            metadata=NO_METADATA,
            bbox_inches="tight",
            pad_inches=0.05,
        )
    return Picture(alt, _settled(file.getvalue(), alt), figure)


def _settled(svg: str, alt: str) -> str:
    """Drop the file's preamble, round its coordinates, name what it shows."""
    svg = svg[svg.index("<svg") :].strip()
    svg = TAG.sub(lambda tag: LONG_NUMBER.sub(_rounded, tag[0]), svg)
    svg = _renamed(re.sub(r"[ \t]*\n[ \t]*", "\n", svg))
    named = f'<svg role="img" aria-label="{escape(alt)}" '
    title = f"<title>{escape(alt, quote=False)}</title>"
    head, rest = svg.split(">", 1)
    return f"{named}{head.removeprefix('<svg ')}>\n{title}{rest}"


def _renamed(svg: str) -> str:
    """
    Number the ids that are used, and drop the others.

    Those of matplotlib depend on the last bit of each coordinate.  A checksum
    of the picture keeps them apart from those of others on the same page.
    """
    used = set(re.findall(r"#([\w-]+)", svg))
    ids = [name for name in re.findall(r' id="([^"]*)"', svg) if name in used]
    numbers = {name: str(i) for i, name in enumerate(ids)}
    svg = ID.sub(lambda m: f"{m[1]}{numbers[m[2]]}" if m[2] in numbers else m[0], svg)
    svg = re.sub(r' id="[^"]*[^"\d][^"]*"', "", svg)
    prefix = f"p{crc32(svg.encode()):08x}-"
    return re.sub(r'( id="|url\(#|href="#)(?=\d+["\)])', rf"\g<1>{prefix}", svg)


def _rounded(digits: re.Match) -> str:
    text = f"{float(digits[0]):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
