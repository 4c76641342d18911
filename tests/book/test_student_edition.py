"""The student edition: each stub is its solution but for the blanks."""

import json
import re

import nbformat
import pytest
import student_edition
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from student_edition import MARK, stub, without_solutions
from support import ROOT

from abstransfer.exercises import all_exercises

PAGES = sorted((ROOT / "book").glob("*.ipynb"))
KNOWN = {exercise.key: exercise for exercise in all_exercises()}
CHECKED = re.compile(r'^check\("([^"]+)"', re.MULTILINE)

STUB = re.compile(  # an exercise's label, and the code that is shown in it
    r"\{exercise-start\}\n:label: (ex-[\w-]+)\n(?:(?!\{exercise-end\}).)*?"
    r"^```python\n(.*?)^```$",
    re.DOTALL | re.MULTILINE,
)

BEFORE = """```{exercise-start}
:label: ex-1-1
```
Twice what?
```{exercise-end}
```

```{solution-start} ex-1-1
:class: dropdown
```
Twice two."""
AFTER = """Easy.
```{solution-end}
```

## Next"""


@pytest.mark.parametrize(
    ("solution", "expected"),
    [
        ("x = 1  # blank", "x = ..."),
        ("x = 1  # not blank at all", "x = 1  # not blank at all"),
        ("a, b = 1, 2  # blank", "a, b = ..."),
        ("for i in x:  # blank\n    y += i\nz = 1", "...\nz = 1"),
        ("for i in x:\n    y += i  # blank\nz = 1", "for i in x:\n    ...\nz = 1"),
        ("f(\n    1,\n    2,\n)  # blank\ng()", "...\ng()"),
        ("a()  # blank\nb()  # blank\nc()", "...\nc()"),
        ("if a:\n    b()\nelse:  # a comment\n    return_(1)  # blank",
         "if a:\n    b()\nelse:  # a comment\n    ..."),
        ("def f(x):\n    return x  # blank", "def f(x):\n    return ..."),
    ],
)  # fmt: skip
def test_a_marked_statement_becomes_a_blank(solution, expected):
    assert stub(solution) == expected


def test_text_of_solutions_is_left_out_and_the_rest_is_kept():
    before, inside = without_solutions(BEFORE, False)
    after, still = without_solutions(AFTER, inside)

    assert before.startswith("```{exercise-start}")
    assert before.endswith("```{exercise-end}\n```")
    assert (inside, after, still) == (True, "## Next", False)


def test_cells_of_a_solution_are_stubs_or_left_out():
    given = new_code_cell("print(1)", outputs=[])
    blank = new_code_cell("y = 2  # blank\ncheck('ex-1-1', y)", execution_count=3)
    blank.metadata["jupyter"] = {"source_hidden": True}
    blank.outputs = [nbformat.v4.new_output("stream", text="right")]
    cells = [given, new_markdown_cell(BEFORE), blank, new_code_cell("print(y)")]

    edition = student_edition.student_edition(
        new_notebook(cells=[*cells, new_markdown_cell(AFTER)])
    )

    sources = [cell.source for cell in edition.cells]
    assert [sources[0], *sources[2:]] == [
        "print(1)",
        "y = ...\ncheck('ex-1-1', y)",
        "## Next",
    ]
    assert edition.cells[2].outputs == []
    assert edition.cells[2].metadata == {}
    assert blank.outputs, "the full edition is not touched"


def test_an_open_exercise_gets_an_empty_cell_that_says_so():
    shown = new_code_cell("print(4)", outputs=[])
    cells = [new_markdown_cell(BEFORE), shown, new_markdown_cell(AFTER)]

    edition = student_edition.student_edition(new_notebook(cells=cells))

    assert [c.cell_type for c in edition.cells] == ["markdown", "code", "markdown"]
    assert edition.cells[1].source == student_edition.OPEN.format(key="ex-1-1")


@pytest.fixture(params=PAGES, ids=lambda path: path.stem)
def page(request):
    return nbformat.read(request.param, as_version=4)


def blank_cells(page):
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    return [cell for cell in code if MARK.search(cell.source)]


def test_a_stub_is_its_solution_but_for_the_blanks(page):
    for cell in blank_cells(page):
        rest = iter(cell.source.split("\n"))
        for line in stub(cell.source).split("\n"):
            if not line.endswith("..."):
                assert line in rest, f"{line!r} is not in the solution, or not there"
        assert "..." in stub(cell.source)


def test_a_stub_shown_in_an_exercise_is_that_of_its_solution(page):
    shown = {}
    for cell in page.cells:
        for key, code in STUB.findall(cell.source):
            shown[key] = code
    for cell in blank_cells(page):
        for key in CHECKED.findall(cell.source):
            assert stub(cell.source).startswith(shown.pop(key, ""))

    assert not shown, "a stub without a solution that is checked"


def test_the_student_edition_of_a_page_holds_no_solution(page):
    edition = student_edition.student_edition(page)
    text = json.dumps(edition)

    assert "{solution-" not in text
    assert not MARK.search("\n".join(cell.source for cell in edition.cells))
    assert text.count("{exercise-start}") == json.dumps(page).count("{exercise-start}")
    assert len(edition.cells) >= len(page.cells) / 2


def test_every_exercise_that_is_checked_is_known_and_answered_rightly(page, request):
    number = request.node.callspec.id[:2]  # of the page: "03", or no number
    for cell in page.cells:
        for key in CHECKED.findall(cell.source) if cell.cell_type == "code" else ():
            assert key in KNOWN
            assert key.split("-")[1].zfill(2) == number
            shown = json.dumps(cell.outputs)
            assert f"{key}: right." in shown, f"{key} is the last line of no cell"


def test_the_script_writes_all_pages(tmp_path, capsys):
    assert student_edition.main([str(tmp_path / "new" / "folder")]) == 0

    written = sorted(p.name for p in (tmp_path / "new" / "folder").iterdir())
    assert written == [path.name for path in PAGES]
    assert "student edition is in" in capsys.readouterr().out
