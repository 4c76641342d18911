"""
JavaScript without comments and without blanks that mean nothing.

Names are kept: what a reader of the built book finds is still legible, and an
error still names the function it comes from.
"""

from __future__ import annotations

import re

WORD = re.compile(r"[\w$]+")
BLANK = re.compile(r"(?:\s+|//[^\n]*|/\*.*?\*/)+", re.DOTALL)
STRING = re.compile(r"\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'")
PATTERN = re.compile(r"/(?:\\.|\[(?:\\.|[^\]\\])*\]|[^/\\\n\[])+/\w*")
BEFORE_PATTERN = {"return", "typeof", "case", "of", "in"}
OPEN_END = ",;{([=?:&|<>*%!~^"  # a line that ends so goes on
OPEN_START = ")]},;.?:=&|*>"  # and so does one before a line that begins so


def squeezed(text: str) -> str:
    """
    Return a script that does the same, shorter.

    >>> squeezed("// What it is.\\nconst half = (x) => {\\n  return x / 2; // why\\n};")
    'const half=(x)=>{return x/2;};'
    >>> squeezed("f(`a  ${ b } // c`, /[/ ]  '/, d + +e)\\ng()")
    "f(`a  ${ b } // c`,/[/ ]  '/,d+ +e)\\ng()"
    """
    tokens = []
    gap = ""
    place = 0
    while place < len(text):
        blank = BLANK.match(text, place)
        if blank:
            gap, place = blank[0], blank.end()
            continue
        end = _end_of_token(text, place, tokens[-1] if tokens else "")
        token = text[place:end]
        if tokens and gap:
            tokens.append(_needed(gap, tokens[-1], token))
        tokens.append(token)
        gap, place = "", end
    return "".join(tokens)


def _end_of_token(text: str, place: int, before: str) -> int:
    char = text[place]
    if char == "`":
        return _end_of_template(text, place + 1)
    kind = WORD
    if char in "\"'":
        kind = STRING
    elif char == "/" and _starts_pattern(before):
        kind = PATTERN
    found = kind.match(text, place)
    return found.end() if found else place + 1


def _starts_pattern(before: str) -> bool:
    """Return whether a slash after this begins a pattern, and does not divide."""
    is_value = WORD.fullmatch(before) or before[-1:] in ")]\"'`"
    return not is_value or before in BEFORE_PATTERN


def _end_of_template(text: str, place: int) -> int:
    while text[place] != "`":
        if text.startswith("${", place):
            place = _end_of_braces(text, place + 2)
        else:
            place += 2 if text[place] == "\\" else 1
    return place + 1


def _end_of_braces(text: str, place: int) -> int:
    while text[place] != "}":
        if text[place] == "{":
            place = _end_of_braces(text, place + 1)
        elif text[place] == "`":
            place = _end_of_template(text, place + 1)
        else:
            string = STRING.match(text, place)
            place = string.end() if string else place + 1
    return place + 1


def _needed(gap: str, left: str, right: str) -> str:
    """Return what of a gap between two tokens must stay."""
    a, b = left[-1], right[0]
    if "\n" in gap and a not in OPEN_END and b not in OPEN_START:
        return "\n"
    if WORD.fullmatch(a + b) or a == b and a in "+-/" or a.isdigit() and b == ".":
        return " "
    return ""
