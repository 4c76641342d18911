"""What a lecturer asks of a scene by its address: hidden controls, and the wall."""

import pytest
from scene_tab import bare, quick

from abstransfer.scenes import KINDS, Race, TauSlider

BOX = '<p class="asks-race-bet" id="bet-0" data-bet="{bet}">The bet</p>'
PLACED = """(bet) => {
    const box = document.getElementById("bet-0");
    box.dataset.bet = bet;
    box.dispatchEvent(new Event("abstransfer:bet"));
}"""
HEARD = """() => {
    window.heard = [];
    const box = document.getElementById("bet-0");
    box.addEventListener("abstransfer:place", ({ detail }) => {
        heard.push(detail);
        box.dataset.bet = detail;
    });
}"""


@pytest.fixture
def tau(open_scene):
    """Open the scene of page 8 at an address; without a run that takes its time."""

    def at(query):
        return open_scene(bare(TauSlider, tau=0, steps=600_000), query=query)

    return at


def test_an_address_hides_controls(tau):
    tab = tau("#tau.hide=luck,guide")

    assert not tab.root.get_by_label("Luck").is_visible()
    assert tab.root.locator("fieldset:visible").count() == 1, "the bet stays"
    assert tab.root.get_by_role("slider").first.is_visible()
    assert not tab.root.locator(".ab-now").first.is_visible()
    tab.go("")
    assert tab.root.get_by_label("Luck").is_visible()


# What steers each scene, by the names that an address may hide.
PARTS = """(names) => Object.fromEntries(names.map((name) => {
    const div = document.body.appendChild(document.createElement("div"));
    const { scene, leave } = said[name].mount(div, {}, { url: false });
    leave();
    div.remove();
    return [name, Object.keys(scene.parts)];
}))"""


def test_every_control_of_every_scene_can_be_hidden(open_scene):
    tab = open_scene("".join(map(quick, KINDS)))
    parts = tab.page.evaluate(PARTS, list(KINDS))
    assert all(parts.values())
    wanted = (f"{name}.hide={','.join(names)}" for name, names in parts.items())
    tab.go(f"#{'&'.join(wanted)}")

    assert tab.root.locator(".ab-now", has_text="cannot hide").count() == 0
    steers = tab.root.locator(".ab-body :is(.ab-slider, .ab-timeline)")
    assert steers.count() > len(KINDS)
    assert steers.locator("visible=true").count() == 0
    assert tab.problems == []


def test_unknown_names_are_refused_in_a_sentence(tau):
    tab = tau("#tau.hide=q0,luck&tau.epsilon=1")
    said = tab.root.locator(".ab-now").first.inner_text()

    assert "“epsilon”, which this scene does not know: it has" in said
    assert "It cannot hide “q0”: its controls are" in said
    assert not tab.root.get_by_label("Luck").is_visible(), "the rest is done"


def test_a_scene_fills_the_wall_and_comes_back(tau):
    tab = tau("#tau.wall=1")
    heading = tab.page.locator("h1")
    box = tab.root.bounding_box()

    assert (box["x"], box["y"], box["width"], box["height"]) == (0, 0, 1440, 900)
    assert tab.page.evaluate("document.querySelector('h1').inert")
    tab.root.get_by_role("button", name="Back to the page").focus()
    tab.press("Escape")
    assert tab.root.bounding_box()["width"] < 1440
    assert not heading.evaluate("h => h.inert")
    tab.click("Enlarge")
    assert tab.root.bounding_box()["width"] == 1440
    assert tab.violations() == []
    tab.click("Back to the page")
    assert tab.root.bounding_box()["width"] < 1440
    assert tab.problems == []


def test_a_bet_that_the_page_asks_is_the_scenes(open_scene):
    tab = open_scene(BOX.format(bet="") + bare(Race))
    line = tab.root.locator(".ab-bet")
    button = tab.root.get_by_role("button", name="All 30 million steps")

    assert tab.root.locator(".ab-bet input").count() == 0, "it does not ask again"
    assert line.inner_text().endswith("Bet above")
    assert not button.is_visible()
    tab.page.evaluate(HEARD)
    tab.page.evaluate(PLACED, "2")
    tab.settle()
    assert line.inner_text() == "You bet on “Prob”. Change"
    assert button.is_visible()
    tab.click("Reset")
    assert tab.page.evaluate("heard") == [""], "the page hears of the reset"
    assert line.inner_text().endswith("Bet above")
    tab.page.evaluate(PLACED, "skip")
    tab.settle()
    assert line.inner_text() == "You did not bet. Change"
    assert tab.violations() == []
    assert tab.problems == []


def test_a_bet_that_was_placed_before_the_scene_lives_is_there(open_scene):
    tab = open_scene(BOX.format(bet="3") + bare(Race))

    assert tab.root.locator(".ab-bet").inner_text() == "You bet on “ND”. Change"
