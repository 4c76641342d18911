"""The exercises of a page in a browser: from a file, by keyboard, kept in the tab."""

import re

import pytest
from answers import parts
from axe_playwright_python.sync_playwright import Axe
from support import ROOT

from abstransfer.exercises import all_exercises, all_open_exercises
from abstransfer.scenes.files import bundled

ALL = {e.key: e for e in (*all_exercises(), *all_open_exercises())}
VALUE, TWO, WORD, LINES, OPEN = "ex-1-1", "ex-7-2", "ex-7-4", "ex-3-1", "ex-0-1"
STUB = f"<pre>{ALL[LINES].stub.code.splitlines()[0]}\n    ...</pre>"
PAGE = """<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Page</title>
<meta name="viewport" content="width=device-width"><style>{style}</style></head>
<body class="bd-content"><main><section id="exercises"><h1>Exercises</h1>
{exercises}</section></main><script>{script}</script></body></html>"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a page that has one exercise of each kind, and an empty one."""
    folder = tmp_path_factory.mktemp("book")
    style = (ROOT / "book" / "_assets" / "book.css").read_text(encoding="utf-8")
    boxes = "\n".join(
        f'<div class="exercise" id="{key}">{STUB * (key == LINES)}{parts(key)}</div>'
        for key in (VALUE, TWO, WORD, LINES, OPEN)
    )
    for name, exercises in (("01_building", boxes), ("02_solving", "")):
        text = PAGE.format(style=style, exercises=exercises, script=bundled("answers"))
        (folder / f"{name}.html").write_text(text, encoding="utf-8")
    return folder


@pytest.fixture
def visit(folder, tabs):
    visit = tabs.lend(folder)
    yield visit
    assert visit.problems == []


@pytest.fixture
def page(visit):
    return visit.open("01_building")


def box(page, key, n=0):
    return page.locator(f"#{key} .ab-answer").nth(n)


def answer(page, key, text, n=0):
    """Type an answer, press Enter, and return what is read aloud."""
    field = box(page, key, n).get_by_role("textbox")
    field.fill(text)
    field.press("Enter")
    return reply(page, key, n)


def reply(page, key, n=0):
    return box(page, key, n).get_by_role("status").inner_text()


def choose(page, key, **mistakes):
    """Choose lines by mistake, and press the button."""
    for name, lines in ALL[key].stub.blanks.items():
        line = lines[mistakes.get(name, "")]
        box(page, key).locator("input").and_(page.locator(f"[value={line!r}]")).check()
    box(page, key).get_by_role("button", name="Check").click()
    return reply(page, key)


def test_a_number_is_told_what_it_is(page):
    names = [wrong.name for wrong in ALL[VALUE].wrong]

    assert answer(page, VALUE, "") == (
        "No answer yet. Write your answer into the field."
    )
    assert answer(page, VALUE, "\u221218,21") == "Right."
    assert answer(page, VALUE, "-18").startswith("Nearly. Right as far as it goes")
    assert f"This looks like: {names[0]}." in answer(page, VALUE, "-20")
    assert "Hint 1 of 3: " + ALL[VALUE].hints[0] in answer(page, VALUE, "-20")
    assert "Hint 2 of 3: " + ALL[VALUE].hints[1] in answer(page, VALUE, "5")


def test_each_of_two_questions_has_its_own_box(page):
    assert answer(page, TWO, "-93.88", 0) == "Right."
    assert answer(page, TWO, "3.17", 1) == "Right."
    assert answer(page, WORD, "no, it stays") == "Right."


def test_lines_are_chosen_and_shown_where_they_belong(page):
    told = choose(page, LINES, following="a cut is a goal")

    assert told.startswith("Not yet. This looks like: a cut is a goal.")
    assert choose(page, LINES) == "Right. It agrees in every case."
    assert not page.locator(f"#{LINES} > pre").is_visible(), "the stub shows twice"
    code = box(page, LINES).locator("pre").inner_text()
    assert code.strip() == ALL[LINES].stub.filled().strip()


def test_it_works_by_keyboard_alone(page):
    field = box(page, WORD).get_by_role("textbox")
    field.focus()
    page.keyboard.type("no")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert reply(page, WORD) == "Right."

    first = box(page, LINES).get_by_role("radio").first
    first.focus()
    page.keyboard.press("ArrowDown")
    assert box(page, LINES).get_by_role("radio").nth(1).is_checked()


def test_a_hint_is_seen_only_after_the_one_before_it(page):
    hints = page.locator(f"#{VALUE} .ab-hint > p")

    seen = [hints.nth(i).is_visible() for i in range(3)]
    for i in range(3):
        page.locator(f"#{VALUE} .ab-hint > summary").nth(i).click()
        seen += [hints.nth(j).is_visible() for j in range(3)]

    no, yes = False, True
    assert seen == [no, no, no, yes, no, no, yes, yes, no, yes, yes, yes]
    assert hints.all_inner_texts() == list(ALL[VALUE].hints)
    assert "Hint 3 of 3" in answer(page, VALUE, "5"), "the other two were read"


def test_hints_need_no_script(chromium, folder):
    context = chromium.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((folder / "01_building.html").as_uri())

    summaries = page.locator(f"#{VALUE} summary")
    assert [summaries.nth(i).is_visible() for i in range(3)] == [True, False, False]
    assert page.get_by_text("What a good answer holds").is_visible()
    context.close()


def tools(page, name):
    page.locator(".ab-answers-tools").get_by_role("button", name=name).click()
    return page.locator(".ab-answers-tools").get_by_role("status").inner_text()


def notes(page):
    return box(page, OPEN).get_by_role("textbox")


def test_answers_and_notes_are_kept_in_the_tab(page, visit):
    answer(page, VALUE, "-18.21")
    answer(page, WORD, "yes")
    choose(page, LINES)
    notes(page).fill("Robots\nlearn.")

    page = visit.open("01_building", "?again")

    assert reply(page, VALUE) == "Right."
    assert box(page, WORD).get_by_role("textbox").input_value() == "yes"
    assert reply(page, WORD) == "", "what is not right is not judged unasked"
    assert reply(page, LINES) == "Right. It agrees in every case."
    assert notes(page).input_value() == "Robots\nlearn."


def test_a_page_can_be_reset_and_the_reset_undone(page):
    answer(page, VALUE, "-18.21")
    notes(page).fill("Robots learn.")

    assert "are gone" in tools(page, "Reset this page")
    assert box(page, VALUE).get_by_role("textbox").input_value() == ""
    assert reply(page, VALUE) == ""
    assert notes(page).input_value() == ""
    assert "are back" in tools(page, "Undo the reset")
    assert reply(page, VALUE) == "Right."
    assert notes(page).input_value() == "Robots learn."


def test_what_was_saved_is_a_text_and_can_be_loaded_on_any_page(page, visit, tmp_path):
    answer(page, VALUE, "-18.21")
    choose(page, LINES)
    notes(page).fill("Robots\n# learn.")
    page.evaluate(
        "sessionStorage.setItem('abstransfer:00_race', '{\"race.bet\":\"nd\"}')"
    )
    with page.expect_download() as download:
        assert "of 2 pages" in tools(page, "Save my answers")
    path = tmp_path / "saved.txt"
    download.value.save_as(path)
    text = path.read_text(encoding="utf-8")
    assert "# 00_race\n\n## race.bet\n> nd\n" in text
    assert "## ex-0-1\n> Robots\n> # learn.\n" in text
    before = page.evaluate("({...sessionStorage})")
    page.evaluate("sessionStorage.clear()")

    page = visit.open("02_solving")
    page.locator("input[type=file]").set_input_files(path)
    page.get_by_text(re.compile("^Loaded: .* of 2 pages.$")).wait_for()

    assert page.evaluate("({...sessionStorage})") == before
    path.write_text("nothing of ours", encoding="utf-8")
    page.locator("input[type=file]").set_input_files(path)
    page.get_by_text("This file holds nothing that was saved here.").wait_for()


@pytest.mark.parametrize("width", [360, 1440])
def test_nothing_is_wider_than_the_page_and_all_has_a_name(tabs, folder, width):
    page = tabs.lend(folder, width=width).open("01_building")
    answer(page, VALUE, "-20")
    choose(page, LINES)

    assert page.evaluate("document.documentElement.scrollWidth") <= width
    found = Axe().run(page).response["violations"]
    assert [(v["id"], v["nodes"][0]["html"][:80]) for v in found] == []


def test_a_box_is_printed_as_a_line_to_write_on(page):
    answer(page, VALUE, "-20")
    page.emulate_media(media="print")

    assert not page.locator(".ab-ask").first.is_visible()
    assert not page.locator(".ab-answers-tools").is_visible()
    assert page.locator(f"#{LINES} > pre").is_visible()
    looks = box(page, VALUE).evaluate("e => getComputedStyle(e).borderBottomStyle")
    assert looks == "solid"
    page.emulate_media(media="screen")
