"""The pages as text: quizzes, headings, times, spelling, links to exercises."""

import json
import re
import subprocess
import sys

import pytest
import reading_level
from pages import stated_seconds
from support import ROOT

BOOK = ROOT / "book"
LESSONS = sorted(BOOK.glob("[0-9]*.ipynb"))
TEXTS = sorted([*BOOK.glob("*.md"), *BOOK.glob("*.ipynb")])
CHOICE = re.compile(r"^```\{dropdown\} ([^\n]+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
QUESTION = re.compile(r"^\*\*(\d)\.\*\* ", re.MULTILINE)
LONGER = {  # pages of more than 1,800 words, and why
    "09_figures": "the paper's five claims are judged one by one",
    "10_worst_driver": "each explanation has its own experiment",
}


def text_of(path):
    if path.suffix == ".md":
        return path.read_text(encoding="utf-8")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "\n\n".join(
        "".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"
    )


@pytest.fixture(params=LESSONS, ids=lambda path: path.stem)
def lesson(request):
    return text_of(request.param)


def questions(lesson):
    """Return the choices of each question of the quiz: (title, reply)."""
    _, _, quiz = lesson.partition("\n## Quiz\n")
    quiz = re.split(r"^## ", quiz, flags=re.MULTILINE)[0]
    starts = [match.start() for match in QUESTION.finditer(quiz)]
    parts = zip(starts, [*starts[1:], None], strict=True)
    return [CHOICE.findall(quiz[start:end]) for start, end in parts]


def test_a_quiz_has_three_questions_each_with_one_right_choice(lesson):
    asked = questions(lesson)

    assert len(asked) == 3
    for choices in asked:
        replies = [reply.strip() for _, reply in choices]
        assert len(choices) >= 2
        assert len(set(choices)) == len(choices)
        assert sum(reply.startswith("Yes") for reply in replies) == 1
        assert all(len(reply.split()) >= 4 for reply in replies), "a reply says why"


def test_the_right_choice_stands_in_every_place_alike():
    """As the seed of a shuffle left it: no place is a good guess."""
    asked = [choices for path in LESSONS for choices in questions(text_of(path))]
    three = [choices for choices in asked if len(choices) == 3]
    places = [
        [reply.strip().startswith("Yes") for _, reply in choices].index(True)
        for choices in three
    ]

    assert len(three) >= 30
    for place in range(3):
        assert places.count(place) >= len(three) / 4


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.stem)
def test_headings_start_at_the_first_level_and_skip_none(path):
    text = re.sub(r"^(`{3,}).*?^\1", "", text_of(path), flags=re.DOTALL | re.MULTILINE)
    levels = [len(mark) for mark in re.findall(r"^(#+) ", text, re.MULTILINE)]

    assert levels.count(1) == 1
    assert levels[0] == 1
    assert all(b <= a + 1 for a, b in zip(levels, levels[1:], strict=False))


def test_a_page_says_what_it_teaches_and_how_long_it_takes(lesson):
    assert "```{admonition} By the end of this page you can" in lesson
    assert re.search(r"^\*Time:\* \d+ minutes", lesson, re.MULTILINE)
    assert stated_seconds(lesson) <= 120
    assert "## Takeaways" in lesson
    assert "{admonition} For the lecturer" in lesson


def test_each_exercise_has_a_solution_and_belongs_to_an_outcome(lesson):
    asked = re.findall(r"\{exercise-start\}\n:label: (\S+)", lesson)
    solved = re.findall(r"\{solution-start\} (\S+)", lesson)
    outcomes = lesson.partition("\n## ")[0]

    assert len(asked) >= 3
    assert asked == solved
    assert all(f"<{key}>" in outcomes for key in asked)


def n_words(text):
    """
    Count the words of a page without exercises, quiz, formulas, lecturer's box.

    Nor are answers counted that are folded below the questions of a scene.
    """
    before, _, after = text.partition("\n## Exercises\n")
    text = before + after.partition("\n## Takeaways\n")[2]
    text = re.sub(r"<details>.*?</details>", "", text, flags=re.DOTALL)
    box = r"^(`{4,})\{admonition\} For the lecturer.*?^\1"
    text = re.sub(box, "", text, flags=re.MULTILINE | re.DOTALL)
    formula = r"^```\{math\}.*?^```|\$\$.*?\$\$|\$[^$]*\$"
    text = re.sub(formula, "", text, flags=re.MULTILINE | re.DOTALL)
    return len(re.findall(r"[A-Za-z][\w'\u2019-]*", text))


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_a_page_has_1000_to_1800_words_without_exercises_and_quiz(path):
    n = n_words(text_of(path))

    assert n >= 1000
    assert n <= 1800 or path.stem in LONGER


def test_each_outcome_of_a_page_is_what_an_exercise_asks_for(lesson):
    box = lesson.partition("\n*You need:*")[0]
    outcomes = re.findall(r"^\d+\. .*$", box, re.MULTILINE)

    assert len(outcomes) >= 3
    assert all("{ref}`exercise" in outcome for outcome in outcomes)


@pytest.mark.parametrize(
    ("words", "seconds"),
    [("about twenty seconds", 20), ("about half a minute", 30), ("5 seconds", 5)]
    + [("about a minute", 60), ("less than two minutes", 120), ("one minute", 60)],
)
def test_stated_times_are_understood(words, seconds):
    assert stated_seconds(f"The notebook runs in {words}.") == seconds


def test_the_spelling_is_right(tmp_path):
    """By codespell: it knows what is often misspelled, so new names pass."""
    for path in TEXTS:
        (tmp_path / f"{path.stem}.md").write_text(text_of(path), encoding="utf-8")
    own = [*(ROOT / "abstransfer").rglob("*.py"), *(ROOT / "tests").rglob("*.py")]
    own += [*ROOT.glob("*.md"), *(ROOT / "scripts").glob("*.py")]
    words = ROOT / "tests" / "words.txt"
    command = [sys.executable, "-m", "codespell_lib", "-I", words, tmp_path, *own]
    done = subprocess.run(command, capture_output=True, encoding="utf-8")

    assert done.returncode == 0, done.stdout + done.stderr


def test_the_reading_level_of_every_page_is_reported(capsys):
    assert reading_level.main([str(path) for path in LESSONS]) == 0

    report = capsys.readouterr().out
    assert all(path.stem in report for path in LESSONS)


def test_long_sentences_are_harder_to_read():
    short = reading_level.grade("The cat sat. The dog ran. It was fun.")
    long = reading_level.grade(
        "Notwithstanding considerable methodological heterogeneity, investigators "
        "demonstrated statistically significant improvements throughout."
    )

    assert short < 3
    assert long > 15
