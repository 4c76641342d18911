"""One dial, two curves: exact and learned numbers, by mouse and by keyboard."""

import re

import pytest
from bs4 import BeautifulSoup
from scene_tab import bare, number

from abstransfer.scenes import Dial

STEPS = 600_000  # of a run that takes no time


@pytest.fixture
def dial(open_scene):
    return open_scene(bare(Dial, steps=STEPS))


def driven(tab):
    """Wait until the curve of driving is there."""
    tab.page.wait_for_function(
        "() => /drives best/.test(document.querySelector('.ab-closing').textContent)"
    )
    return tab


def bet(tab, text="I do not bet: show me"):
    return tab.pick(re.compile("^Bet first"), text)


def turn(tab, beta):
    tab.root.get_by_role("slider", name="The dial").fill(str(beta))
    return tab.settle()


def taught(tab):
    """Wait until the workers are done."""
    tab.root.get_by_role("button", name="Stop").wait_for(state="hidden")
    return tab.settle()


def told(tab):
    """Wait until the closing sentence says what became of the bet."""
    tab.page.wait_for_function(
        "() => /You bet on/.test(document.querySelector('.ab-closing').textContent)"
    )
    return tab.settle()


def goals(tab, beta):
    return tab.rows()[f"{beta:.2f}"][2]


# Numbers


def test_driving_is_worth_what_python_says(dial):
    rows = driven(dial).rows()
    scene = Dial()

    assert len(rows) == 33
    for beta in (0.0, 0.25, 0.5, 1.0, 2.75, 8.0):
        source, target, _ = rows[f"{beta:.2f}"]
        assert abs(number(source) - scene.driving(beta, "source")) < 1e-9
        assert abs(number(target) - scene.driving(beta)) < 1e-9
    best = max(rows, key=lambda beta: number(rows[beta][1]))
    assert f"drives best at β = {best} in the target" in dial.closing
    assert "peak 0.50" in dial.root.locator(".ab-chart").first.text_content()


@pytest.mark.parametrize(
    ("strategy", "reward"), [("hard", "goal"), ("soft", "goal"), ("hard", "cost")]
)
def test_teaching_is_the_run_that_python_makes(open_scene, strategy, reward):
    setting = {"strategy": strategy, "reward": reward, "steps": STEPS, "luck": 7}
    tab = bet(driven(open_scene(bare(Dial, **setting))))
    for beta in (0.0, 1.5):
        turn(tab, beta).click(re.compile(r"^Let β = .* teach"))
        taught(tab)
        wanted = Dial(**setting).teaching(beta)

        assert goals(tab, beta) == f"{wanted:,}"
    assert tab.problems == []


# To the end, by mouse and by keyboard


def test_a_bet_comes_first_and_is_answered(dial):
    driven(dial)
    five = dial.root.get_by_role("button", name="Let five teach: β = 0, 0.50, 1, 2, 8")
    assert five.is_disabled()
    assert "teaches best" not in dial.closing

    bet(dial, "at Prob, β = 1")
    assert five.is_enabled()
    five.click()
    told(dial)
    found = {beta: number(goals(dial, beta)) for beta in (0, 0.5, 1, 2, 8)}
    best = max(found, key=found.get)

    assert f"Of 5 places tried, it teaches best at β = {best:.2f}" in dial.closing
    assert f"{found[best]:,.0f} goals" in dial.closing
    assert ("”: right." if best == 1 else "”; it was “") in dial.closing
    assert len(dial.root.locator(".ab-chart").nth(1).locator(".ab-marker").all()) >= 4
    assert dial.problems == []


def test_by_keyboard_alone(dial):
    driven(dial)
    dial.root.get_by_role("radio", name="at ND, β = 0").focus()
    dial.press("Space")
    for _ in range(8):
        dial.press("Tab")
        if dial.focused.startswith("Let five"):
            break
        if dial.page.evaluate("document.activeElement.type") == "range":
            dial.press("ArrowRight", "ArrowRight")
    dial.press("Enter")
    told(dial)
    taught(dial)

    assert "At β = 1.50" in dial.root.inner_text()
    assert "You bet on “at ND, β = 0”" in dial.closing
    assert dial.focused.startswith("Let five"), "the focus is not lost"


def test_points_are_kept_by_setting(dial):
    bet(driven(dial)).click(re.compile(r"^Let β"))
    known = goals(taught(dial), 1.0)
    dial.pick("Advice", "soft")
    assert goals(dial, 1.0) == "–"
    dial.click(re.compile(r"^Let β"))
    other = goals(taught(dial), 1.0)
    dial.pick("Advice", "hard")

    assert goals(dial, 1.0) == known != other
    lines = (
        dial.root.locator(".ab-chart").nth(1).locator(".ab-name").all_text_contents()
    )
    assert lines == ["hard", "soft"]
    dial.click("Reset")
    assert goals(dial, 1.0) == "–"


# State


def test_a_moment_has_an_address(open_scene):
    first = open_scene(bare(Dial))
    turn(first, 2.5).pick("The learner's reward", "−1 a step, Q starts at 0")
    second = open_scene(bare(Dial), query=first.url_with("reward=cost"))

    assert "At β = 2.50" in second.root.inner_text()
    assert second.root.get_by_role("radio", name="−1 a step").is_checked()
    second.click("Reset")
    assert "At β = 1.00 (Prob)" in second.root.inner_text()


def test_ends_and_quick_changes(dial):
    sliders = dial.root.get_by_role("slider").all()
    for slider in sliders:
        for value in ("min", "max"):
            slider.fill(slider.get_attribute(value))
            dial.settle()
    for value in ["1", "7.75", "0", "3", "0.5"]:
        sliders[0].evaluate(
            "(e, v) => { e.value = v; e.dispatchEvent(new Event('input')); }", value
        )
    dial.settle()

    wanted = f"{Dial().driving(0.5):.2f}".replace("-", "\u2212")
    assert f"At β = 0.50, driving is worth {wanted}" in dial.root.inner_text()
    assert dial.problems == []


def test_another_building_has_curves_of_its_own(open_scene):
    scene = Dial(map="source", steps=STEPS)
    tab = driven(open_scene(bare(Dial, map="source", steps=STEPS)))

    source, target, _ = tab.rows()["0.50"]
    assert source == target
    assert abs(number(target) - scene.driving(0.5)) < 1e-9


# By the page itself: a run of 30 million steps may be over before a test could.
STOPPED = """async (begun) => {
    const pictures = () => new Promise(requestAnimationFrame);
    while (!RegExp(begun).test(document.body.textContent)) await pictures();
    const stop = (button) => button.textContent === "Stop";
    [...document.querySelectorAll("button")].find(stop).click();
}"""


def test_a_stopped_run_goes_on_to_the_same_end(open_scene):
    wanted = Dial().teaching(1.0)
    tab = bet(driven(open_scene(bare(Dial))))
    tab.click(re.compile("^Let β"))
    tab.page.evaluate(STOPPED, "Learning: β = 1.00, [1-9]")
    tab.settle().click(re.compile("^Let β"))

    assert goals(taught(tab), 1.0) == f"{wanted:,}"
    assert "Stopped" not in tab.root.inner_text()


def test_workers_end_when_stopped_and_when_the_reader_leaves(open_scene):
    tab = bet(driven(open_scene(bare(Dial))))
    tab.click(re.compile("^Let five"))
    assert len(tab.wait_for_worker().page.workers) >= 1
    tab.page.evaluate(STOPPED, "Learning: β = 0.00, [1-9]")
    assert tab.is_idle()
    assert goals(tab, 8.0) == "–"
    kept = "Stopped: β = 0.00, [1-9]"
    assert re.search(kept, tab.root.inner_text()), "what was learned stays"
    tab.pick("Advice", "soft")
    assert "Stopped" not in tab.root.inner_text(), "it was another advice"
    tab.pick("Advice", "hard")
    assert re.search(kept, tab.root.inner_text())
    tab.click(re.compile("^Let five"))
    assert re.search(kept.replace("Stopped", "Learning"), tab.root.inner_text())
    tab.page.goto("about:blank")
    assert tab.is_idle()
    assert tab.problems == []


# Looks


def test_it_is_accessible(open_scene):
    tab = driven(open_scene(bare(Dial, steps=STEPS)))
    assert tab.violations() == []
    bet(tab).click(re.compile(r"^Let β"))
    taught(tab).rows()
    assert tab.violations() == []


def test_on_a_phone(open_scene):
    tab = driven(open_scene(bare(Dial, steps=STEPS), width=400))

    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert tab.small_controls() == []


# In Python


def test_the_still_picture_says_where_the_peaks_are():
    scene = Dial(steps=STEPS)
    soup = BeautifulSoup(scene.html(), "html.parser")
    caption = soup.find("figcaption").get_text()
    teaching = {beta: scene.teaching(beta) for beta in (0.0, 0.5, 1.0, 8.0)}
    best = max(teaching, key=teaching.get)

    assert "drives best at β = 0.5" in caption
    assert f"teaches best at β = {best:g}: {teaching[best]:,} goals" in caption
    assert len(soup.find_all("svg")) == 3
    known = scene.options()["points"]
    assert [point[:2] for point in known] == [[b, teaching[b]] for b in (0, 1)]
