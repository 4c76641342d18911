"""Still pictures of a ballot box, small and the same every time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from ..parts.curves import WIDTH, _line, _text
from ..parts.stills import paint

LINE = 44  # height of an action: its name, and two bars
FULL = 190  # width of a bar of probability 1


def box_svg(rows: Mapping[str, Sequence[tuple[str, float]]], alt: str) -> str:
    """
    Return bars of probabilities as SVG, several for each action.

    Parameters
    ----------
    rows : dict from action to (name, probability) of each bar
    alt : str
        What the picture shows.
    """
    parts = []
    for i, (action, bars) in enumerate(rows.items()):
        top = LINE * i + 12
        parts.append(_text(0, top, action, "start"))
        for j, (name, share) in enumerate(bars):
            y = top + 11 + 13 * j
            start = 60
            parts.append(_text(start - 5, y + 4, name, "end"))
            color = paint("accent") if j == 0 else paint("faint")
            if share > 0:
                parts.append(_line(f"M{start} {y}h{FULL * share:.1f}", color, "", 8))
            parts.append(
                _text(start + FULL * share + 5, y + 4, f"{share:.2f}", "start")
            )
    looks = f"font:11px sans-serif;fill:{paint('ink')}"
    return (
        f'<svg role="img" viewBox="0 0 {WIDTH} {LINE * len(rows) + 4}" '
        f'aria-label="{escape(alt)}" style="{looks}">{"".join(parts)}</svg>'
    )
