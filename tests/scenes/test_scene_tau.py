"""The tau slider: runs at any tau, learned while the reader looks, and remembered."""

import json

import pytest
from run_scenes import SHORT, python_run
from scene_tab import COUNTED, bare
from support import PATIENCE

from abstransfer.experiments.arms import TAUS
from abstransfer.scenes import TauSlider

SIDES = ("hard", "soft")


@pytest.fixture(scope="module")
def slider():
    return TauSlider(steps=SHORT)


def curve(widget, side, tau, guide="nd"):
    return python_run(widget, guide, side, tau).goals.tolist()


def to(scene, tau):
    """Move the slider, and wait until both runs are known."""
    scene.slider("Advice until step").fill(str(int(tau)))
    scene.settle()
    scene.page.wait_for_function(
        "!document.querySelector('.ab-body > p').innerText.includes(': learning')"
    )
    return scene.settle()


# What Python says


def test_a_slider_is_one_line_and_its_picture_is_always_the_same(slider):
    assert repr(TauSlider()) == "TauSlider()"
    assert slider.html() == TauSlider(steps=SHORT).html()
    with pytest.raises(ValueError, match="guides must be one of"):
        TauSlider(guides="nd")


def test_the_still_picture_compares_with_the_papers_tau(slider):
    still = slider.still()
    hard, soft = (
        sum(curve(slider, side, tau))
        for side, tau in zip(SIDES, (3.5e6, 11e6), strict=True)
    )

    assert len(still.frames) == 3
    assert f"3.5 M and 11 M, to {hard:,} and {soft:,}" in still.caption
    assert ("ND hard", "3.5 M", f"{hard:,}") in still.rows


def test_the_page_carries_what_it_shows_first(slider):
    known = slider.options()["curves"]

    assert known == {
        f"none 0 1 {SHORT}": python_run(slider, None).goals.tolist(),
        f"nd-hard 9000000 1 {SHORT}": curve(slider, "hard", 9e6),
        f"nd-soft 9000000 1 {SHORT}": curve(slider, "soft", 9e6),
    }
    assert repr(slider) == f"TauSlider(steps={SHORT})"


# In the page


def test_it_says_something_at_once_without_a_worker(show, slider):
    scene = show(slider, first=COUNTED)

    totals = [sum(curve(slider, side, 9e6)) for side in SIDES]
    for total in totals:
        assert f"{total:,} " in scene.words
    assert scene.root.locator(".ab-chart").count() == 3
    assert scene.page.evaluate("nWorkers") == 0
    assert scene.problems == []


@pytest.mark.parametrize(("guide", "text"), [("nd", "ND"), ("rand", "wanderer")])
def test_any_tau_has_pythons_numbers(show, slider, guide, text):
    scene = show(slider)
    scene.root.get_by_role("radio", name=text, exact=True).check()
    to(scene, 6.5e6)

    for side in SIDES:
        assert scene.column(side) == curve(slider, side, 6.5e6, guide)
    assert scene.column("Q-learning") == python_run(slider, None).goals.tolist()
    assert scene.problems == []


def test_thirty_million_steps_are_the_stored_ones(show):
    """The one whole run in a browser: all others show on short ones that they agree."""
    widget = TauSlider(tau=3_500_000)
    scene = show(bare(TauSlider, tau=3_500_000)).wait("(hard)", ".ab-body > p")

    assert scene.is_idle(PATIENCE)
    assert scene.column("Q-learning") == widget.learn(widget.arm(None)).tolist()
    assert scene.column("hard") == widget.learn(widget.arm("hard")).tolist()
    assert scene.problems == []


def test_the_ends_of_tau(show, slider):
    scene = to(show(slider), 0)
    none = python_run(slider, None).goals.tolist()
    assert scene.column("hard") == scene.column("soft") == none
    assert "plain Q-learning" in scene.root.inner_text()
    to(scene, 30e6)

    for side in SIDES:
        assert scene.column(side) == curve(slider, side, 30e6)
    assert scene.problems == []


def test_five_quick_changes_learn_the_last_tau_only(show, slider):
    scene = show(slider)
    handle = scene.slider("Advice until step")
    handle.evaluate(  # at once: a short run could end between two calls from Python
        """slider => [1e6, 20e6, 4e6, 12e6, 5e6].forEach((tau) => {
            slider.value = tau;
            slider.dispatchEvent(new Event("input", { bubbles: true }));
        })"""
    )
    to(scene, 5e6)
    scene.bet("2 to 5 million")

    caption, _, _ = scene.table()
    for side in SIDES:
        totals = [f"{t} M {sum(curve(slider, side, 1e6 * t)):,}" for t in (5, 9)]
        assert f"Goals by \u03c4, {side}: {', '.join(totals)}." in caption


def test_a_known_tau_is_not_learned_again(show, slider):
    scene = to(to(show(slider), 5e6), 9e6)
    scene.page.evaluate("() => { window.Worker = () => (window.begun = 1); }")
    to(scene, 5e6)

    assert scene.column("hard") == curve(slider, "hard", 5e6)
    assert scene.page.evaluate("window.begun") is None
    assert scene.problems == []


def test_all_ten_tau_and_the_bet(show, slider):
    scene = show(slider).bet("2 million or fewer")
    assert scene.closing == ""
    scene.button("Learn with ten").click()
    scene.wait("You bet on", ".ab-closing")
    totals = {
        side: {tau: sum(curve(slider, side, tau)) for tau in (*TAUS,)} for side in SIDES
    }

    for side in SIDES:
        tau = max(totals[side], key=totals[side].get)
        text = f"{tau / 1e6:g} M ({totals[side][tau]:,}"
        assert text in scene.closing
    assert "Of 10 \u03c4 tried with ND" in scene.closing
    assert "The paper chose 3.5 M and 11 M." in scene.closing
    assert scene.violations() == []
    assert scene.problems == []


def test_by_keyboard_alone_to_the_end(show, slider):
    scene = show(slider, color_scheme="dark")
    page, focus = scene.page, "document.activeElement"
    for _ in range(20):
        page.keyboard.press("Tab")
        if page.evaluate(f"{focus}.type === 'range' && {focus}.max === '30000000'"):
            page.keyboard.press("ArrowRight")
        if page.evaluate(f"{focus}.closest('.ab-bet') !== null"):
            page.keyboard.press("ArrowDown")
            scene.settle()
        if "Learn with ten" in page.evaluate(f"{focus}.innerText ?? ''"):
            page.keyboard.press("Enter")
            break
    scene.wait("You bet on", ".ab-closing")

    assert scene.slider("Advice until step").input_value() == "9500000"
    assert page.evaluate(f"{focus}.innerText") == "Ten \u03c4 are known"
    scene.wait("You bet on", "[role=status]")
    assert scene.violations() == []


def test_a_moment_has_an_address_and_a_reset(show, slider):
    scene = show(slider, "#tau.tau=2000000&tau.guide=prob")
    scene.wait("Prob advises until step 2 M:")
    to(scene, 3e6)
    scene.page.wait_for_function("location.hash.includes('tau.tau=3000000')")
    assert scene.column("soft") == curve(slider, "soft", 3e6, "prob")
    scene.button("Reset").click()
    scene.page.wait_for_function("!location.hash.includes('tau')")

    assert scene.column("hard") == curve(slider, "hard", 9e6)
    assert scene.is_idle()


def test_leaving_while_it_learns_ends_the_workers(show):
    scene = show(TauSlider(steps=6_000_000), "#tau.all=true")
    scene.page.wait_for_function("document.body.innerText.includes('Stop (')")
    scene.wait_for_worker().button("Stop").click()
    scene.settle()
    assert scene.is_idle()
    to_learning(scene)
    scene.page.goto("about:blank")

    assert scene.is_idle()
    assert scene.problems == []


def to_learning(scene):
    """Move the slider, and wait for a worker."""
    scene.slider("Advice until step").fill("15000000")
    scene.page.wait_for_function("document.body.innerText.includes(': learning')")
    scene.wait_for_worker()


def test_on_a_phone_with_little_motion(show, slider):
    options = {"color_scheme": "dark", "reduced_motion": "reduce"}
    scene = to(show(slider, width=400, **options).bet("2 to 5 million"), 4e6)

    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert scene.small_controls() == []
    assert scene.violations() == []


def test_the_schedule_follows_the_hand_and_the_rest_waits(show, slider):
    scene = show(slider)

    assert all(0 < n < 400 for n in scene.writes_by_moves(".ab-slider input", 1e6))


def test_options_are_small(slider):
    assert len(json.dumps(TauSlider().options())) < 1_500
