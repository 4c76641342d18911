"""The student edition: each stub is its solution but for the blanks."""

import ast
import json
import os
import re
from tempfile import TemporaryDirectory

import nbformat
import pytest
import student_edition
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from plain_markdown import Course, plain, read_course
from student_edition import MARK, kept, pieces, stub, without_solutions
from support import ROOT, spoken_by_files
from traitlets.config import Config

from abstransfer.exercises import all_exercises, all_open_exercises

PAGES = sorted((ROOT / "book").glob("[0-9]*.ipynb"))  # those with exercises
KNOWN = {exercise.key: exercise for exercise in all_exercises()}
OPEN = {exercise.key: exercise for exercise in all_open_exercises()}
COURSE = read_course(ROOT / "book")
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
        ("a, b = 1, 2  # blank", "a = b = ..."),
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
    blank = new_code_cell('y = 2  # blank\ncheck("ex-1-1", y)', execution_count=3)
    blank.metadata["jupyter"] = {"source_hidden": True}
    blank.outputs = [nbformat.v4.new_output("stream", text="right")]
    cells = [given, new_markdown_cell(BEFORE), blank, new_code_cell("print(y)")]

    edition = student_edition.student_edition(
        new_notebook(cells=[*cells, new_markdown_cell(AFTER)]), COURSE
    )

    sources = [cell.source for cell in edition.cells]
    assert [*sources[:2], *sources[3:]] == [
        "print(1)",
        f"{student_edition.WHOSE}\n\n{student_edition.IMPORT}",
        'y = ...\ncheck("ex-1-1", y)',
        "## Next",
    ]
    assert edition.cells[3].outputs == []
    assert edition.cells[3].metadata == {}
    assert blank.outputs, "the full edition is not touched"


def test_an_open_exercise_gets_a_cell_for_words():
    shown = new_code_cell("print(4)", outputs=[])
    cells = [new_markdown_cell(BEFORE), shown, new_markdown_cell(AFTER)]

    edition = student_edition.student_edition(new_notebook(cells=cells), COURSE)

    kinds = [cell.cell_type for cell in edition.cells]
    assert kinds == ["markdown", "code", "code", "markdown"]
    assert edition.cells[2].source == student_edition.OPEN.format(key="ex-1-1")


def test_a_check_of_a_cell_that_is_left_out_stays():
    """As where a solution tries a function before it is checked."""
    made = new_code_cell("def f(x):\n    return x  # blank", outputs=[])
    tried = new_code_cell('print(f(2))\ncheck("ex-1-1", f)', outputs=[])
    cells = [new_markdown_cell(BEFORE), made, tried, new_markdown_cell(AFTER)]

    edition = student_edition.student_edition(new_notebook(cells=cells), COURSE)

    assert [cell.source for cell in edition.cells][2:4] == [
        "def f(x):\n    return ...",
        'check("ex-1-1", f)',
    ]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("x = ...\nprint(-x)", "x = ..."),
        ("for i in x:\n    y = ...\n    print(y.sum())", "..."),
        ("for i in x:\n    print(i)\ny = ...", "y = ..."),
        ('def f():\n    print(1)\n\n\nf()\ncheck("ex-1-1", f)',
         'def f():\n    print(1)\n\n\ncheck("ex-1-1", f)'),
    ],
)  # fmt: skip
def test_what_would_tell_or_fail_is_left_out(code, expected):
    assert kept(code) == expected


# Plain Markdown


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(page-x)=\n# Title", "# Title"),
        ("```{math}\n:label: eq-rho\nx\n```", "$$\nx\n\\tag{7}\n$$"),
        ("```{math}\nx\n```", "$$\nx\n$$"),
        ("see {eq}`eq-rho`, {ref}`exercise 1 <ex-0-1>`", "see (7), exercise 1"),
        ("see {ref}`blind`", "see *Of the blind*"),
        ("{doc}`00_race`; {doc}`notation`; {doc}`it <00_race>`",
         "[The race](00_race.ipynb); *Words*; [it](00_race.ipynb)"),
        ("{cite}`me`, {cite:t}`me`, {term}`sweeps <sweep>`",
         "(Me, 2015), Me (2015), sweeps"),
        ("{func}`~abstransfer.race`", "`abstransfer.race`"),
        ('(<a href="#race.t=1">step 1</a>)', "(step 1)"),
        ("```{admonition} Bet\n:class: important\n:name: bet-0-a\nWho?\n\n* I\n```",
         "> **Bet**\n>\n> Who?\n>\n> * I"),
        ("```{admonition} The bet: who\n:name: reply-0-a\n\n**I.**\n```",
         "<details>\n<summary>The bet: who</summary>\n\n**I.**\n\n</details>"),
        ("```{dropdown} Its $Q$ < 1\nNo.\n```",
         "<details>\n<summary>Its <i>Q</i> &lt; 1</summary>\n\nNo.\n\n</details>"),
        ("````{admonition} For the lecturer\n:class: note, dropdown\n42\n````", ""),
        ("```{exercise-start}\n:label: ex-3-1\n```\nWhat?\n```{exercise-end}\n```",
         "### Exercise 3.1\nWhat?"),
        ("````{admonition} A\n```{dropdown} B\nC\n```\n````",
         "> **A**\n>\n> <details>\n> <summary>B</summary>\n>\n> C\n>\n> </details>"),
        ("    {not: `a role`}\n\n```python\nx\n```",
         "{not: `a role`}\n\n```python\nx\n```"),
    ],
)  # fmt: skip
def test_every_form_of_a_page_has_a_plain_one(text, expected):
    titles = {"00_race": "The race", "notation": "Words"}
    works = {"me": ("Me", "2015")}

    course = Course(
        titles, {"00_race"}, {"eq-rho": 7}, {"blind": "Of the blind"}, works
    )

    assert plain(text, course) == expected


@pytest.mark.parametrize("text", ["```{video} x\n```", "{sub}`2`"])
def test_a_form_that_is_not_known_is_refused_by_name(text):
    with pytest.raises(ValueError, match=r"no plain form for the \w+ \{(video|sub)\}"):
        plain(text, COURSE)


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


@pytest.fixture
def edition(page):
    return student_edition.student_edition(page, COURSE)


def prose(notebook):
    cells = (cell for cell in notebook.cells if cell.cell_type == "markdown")
    return "\n\n".join(cell.source for cell in cells)


def keys_of(notebook):
    """Return the exercises that cells check, in order."""
    cells = (cell for cell in notebook.cells if cell.cell_type == "code")
    return [key for cell in cells for key in CHECKED.findall(cell.source)]


def test_the_student_edition_of_a_page_is_plain_markdown(edition):
    text = re.sub(r"^```(?s:.*?)^```$|^    .*$", "", prose(edition), flags=re.M)

    assert not re.search(r"\{[a-z][\w:-]*\}`|^(`{3,}|:{3,})|^\([\w-]+\)=", text, re.M)
    assert not re.search(r"^:[\w-]+:|^%|\\label\{|\(#", text, re.M)
    for fold in ("<details>", "<summary>"):
        assert text.count(fold) == text.count(fold.replace("<", "</"))
    for line in re.findall(r"^.*\$\$.*$", text, re.M):
        assert line == "$$", "an equation stands alone, in no box"
    assert text.count("$$") % 2 == 0
    assert not [x for x in re.findall("<summary>(.*)</summary>", text) if "$" in x]


def test_links_of_the_student_edition_lead_to_its_pages(edition):
    for target in re.findall(r"\]\(([^)]*)\)", prose(edition)):
        assert target in {path.name for path in PAGES}


def solutions_of(page):
    """Return the sentences of a page's solutions and of its box for lecturers."""
    text = prose(page)
    boxes = re.findall(
        r"^````\{admonition\} For the lecturer.*?^````$", text, re.S | re.M
    )
    left = [match[0] for match in re.finditer(
        r"^```\{solution-start\}.*?^```\{solution-end\}", text, re.S | re.M
    )]  # fmt: skip
    lines = "\n".join([*boxes, *left]).split("\n")
    return {
        line for line in lines if len(line) > 30 and not line.startswith(("`", ":"))
    }


def test_the_student_edition_of_a_page_holds_no_solution(page, edition):
    text = prose(edition)
    for sentence in solutions_of(page):
        assert plain(sentence, COURSE) not in text

    assert not MARK.search("\n".join(cell.source for cell in edition.cells))
    assert "For the lecturer" not in text
    assert len(edition.cells) >= len(page.cells) / 2


def test_each_question_has_a_blank_and_a_check(page, edition):
    labels = re.findall(r"^:label: (ex-[\w-]+)$", prose(page), re.M)
    wanted = sorted({*labels, *keys_of(page)})

    assert sorted(keys_of(edition)) == wanted
    assert re.findall(r"^### Exercise (.*)$", prose(edition), re.M) == [
        label.removeprefix("ex-").replace("-", ".") for label in labels
    ]


def test_cells_beside_a_blank_neither_tell_nor_fail(edition):
    """Below the first exercise only blanks run, and only `check` uses them."""
    at = [i for i, cell in enumerate(edition.cells) if "### Exercise" in cell.source]
    for cell in edition.cells[at[0] :] if at else ():
        if cell.cell_type != "code":
            continue
        assert not cell.outputs
        unanswered = set()
        for node in ast.parse(cell.source).body:
            is_check = ast.unparse(node).startswith("check(")
            names = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
            if isinstance(node, ast.Assign) and ast.unparse(node.value) == "...":
                unanswered |= names
            elif not is_check:
                assert not names & unanswered
            is_kept = (ast.Assign, ast.FunctionDef, ast.Import, ast.ImportFrom)
            assert is_check or isinstance(node, is_kept) or ast.unparse(node) == "..."


def numbers_in(code):
    """Return what the sums of a code come to that hold numbers only."""
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Constant | ast.BinOp | ast.UnaryOp):
            try:
                number = eval(compile(ast.Expression(node), "sum", "eval"), {})
            except (NameError, TypeError):
                continue
            if isinstance(number, float | int):
                yield float(number)


def test_numbers_in_code_are_those_written_and_their_sums():
    code = "sets = 8 + 20  # of one\nx = sets * 3"

    assert sorted(numbers_in(code)) == [3, 8, 20, 28]


def test_no_cell_of_the_exercises_comes_to_a_number_that_is_asked_for(edition):
    keys = [key for key in keys_of(edition) if key in KNOWN and not KNOWN[key].cases]
    wanted = {
        key: [abs(x) for x in (KNOWN[key].solution, *KNOWN[key].also)]
        for key in keys
        if not isinstance(KNOWN[key].solution, str)
    }
    at = [i for i, cell in enumerate(edition.cells) if "### Exercise" in cell.source]
    for cell in edition.cells[at[0] :] if at else ():
        if cell.cell_type == "code":
            told = [abs(x) for x in numbers_in(cell.source)]
            for key, numbers in wanted.items():
                hit = [x for x in told for y in numbers if x == pytest.approx(y, 1e-3)]
                assert not hit, (key, cell.source)


def test_what_a_page_comes_to_is_folded(edition):
    if "## Takeaways" in prose(edition):
        _, told = prose(edition).split("## Takeaways")
        assert re.fullmatch(
            r"\s*<details>\n<summary>.*</summary>\n\n(\*.*\n)+\n</details>.*",
            told,
            re.S,
        )


IN_WORDS = {  # the questions that no check judges, in short
    "02_solving": ["which cells"],
    "03_learning": ["which actions", "By how much"],
    "04_abstraction": ["In which abstract states", "have to know"],
    "05_inducing": ["looks new", "Of Prob's drive", "Of ND's"],
    "07_driving_test": ["what the paper did"],
    "08_advice": ["such an error"],
    "09_figures": [
        *["does the interval grow", "would you sign", "something false"],
        *["At which margin", "choosing the margin"],
    ],
    "10_worst_driver": ["does diluting Prob close", "a good one"],
    "11_neighbours": ["How far are they apart"],
    "12_your_turn": ["common sense"],
}


def test_each_question_has_a_blank_of_its_own(edition, request):
    name = request.node.callspec.id
    cells = [cell.source for cell in edition.cells if cell.cell_type == "code"]
    words = [source for source in cells if source.endswith("\nin_words = ...")]

    assert len(words) == len(IN_WORDS.get(name, ()))
    for source, part in zip(words, IN_WORDS.get(name, ()), strict=True):
        assert part in source.replace("\n# ", " ")


ASKED_AS_CODE = {"ex-4-2", "ex-8-1"}  # the "?" of these is what the function says


def test_an_exercise_has_a_blank_for_each_question_mark(edition):
    """Counted in the edition alone: code that is written answers no question."""
    text = "\n".join(
        cell.source if cell.cell_type == "markdown" else f"<cell>{cell.source}</cell>"
        for cell in edition.cells
    )
    parts = re.split(r"^### Exercise ", text, flags=re.M)[1:]
    assert len(parts) == len(re.findall("### Exercise", prose(edition)))
    for part in parts:
        number = part.partition("\n")[0]
        key = f"ex-{number.replace('.', '-')}"
        asked = part.split("<cell>")[0]
        asked = re.sub(
            r"^```(?s:.*?)^```$|^    .*$|^\*\*.*\*\*$", "", asked, flags=re.M
        )
        cells = "\n".join(re.findall("<cell>(.*?)</cell>", part, re.S))
        judged = [k for k in CHECKED.findall(cells) if k in OPEN or not KNOWN[k].cases]
        blanks = len(judged) + cells.count("\nin_words = ...")

        assert asked.count("?") <= blanks + (key in ASKED_AS_CODE), number


def test_a_blank_for_a_value_says_first_what_is_asked_for(page):
    """In JupyterLab the first line of a folded solution is what one sees of it."""
    for cell in blank_cells(page):
        asked = [f"# {KNOWN[k].task}" for k in CHECKED.findall(cell.source)]
        if asked and not KNOWN[CHECKED.findall(cell.source)[-1]].cases:
            comment = re.match(r"(?:# .*\n)+", cell.source)[0]
            assert comment[2:].replace("\n# ", " ").strip() in asked[-1].replace(
                "*", ""
            )


def test_the_first_line_of_a_folded_solution_is_no_blank(page):
    for cell in blank_cells(page):
        assert not MARK.search(cell.source.partition("\n")[0])


def test_words_of_a_solution_are_folded_behind_a_line_that_tells_nothing(page):
    """In JupyterLab a cell is folded as a whole, to its first line."""
    inside = False
    for cell in page.cells:
        if cell.cell_type == "markdown":
            rest, still = without_solutions(cell.source, inside)
            found = pieces(cell.source, inside)
            inside = still
            if any(is_solution and text.strip() for text, is_solution, _ in found):
                assert cell.metadata.get("jupyter") == {"source_hidden": True}
                assert re.match(r"```\{solution-start\}|% Words", cell.source)
                assert rest == "", "what is no solution would be folded, too"


# Those that run in seconds; in the night all: make nightly
CHEAP = ("01_building", "02_solving", "06_deducing")
RUN = [p for p in PAGES if p.stem in CHEAP or "EVERY_PAGE" in os.environ]


@pytest.mark.parametrize("path", RUN, ids=lambda path: path.stem)
def test_run_all_without_an_answer_gives_words(path, tmp_path):
    edition = student_edition.student_edition(nbformat.read(path, 4), COURSE)
    keys = keys_of(edition)
    alone = {"metadata": {"path": tmp_path}}  # as it is handed out
    with TemporaryDirectory() as folder:
        config = Config(KernelManager=spoken_by_files(folder))
        NotebookClient(edition, timeout=1000, resources=alone, config=config).execute()

    said = json.dumps([cell.get("outputs") for cell in edition.cells])
    for key in keys:
        assert re.search(rf"\*\*{key}: no(t| answer) yet\.\*\*", said), key
    assert "A good answer holds" not in said


def test_every_exercise_that_is_checked_is_known_and_answered_rightly(page, request):
    number = request.node.callspec.id[:2]  # of the page: "03", or no number
    for cell in page.cells:
        for key in CHECKED.findall(cell.source) if cell.cell_type == "code" else ():
            assert key in KNOWN
            assert key.split("-")[1].zfill(2) == number
            shown = json.dumps(cell.outputs)
            assert f"{key}: right." in shown, f"{key} is the last line of no cell"


def test_the_script_writes_all_pages_with_exercises(tmp_path, capsys):
    assert student_edition.main([str(tmp_path / "new" / "folder")]) == 0

    written = sorted(p.name for p in (tmp_path / "new" / "folder").iterdir())
    assert written == [path.name for path in PAGES]
    assert "student edition is in" in capsys.readouterr().out
