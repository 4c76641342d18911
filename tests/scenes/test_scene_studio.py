"""Map Studio: by mouse and by keyboard, and beside Python."""

import re

import pytest
import traitlets
from buildings import tile_map
from golden.foreign_texts import LARGER_CELLS, NAMED
from scene_tab import bare, number

from abstransfer.abstraction import LABELS
from abstransfer.builders import abstract_policies
from abstransfer.driving import PAPER, ROWS, column
from abstransfer.maps import parse_map, read_map
from abstransfer.navigation import navigation_tasks
from abstransfer.scenes import Studio

SOURCE = str(read_map("source"))
NAMES = dict(zip(ROWS, ("wanderer", "ND", "Prob", "Grad", "optimal"), strict=True))
CORRIDOR = 5 * 15 + 8  # a cell


@pytest.fixture
def studio(open_scene):
    return open_scene(bare(Studio))


def solved(tab):
    """Wait until Grad is at the top; return the table of numbers."""
    tab.page.wait_for_function(
        "() => !document.querySelector('.ab-bars').textContent.includes('climbing')"
        " && /Grad −\\d/.test(document.querySelector('.ab-bars').innerText"
        ".replace(/\\s+/g, ' '))"
    )
    return tab.rows()


def legal(tab):
    return tab.root.locator(".ab-view + p").inner_text()


def text_of(tab):
    return tab.root.locator("textarea").input_value()


def write(tab, text):
    """Type a text into the field, as one change."""
    details = tab.root.locator("details").first
    if details.get_attribute("open") is None:
        details.locator("summary").click()
    tab.root.locator("textarea").fill(text)
    return tab.settle()


# Numbers


def test_table_1_of_an_edited_map_is_pythons(studio):
    solved(studio)  # what the edit is compared with
    studio.pick("Tool", "Door").click_cell(17, x=0.98)
    text = text_of(studio)
    rows = solved(studio)
    tasks = navigation_tasks(parse_map(text))
    wanted = column(tasks, abstract_policies(tasks))

    assert text != SOURCE
    for row in ROWS:
        assert abs(number(rows[NAMES[row]][0]) - wanted[row]) < 1e-9
    for what in ("cells", "rooms", "goals"):
        assert number(rows[what][0]) == wanted[what]
    assert number(rows["abstract states"][0]) == wanted["abstract_states"]
    assert number(rows["doors"][0]) == 12
    assert wanted["optimal"] > -14.0039, "a door more is no harm"
    assert "What moved most: " in studio.closing
    assert studio.problems == []


def test_the_papers_counts_and_numbers_are_marked(studio):
    rows = solved(studio)
    for building, counts in studio.ask("probe.PAPER").items():
        for row in ROWS:
            assert counts[row] == PAPER[building][row]
    mark = studio.root.get_by_text("Cells, rooms and goals as in the paper's source")

    assert rows["ND"][1] == "\u221244.61"
    assert mark.is_visible()
    studio.pick("Tool", "Goal").click_cell(0)
    assert mark.count() == 0
    studio.click("The target")
    assert studio.root.get_by_text(
        "Cells, rooms and goals as in the paper's target"
    ).is_visible()


def test_what_a_cell_says_is_the_mdp(studio):
    tasks = navigation_tasks(read_map("source"), keep=[7])
    for cell in (CORRIDOR, 0, 34, 16):
        assert_cell_says_the_mdp(studio, tasks, cell)


def assert_cell_says_the_mdp(studio, tasks, cell):
    studio.cell(cell).hover()
    studio.settle()
    lines = [
        [td.inner_text() for td in line.locator("td").all()]
        for line in studio.root.locator(".ab-columns tbody tr").all()
    ]
    found = {}
    for name, place, chance, reward in lines[:-1]:
        row, col = divmod(cell, 15)
        if place != "here":
            row, col = (int(n) - 1 for n in re.findall(r"\d+", place))
        found[name.replace(" ", "_"), row * 15 + col] = float(chance), number(reward)
    wanted = {}
    for a, action in enumerate(tasks.actions):
        if not tasks.available[cell, a]:
            continue
        for s, p in zip(tasks.mdp.next_state[cell, a], tasks.mdp.prob[cell, a]):  # noqa: B905
            if p:
                old = wanted.get((action, int(s)), (0, 0))[0]
                wanted[action, int(s)] = round(old + p, 2), float(tasks.mdp.reward[s])

    assert found == wanted
    assert lines[-1][0] == "any other"


# What is legal


def drawn(changes):
    """Return the source with characters at (row, column) changed."""
    lines = [list(line) for line in SOURCE.split("\n")]
    for (row, col), char in changes.items():
        lines[row][col] = char
    return "\n".join("".join(line) for line in lines)


BROKEN = {
    "room open": drawn({(6, 15): " "}),
    "unreachable": drawn({(9, 6): "|", (6, 3): "-", (12, 3): "-"}),
    "no goal": SOURCE.replace("*", " "),
    "goal outside": drawn({(9, 9): "*"}),
    "door in a room": drawn({(1, 2): "d"}),
    "unknown": SOURCE.replace("*", "x", 1),
    "short line": SOURCE.replace("|\n", "\n", 1),
    "hole": drawn({(0, 1): " "}),
    "empty": "",
    "another format": NAMED["a MovingAI map"][0],
    "fenced": "```\n" + drawn({(9, 9): "*"}) + "\n```",
}


def test_an_illegal_drawing_is_refused_in_pythons_words(studio):
    seen = set()
    for text in BROKEN.values():
        write(studio, text)
        problem = Studio(text=text).problem
        seen.add(problem)

        assert problem
        assert legal(studio).startswith(f"Not legal yet: {problem}.")
        assert "–" in studio.root.locator(".ab-bars").inner_text()
    assert len(seen) == len(BROKEN)
    write(studio, BROKEN["goal outside"])
    assert legal(studio).endswith("(Of the text; as a cell: row 5, column 5.)")
    write(studio, SOURCE)
    assert legal(studio) == "A legal building."
    assert solved(studio)["ND"][0].startswith("\u221244.05")
    assert studio.problems == []


def test_a_maze_of_somebody_else_is_pasted_and_solved(studio):
    text, meant = LARGER_CELLS["goal at the side"]
    write(studio, text)

    assert legal(studio) == "A legal building."
    assert studio.page.locator("[data-cell]").count() == 2 * 3
    optimal = column(navigation_tasks(parse_map(meant)), {})["optimal"]
    assert number(solved(studio)["optimal"][0]) == pytest.approx(optimal)


# By keyboard, by mouse

ARROWS = ("ArrowUp", "ArrowRight", "ArrowDown", "ArrowLeft")
WAY = """() => {  // the best way from the cell that has the focus
    const name = document.activeElement.getAttribute("aria-label");
    const [row, column] = name.match(/\\d+/g).map(Number);
    const map = probe.parseMap(probe.mapTexts.source);
    const tasks = probe.navigationTasks(map, { keep: [7] });
    const v = probe.optimalValues(tasks);
    const cell = (row - 1) * map.width + column - 1;
    const ways = [0, 1, 2, 3].map((d) => map.neighbors[4 * cell + d]);
    return probe.argmax(ways.map((other) => (other < 0 ? -1e9 : v[other])));
}"""


def test_by_keyboard_alone_to_the_goal_and_a_new_door(studio):
    studio.root.get_by_role("radio", name="Walk").focus()
    for _ in range(6):
        studio.press("Tab")
        if "row " in studio.focused:
            break
    closing = studio.root.locator(".ab-closing")
    for _ in range(100):
        if closing.inner_text().startswith("The goal, after"):
            break
        studio.press(ARROWS[studio.ask(WAY)])
    closing = studio.closing
    studio.press("3", "Shift+ArrowRight")

    said = re.match(r"The goal, after (\d+) steps: a return of −(\d+\.\d\d)\.", closing)
    paid = 100 * (1 - 0.99 ** int(said[1]))  # where it stood, and where it passed
    assert said[2] == f"{paid:.2f}"
    assert studio.root.get_by_role("radio", name="Door").is_checked()
    assert text_of(studio) != SOURCE
    assert "door east" in studio.focused
    studio.press("Control+z")
    assert text_of(studio) == SOURCE
    studio.press("Control+y")
    assert text_of(studio) != SOURCE
    assert studio.problems == []


def test_a_room_is_painted_by_dragging(studio):
    studio.pick("Tool", "Corridor")
    start, end = (studio.cell(n).bounding_box() for n in (0, 2))
    mouse = studio.page.mouse
    mouse.move(start["x"] + 9, start["y"] + 9)
    mouse.down()
    mouse.move(end["x"] + 9, end["y"] + 9, steps=8)
    mouse.up()
    studio.settle()
    drawn = text_of(studio).split("\n")

    assert drawn[1].startswith("|. . .|")
    for _ in range(3):
        studio.click("Undo")
    assert text_of(studio) == SOURCE
    assert studio.root.get_by_role("button", name="Undo").is_visible()


def test_tools_of_the_mouse(studio):
    studio.click_cell(CORRIDOR - 2).click_cell(CORRIDOR - 1)
    assert "Step 1: (s, a, s′, r)" in studio.root.inner_text()
    studio.click_cell(int(read_map("source").goals[2]))
    assert "task 3" in studio.root.inner_text()
    studio.pick("Tool", "Wall").click_cell(CORRIDOR, y=0.05)
    assert text_of(studio).count("-") == SOURCE.count("-") + 1
    studio.click_cell(CORRIDOR, y=0.05)
    assert text_of(studio) == SOURCE
    before = text_of(studio)
    studio.click_cell(0, x=0.02)
    assert text_of(studio) == before, "the outer wall stays"


def test_layers_lie_over_the_cells(studio):
    solved(studio)
    patterns = studio.root.locator(".ab-pattern:not([hidden])")
    arrows = studio.root.locator(".ab-arrow:not([hidden])")
    studio.pick("In the cells", "abstract states")
    assert patterns.count() > 100
    for advice in ("ND", "Prob", "Grad", "optimal"):
        studio.pick("In the cells", "the building")
        assert patterns.count() == arrows.count() == 0
        studio.pick("In the cells", advice)
        assert arrows.count() > 100, advice
    assert studio.problems == []


# Buildings of all sizes


def test_a_small_and_a_large_building(studio):
    rows = studio.root.get_by_role("spinbutton", name="Rows")
    columns = studio.root.get_by_role("spinbutton", name="Columns")
    rows.fill("3")
    columns.fill("3")
    studio.click("A blank room of")
    found = solved(studio)
    map_ = parse_map(text_of(studio))
    tasks = navigation_tasks(map_)
    wanted = column(tasks, abstract_policies(tasks))
    assert map_.shape == (3, 3)
    for row in ROWS:
        assert abs(number(found[NAMES[row]][0]) - wanted[row]) < 1e-9

    rows.fill("60")
    columns.fill("99")
    studio.click("A blank room of")
    assert parse_map(text_of(studio)).shape == (60, 60)
    solve = studio.root.get_by_role("button", name="Large building: solve it")
    assert solve.is_visible()
    assert studio.rows()["Prob"][0] == "–"
    studio.click_cell(0)
    solve.click()
    studio.page.wait_for_function(
        "() => /Prob\\s*−\\d/.test(document.querySelector('.ab-bars').innerText)"
    )
    studio.click("The source")
    assert solved(studio)["Prob"][0].startswith("\u221236.24")
    assert studio.problems == []


def test_the_page_stays_free_while_grad_climbs(studio):
    studio.click("The target")
    pictures = "n => new Promise(f => (function next() {"
    pictures += " n-- ? requestAnimationFrame(next) : f() })())"
    studio.page.evaluate(pictures, 30)

    assert "climbing" in studio.root.locator(".ab-bars").inner_text()
    studio.click("The source")
    assert solved(studio)["Grad"][0].startswith("\u221230.30")


# State


def test_a_drawing_has_an_address(open_scene):
    first = open_scene(bare(Studio))
    first.pick("Tool", "Goal").click_cell(1).pick("In the cells", "optimal")
    query = first.url_with("show=optimal")
    second = open_scene(bare(Studio), query=query)

    assert text_of(second) == text_of(first) != SOURCE
    assert second.root.get_by_role("radio", name="optimal").first.is_checked()
    second.click("Reset")
    assert text_of(second) == SOURCE
    second.click("Undo")
    assert text_of(second) == text_of(first), "a reset can be undone"


@pytest.mark.parametrize(
    "query",
    ["#studio.text=x", "#studio.task=99", "#studio.start=-4", "#studio.walk=NOPE"],
)
def test_a_wrong_address_does_no_harm(open_scene, query):
    tab = open_scene(bare(Studio), query=query)

    assert len(tab.grid.locator("[data-cell]").all()) == 135
    assert tab.problems == []


def test_quick_changes_and_leaving_while_it_solves(studio):
    studio.page.evaluate(
        """() => {
            for (const cell of [0, 1, 2, 15, 16]) {
                document.querySelector(`input[value=goal]`).click();
                const tile = document.querySelector(`[data-cell="${cell}"]`);
                tile.dispatchEvent(new MouseEvent("click", { bubbles: true }));
            }
        }"""
    )
    studio.settle()
    assert len(parse_map(text_of(studio)).goals) == 11 + 4 - 1
    studio.click("The target")
    studio.page.goto("about:blank")
    assert studio.problems == []


def test_text_comes_in_and_goes_out(studio):
    building = tile_map(read_map("source"), 1, 2)
    write(studio, f"\n\n{building}\n")
    assert "22 rooms" in studio.root.inner_text()
    with studio.page.expect_download() as download:
        studio.click("Save as a file")
    assert download.value.path().read_text(encoding="utf-8").strip() == str(building)
    studio.click("Copy")
    assert studio.problems == []


# Looks


def test_it_is_accessible(open_scene):
    tab = open_scene(bare(Studio))
    solved(tab)
    write(tab, BROKEN["room open"])
    assert tab.violations() == []
    write(tab, SOURCE)
    assert tab.violations() == []


def test_on_a_phone(open_scene):
    tab = open_scene(bare(Studio), width=400, has_touch=True)
    tab.root.locator("details").first.locator("summary").tap()
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert tab.small_controls() == []
    tab.pick("Tool", "Room")
    tab.cell(CORRIDOR).tap()
    tab.settle()

    assert text_of(tab) != SOURCE
    assert tab.problems == []


# In Python


def test_python_reads_the_drawing_and_draws():
    scene = Studio()
    seen = []
    scene.observe(lambda change: seen.append(change.new), "map")
    scene.text = BROKEN["room open"]
    assert scene.problem.startswith("row 7, column ")
    assert str(scene.map) == SOURCE
    scene.text = str(read_map("target"))
    assert scene.problem == ""
    assert seen == [read_map("target")]
    scene.map = "source"
    assert scene.text == SOURCE
    with pytest.raises(ValueError, match="border has a hole"):
        scene.map = "+---+\n|  *|\n+-- +"
    with pytest.raises(ValueError, match="together with text"):
        Studio(map="source", text="x")
    with pytest.raises(traitlets.TraitError):
        scene.tool = "hammer"


def test_a_robot_says_a_label_and_chance_takes_the_way(studio):
    studio.go("#studio.start=51&studio.walk=")
    assert studio.root.get_by_text("The robot waits").first.is_visible()
    button = studio.root.locator("tbody button").first
    name = button.inner_text()
    button.focus()
    studio.press("Enter")

    assert f"Step 1: (s, a, s\u2032, r) = ((4, 7), {name}, " in studio.root.inner_text()
    assert studio.page.evaluate("document.activeElement.closest('table') !== null")
    assert LABELS[0].replace("_", " ") == name
    assert studio.url_with("studio.walk=0")
    assert studio.problems == []
