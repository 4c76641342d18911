"""Box plots that fill: the page's own intervals and verdicts, run by run."""

import json
from functools import cache

import numpy as np
import pytest
from scene_tab import bare, number

from abstransfer.experiments import stats
from abstransfer.experiments.results import read_results
from abstransfer.reproduction.optional_stopping import (
    SAME,
    orders,
    read_along,
    tracks,
)
from abstransfer.scenes import Filling

RESULTS = read_results("goal-target")
READ = """async key => {
    const host = document.querySelector(".abstransfer-scene");
    const { data } = JSON.parse(host.dataset.options);
    const tracks = [];
    for (let k = 0; k < 5; k++) {
        const mine = [];
        for (let n = 5; n <= (key === "same" ? 25 : 50); n++) {
            const found = probe.findingsOf(data, key, k, n);
            const verdicts = probe.verdictsOf(found, key);
            verdicts.forEach((v, i) => (mine[i] ??= []).push(v));
        }
        tracks.push(...mine);
    }
    return tracks;
}"""


@cache
def reading(key):
    """What who reads along does, worked out once."""
    return read_along(tracks(RESULTS, key))


@pytest.fixture
def page(show):
    """The scene without its still picture: quick."""

    def open_page(query="", **options):
        widget = bare(Filling)
        data = json.dumps(Filling().options()).replace('"', "&quot;")
        return show(widget.replace("{}", data), query, **options)

    return open_page


def sign(scene):
    scene.button("I sign now").click()
    return scene.settle()


# What Python says


def test_the_still_picture_states_both_sides():
    caption = Filling().still().caption
    trap = reading(SAME)

    assert f"\u201c{reading('1').verdict}\u201d from {reading('1').settled}" in caption
    assert f"of {len(trap.stops)} comparisons" in caption
    signed = sum(map(bool, trap.stops))
    assert f"signs {signed}: {signed / len(trap.stops):.0%}." in caption


def test_python_has_the_verdict_of_the_scene_and_other_results():
    scene = Filling(claim="2", order=3, n=6)
    assert scene.verdict() == tracks(RESULTS, "2")[3][1]
    assert repr(scene) == "Filling(claim='2', n=6, order=3)"
    scene.results = "goal-target_c"

    wanted = read_results("goal-target_c").totals("prob-soft").tolist()
    assert wanted in scene.data["totals"]
    assert repr(scene).endswith("results='goal-target_c')")


# In the page


def test_verdicts_are_pythons_life_by_life_in_all_orders(page):
    scene = page()

    for key in ("2", "4", SAME):  # a condition, a margin, and many tracks
        assert scene.ask(READ, key) == tracks(RESULTS, key)


@pytest.mark.parametrize(("order", "n"), [(0, 5), (2, 17), (4, 50)])
def test_the_table_has_the_numbers_of_the_pages_functions(page, order, n):
    scene = page(f"#filling.order={order}&filling.n={n}&filling.claim=2")
    scene.bet("more than 30")
    rows, lives = scene.rows(), orders(50)[order][:n]

    for arm, name in [("none", "Q-learning"), ("nd-soft", "ND soft")]:
        wanted = stats.t_interval(RESULTS.totals(arm)[lives])
        assert rows[name][:3] == [f"{end:,.0f}" for end in wanted]
    gain = stats.gain_interval(
        *(RESULTS.totals(arm)[lives] for arm in ("prob-soft", "prob-hard"))
    )
    found = [
        number(text.removesuffix(" %")) for text in rows["prob-soft over prob-hard"][:3]
    ]
    np.testing.assert_allclose(found, [100 * end for end in gain], atol=0.0501)
    assert tracks(RESULTS, "2")[order][n - 5] in scene.root.inner_text()
    assert scene.problems == []


def test_it_asks_first_and_ends_in_both_sentences(page):
    scene = page()
    assert scene.root.locator(".ab-chart:visible").count() == 1
    assert scene.root.get_by_role("button", name="I sign now").count() == 0
    scene.bet("6 to 15")
    assert scene.root.locator(".ab-chart:visible").count() == 2
    sign(scene)

    one, trap = reading("1"), reading(SAME)
    assert scene.closing.startswith(
        "You bet on \u201c6 to 15\u201d; it was \u201c5 runs\u201d."
    )
    assert f"all 50 say \u201c{one.verdict}\u201d" in scene.closing
    assert f"From {one.settled} runs on" in scene.closing
    assert f"wrong in {one.wrong} of 5 orders" in scene.closing
    scene.pick("Claim", "each arm against itself")
    assert scene.closing == ""
    sign(scene)

    signed = sum(map(bool, trap.stops))
    assert f"signs {signed} of 45 comparisons" in scene.closing
    assert f"{100 * signed / 45:.0f} % wrong" in scene.closing
    assert scene.violations() == []
    assert scene.problems == []


def test_by_keyboard_alone_to_the_end_in_the_dark_on_a_phone(page):
    scene = page(width=400, color_scheme="dark", reduced_motion="reduce")
    keys, focus = scene.page.keyboard, "document.activeElement"
    ground = "getComputedStyle(document.querySelector('.abstransfer-scene')).color"
    before = scene.page.evaluate(ground)
    scene.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    assert scene.page.evaluate(ground) != before
    for _ in range(20):
        keys.press("Tab")
        if scene.page.evaluate(f"{focus}.closest('.ab-bet') !== null"):
            scene.press("Space")
        if scene.page.evaluate(f"{focus}.type === 'range'"):
            scene.press("ArrowRight", "ArrowRight")
        if scene.focused == "I sign now":
            keys.press("Enter")
            break
    scene.wait("all 50 say", ".ab-closing")

    assert scene.closing.startswith("You bet on \u201c5 runs\u201d: right.")
    assert "after 7 runs" in scene.closing
    scene.wait("all 50 say", "[role=status]")
    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert scene.small_controls() == []
    assert scene.violations() == []
    assert scene.problems == []


def test_ends_of_the_slider_quick_changes_and_how_much_they_paint(page):
    scene = page("#filling.claim=5").bet("5 runs")
    assert max(scene.writes_by_moves(".ab-timeline input", 5)) < 400
    slider = scene.slider("Runs")
    for value in ("5", "50", "7", "31", "12"):
        slider.fill(value)
    scene.settle()

    assert (
        "After 12 runs: claim 5 holds (8 of its 8 findings hold)."
        in scene.root.inner_text()
    )
    sign(scene)
    scene.url_with("filling.signed=12")
    scene.pick("Order of the runs", "shuffled 2")
    assert scene.closing == "", "signed in one order, not in the other"
    scene.page.wait_for_function("!location.hash.includes('signed')")
    scene.button("Reset").click()
    scene.page.wait_for_function("!location.hash.includes('filling')")
    assert slider.input_value() == "5"
    assert scene.problems == []


def test_fewer_runs_shorten_the_time_line(show):
    scene = show(Filling(results="goal-target_c"), "#filling.n=50").bet("16 to 30")

    assert scene.slider("Runs").get_attribute("max") == "20"
    sign(scene)
    wanted = read_along(tracks(read_results("goal-target_c"), "1"))
    assert f"all 20 say \u201c{wanted.verdict}\u201d" in scene.closing
    assert scene.problems == []
