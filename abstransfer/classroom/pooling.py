"""
Pool the result cards of a class: a blind test of a claim in many buildings.

The claim is named before a card is read.  Every card is run again, and counts once: one
building a student.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..experiments.stats import Interval, t_interval
from ..project.card import TITLE, verify
from ..project.student import building_of, seed_of
from .handed_in import files_of, texts_of

KINDS = (".ipynb", ".md", ".txt", ".eml")


class Pooled(NamedTuple):
    """What the cards of a class say of a claim."""

    gains: dict[str, float]  #: by student, the share of goals above the other's
    left_out: dict[str, str]  #: by file or student, why nothing of it counts
    interval: Interval  #: of the mean gain over buildings
    verdict: str  #: "holds", "does not hold" or "undecided"


def pool(
    folder: Path,
    robot: str,
    over: str = "none",
    *,
    margin: float = 0.0,
    tell: Callable[[str], None] = lambda text: None,
) -> Pooled:
    """
    Test on the cards of a folder that a robot's gain over another exceeds a margin.

    A file without a card is told, too: nothing that was handed in is lost.

    Parameters
    ----------
    folder : Path
        Holds notebooks and texts with cards.
    robot, over : str
        Names of robots on the cards, such as "nd" and "none".
    margin : float
        As a share: 0.05 is 5 % more goals.
    tell : function of str
        Is told each card as it is run.

    Raises
    ------
    ValueError
        If no card counts.
    """
    folder, gains, left_out = Path(folder), {}, {}
    for path in files_of(folder):
        file = path.relative_to(folder).as_posix()
        for card in _cards(path) or [""]:
            name = file
            try:
                if not card:
                    raise ValueError(_no_card(path))
                [found] = verify(card)
                name = found.setup.student or name
                gain = _gain(found, robot, over)
                seeds = {seed_of(other) for other in gains}
                if seed_of(name) in seeds:
                    raise ValueError("a second card of this student")
                gains[name] = gain
                tell(f"{name}: {100 * gain:+.1f} %")
            except ValueError as error:
                left_out[name] = str(error)
                tell(f"{name}: left out, {error}")
    if not gains:
        raise ValueError(f"{folder} holds no card that counts")
    interval = t_interval(np.array(list(gains.values())))
    verdict = "undecided"
    if interval.low > margin:
        verdict = "holds"
    elif interval.high <= margin:
        verdict = "does not hold"
    return Pooled(gains, left_out, interval, verdict)


def _no_card(path: Path) -> str:
    if path.suffix in KINDS:
        return "it holds no card"
    return f"cards are read from {', '.join(KINDS)} only"


def _gain(found, robot: str, over: str) -> float:
    setup, goals = found.setup, found.race.goals
    if not setup.student:
        raise ValueError("the card names no student")
    if str(setup.map) != str(building_of(setup.student)):
        raise ValueError("the building is not the student's own")
    for name in (robot, over):
        if name not in goals:
            raise ValueError(f"the card has no robot {name!r}")
    if not goals[over].sum():
        raise ValueError(f"{over!r} reaches no goal")
    return float(goals[robot].mean() / goals[over].mean() - 1)


def _cards(path: Path) -> list[str]:
    """Return the cards of a file, each as a text; the same text counts once."""
    if path.suffix not in KINDS:
        return []
    text = path.read_text("utf-8-sig", errors="replace")
    if path.suffix == ".ipynb":
        import nbformat

        try:
            cells = nbformat.reads(text, as_version=4).cells
        except Exception:  # whatever a file can be that is no notebook
            return []
        text = "\n".join(said for cell in cells for said in texts_of(cell))
    parts, lines = [], text.splitlines(keepends=True)
    for line in lines:
        if line.lstrip("> \t").strip() == TITLE:
            parts.append("")
        if parts:
            parts[-1] += line
    return list(dict.fromkeys(part.rstrip() + "\n" for part in parts))
