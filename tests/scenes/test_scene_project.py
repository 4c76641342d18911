"""Your turn: races in any building, the card, by mouse and by keyboard."""

import re

import numpy as np
import pytest
from scene_tab import bare, number

from abstransfer.abstraction import FEATURES
from abstransfer.experiments.stats import t_interval
from abstransfer.maps import parse_map, read_map
from abstransfer.project.card import card_text, verify
from abstransfer.project.prediction import Prediction
from abstransfer.project.setup import GUIDES, Setup, drives, run, scale
from abstransfer.project.student import building_of, seed_of
from abstransfer.scenes import Project

SCHOOL = parse_map(Project().text)
NAMES = {"nd": "ND", "prob": "Prob", "grad": "Grad", "eager": "eager"}


def half_up(x):
    return int(np.floor(x + 0.5))


def project(open_page, query="", width=1440, color_scheme="light", **options):
    looks = {"width": width, "color_scheme": color_scheme}
    return open_page(bare(Project, **options), query, **looks)


def bet(tab, text="all of them"):
    tab.root.locator(".ab-bet").get_by_text(text, exact=True).click()
    return tab.settle()


def raced(tab):
    """Press the button, and wait for the verdict."""
    tab.root.get_by_role("button", name="Race").click()
    return finished(tab)


def finished(tab):
    tab.page.wait_for_function(
        "() => /A run without/.test(document.querySelector('.ab-closing').textContent)"
    )
    return tab.settle()


def card(tab):
    return tab.root.get_by_label("The result card as text").input_value()


def text_of(tab):
    return tab.root.get_by_label("The building as text").input_value()


def driven(tab):
    """Wait until all advice was tried as drivers."""
    tab.page.wait_for_function(
        "() => /abstract states/.test(document.querySelector('.ab-columns').innerText)"
    )
    return tab.settle()


# Numbers


def test_a_race_in_the_school_is_pythons_to_the_last_goal(open_scene):
    tab = driven(project(open_scene))
    button = tab.root.get_by_role("button", name="Race")
    assert button.is_disabled()
    assert tab.root.locator(".ab-bars li").count() == 6
    values = drives(Setup(SCHOOL))
    bars = tab.root.locator(".ab-bars li").all_inner_texts()
    shown = {line.split()[0]: number(line.split()[-1]) for line in bars}
    for name, label in NAMES.items():
        assert shown[label] == round(values[name], 1)
    assert shown["optimal"] == round(values["optimal"], 1)
    raced(bet(tab))
    goals = run(Setup(SCHOOL)).goals

    assert card(tab) == Project().card()
    for name in ("nd", "prob", "grad", "eager"):
        more = goals[name] - goals["none"]
        share = 100 * (goals[name].sum() / goals["none"].sum() - 1)
        n = max((more < 0).sum(), (more > 0).sum())
        word = "hurt" if share < 0 else "helped"
        sign = "" if share < 0 else "+"
        found = f"{NAMES[name]} {word} in {n} ({sign}{share:.1f} %)"
        assert found in tab.closing.replace("\u2212", "-")
        assert tab.rows()[name][3:] == [str(n) for n in goals[name]]
    better = [n for n in ("nd", "prob", "grad") if goals[n].sum() > goals["none"].sum()]
    assert better == [], "or the sentence of the bet is another one"
    assert "You bet on “all of them”; it was “none”." in tab.closing
    chart = tab.root.locator(".ab-chart").text_content().replace("\u2212", "-")
    for name in NAMES:
        more = t_interval(goals[name] - goals["none"])
        mean, low, high = (f"{half_up(x):+,}" for x in more)
        assert f"{NAMES[name]}{mean} [{low}, {high}]" in chart
    assert tab.problems == []


SETUPS = [
    Setup(SCHOOL, guides=("nd",), runs=1, student="Zoë Ångström"),
    Setup(SCHOOL, guides=("prob", "rand"), strategy="soft", runs=2),
    Setup(SCHOOL, FEATURES[:4] + FEATURES[9:], ("nd", "grad"), "own", runs=1),
    Setup(SCHOOL, (), ("nd", "eager"), "source", runs=1),
    Setup(parse_map("+-+-+-+\n|. .d*|\n+-+-+-+"), guides=("nd", "eager"), runs=3),
]


def widget_of(setup):
    parts = setup._asdict()
    parts["lives"] = parts.pop("runs")  # addresses keep the word
    lists = {name: list(parts[name]) for name in ("features", "guides")}
    return Project(**parts | lists)


@pytest.mark.parametrize("setup", SETUPS, ids=["named", "soft", "own", "blind", "tiny"])
def test_other_races_are_pythons_too(open_scene, setup):
    widget = widget_of(setup)
    tab = project(open_scene, **widget.changed)
    raced(bet(tab, "I do not bet: show me"))

    assert widget.setup == setup
    assert card(tab) == card_text(setup, run(setup).goals, prediction=Prediction(1))
    assert verify(card(tab))[0].setup == setup
    assert "You bet" not in tab.closing
    assert tab.problems == []


def test_more_runs_are_added_and_another_building_begins_anew(open_scene):
    tab = raced(bet(project(open_scene, guides=["nd"], lives=2)))
    first = tab.rows()["nd"][3:]
    tab.root.get_by_role("slider", name="Runs").fill("3")
    tab.settle()
    raced(tab)
    assert tab.rows()["nd"][3:5] == first
    third = run(Setup(SCHOOL, guides=("nd",), runs=3)).goals["nd"][2]
    assert tab.rows()["nd"][5] == str(third)

    tab.pick("Tool", "Door").click_cell(2 * 9 + 4, y=0.98)
    assert text_of(tab) != str(SCHOOL)
    assert tab.rows()["nd"][1:] == [""] * 5
    raced(driven(tab))
    assert verify(card(tab))[0].setup.map == parse_map(text_of(tab))
    assert "You bet" not in tab.closing, "the bet was on the school"
    tab.click("Undo")
    assert text_of(tab) == str(SCHOOL)
    assert tab.problems == []


def test_a_large_building_waits_to_be_asked_and_stops(open_scene):
    tab = bet(project(open_scene, guides=["eager"], lives=1))
    for name in ("Rows", "Columns"):
        tab.root.get_by_role("spinbutton", name=name).fill("60")
    tab.click("A blank room of")
    assert "solved when the race begins" in tab.root.inner_text()
    tab.click("Race")
    tab.page.wait_for_function("() => document.body.innerText.includes('Racing:')")
    tab.click("Stop")
    assert not tab.closing
    tab.page.goto("about:blank")
    assert tab.problems == []


def test_a_stopped_race_keeps_what_was_learned_and_goes_on(open_scene):
    tab = bet(project(open_scene, text=str(read_map("source")), lives=20))
    driven(tab).click("Race")
    tab.page.wait_for_function("() => /Racing: [1-9]/.test(document.body.innerText)")
    tab.click("Stop")
    assert tab.is_idle()
    told = r"Done: (\d+) % of 100 runs. It can go on."
    before = int(re.search(told, tab.root.inner_text())[1])
    assert before > 0
    tab.click("Go on with the race")
    tab.click("Stop")
    assert int(re.search(told, tab.root.inner_text())[1]) >= before
    assert not tab.closing
    tab.pick("Advice", "soft: ever less often")
    assert "Done:" not in tab.root.inner_text(), "another race"
    assert tab.problems == []


def test_leaving_and_quick_changes_while_it_races(open_scene):
    tab = bet(project(open_scene, text=str(read_map("source")), lives=20))
    driven(tab).click("Race")
    tab.page.wait_for_function("() => document.body.innerText.includes('Racing:')")
    for text in ("soft: ever less often", "hard: obey to the letter") * 2:
        tab.pick("Advice", text)
    assert "Racing" not in tab.root.inner_text()
    assert tab.is_idle()
    tab.click("Race")
    tab.page.wait_for_function("() => document.body.innerText.includes('Racing:')")
    tab.page.goto("about:blank")

    assert tab.problems == []


# Whose race it is, and what is predicted


def predict(tab, robot="ND", direction="fewer goals", percent=3):
    tab.root.get_by_label("Robot").select_option(robot)
    tab.root.get_by_label("Compared with none").select_option(direction)
    tab.root.get_by_label("Refuted, in percent").fill(str(percent))
    tab.root.get_by_label("Refuted, in percent").press("Tab")
    return tab.settle()


FORECAST = ("Robot", "Compared with none", "Refuted, in percent")


def is_closed(tab):
    (is_all,) = {tab.root.get_by_label(name).is_disabled() for name in FORECAST}
    return is_all


def test_a_prediction_is_sealed_when_the_race_begins_and_told_on_the_card(open_scene):
    tab = bet(driven(project(open_scene, guides=["nd"], lives=2)))
    predict(tab)
    assert not is_closed(tab)
    tab.click("Race")
    assert is_closed(tab)
    finished(tab)
    goals = run(Setup(SCHOOL, guides=("nd",), runs=2)).goals
    sealed = Prediction(1, "nd", "-", 3)
    found = sealed.compare(goals)

    assert is_closed(tab)
    assert f"Sealed before race 1: {sealed.line()[-8:]}." in tab.root.inner_text()
    assert f"Your prediction: {found}." in tab.closing
    assert f"- Prediction: {sealed.line()}\n- Found: {found}\n" in card(tab)
    assert verify(card(tab))[0].prediction == sealed
    tab.root.get_by_role("slider", name="Runs").fill("3")
    raced(tab.settle())
    assert verify(card(tab))[0].prediction == sealed, "the same race, one run more"
    assert tab.problems == []


def test_each_race_is_counted_and_a_reset_or_a_new_visit_forgets_none(open_scene):
    tab = raced(bet(driven(project(open_scene, guides=["nd"], lives=1))))
    tab.pick("Advice", "soft: ever less often")
    assert not is_closed(tab), "another race"
    raced(tab)
    assert verify(card(tab))[0].prediction == Prediction(2)
    tab.click("Reset")
    assert not is_closed(tab)
    tab.page.reload()
    tab.page.wait_for_selector(".ab-live")
    raced(bet(driven(tab)))
    assert verify(card(tab))[0].prediction == Prediction(3)
    assert tab.problems == []


def test_a_name_gives_a_seed_and_a_building_of_ones_own(open_scene):
    tab = project(open_scene)
    mine = tab.root.get_by_role("button", name="My building")
    assert mine.get_attribute("aria-disabled") == "true"
    tab.root.get_by_label("Your name").fill("  Zoë  Ångström ")
    tab.page.evaluate("dispatchEvent(new Event('hashchange'))")  # all is drawn anew
    tab.settle()
    tab.press("Tab")
    assert f"Seed {seed_of('Zoë Ångström')}" in tab.root.inner_text()
    mine.click()
    tab.settle()

    assert text_of(tab) == str(building_of("Zoë Ångström"))
    assert tab.problems == []


# By keyboard; looks


def test_by_keyboard_alone_to_the_card(open_scene):
    tab = driven(project(open_scene, lives=1))
    page, focus = tab.page, "document.activeElement"
    cells, words = 0, ""
    for _ in range(60):
        page.keyboard.press("Tab")
        words = page.evaluate(f"{focus}.innerText ?? ''")
        kind = page.evaluate(f"{focus}.type ?? ''")
        if page.evaluate(f"{focus}.closest('.ab-bet') !== null"):
            page.keyboard.press("ArrowDown")
        if page.evaluate(f"{focus}.dataset.cell !== undefined"):
            cells += 1
            page.keyboard.press("1")
            page.keyboard.press("Shift+ArrowDown")
        if words.startswith("What the robots see"):
            page.keyboard.press("Enter")
        if kind == "checkbox":
            label = page.evaluate(f"{focus}.closest('label').innerText")
            if label == "in a room":
                page.keyboard.press("Space")
        if words.startswith("Race"):
            page.keyboard.press("Enter")
            break
        tab.settle()
    finished(tab)
    again = verify(card(tab))[0].setup

    assert cells == 1, "one tab stop in the grid"
    assert again.features == FEATURES[:-1]
    assert again.map != SCHOOL
    assert page.evaluate(f"{focus}.innerText").startswith("Race")
    assert tab.problems == []


@pytest.mark.parametrize(("width", "color"), [(1440, "light"), (400, "dark")])
def test_it_is_accessible_and_fits(open_scene, width, color):
    tab = driven(project(open_scene, width=width, color_scheme=color, lives=1))
    if color == "dark":
        tab.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    tab.root.get_by_text("What the robots see").click()
    raced(bet(tab)).rows()
    tab.root.get_by_text("The building as text").click()
    area = tab.root.get_by_label("The result card as text").bounding_box()

    assert area["width"] > 0.8 * tab.root.bounding_box()["width"]
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= width
    assert tab.small_controls() == []
    assert tab.violations() == []
    with tab.page.expect_download() as download:
        tab.root.get_by_role("button", name="Save as a file").last.click()
    assert verify(download.value.path().read_text(encoding="utf-8"))[0].setup == Setup(
        SCHOOL, runs=1
    )


def test_an_address_a_reset_and_how_much_a_move_paints(open_scene):
    query = "#project.features=5&project.guides=[&project.lives=99&project.advice=x"
    tab = driven(project(open_scene, query))
    tab.root.get_by_text("What the robots see").click()
    tab.root.get_by_label("in a room").uncheck()
    assert "in_room" not in tab.url_with("features=%5B")
    moves = driven(tab).writes_by_moves(".ab-slider input", 2)
    tab.click("Reset")

    assert max(moves) < 40, "the building stays"
    assert tab.root.get_by_label("in a room").is_checked()
    assert tab.root.get_by_role("slider", name="Runs").input_value() == "5"
    assert tab.problems == []


# In Python


def test_runs_are_as_long_as_on_the_page():
    assert scale(SCHOOL) == (600_000, 70_000)
    assert scale(read_map("target")) == (30_000_000, 3_500_000)
    steps, tau = scale(parse_map("+---+\n|.d*|\n+---+"))
    assert 0 < tau < steps


def test_the_still_picture_and_the_traits():
    scene = Project()
    still = scene.still()
    goals = scene.run().goals

    assert repr(scene) == "Project()"
    assert f"reaches {goals['none'].mean():,.0f} goals" in still.caption
    assert len(still.frames) == 3
    assert set(GUIDES) >= set(scene.guides)
    scene.map = "source"
    assert scene.text == str(read_map("source"))
    scene.text = "x"
    assert scene.map == read_map("source")
    with pytest.raises(ValueError, match="together with text"):
        Project(map="source", text="x")
