"""
Buildings as they come from elsewhere: text made ready for ``maps``, or called by name.

What makes no difference is taken away: a byte-order mark, line ends and the end of a
file of other systems, blanks at line ends, a common indent, tabs, a fence of
backquotes, lines around the picture that begin with ``#``; dashes, blanks and lines of
typographers stand for ``-``, blank, ``|`` and ``+``.

Mazes are often drawn with cells of several characters, ``+---+---+``.  Where ``+`` (or
``o``) stands at every corner of such cells and nowhere else, each cell becomes one
character; G is a goal there, and S, a start, a cell as any other: robots start
anywhere.
What may be such a maze or a map of ours is ours, if all its corners are those of walls
that meet; else cells of 3 x 1 characters, the commonest size, are read so, and others
are refused.

All that is not ours is refused; a format that many people use is called by its name.
The scenes read by the same tables; ``scenes/engine/foreign.js`` has the same steps.
"""

from __future__ import annotations

import re
from typing import NamedTuple

# What stands for the characters of a map.
SAME = {
    "-": "\u2010\u2011\u2012\u2013\u2014\u2015\u2212─━┄┅┈┉╌╍═╴╶╸╺╼╾",
    "|": "│┃┆┇┊┋╎╏║╵╷╹╻╽╿",
    "+": "".join(map(chr, [*range(0x250C, 0x254C), *range(0x2552, 0x2571)])),
    " ": "\u00a0\u202f\u205f\u3000" + "".join(map(chr, range(0x2000, 0x200B))),
}
PLAIN = str.maketrans({char: plain for plain, chars in SAME.items() for char in chars})
TAB_SIZES = (8, 4, 2, *range(1, 17))
POSTS = r"([+o])({0}+)\1(?:\2\1)*"  # a border of cells of one size

CELLS = "its walls fill cells, and here a wall stands on the edge between two cells"
DOORS = f"{CELLS}, as a door does"
# Formats: name, what does not go over, and how a text of it begins or looks; first
# come, first served.  The patterns mean the same in Python and in JavaScript.
FORMATS = (
    ("a MovingAI map", DOORS, r"type [^\n]*\nheight [0-9]+\nwidth [0-9]+\nmap"),
    ("a Pacman layout", DOORS, r"%{3,}\n%"),
    ("a printed Minigrid", DOORS, r"(?:WG){3,}\n"),
    ("a map of Policy Reuse", DOORS, r"-{3,}\n(?:-[-rcd]*\n?)+$"),
    ("a grid with solid cells", DOORS, r"([#wWX@\u2588])\1{2,}\n"),
    (
        "a layout of gym-classics",
        DOORS,
        r"(?=[^X]*X)(?:\|[^|\n]*\|\n?)+$",
    ),
    (
        "the taxi's map",
        "it has no lines between its rows, where walls and doors could stand",
        r"\+-+\+\n(?:\|[^\n:]*:[^\n]*\|\n){2,}\+-+\+$",
    ),
    (
        "a map of FrozenLake",
        "it has holes and no walls, and here rooms, walls and doors are wanted",
        r"(?:\[\s*[\"'][SFHG]+[\"']|[SFHG]+(?:\n[SFHG]+)+$)",
    ),
    (
        "a list of transitions",
        "that is a decision problem without a picture, for MDP",
        r"(?:[0-9]+[ \t,][^ \t,\n]+[ \t,][0-9]+[ \t,][01]\.[0-9]+(?:\n|$))+",
    ),
    (
        "an occupancy grid",
        DOORS,
        r"(?:P[25]\s|[0-9](?:[,; \t]*[0-9])+(?:\n[0-9](?:[,; \t]*[0-9])+)+$)",
    ),
    ("a map that begins with its size", CELLS, r"[0-9]+ [0-9]+\n[^0-9\n]"),
    ("data, JSON or XML", "a picture is wanted, as text", r"[\[{<]"),
    ("text without a drawing", "there is no wall '|' in it", r"[^+|]+$"),
)


class Picture(NamedTuple):
    """The picture in a text, one character a cell, edge or corner."""

    lines: list[str]  #: of the picture alone
    rows: list[int]  #: line of the text, counted from 0, of each line of the picture
    columns: list[int]  #: column of the text of each column of the picture

    def refuse(self, row: int, column: int, problem: str, remedy: str):
        """Raise ValueError with the place in the text as an editor counts, from 1."""
        place = f"row {self.rows[row] + 1}, column {self.columns[column] + 1}"
        raise ValueError(f"{place}: {problem}; {remedy}")


def decoded(raw: bytes) -> str:
    """Return the text of a file in UTF-8 or UTF-16, with or without its mark."""
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return raw.decode("utf-16")
    is_wide = b"\0" in raw[:2]
    return raw.decode(f"utf-16-{'le' if raw[0] else 'be'}" if is_wide else "utf-8-sig")


def find_picture(text: str, known: tuple[tuple[str, str], ...]) -> Picture:
    """
    Return the picture in a text, without what makes no difference.

    `known` are the characters that a map may have, by row % 2 and column % 2.

    >>> drawn = "# two cells\\r\\n  +---+---+ \\r\\n  | S d G |\\r\\n  +---+---+"
    >>> find_picture(drawn, (("+-| ", "-d "), ("|d ", ". *"))).lines
    ['+-+-+', '| d*|', '+-+-+']
    """
    lines = _lines(text)
    rows = list(range(len(lines)))
    while rows and _is_around(lines[rows[-1]], "#"):
        rows.pop()
    while rows and _is_around(lines[rows[0]], "#"):
        rows.pop(0)
    left, lines = _without_tabs([lines[row] for row in rows], rows)
    longest = max(map(len, lines), default=0)
    picture = Picture(lines, rows, list(range(left, left + longest + 1)))
    return _narrowed(picture, known) or picture


def named(text: str) -> str:
    """
    Return what a text looks like that is no map, and what it lacks; "" if unknown.

    >>> named("%%%%%\\n%P .%\\n%%%%%")[:31]
    'this looks like a Pacman layout'
    """
    lines = _lines(text)
    kept = {mark: [x for x in lines if not _is_around(x, mark)] for mark in ("#", "`")}
    for name, lacks, pattern in FORMATS:
        for lines in kept.values():
            if re.match(pattern, "\n".join(line.strip() for line in lines)):
                return (
                    f"this looks like {name}: {lacks}; "
                    "page 1 of the book shows how a building is drawn"
                )
    return ""


def _lines(text: str) -> list[str]:
    text = text.removeprefix("\ufeff").rstrip("\x1a").translate(PLAIN)
    return text.splitlines()


def _is_around(line: str, mark: str) -> bool:
    """Whether a line is blank, a fence or, with its mark, a comment."""
    line = line.strip()
    return not line or line.startswith(("```", "~~~", mark))


def _cut(lines: list[str]) -> tuple[int, list[str]]:
    """Return the common indent, and the lines without it and blanks at their ends."""
    left = min((len(line) - len(line.lstrip(" ")) for line in lines), default=0)
    right = max((len(line.rstrip(" ")) for line in lines), default=0)
    return left, [line[left:right] for line in lines]


def _without_tabs(lines: list[str], rows: list[int]) -> tuple[int, list[str]]:
    """Return what `_cut` does, tabs made blanks by the one size that fits."""
    tabs = [(i, line.index("\t")) for i, line in enumerate(lines) if "\t" in line]
    if not tabs:
        return _cut(lines)
    found = [_cut([line.expandtabs(size) for line in lines]) for size in TAB_SIZES]
    even = [(left, drawn) for left, drawn in found if len({*map(len, drawn)}) == 1]
    if even and all(drawn == even[0][1] for _, drawn in even):
        return even[0]
    (row, column), tab = tabs[0], "a tab, of which nobody knows how wide it is"
    longest = range(max(map(len, lines)))
    Picture(lines, rows, longest).refuse(row, column, tab, "write blanks instead")


def _narrowed(picture: Picture, known) -> Picture | None:
    """Return a drawing of larger cells as one of cells of one character, or None."""
    lines = picture.lines
    if not lines or len({*map(len, lines)}) > 1:
        return None
    top = re.fullmatch(POSTS.format("-"), lines[0])
    side = re.fullmatch(POSTS.format(r"\|"), "".join(line[0] for line in lines))
    if not top or not side or len(top[2]) < 2:
        return None
    high, wide = len(side[2]), len(top[2])
    tall, broad = _blocks(len(lines), high), _blocks(len(lines[0]), wide)
    drawn = [
        [_meaning([line[x:x_end] for line in lines[y:y_end]]) for x, x_end in broad]
        for y, y_end in tall
    ]
    posts = [char for line in drawn[::2] for char in line[::2]]
    if len(posts) == 4 or {*posts} != {top[1]} or any("" in line for line in drawn):
        return None  # one cell, or posts of several kinds, or a cell of several kinds
    if "".join(map("".join, drawn)).count(top[1]) > len(posts):
        return None
    if _may_be_ours(lines, known):
        needless = [
            (y, x) for y, _ in tall[::2] for x, _ in broad[::2] if _walls(lines, y, x)
        ]
        if not needless:
            return None
        if (high, wide) != (1, 3):
            row, column = needless[0]
            picture.refuse(
                row,
                column,
                f"here no walls meet, as if cells were {wide} x {high} characters",
                f"write {_walls(lines, row, column)!r}, or one character a cell",
            )
    for line in drawn[1::2]:
        line[1::2] = [{"G": "*", "S": " "}.get(char, char) for char in line[1::2]]
    for line in drawn[::2]:
        line[::2] = "+" * len(line[::2])
    return Picture(
        ["".join(line) for line in drawn],
        [picture.rows[(start + end) // 2] for start, end in tall],
        [picture.columns[(start + end) // 2] for start, end in broad],
    )


def _blocks(length: int, size: int) -> list[tuple[int, int]]:
    """Return first and end of posts (one character) and what lies between (size)."""
    starts = range(0, length, size + 1)
    ends = [(i, i + 1) for i in starts] + [(i + 1, i + 1 + size) for i in starts[:-1]]
    return sorted(ends)


def _meaning(block: list[str]) -> str:
    """Return the one letter in a block, or the character that fills it, or ""."""
    chars = "".join(block)
    letters = re.sub("[ |-]", "", chars)
    return letters if len(letters) == 1 else chars[0] * (len({*chars}) == 1)


def _may_be_ours(lines: list[str], known) -> bool:
    """Whether each character may stand where it does, one character a cell."""
    return len(lines) % 2 + len(lines[0]) % 2 == 2 and all(
        char in known[row % 2][column % 2]
        for row, line in enumerate(lines)
        for column, char in enumerate(line)
    )


def _walls(lines: list[str], row: int, column: int) -> str:
    """Return what we would draw for a '+' where no walls meet, "" where they do."""
    n, e, s, w = (
        0 <= y < len(lines) and 0 <= x < len(lines[0]) and lines[y][x] in "-|d"
        for y, x in (
            (row - 1, column),
            (row, column + 1),
            (row + 1, column),
            (row, column - 1),
        )
    )
    if n != s or e != w or (n and e):
        return ""
    return "|" if n else "-" if e else " "
