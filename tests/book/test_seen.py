"""What a reader should have seen in a scene: each number of it is computed."""

import json
import re

import pytest
from seen import SEEN
from support import ROOT

PAGES = sorted((ROOT / "book").glob("[0-9]*.ipynb"))
FOLDED = re.compile(
    r"<details>\n<summary>What you should have seen</summary>\n\n(.*?)\n\n</details>",
    re.DOTALL,
)
ITEM = re.compile(r"^\d\. (.+)$", re.MULTILINE)


def questions_and_answers(path):
    """Return the numbered questions under the scenes of a page, and their answers."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    shown = [
        i for i, c in enumerate(cells) if "data-scene=" in json.dumps(c.get("outputs"))
    ]
    questions, answers = [], []
    for i in shown:
        if not (text := "".join(cells[i + 1]["source"])).startswith("1. "):
            continue
        folded = FOLDED.search(text)
        assert folded, f"questions without answers: {text[:80]}"
        questions += ITEM.findall(text[: folded.start()])
        answers += ITEM.findall(folded[1])
    return questions, answers


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_every_question_under_a_scene_has_an_answer(path):
    questions, answers = questions_and_answers(path)

    assert len(questions) == len(answers) >= 2
    assert all(len(answer.split()) >= 5 for answer in answers)


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_the_numbers_of_an_answer_are_computed(path):
    _, answers = questions_and_answers(path)
    found = list(SEEN[path.stem[:2]]())

    assert len(found) == len(answers)
    for answer, phrases in zip(answers, found, strict=True):
        rest = re.sub("<[^>]*>", "", answer)
        rest = rest.replace("$", "").replace("−", "-").replace("\\beta", "beta")
        for phrase in phrases:
            assert phrase in rest, f"{phrase!r} is not in: {answer}"
        for phrase in sorted(phrases, key=len, reverse=True):
            rest = rest.replace(phrase, "")
        assert not re.search(r"\d", rest), f"a number that nothing computes: {rest}"
