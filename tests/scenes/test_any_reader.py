"""What holds in all scenes for any reader: by ear, finger, keyboard, in contrast."""

import pytest
from scene_tab import bare

from abstransfer.scenes import KINDS

PLAYS = ["race", "ripple", "microscope", "hill"]
# Waits of a scene go on only when the test says so: `pass()`.
WAITING = """
const real = window.setTimeout;
const waiting = [];
window.setTimeout = (act, wait = 0, ...rest) =>
    wait < 50 ? real(act, wait, ...rest) : 1e6 + waiting.push(() => act(...rest));
window.pass = () => waiting.splice(0).forEach((act) => act());
"""
# How often what is live by itself is written in a number of steps, and after them.
HEARD = """async (n) => {
    let written = 0;
    const all = { childList: true, characterData: true, subtree: true };
    const observer = new MutationObserver(() => written++);
    const live = '[aria-live]:not([aria-live="off"]), [role="status"], ' +
        'output:not([aria-live="off"])';
    for (const each of document.querySelectorAll(live)) observer.observe(each, all);
    const slider = document.querySelector('.ab-timeline [type="range"]');
    slider.value = slider.min;
    while (n--) {
        slider.stepUp();
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        await new Promise(requestAnimationFrame);
    }
    const before = written;
    pass();
    await new Promise(requestAnimationFrame);
    observer.disconnect();
    return [before, written];
}"""


# What a scene is before the reader does something


@pytest.fixture(params=KINDS)
def untouched(all_scenes, request):
    """A scene that nobody touched, beside all others."""
    return all_scenes.page.locator(f'.ab-live[data-scene="{request.param}"]')


def test_all_scenes_live_on_one_page(all_scenes):
    assert all_scenes.page.locator(".ab-live").count() == len(KINDS) >= 12
    assert all_scenes.problems == []


def test_only_one_thing_speaks_in_a_scene(untouched):
    live = untouched.locator(
        '[aria-live]:not([aria-live="off"]), [role="status"],'
        ' output:not([aria-live="off"])'
    )

    assert live.count() == 1


def test_a_scene_says_nothing_before_the_reader_does_something(all_scenes, untouched):
    all_scenes.page.wait_for_timeout(100)

    assert untouched.locator("[role=status]").inner_text() == ""


def test_a_scene_is_a_landmark_with_its_title(untouched):
    assert untouched.get_by_role("region", name="Scene: ").count() == 1


def test_all_cells_of_a_grid_have_a_name(all_scenes, untouched):
    name = untouched.get_attribute("data-scene")
    nameless = f"[data-scene={name}] [role=gridcell]:not([aria-label])"
    all_scenes.page.wait_for_function(f"!document.querySelector('{nameless}')")

    assert all_scenes.problems == []


# What is the same by other means


@pytest.mark.parametrize("name", PLAYS)
def test_many_steps_are_one_sentence(open_scene, name):
    tab = open_scene(bare(KINDS[name], bet="skip"), first=WAITING)
    tab.page.evaluate("pass()")

    assert tab.page.evaluate(HEARD, 20) == [0, 1]


def touch(tab, slider, path):
    """Put a finger on the middle of a slider, take it along, lift it."""
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    session = tab.page.context.new_cdp_session(tab.page)
    point = [{"x": x, "y": y}]
    session.send(
        "Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": point}
    )
    for dx, dy in path:
        point = [{"x": x + dx, "y": y + dy}]
        session.send(
            "Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": point}
        )
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    tab.settle().settle()


def test_a_finger_that_scrolls_over_a_slider_leaves_it_as_it_was(open_scene):
    tab = open_scene(bare(KINDS["hill"]), width=400, has_touch=True)
    slider = tab.root.get_by_role("slider", name="q (up")
    before = slider.input_value()
    touch(tab, slider, [(0, -10 * i) for i in range(1, 15)])

    assert slider.input_value() == before == "0.3"
    assert tab.page.evaluate("scrollY") > 0, "the page was meant"
    assert "hill.q" not in tab.page.url


def test_a_finger_moves_a_slider_and_a_tap_too(open_scene):
    tab = open_scene(bare(KINDS["hill"]), width=400, has_touch=True)
    slider = tab.root.get_by_role("slider", name="q (up")
    touch(tab, slider, [])
    tapped = float(slider.input_value())
    touch(tab, slider, [(5 * i, 0) for i in range(1, 15)])
    moved = float(slider.input_value())

    assert 0.4 < tapped < 0.6 < moved
    assert f"hill.q={moved:g}" in tab.url_with(f"hill.q={moved:g}")


@pytest.mark.parametrize("name", ["race", "studio"])
def test_letters_of_a_field_are_large_enough_that_a_phone_does_not_zoom_in(
    open_scene, name
):
    tab = open_scene(bare(KINDS[name]), width=400, has_touch=True, is_mobile=True)
    sizes = tab.root.evaluate(
        "e => [...e.querySelectorAll('select, input, textarea')]"
        ".map((field) => parseFloat(getComputedStyle(field).fontSize))"
    )

    assert len(sizes) > 1
    assert min(sizes) >= 16


def large():
    """A building of one room, 40 x 40 cells: solving it waits to be asked for."""
    rows = ["|" + " " * 79 + "|"] * 79
    rows[38] = "|" + " " * 38 + "*" + " " * 40 + "|"
    wall = "+" + "-" * 79 + "+"
    return "\n".join([wall, *rows, wall])


# Buttons that hide themselves.
HIDING = {
    "hill": ("Forget the earlier climbs", {"earlier": [[0.9, 0.9]]}),
    "studio": ("Large building: solve it", {"text": large()}),
    "ladder": ("Large building: solve it", {"text": large()}),
}


@pytest.mark.parametrize("name", HIDING)
def test_a_button_that_hides_itself_hands_the_focus_on(open_scene, name):
    text, state = HIDING[name]
    tab = open_scene(bare(KINDS[name], **state))
    button = tab.root.get_by_role("button", name=text)
    button.focus()
    tab.press("Enter")

    assert not button.is_visible()
    assert tab.page.evaluate("document.activeElement.closest('.ab-scene') !== null")
    assert tab.problems == []


@pytest.mark.parametrize("name", ["studio", "ballot", "paint"])
def test_bars_are_seen_in_high_contrast(open_scene, name):
    tab = open_scene(bare(KINDS[name], bet="skip"), forced_colors="active")
    if name == "paint":
        tab.pick("And of all", "I do not bet: show me")
        tab.root.locator(".ab-bars li").first.wait_for()
    bar = tab.root.locator(".ab-bar").first
    bar.wait_for(state="attached")
    ground = tab.root.evaluate("e => getComputedStyle(e).backgroundColor")

    assert bar.evaluate("e => getComputedStyle(e).backgroundColor") != ground


def test_letters_of_a_chart_keep_their_ground_in_high_contrast(open_scene):
    """Its colours stay those of the page's theme, whatever the reader's colours are."""
    tab = open_scene(bare(KINDS["dial"]), forced_colors="active")
    seen = "e => getComputedStyle(e).backgroundColor"

    assert tab.root.locator("svg").first.evaluate(seen) == "rgb(255, 255, 255)"


def test_on_a_phone_that_lies_a_swipe_moves_the_page_not_the_building(open_scene):
    tab = open_scene(bare(KINDS["ripple"]))
    gap = "e => e.scrollHeight - e.clientHeight"
    frame = tab.root.locator(".ab-frame").first
    tab.page.set_viewport_size({"width": 800, "height": 360})

    assert frame.bounding_box()["height"] > 360, "it would be cut"
    assert frame.evaluate(gap) == 0


# The look of a scene while an element of the page has an attribute.
LOOK = """([part, name, value]) => {
    document[part].setAttribute(name, value);
    const scene = document.querySelector(".abstransfer-scene");
    const look = getComputedStyle(scene).colorScheme;
    document[part].removeAttribute(name);
    return look;
}"""
HIGH = "vscode-high-contrast"  # VS Code gives this name to its light form, too


@pytest.mark.parametrize(
    ("part", "name", "value", "scheme"),
    [
        ("documentElement", "data-theme", "dark", "dark"),  # the built book
        ("documentElement", "theme", "dark", "dark"),  # Colab
        ("body", "data-jp-theme-light", "false", "dark"),  # JupyterLab
        ("body", "class", "vscode-dark", "dark"),
        ("body", "class", HIGH, "dark"),
        ("body", "class", f"{HIGH} {HIGH}-light", "light"),
        ("body", "class", "vscode-light", "light"),
    ],
)
def test_a_scene_is_dark_where_what_shows_it_is(all_scenes, part, name, value, scheme):
    assert all_scenes.page.evaluate(LOOK, [part, name, value]) == scheme


def test_a_placed_bet_is_a_line_that_opens_again(open_scene):
    tab = open_scene(bare(KINDS["hill"]))
    tab.pick("Bet first", "not always")
    assert not tab.root.get_by_role("group", name="Bet first").is_visible()
    assert tab.root.get_by_text("You bet on \u201cnot always\u201d.").is_visible()
    tab.click("Change").pick("Bet first", "always on the same")

    line = tab.root.locator(".ab-bet > p")
    assert line.inner_text().startswith("You bet on \u201calways on the same\u201d.")


def test_who_bets_by_arrow_keys_has_bet_on_leaving(open_scene):
    tab = open_scene(bare(KINDS["hill"]))
    tab.root.get_by_role("radio", name="always on the same").focus()
    tab.press("Space", "ArrowDown")
    assert tab.root.get_by_role("radio", name="not always").is_checked()
    tab.press("Tab")

    assert tab.root.locator(".ab-bet > p").is_visible()
    assert tab.page.evaluate("document.activeElement.closest('.ab-scene') !== null")


def test_on_a_phone_what_is_said_is_seen_while_the_scene_is_handled(open_scene):
    tab = open_scene(bare(KINDS["hill"]), width=400)
    said = tab.root.locator(".ab-said")
    tab.root.get_by_role("slider", name="p (left").focus()
    tab.press("ArrowRight")
    tab.page.wait_for_function(
        "document.querySelector('.ab-said').textContent.includes('p = ')"
    )
    box = said.bounding_box()

    assert box["width"] > 300
    assert box["y"] + box["height"] <= 900, "at the rim of the window"
    tab.page.locator("h1").click()
    assert said.bounding_box()["width"] < 2
