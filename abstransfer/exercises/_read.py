"""Reading an answer, whatever it is, and kind words where it cannot be read."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Iterator
from itertools import islice

import numpy as np


class Unreadable(Exception):
    """Says in kind words why an answer cannot be judged."""

    printed = ""  # what the answer printed before


QUOTES = " \t\r\n\"'`\u201c\u201d\u201e\u2018\u2019\u00ab\u00bb$!"
SIGNS = str.maketrans(
    {
        **dict.fromkeys("\u2010\u2011\u2012\u2013\u2212\ufe63\uff0d", "-"),
        **dict.fromkeys("\u00a0\u2007\u2009\u202f", " "),
        **dict.fromkeys("\u00d7\u00b7\u22c5", "*"),
        "\u00f7": "/",
        "\u221e": "inf",
        "^": "**",
    }
)
OPERATORS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
USUAL = {"suppress": False, "formatter": {}, "floatmode": "maxprec", "sign": "-"}
READ_ERRORS = (SyntaxError, ValueError, ArithmeticError, RecursionError, MemoryError)
READ_ERRORS += (TypeError,)  # a root of a number below 0
LONGEST = 200  # letters of a formula
MOST = 100_000  # entries taken from something that could go on for ever


def blank(answer) -> None:
    """Refuse what is no answer yet."""
    if answer is ...:
        raise Unreadable("The blank `...` is still there; put your answer in its place")
    if answer is None:
        raise Unreadable(
            "There is no answer in it, only `None`. Is a `return` missing?"
        )


def numbers(answer) -> np.ndarray:
    """Return an answer as an array of floats; a text may hold a formula."""
    blank(answer)
    if isinstance(answer, str):
        text = plain(answer)
        if len(re.findall(r",(?=\d)", text)) == 1:  # of decimals
            text = re.sub(r",(?=\d)", ".", text)
        if "," in text:  # a tuple, or a list
            text = text.strip("()[]")
        found = [formula(part) for part in re.split(r";|,|\band\b", text)]
        answer = found[0] if len(found) == 1 else found
    elif isinstance(answer, Iterator):
        answer = list(islice(answer, MOST))
    elif callable(answer):
        raise Unreadable("This is a function; what is asked for is a number or array")
    if isinstance(answer, (list, tuple)) and any(isinstance(a, str) for a in answer):
        answer = [numbers(a).tolist() for a in answer]
    try:
        array = np.asarray(answer)
        if np.iscomplexobj(array) and not array.imag.any():
            answer = array.real
        array = np.array(answer, dtype=float)
        lost = np.iscomplexobj(answer) or np.ma.is_masked(answer)
    except Exception:
        lost = True
    if lost:
        raise Unreadable(
            f"A number or an array of numbers is asked for, not {_kind(answer)}"
        )
    if np.isnan(array).any():
        raise Unreadable(
            "There is a `nan` in it, which comes from 0/0 or from inf - inf. "
            "Where could that happen?"
        )
    return array


def size(answer) -> np.ndarray:
    """Return numbers without their signs: a cost of 1 and a value of -1 agree."""
    return np.abs(numbers(answer))


def word(answer) -> str:
    """Return a text without quotes, article and plural; yes or no if it says so."""
    blank(answer)
    if isinstance(answer, (bool, np.bool_)):
        return "yes" if answer else "no"
    if not isinstance(answer, str):
        raise Unreadable(f"A word in quotes is asked for, not {_kind(answer)}")
    words = re.findall(r"\w+", str.__str__(answer).lower())
    if words and words[0] in ("yes", "y", "true", "no", "n", "not", "false"):
        return "yes" if words[0] in ("yes", "y", "true") else "no"
    if len(words) > 1 and words[0] in ("a", "an", "the"):
        words = words[1:]
    return " ".join(re.sub(r"(?<=\w\w[^s])s$", "", w) for w in words)


def letters(answer) -> str:
    """
    Return the letters that stand alone in a text, each once, in order.

    >>> letters("b and A"), letters("A, B; not c"), letters("AB")
    ('AB', 'ABC', 'AB')
    """
    blank(answer)
    if isinstance(answer, (list, tuple, set, frozenset)):
        answer = " ".join(map(str, answer))
    if not isinstance(answer, str):
        raise Unreadable(f"Letters in quotes are asked for, not {_kind(answer)}")
    words = [word.upper() for word in re.findall("[A-Za-z]+", str.__str__(answer))]
    found = {word for word in words if len(word) == 1}
    if len(words) == 1 and len(words[0]) <= 4:  # AB
        found = set(words[0])
    if not found:
        raise Unreadable("Write the letters, for instance: A and C")
    return "".join(sorted(found))


def numbers_of_actions(answer) -> np.ndarray:
    """Return a set of actions, sorted; a set, a list, an array or a mask will do."""
    blank(answer)
    if isinstance(answer, (set, frozenset)):
        answer = list(answer)
    array = np.atleast_1d(numbers(answer))
    if np.asarray(answer).dtype == bool:
        array = np.flatnonzero(array)
    return np.unique(array).astype(float)


def forms(answer) -> list:
    """Return what an answer may mean: a comma in a text is one of two things."""
    if not isinstance(answer, str) or "," not in str.__str__(answer):
        return [answer]
    text = str.__str__(answer)
    found = []
    apart = re.search(r";|\band\b", text)  # 0,28; 6,6
    if apart or len(re.findall(r",\d", text)) == 1:  # 0,28
        found.append(re.sub(r",(?=\d)", ".", text))
    if re.search(r"\d,\d{3}(?!\d)", text):  # 5,000
        found.append(re.sub(r"(?<=\d),(?=\d{3})", "", text))
    return found or [text]


def plain(text: str) -> str:
    """Return a text with the signs of a keyboard, without quotes and what they hold."""
    text = str.__str__(text).translate(SIGNS).strip(QUOTES).rstrip(QUOTES + ".")
    text = re.split(r"[=\u2248~]", text)[-1]  # "x = 5" says 5
    return re.sub(r"(?<=\d) (?=\d{3}(?!\d))", "", text)  # 5 000


def formula(text: str) -> float:
    """
    Return the number that a text stands for; nothing in it is run.

    >>> formula("1/(1 - 0.9)"), formula("5 goals"), formula("2**-1 %"), formula("3(2)")
    (10.000000000000002, 5.0, 0.5, 6.0)
    """
    bare = re.sub(r"(?<=[\d.)])\s*(%|per cent|[a-z]{2,})?[.\s]*$", "", text.strip())
    bare = re.sub(r"(?<=[\d.)])\s*\(", "*(", bare)  # a product without its sign
    try:
        if len(bare) > LONGEST:
            raise ValueError("too long")
        number = _worth(ast.parse(bare.strip(), mode="eval").body)
    except READ_ERRORS:
        raise Unreadable(
            f"A number is asked for; `{short(text, 40)}` cannot be read as one"
        ) from None
    return number


def _worth(node: ast.AST) -> float:
    match node:
        case ast.Constant() if type(node.value) in (int, float):
            return float(node.value)
        case ast.Name(id="inf" | "infinity"):
            return np.inf
        case ast.UnaryOp() if type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)](_worth(node.operand))
        case ast.BinOp() if type(node.op) in OPERATORS:
            return float(
                OPERATORS[type(node.op)](_worth(node.left), _worth(node.right))
            )
    raise ValueError("no number")


def _kind(thing) -> str:
    name = short(type(thing).__name__, 40)
    if name == "str":
        return "a text"
    if isinstance(thing, (list, tuple)) and thing:
        inside = short(type(thing[0]).__name__, 40)
        if inside in ("set", "dict", "list", "tuple", "NoneType", "ellipsis"):
            return f"a {name} of {inside}s"
    return f"a {name}"


def same(a, b, tolerance: float) -> bool:
    """Return whether two answers that were read agree, but for axes of length 1."""
    if isinstance(a, str) or isinstance(b, str):
        return isinstance(a, str) and isinstance(b, str) and a == b
    a, b = np.squeeze(a), np.squeeze(b)
    return a.shape == b.shape and np.allclose(a, b, rtol=tolerance, atol=tolerance)


def short(text: str, length: int = 200) -> str:
    """Return a text in one line, of letters that can be shown, cut to a length."""
    text = str.__str__(text)[: 4 * length]
    text = re.sub(r" at 0x[0-9a-fA-F]+", "", text).replace("`", "'")
    text = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return text if len(text) <= length else text[: length - 3].rstrip() + "..."


def shown(thing, precision: int = 4) -> str:
    """Return a number, array or function as a short text, the same each time."""
    try:
        if isinstance(thing, np.random.Generator):
            return "a generator"
        if callable(thing):
            return short(getattr(thing, "__name__", type(thing).__name__))
        if isinstance(thing, (list, tuple)):
            return f"[{', '.join(shown(part, precision) for part in thing[:50])}]"
        if isinstance(thing, (bool, np.bool_)):
            return str(bool(thing))
        if type(thing) is int:
            return short(str(thing))
        if isinstance(thing, str):
            return repr(short(thing))
        with np.printoptions(precision=precision, threshold=100, **USUAL):
            return short(np.array2string(np.asarray(thing), separator=", "), 400)
    except Exception:
        return short(type(thing).__name__)
