"""Paint by abstract state: what looks alike, and what forgetting costs."""

import re

import numpy as np
import pytest
from bs4 import BeautifulSoup
from buildings import tile_map
from scene_tab import bare, number
from traitlets import TraitError

from abstransfer import maps
from abstransfer.abstraction import FEATURES
from abstransfer.navigation import navigation_tasks
from abstransfer.scenes import Paint
from abstransfer.scenes.paint.counts import count_states

SMALL, LARGE = maps.read_map("source"), maps.read_map("target")
TWO_CELLS = "+---+\n|.d*|\n+---+"
COUNTS = {
    "abstract states in the small building": ("source", 1),
    "abstract states in the large one": ("target", 1),
    "of the large one's states look new": ("unseen", 100),
    "of the small one's states: in a conflict (no action suits all that look so)": (
        "torn",
        100,
    ),
    "of the small one's states: one action for each abstract state is right": (
        "right",
        100,
    ),
}


def building(tab, which):
    return tab.root.locator(".ab-building").nth(which)


def lit(tab, which):
    return (
        building(tab, which)
        .locator(".ab-lit")
        .evaluate_all("all => all.map(tile => Number(tile.dataset.cell))")
    )


def counted(tab):
    """Wait until all tasks are counted."""
    tab.page.wait_for_function(
        "() => document.querySelector('.ab-body > p').textContent.includes('of all')"
    )
    return tab


def bet(tab, few="about 90", new="one in a hundred"):
    tab.pick(re.compile("^Bet first"), few).pick(re.compile("^And of all"), new)
    tab.wait("occur in the small building and")
    return tab


def assert_counts(tab, features, source=SMALL, target=LARGE):
    rows, wanted = tab.rows(), count_states(source, target, tuple(features))
    for name, (key, scale) in COUNTS.items():
        found = number(rows[name][0].removesuffix(" %"))
        assert abs(found - scale * getattr(wanted, key)) < 1e-4, name


def states_of_all(map_, z, mask):
    tasks = navigation_tasks(map_)
    return int(((tasks.rho ^ z) & mask == 0)[~tasks.mdp.terminal].sum())


@pytest.fixture
def paint(show):
    return counted(show(bare(Paint)))


# Numbers


def test_what_is_lit_is_what_python_says(paint):
    scene = Paint()
    for task, away, z in ((0, 11, 530), (7, 3, 530), (4, 34, 17)):
        paint.go(f"#paint.task={task}&paint.away={away}&paint.z={z}")
        scene.set_trait("task", task)
        scene.away, scene.z = away, z

        assert lit(paint, 0) == scene.lit["source"]
        assert lit(paint, 1) == scene.lit["target"]
        assert f"{len(lit(paint, 0))} cell" in paint.words
        states = [states_of_all(map_, z, 2047) for map_ in (SMALL, LARGE)]
        assert f"{states[0]:,} states of all 11 tasks" in paint.words
        assert f"{states[1]:,} states of all 35 tasks" in paint.words
        assert max(states) > 0, "no such state: nothing compared"


def test_counts_by_features_are_those_of_python(paint):
    bet(paint)
    assert_counts(paint, FEATURES)
    assert "88 of 2,048 abstract states" in paint.closing
    assert paint.closing.count("right.") == 2

    choices = {"The 8 sights": FEATURES[:8], "No sights": FEATURES[8:], "None": ()}
    for name, features in choices.items():
        paint.click(name)
        assert_counts(paint, features)
    paint.click("All 11")
    for label in ("the goal is almost near", "in a room", "empty space away"):
        paint.root.get_by_role("checkbox", name=label).uncheck()
    kept = [f for i, f in enumerate(FEATURES) if i not in (4, 9, 10)]
    paint.settle()
    assert_counts(paint, kept)
    wanted = count_states(SMALL, LARGE, tuple(kept))
    assert f"With 8 features, {wanted.source} of 256" in paint.closing
    assert "With all 11 it was 88, 96, 0.9 %" in paint.closing
    assert paint.problems == []


LOOKS = """all => all.map(tile => {
    const [x, y] = ["x", "y"].map(name => tile.getAttribute(name));
    const place = `[transform="translate(${x} ${y})"]`;
    const pattern = tile.closest("svg").querySelector(`.ab-pattern${place}`);
    return tile.classList.contains("ab-classed")
        ? tile.style.getPropertyValue("--ab-hue") + pattern.getAttribute("d") : "plain";
})"""


def test_cells_are_painted_alike_iff_they_look_alike(paint):
    painted, rho = [], []
    for which, map_, task in ((0, SMALL, 0), (1, LARGE, 11), (0, SMALL, 9)):
        paint.root.get_by_role("slider").nth(which).fill(str(task))
        paint.settle()
        tasks = navigation_tasks(map_, keep=[task])
        painted += building(paint, which).locator(".ab-tile").evaluate_all(LOOKS)
        rho += np.where(tasks.mdp.terminal, -1, tasks.rho).tolist()

    pairs = set(zip(painted, rho, strict=True))
    assert len(pairs) == len(set(rho)) == len(set(painted)) > 60
    assert ("plain", -1) in pairs


# By mouse and by keyboard


def test_a_bet_comes_before_the_counts(paint):
    assert not paint.root.locator(".ab-bars").first.is_visible()
    assert paint.rows()["abstract states in the small building"] == ["–", "–"]
    paint.pick(re.compile("^Bet first"), "nearly all")
    assert paint.closing == ""
    paint.pick(re.compile("^And of all"), "one in ten")

    assert "it was “about 90”" in paint.closing
    assert "it was “one in a hundred”" in paint.closing
    new = building(paint, 1).locator(".ab-text:not([hidden])").count()
    task = navigation_tasks(LARGE, keep=[11])
    seen = navigation_tasks(SMALL)
    unknown = ~np.isin(task.rho, seen.rho[~seen.mdp.terminal]) & ~task.mdp.terminal
    assert new == unknown.sum() > 0


def test_by_mouse(paint):
    cell = building(paint, 1).locator('[data-cell="0"]')
    before = lit(paint, 0), lit(paint, 1)
    cell.hover()
    paint.settle()
    rho = navigation_tasks(LARGE, keep=[11]).rho
    assert lit(paint, 1) == np.flatnonzero(rho == rho[0]).tolist()
    assert lit(paint, 0) != before[0]
    paint.page.mouse.move(5, 5)
    paint.settle()
    assert (lit(paint, 0), lit(paint, 1)) == before, "what is kept is lit again"

    cell.click()
    paint.page.mouse.move(5, 5)
    paint.settle()
    assert lit(paint, 1) == np.flatnonzero(rho == rho[0]).tolist()
    goal = SMALL.goals[7]
    building(paint, 0).locator(f'[data-cell="{goal}"]').click()
    assert "task=7" in paint.url_with("task=7")
    assert building(paint, 0).locator(".ab-goal:not(.ab-othergoal)").count() == 1


def test_by_keyboard_alone(paint):
    building(paint, 0).locator('[tabindex="0"]').focus()
    paint.press("ArrowDown", "End", "ArrowLeft")
    assert paint.focused.startswith("row 2, column 14: the goal of another task; ")
    paint.press("Enter")
    assert paint.focused == "row 2, column 14: the goal"
    paint.press("ArrowRight")
    task = SMALL.goals.tolist().index(28)
    tasks = navigation_tasks(SMALL, keep=[task])
    alike = (tasks.rho == tasks.rho[29]) & ~tasks.mdp.terminal
    wanted = np.flatnonzero(alike).tolist()
    assert lit(paint, 0) == wanted, "the focus lights, as the pointer does"
    assert f"; {len(wanted)} cell" in paint.focused
    paint.press("Enter")
    stops = []
    for _ in range(20):
        paint.press("Tab")
        stops.append(paint.focused)
        kind = paint.page.evaluate("document.activeElement.type ?? ''")
        if kind == "radio":
            paint.press("Space")
    paint.wait("occur in the small building and")

    assert sum("row " in name for name in stops) == 1, "one tab stop in a grid"
    assert lit(paint, 0) == wanted
    assert not any("painted" in name for name in stops), "a picture is no tab stop"
    assert "88 of 2,048" in paint.closing
    assert paint.problems == []


# State


def test_ends_of_sliders_quick_changes_and_reset(paint):
    bet(paint)
    sliders = paint.root.get_by_role("slider").all()
    for slider in sliders:
        for value in ("min", "max"):
            slider.fill(slider.get_attribute(value))
            paint.settle()
    for name in ("None", "All 11", "No sights", "The 8 sights", "No sights"):
        paint.root.get_by_role("button", name=name).click()
    paint.settle()
    assert_counts(paint, FEATURES[8:])
    url = paint.url_with("features=1792")
    assert "task=10" in url
    assert "away=34" in url
    assert "bet" not in url

    moves = paint.writes_by_moves('[type="range"]', 1)
    assert max(moves) < 2 * SMALL.n_cells + LARGE.n_cells, "what is the same stays"
    paint.click("Reset")
    assert lit(paint, 0) == Paint().lit["source"]
    assert paint.closing == ""
    assert paint.problems == []


def test_the_scene_is_there_at_once_and_buttons_paint_each_cell_once(paint):
    bet(paint)
    n, left = paint.nodes_at_once("paint")
    buttons = "[...document.querySelectorAll('.ab-scene button')].slice(0, 4)"
    clicks = paint.writes(f"() => {buttons}.map((b) => () => b.click())")

    assert n > SMALL.n_cells + LARGE.n_cells
    assert left == 0
    assert len(clicks) == 4
    # A cell's own hue and class, its pattern, its mark.
    assert max(clicks) < 5 * (SMALL.n_cells + LARGE.n_cells)


@pytest.mark.parametrize("size", ["tiny", "huge"])
def test_other_buildings(show, size):
    if size == "tiny":
        scene = Paint(source=TWO_CELLS, map=TWO_CELLS, away=0)
    else:
        huge = tile_map(maps.read_map("source"), 6, 4)
        assert huge.n_cells >= 54 * 60
        scene = Paint(map=huge, source="source")
    html = bare(Paint, **{name: getattr(scene, name) for name in scene.changed})
    tab = show(html)
    tab.settle()
    assert tab.root.locator(".ab-building").count() == 2
    tab.page.get_by_role("slider", name="Goal of the small").fill("0")
    if size == "tiny":
        bet(counted(tab))
        assert_counts(tab, FEATURES, scene.source, scene.map)
    assert tab.problems == []


# Looks


def test_it_is_accessible(show):
    tab = bet(counted(show(bare(Paint), width=400)))
    tab.click("No sights").rows()

    assert tab.violations() == []
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert tab.small_controls() == []
    tile = building(tab, 1).locator(".ab-tile").first.bounding_box()
    assert tile["width"] >= 23.5, "wide enough for a finger"


def test_nothing_moves_by_itself(show):
    tab = counted(show(bare(Paint), reduced_motion="reduce"))
    assert len(tab.pictures(9)) == 1


# In Python


def test_features_go_by_names_in_python_and_by_bits_in_the_browser():
    scene = Paint(features=["in_room", "near_goal"])
    assert scene.features == ("near_goal", "in_room")
    assert scene.get_state()["features"] == 256 + 1024
    scene.set_state({"features": 3})  # as the browser does
    assert scene.features == FEATURES[:2]
    with pytest.raises(TraitError, match="names among"):
        scene.features = ["smell"]
    with pytest.raises(TraitError, match="names among"):
        scene.features = "in_room"


def test_the_still_picture_counts():
    soup = BeautifulSoup(Paint().html(), "html.parser")
    wanted = count_states(SMALL, LARGE, FEATURES)

    caption = soup.find("figcaption").get_text()
    assert f"{wanted.source} abstract states occur in the small building" in caption
    assert f"{wanted.unseen:.1%}" in caption
    assert len(soup.find_all("svg")) == 3
    rows = {row.td.get_text(): row for row in soup.find_all("tr") if row.td}
    assert rows["all 11"].find_all("td")[1].get_text() == str(wanted.source)
