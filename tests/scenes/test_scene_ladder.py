"""The ladder: Table 1 of any source, by mouse and by keyboard, and beside Python."""

import re

import pytest
from scene_tab import bare, number

from abstransfer.builders import BUILDERS
from abstransfer.driving import PAPER, ROWS
from abstransfer.maps import read_map
from abstransfer.scenes import Ladder

SOURCE = str(read_map("source"))
NAMES = dict(zip(ROWS, ("wanderer", "ND", "Prob", "Grad", "optimal"), strict=True))
DONE = "() => /top of its climb/.test(document.querySelector('.ab-body').innerText)"


def ladder(open_page, **options):
    return open_page(bare(Ladder), **options)


def solved(tab):
    """Wait until Grad is at the top."""
    tab.settle().page.wait_for_function(DONE)
    return tab.settle()


def bets(tab, order="Grad, Prob, ND", gap="half of its cost"):
    for place, text in enumerate((order, gap)):
        group = tab.root.locator(".ab-bet").nth(place)
        group.get_by_text(text, exact=True).click()
    return tab.settle()


def text_of(tab):
    return tab.root.locator("textarea").input_value()


def assert_rungs_are_pythons(tab, **options):
    rows = solved(tab).rows()
    table = Ladder(text=text_of(tab), **options).table
    for row in ROWS:
        source, _, target, _ = rows[NAMES[row]]
        assert abs(number(source) - table["source"][row]) < 1e-9, row
        assert abs(number(target) - table["target"][row]) < 1e-9, row


def rungs(tab):
    """The names and numbers beside the rungs, and their boxes."""
    return tab.root.locator(".ab-chart text.ab-name").evaluate_all(
        "all => all.map(e => [e.textContent, e.getBoundingClientRect()])"
        ".map(([text, b]) => [text, b.left, b.top, b.right, b.bottom])"
    )


# Numbers


def test_the_bets_are_asked_before_the_target_is_shown(open_scene):
    tab = solved(ladder(open_scene))
    rows, page = tab.rows(), tab.page
    table = Ladder().table
    assert [rows[NAMES[name]][2] for name in BUILDERS] == ["–"] * 3
    assert number(rows["wanderer"][2]) == pytest.approx(table["target"]["rand"])
    assert "In the source" in tab.closing
    bets(tab)

    assert_rungs_are_pythons(tab)
    order = sorted(BUILDERS, key=table["target"].get, reverse=True)
    best, optimal = table["target"][order[0]], table["target"]["optimal"]
    right = ", ".join(NAMES[name] for name in order)
    assert f"“Grad, Prob, ND”; it was “{right}”." in tab.closing
    assert f"pays {100 * (best / optimal - 1):.0f} % more" in tab.closing
    assert best / optimal - 1 > 1
    assert "it was “more than all of it again”" in tab.closing
    paper = {row: [PAPER[s][row] for s in ("source", "target")] for row in ROWS}
    found = tab.rows()
    assert paper == {
        row: [number(found[NAMES[row]][i]) for i in (1, 3)] for row in ROWS
    }
    assert page.locator(".ab-chart path.ab-marker").count() == 20
    assert tab.problems == []


def test_an_edited_source_moves_both_ladders(open_scene):
    tab = solved(bets(ladder(open_scene)))
    before = Ladder().table["target"]
    tab.pick("Tool", "Door").click_cell(17, x=0.98)
    assert text_of(tab) != SOURCE
    assert_rungs_are_pythons(tab)
    after = Ladder(text=text_of(tab)).table["target"]
    moves = {name: after[name] - before[name] for name in BUILDERS}
    most = max(moves, key=lambda name: abs(moves[name]))

    assert f"{NAMES[most]} moved most, by {moves[most]:+.1f}." in tab.closing.replace(
        "\u2212", "-"
    )
    assert "they are not of this source" in tab.root.inner_text()
    tab.click("Undo")
    assert text_of(tab) == SOURCE
    assert "You bet on" in solved(tab).closing
    assert tab.problems == []


def test_another_reading_is_pythons_too(open_scene):
    tab = bets(ladder(open_scene))
    tab.pick("What an action says", "north, east, south, west")
    tab.root.get_by_role("slider", name="probability").fill("0.5")
    tab.root.get_by_role("slider", name="The goal is near").fill("9")
    tab.settle()
    options = {"actions": "compass", "success": 0.5, "near": 9}

    assert_rungs_are_pythons(tab, **options)
    tab.pick("What an action says", "go to what you see")
    for value in ("0.6", "0.75", "0.55", "0.95", "1"):  # five in a row
        tab.root.get_by_role("slider", name="probability").fill(value)
    assert_rungs_are_pythons(tab, success=1.0, near=9)
    query = tab.url_with("ladder.near=9")
    assert "actions" not in query
    tab.click("Reset")
    assert_rungs_of_the_paper(tab)
    assert tab.problems == []


def assert_rungs_of_the_paper(tab):
    assert solved(tab).root.locator(".ab-bet :checked").count() == 0
    assert "Hollow marks: the paper's numbers." in tab.root.inner_text()
    assert number(tab.rows()["Grad"][0]) == pytest.approx(
        Ladder().table["source"]["grad"]
    )


# Sizes


def test_small_large_and_illegal_sources(open_scene):
    tab = bets(ladder(open_scene))
    rows, columns = (
        tab.root.get_by_role("spinbutton", name=n) for n in ("Rows", "Columns")
    )
    rows.fill("3")
    columns.fill("3")
    tab.click("A blank room of")
    assert_rungs_are_pythons(tab)
    rows.fill("60")
    columns.fill("60")
    tab.click("A blank room of")
    solve = tab.root.get_by_role("button", name="Large building: solve it")
    assert tab.rows()["ND"][0] == "–"
    solve.click()
    tab.page.wait_for_function(
        "() => /ND −\\d/.test(document.querySelector('.ab-chart').textContent)"
    )
    tab.click("The source")  # while it solves
    tab.root.locator("details").first.locator("summary").click()
    tab.root.locator("textarea").fill("x")
    tab.settle()
    assert "Not legal yet" in tab.root.inner_text()
    assert tab.rows()["ND"][0] == "–"
    tab.root.locator("textarea").fill(SOURCE)
    assert_rungs_are_pythons(tab)
    assert tab.problems == []


# By keyboard; speed; looks

PLACES = """async (value) => {  // of the lowest rung of the source, till it rests
    const slider = document.querySelector(".ab-slider input");
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
    const places = new Set();
    for (let same = 0; same < 40; same++) {
        await new Promise(requestAnimationFrame);
        const names = [...document.querySelectorAll(".ab-chart text.ab-name")];
        const rung = names.find((name) => name.textContent.startsWith("wanderer −"));
        const y = rung?.getAttribute("y");
        if (!rung || places.has(y)) continue;
        places.add(y);
        same = 0;
    }
    return places.size;
}"""


def test_by_keyboard_alone_to_the_end(open_scene):
    tab = solved(ladder(open_scene, color_scheme="dark", reduced_motion="reduce"))
    page, focus = tab.page, "document.activeElement"
    cells = 0
    for _ in range(24):
        page.keyboard.press("Tab")
        if page.evaluate(f"{focus}.closest('.ab-bet') !== null"):
            page.keyboard.press("ArrowDown")
            tab.settle()
        if page.evaluate(f"{focus}.dataset.cell !== undefined"):
            cells += 1
            page.keyboard.press("1")
            page.keyboard.press("Shift+ArrowDown")
        if page.evaluate(f"{focus}.type === 'range'"):
            break
    solved(tab)
    changed = text_of(tab)

    assert cells == 1, "one tab stop in the grid"
    assert changed != SOURCE
    assert "moved most" in tab.closing
    assert_rungs_are_pythons(tab)
    assert tab.violations() == []
    assert tab.problems == []


@pytest.mark.parametrize("width", [1440, 400])
def test_names_of_rungs_never_overlap_and_nothing_is_cut(open_scene, width):
    still = {"reduced_motion": "reduce"}  # rungs jump
    tab = solved(bets(ladder(open_scene, width=width, **still)))
    for success in ("0.9", "0.5"):
        tab.root.get_by_role("slider", name="probability").fill(success)
        solved(tab)
        boxes = rungs(tab)
        frame = tab.root.locator(".ab-chart").bounding_box()
        assert len(boxes) == 12
        for i, (text, left, top, right, bottom) in enumerate(boxes):
            assert left >= frame["x"] - 1, text
            assert right <= frame["x"] + frame["width"] + 1, text
            for other, x0, y0, x1, y1 in boxes[:i]:
                clear = right <= x0 or x1 <= left or bottom <= y0 + 2 or y1 <= top + 2
                assert clear, (text, other)
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= width
    assert tab.small_controls() == []
    tab.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    tab.settle()
    assert tab.violations() == []
    assert tab.page.evaluate(PLACES, 0.9) <= 2, "no gliding where it is unwelcome"


def test_rungs_glide_and_a_move_paints_no_building(open_scene):
    tab = solved(bets(ladder(open_scene, reduced_motion="reduce")))
    moves = tab.writes_by_moves(".ab-slider input", 0.1)
    assert max(moves) < 500

    tab = solved(bets(ladder(open_scene)))
    assert tab.page.evaluate(PLACES, 0.5) > 3
    tab.page.goto("about:blank")
    assert tab.problems == []


# In Python


def test_python_reads_and_sets_the_source():
    scene = Ladder()
    assert repr(scene) == "Ladder()"
    assert scene.html() == Ladder().html()
    scene.source = "target"
    assert scene.text == str(read_map("target"))
    scene.text = SOURCE[:-3]
    assert scene.source == read_map("target"), "the last legal one"
    assert "rror" not in repr(scene)
    with pytest.raises(ValueError, match="together with text"):
        Ladder(source="source", text="x")


def test_the_still_picture_states_the_finding():
    still = Ladder().still()
    table = Ladder().table["target"]
    best = max(BUILDERS, key=table.get)

    assert len(still.frames) == 3
    more = 100 * (table[best] / table["optimal"] - 1)
    assert f"{NAMES[best]}, pays {more:.0f} % more than the best" in still.caption
    assert still.rows[1][2] == "\u221244.61"
    edited = Ladder(success=0.8).still()
    assert {row[2] for row in edited.rows} == {"–"}, "the paper's are not of this floor"
    assert len(re.findall("<path", edited.frames[-1])) < len(
        re.findall("<path", still.frames[-1])
    )


def test_a_wrong_address_does_no_harm(open_scene):
    tab = ladder(open_scene, query="#ladder.target=x&ladder.near=99&ladder.text=y")

    assert "Not legal yet" in tab.root.inner_text()
    assert tab.problems == []
