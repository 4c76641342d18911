"""The scene of the intro: sights and advice equal Python's; one button starts it."""

import re

import pytest
from scene_tab import CLOCK

from abstransfer.scenes import Sights


def shown(tab):
    """Return what the scene's table tells: chances by direction."""
    return {way: chance for way, (_, chance) in tab.rows().items()}


@pytest.mark.parametrize("size", ["small", "large"])
def test_sights_and_advice_are_pythons(open_scene, size):
    scene = Sights(size=size, cell=78, task=3)
    tab = open_scene(scene)
    ways = {"N": "north", "E": "east", "S": "south", "W": "west"}

    wanted = {
        ways[way]: f"{100 * share:.0f} %"
        for way, share in zip("NESW", scene.arrows[78], strict=True)
        if way in scene.seen
    }
    assert shown(tab) == wanted
    assert tab.violations() == []
    assert tab.problems == []


def test_one_button_lets_the_robot_walk_to_its_goal(open_scene):
    tab = open_scene(Sights())
    tab.click("Start")
    tab.page.wait_for_function(
        "document.querySelector('.ab-closing').textContent.includes('after')"
    )

    assert tab.closing.startswith("The goal of the small building, after ")
    tab.root.get_by_role("button", name="Start").wait_for()
    assert int(re.search(r"after (\d+) steps", tab.closing)[1]) >= 5
    assert "sights.t=" in tab.url_with("t=")


def test_the_same_sheet_is_drawn_in_the_large_building_or_not_at_all(open_scene):
    tab = open_scene(Sights())
    tab.pick("Building", "the large one")

    assert len(tab.root.locator("[data-cell]").all()) == 540
    assert tab.root.locator(".ab-arrow:not([hidden])").count() > 500
    tab.root.get_by_label("Show the advice").uncheck()
    tab.settle()
    assert tab.root.locator(".ab-arrow:not([hidden])").count() == 0
    assert "the advice" not in tab.root.locator("li").first.inner_text()
    tab.click_cell(32)
    assert "row 2, column 3" in tab.root.inner_text()
    assert tab.problems == []


def test_what_is_no_longer_so_is_not_said_any_more(open_scene):
    tab = open_scene(Sights())
    tab.click("Start")
    said = "document.querySelector('.ab-said').textContent"
    tab.page.wait_for_function(f"{said}.startsWith('The goal of the small building')")
    tab.pick("Building", "the large one")

    assert "small building" not in tab.page.evaluate(said)


def test_a_robot_that_walks_stands_still_after_a_reset(open_scene):
    tab = open_scene(Sights())
    tab.page.evaluate(CLOCK)
    tab.click("Start")
    tab.page.evaluate("pass(700)")
    assert "row 8, column 1 " not in tab.settle().root.inner_text()
    tab.click("Reset")
    tab.page.evaluate("pass(2000)")

    assert "From row 8, column 1 the robot sees" in tab.settle().root.inner_text()
    assert tab.root.get_by_role("button", name="Start").is_visible()


def test_without_the_advice_no_robot_obeys_it_and_no_table_tells_it(open_scene):
    tab = open_scene(Sights(advice=False, cell=78))
    start = tab.root.get_by_role("button", name="Start")

    assert tab.rows() == {
        "north": ["a door further on towards the goal"],
        "east": ["empty space away from the goal"],
    }
    assert not start.is_visible()
    tab.root.get_by_label("Show the advice").check()
    tab.settle()
    assert start.is_visible()
    assert tab.rows()["north"][1] == "100 %"


def test_unseen_views_and_goals_have_an_answer():
    scene = Sights(size="large", task=11)
    arrows = scene.arrows
    live = ~scene.tasks.mdp.terminal

    assert arrows[live].sum(axis=1) == pytest.approx(1)
    assert (arrows[~live] == 0).all()
