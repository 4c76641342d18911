"""What the hints and the solutions say runs on the page where they stand."""

import ast
import builtins
import dis
import inspect
import json
import re

import matplotlib as mpl
import numpy as np
import pytest
from support import ROOT

import abstransfer as at
from abstransfer.exercises import (
    _check,
    all_exercises,
    check,
    exercises_of,
    open_exercises_of,
)
from abstransfer.exercises._model import first_of

ALL = {exercise.key: exercise for exercise in all_exercises()}
PAGES = sorted(
    path
    for path in (ROOT / "book").glob("[0-9]*.ipynb")
    if any(int(path.name[:2]) == int(key.split("-")[1]) for key in ALL)
)
CODE = re.compile(r"`([^`]+)`")
LABEL = re.compile(r"\{exercise-start\}\n:label: (ex-\d+-\d+)")
CHECKED = re.compile(r'^check\("([^"]+)"', re.MULTILINE)

# What the words of a hint name before its code.
NAMED = {
    "ex-3-2": "n = len(q_row)",
    "ex-5-1": "policy, rho = policies[0], rhos[0]\n"
    "votes = np.zeros((n_abstract, policy.shape[1]))",
    "ex-5-2": "votes = np.ones((n_abstract, policies[0].shape[1]))",
    "ex-6-2": "s = 0",
}
# Where the code of a hint is not the whole answer, and what the words add.
IN_PART = {
    "ex-1-3": "which cell, then which reward",
    "ex-3-1": "alpha times the target",
    "ex-3-2": "one of the best actions is drawn",
    "ex-4-2": "rows and columns apart are added",
    "ex-5-1": "the votes are divided by these sums",
    "ex-5-2": "the set is divided by its size",
    "ex-6-2": "the answer is G",
    "ex-7-4": "what is compared is the order",
    "ex-12-3": "each row is divided by its sum",
}


def code_of(exercise):
    """Return the code in the hints of an exercise, in order."""
    return [code for hint in exercise.hints for code in CODE.findall(hint)]


def follow(exercise, names, case=()):
    """Run the code of the hints, line by line; return what the last one gives."""
    names = (
        {**names, **dict(zip(exercise.parameters, case, strict=True))}
        if case
        else names
    )
    exec(NAMED.get(exercise.key, ""), names)
    given = None
    for code in code_of(exercise):
        given = run(code, names)
    return given


def run(source, names):
    """Run a source; return the value of its last line if that is an expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, source[:40], "exec"), names)
    return last and eval(
        compile(ast.Expression(last.value), source[:40], "eval"), names
    )


# ---- only the cells that matter: those that make a name that is used later


def instructions(code):
    """Yield what a source does to names, also in its functions."""
    yield from dis.get_instructions(code)
    for inner in code.co_consts:
        if inspect.iscode(inner):
            yield from instructions(inner)


def used(source):
    """Return the names of the page that a source looks up."""
    code = compile(source, "cell", "exec")
    loads = ("LOAD_NAME", "LOAD_GLOBAL")
    return {i.argval for i in instructions(code) if i.opname in loads}


def changed(source):
    """Return the names that a cell may change, and those it surely makes anew."""
    may = {
        i.argval
        for i in instructions(compile(source, "cell", "exec"))
        if i.opname in ("STORE_NAME", "STORE_GLOBAL")
    }
    surely = set()
    for node in ast.walk(tree := ast.parse(source)):  # x[0] = 1, x.y = 1
        if isinstance(getattr(node, "ctx", None), ast.Store) and isinstance(
            getattr(node, "value", None), ast.Name
        ):
            may.add(node.value.id)
    for node in tree.body:
        if isinstance(node, ast.Assign):
            surely |= {t.id for t in node.targets if isinstance(t, ast.Name)}
    return may, surely


def cells_that_matter(cells):
    """Yield the cells that exercises need, each with the ids that it asks or checks."""
    kept, wanted = [], set()
    for kind, source in reversed(cells):
        if kind == "markdown":
            keys = [
                k
                for k in ALL
                for label in LABEL.findall(source)
                if first_of(k) == label
            ]
            for key in keys:
                code = [NAMED.get(key, ""), *code_of(ALL[key])]
                own = set().union(*(changed(line)[1] for line in code))
                given = ALL[key].parameters if ALL[key].cases else ()
                wanted |= used("\n".join(code)) - own - set(given)
            if keys:
                kept.append((kind, source, keys))
            continue
        keys = CHECKED.findall(source)
        may, surely = changed(source)
        if keys or may & wanted:
            wanted = (wanted - surely) | used(source)
            kept.append((kind, source, keys))
    return reversed(kept)


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_hints_and_solutions_run_on_their_page(path, monkeypatch):
    """Each page is run once, with the cells that its exercises need."""
    monkeypatch.setattr(_check, "_tries", {})
    monkeypatch.chdir(path.parent)
    monkeypatch.setitem(mpl.rcParams, "backend", "agg")
    page = json.loads(path.read_text(encoding="utf-8"))
    cells = [(cell["cell_type"], "".join(cell["source"])) for cell in page["cells"]]
    asked, solved, names = set(), set(), {"__name__": "page"}

    for kind, source, keys in cells_that_matter(cells):
        if kind == "code":
            reply = run(source, names)
            solved |= {key for key in keys if reply}
            continue
        for key in keys:
            asked.add(key)
            hints_run(ALL[key], names)

    on_page = {key for key in ALL if int(key.split("-")[1]) == int(path.name[:2])}
    assert asked == solved == on_page


def hints_run(exercise, names):
    if not code_of(exercise):
        return
    if exercise.cases:
        first = next(exercise.cases(np.random.default_rng(1)))
        follow(exercise, dict(names), first)
        answer = like(exercise, lambda *case: follow(exercise, dict(names), case))
    else:
        answer = follow(exercise, dict(names))
    if exercise.key not in IN_PART:
        assert check(exercise.key, answer), (
            f"the last code in the hints of {exercise.key}"
        )


def like(exercise, function):
    """Return a function that takes what the solution takes."""
    function.__signature__ = inspect.signature(exercise.solution)
    return function


# ---- open exercises, of which only the hints can be looked at

# Names that the words of a hint give, or leave to the reader.
GIVEN = {
    "00_race": {"curve"},  # the average curve
    "08_advice": {"copy"},  # of the table
}
NOTEBOOKS = sorted((ROOT / "book").glob("[0-9]*.ipynb"))
STATED = re.compile(
    r"\{exercise-start\}\n:label: (ex-\d+-\d+)\n```\n(.*?)```\{exercise-end\}",
    re.DOTALL,
)


def words_of(path):
    """Return the Markdown of a page."""
    page = json.loads(path.read_text(encoding="utf-8"))
    return "\n".join(
        "".join(cell["source"])
        for cell in page["cells"]
        if cell["cell_type"] == "markdown"
    )


def asked(code):
    """Return the names that are called or have something after a dot."""
    nodes = list(ast.walk(ast.parse(code)))
    before = [n.func for n in nodes if isinstance(n, ast.Call)]
    before += [n.value for n in nodes if isinstance(n, ast.Attribute)]
    return {n.id for n in before if isinstance(n, ast.Name)}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_what_a_hint_of_an_open_exercise_calls_is_on_its_page(path):
    page = json.loads(path.read_text(encoding="utf-8"))
    known = {*dir(builtins), *GIVEN.get(path.stem, ())}
    for cell in page["cells"]:
        if cell["cell_type"] == "code":
            known |= changed("".join(cell["source"]))[0]
    for exercise in open_exercises_of(int(path.name[:2])).values():
        for code in code_of(exercise):
            known |= changed(code)[0]
            assert asked(code) <= known, code
            for name in re.findall(r"\b(?:at|np)(?:\.\w+)+", code):
                assert eval(name, {"at": at, "np": np}), name


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_each_exercise_of_a_page_is_known_and_its_hints_stand_in_one_place(path):
    stated = dict(STATED.findall(words_of(path)))
    page = int(path.name[:2])
    known = exercises_of(page) | open_exercises_of(page)

    assert set(stated) == {first_of(key) for key in known}
    for key, words in stated.items():
        assert "hint" not in words.lower(), f"{key}: hints are data in exercises/"
