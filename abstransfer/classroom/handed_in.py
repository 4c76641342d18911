"""
What stands in a notebook that was handed in: whose it is, replies, predictions, cards.
"""

from __future__ import annotations

import ast
import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

from ..project.card import TITLE, verify

VERDICTS = ("right", "nearly", "not yet", "hint", "no answer yet", "not checked")
REPLY = re.compile(
    rf"^\**(ex-\d+-\d+[b-z]?): ({'|'.join(VERDICTS)})\.\**(.*?)(?=^\**ex-\d|\Z)",
    re.MULTILINE | re.DOTALL,
)
MISTAKE = re.compile(r"This looks like: \*(.+?)\*\.")
SEALED = re.compile(
    r"\b(ex-\d+-\d+[b-z]?): sealed ([0-9a-f]{8}), "
    r"(direction [-+], at least \S+?|no effect above \S+ either way)\.(?!\d)"
)
OPENED = re.compile(
    r"\bex-\d+-\d+[b-z]?: (as predicted|refuted)\. Sealed ([0-9a-f]{8})"
)
ASKED = re.compile(r'\bcheck\(\s*["\'](ex-\d+-\d+[b-z]?)["\']')


def files_of(folder: Path, kind: str = "*") -> list[Path]:
    """Return the files of a folder, at any depth, in order; none that is hidden."""
    paths = (path.relative_to(folder) for path in folder.rglob(kind))
    return sorted(
        folder / path
        for path in paths
        if not any(part.startswith(".") for part in path.parts)
        and (folder / path).is_file()
    )


def code_of(notebook) -> list[str]:
    """Return the code of a notebook, cell by cell."""
    return [cell.source for cell in notebook.cells if cell.cell_type == "code"]


def student_of(notebook) -> str:
    """Return the name in the line ``student = "..."``; "" where there is none."""
    for line in "\n".join(code_of(notebook)).split("\n"):
        if found := re.match(r"student\s*=\s*(['\"].*)", line):
            try:
                name = ast.literal_eval(found[1].partition("#")[0].strip())
            except (SyntaxError, ValueError):
                continue
            return " ".join(str(name).split()).strip(".")
    return ""


def asked_in(notebook) -> list[str]:
    """Return the exercises that a notebook checks, in order."""
    return list(dict.fromkeys(ASKED.findall("\n".join(code_of(notebook)))))


def digest(notebook) -> str:
    """Return a digest of all code but the line that says whose it is."""
    lines = "\n".join(code_of(notebook)).split("\n")
    text = "\n".join(x for x in map(str.strip, lines) if not x.startswith("student"))
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()


def texts_of(cell) -> Iterator[str]:
    """Yield what a cell says: its text, or each of its outputs."""
    if cell.cell_type != "code":
        yield cell.source
    for output in cell.get("outputs", ()):
        data = output.get("data", {})
        yield (
            output.get("text")
            or data.get("text/markdown")
            or data.get("text/plain", "")
        )


def replies_in(text: str) -> dict[str, tuple[str, str]]:
    """
    Return the replies in a text: by exercise the verdict, and a mistake's name.

    >>> replies_in("**ex-2-3: not yet.** This looks like: *one sweep less*. Count.")
    {'ex-2-3': ('not yet', 'one sweep less')}
    >>> replies_in("ex-1-1: right.\\nex-1-2: no answer yet. The blank")
    {'ex-1-1': ('right', ''), 'ex-1-2': ('no answer yet', '')}
    """
    found = {}
    for key, verdict, words in REPLY.findall(text):
        mistake = MISTAKE.search(" ".join(words.split()))
        found[key] = (verdict, mistake[1] if mistake else "")
    return found


def predictions_said(before: list[str], again: list[str]) -> str:
    """
    Return in words which predictions were sealed, and what came of them.

    Parameters
    ----------
    before, again : list of str
        What the notebook said as it was handed in, and when it was run again.

    Examples
    --------
    >>> said = ["ex-10-1: sealed 6412c89f, direction +, at least 0.05."]
    >>> predictions_said(said, said)
    'ex-10-1 6412c89f, direction +, at least 0.05'
    >>> predictions_said(said, ["ex-10-1: sealed 0123abcd, direction -, at least 1."])
    'ex-10-1 0123abcd, direction -, at least 1, but 6412c89f was handed in'
    """
    told, found = _sealed(before), _sealed(again)
    came = {seal: word for word, seal in OPENED.findall("\n".join(before + again))}
    words = []
    for key in dict.fromkeys([*told, *found]):
        seals = found.get(key) or told[key]
        *others, seal = seals
        text = f"{key} {seal}, {seals[seal]}"
        text += f": {came[seal]}" if seal in came else ""
        text += f", the last of {len(seals)}" if others else ""
        other = [each for each in told.get(key, ()) if each not in seals]
        text += f", but {', '.join(other)} was handed in" if other else ""
        words.append(text if key in found else f"{text}, not made again")
    return "; ".join(words)


def _sealed(texts: list[str]) -> dict[str, dict[str, str]]:
    """Return by exercise its seals, in order, each with what was sealed."""
    found = {}
    for key, seal, words in SEALED.findall("\n".join(texts)):
        found.setdefault(key, {})[seal] = words
    return found


def cards_said(texts: list[str]) -> str:
    """Return in words what running the cards of texts again says; "" without one."""
    words = []
    for text in dict.fromkeys(text for text in texts if TITLE in text):
        try:
            words += [_confirmed(found) for found in verify(text)]
        except ValueError as error:
            words.append(str(error))
    return "; ".join(words)


def _confirmed(found) -> str:
    """Return what a card comes to that was run again, with what was predicted on it."""
    bet = found.prediction
    if not (bet and bet.robot):
        return "confirmed"
    came = bet.compare(found.race.goals)
    return f"confirmed, race {bet.race}, predicted {bet.robot} {bet.direction}: {came}"
