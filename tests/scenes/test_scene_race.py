"""The race: robots in one building, step by step, and all the steps in workers."""

import json

import numpy as np
import pytest
from run_scenes import SHORT, python_run

from abstransfer.abstraction import LABELS
from abstransfer.experiments.arms import ARMS
from abstransfer.experiments.problem import build_guides, target_tasks
from abstransfer.experiments.results import read_results
from abstransfer.scenes import Race

NAMES = {"none": "Q-learning", "rand": "wanderer", "prob": "Prob", "nd": "ND"}
TAU = {arm.guide: arm.tau for arm in ARMS if arm.strategy == "hard"}


@pytest.fixture(scope="module")
def race():
    return Race(steps=SHORT)


@pytest.fixture(scope="module")
def runs(race):
    """Python's runs of the four racers, with their first steps."""
    return {
        name: python_run(race, guide, tau=TAU[guide], trace=1000)
        for name, guide in zip(NAMES, (None, "rand", "prob", "nd"), strict=True)
    }


def place(cell):
    return f"row {cell // 30 + 1}, column {cell % 30 + 1}"


def learned(scene):
    """Press the button, and wait for the end of all runs."""
    scene.button("million steps").click()
    return scene.wait("They reached")


# What Python says


def test_a_race_is_one_line_and_its_picture_is_always_the_same(race):
    assert repr(Race()) == "Race()"
    assert repr(Race(luck=3, policy=None)) == "Race(luck=3)"
    assert race.html() == Race(steps=SHORT).html()
    with pytest.raises(ValueError, match="lucky must be one of"):
        Race(lucky=1)


def test_the_still_picture_says_who_won(race, runs):
    still = race.still()
    totals = {name: int(run.goals.sum()) for name, run in runs.items()}

    assert len(still.frames) == 3
    assert f"ND {totals['nd']:,}" in still.caption
    assert [row[2] for row in still.rows] == [
        f"{total:,}" for total in sorted(totals.values(), reverse=True)
    ]
    assert still.rows[0][0] == "ND (N)"


def test_what_needs_no_other_building_stands_beside_what_advice_is_worth(race):
    told = read_results("controls-target").totals("eager-hard").mean()
    nd = read_results("goal-target").totals("nd-hard").mean()

    assert f"reaches, in 30 million steps, {told:,.0f} on average" in (
        race.still().caption
    )
    assert told > 0.95 * nd, "or the scene may not say that it comes as far"
    other = Race(steps=SHORT, map="target_b").still()
    assert "on average" not in other.caption, "a control is of its building"


def test_stored_results_are_those_of_q_learning():
    scene = Race(luck=2)

    found = scene.learn(scene.arms[-1])
    assert found.tolist() == python_run(scene, "nd", tau=TAU["nd"]).goals.tolist()


@pytest.mark.parametrize(
    ("policy", "problem"),
    [
        (np.ones((3, 8)) / 8, r"shape \(2048, 8\), got \(3, 8\)"),
        (np.full((2048, 8), 0.2), "sum to 1, got .* for abstract state 0"),
    ],
)
def test_a_wrong_policy_is_refused(policy, problem):
    with pytest.raises(ValueError, match=problem):
        Race(policy=policy)


def test_a_policy_comes_back_from_the_browser_as_it_went():
    nd = build_guides(Race().problem, ["nd"])["nd"]
    scene = Race(policy=nd)
    trait = Race.class_traits()["policy"]
    sent = trait.metadata["to_json"](scene.policy, scene)

    assert len(json.dumps(sent)) < 20_000
    np.testing.assert_array_equal(trait.metadata["from_json"](sent, scene), nd)
    scene.policy = None
    assert scene.changed == {}


# The first steps


def test_robots_are_where_python_has_them(show, race, runs):
    scene = show(race)
    for t in (0, 1, 39, 76, 500, 1000):
        scene.go(f"#race.t={t}")
        assert_robots_are_where_python_has_them(scene, race, runs, t)
    assert scene.problems == []


def assert_robots_are_where_python_has_them(scene, race, runs, t):
    n_cells = race.map.n_cells
    _, _, rows = scene.table()

    for row, run in zip(rows, runs.values(), strict=True):
        trace = run.trace
        goal = target_tasks(race.problem).mdp.terminal[trace.next_state]
        cell = trace.next_state[t - 1] if t else trace.state[0]
        action = LABELS[trace.action[t - 1]].replace("_", " ") if t else "\u2013"
        assert row[1] == place(cell % n_cells)
        assert row[2:4] == [action, str(goal[:t].sum())]


def test_the_first_moment_where_they_part_is_found_and_marked(show, race, runs):
    states = np.array([run.trace.next_state for run in runs.values()])
    t = int((states != states[0]).any(axis=0).argmax()) + 1
    before = runs["none"].trace.state[t - 1] % race.map.n_cells
    scene = show(race, "#race.t=0")
    assert scene.root.locator(".ab-lit").count() == 0
    scene.button("Next event").click()
    scene.settle()

    assert scene.slider("Step").input_value() == str(t)
    assert f"Step {t}: here, in the frame, they part" in scene.root.inner_text()
    lit = scene.root.locator(".ab-lit")
    assert lit.count() == 1
    assert lit.get_attribute("data-cell") == str(before)


def test_the_time_line_plays_and_steps_back(show, race):
    scene = show(race)
    scene.button("One step back").click()
    scene.settle()
    assert scene.slider("Step").input_value() == "38"
    scene.button("Play").click()
    scene.page.wait_for_function(
        "Number(document.querySelector('.ab-timeline input').value) > 42"
    )
    scene.button("Pause").click()
    assert scene.problems == []


# All steps


def test_by_mouse_to_the_end_with_pythons_numbers(show, race, runs):
    scene = show(race)
    assert not scene.button("million steps").is_visible(), "bet first"
    learned(scene.bet("Prob"))
    totals = {name: int(run.goals.sum()) for name, run in runs.items()}

    assert "You bet on \u201cProb\u201d; it was \u201cND\u201d." in scene.closing
    assert all(f"{NAMES[n]} {total:,}" in scene.closing for n, total in totals.items())
    for name, run in runs.items():
        assert scene.column(NAMES[name]) == run.goals.tolist()
    assert "a robot that is told only what can be done here" in scene.closing
    assert scene.root.locator(".ab-line").count() == 4
    assert scene.violations() == []
    assert scene.problems == []


def test_by_keyboard_alone_to_the_end(show, race):
    scene = show(race, color_scheme="dark")
    keyboard, seen = scene.page.keyboard, []
    for _ in range(30):
        keyboard.press("Tab")
        focus = "document.activeElement"
        label = f"({focus}.ariaLabel || {focus}.value || {focus}.innerText)"
        seen.append(str(scene.page.evaluate(label)))
        if seen[-1] == "Next event":
            keyboard.press("Enter")
        if scene.page.evaluate(f"{focus}.closest('.ab-bet') !== null"):
            keyboard.press("ArrowDown")
            scene.settle()
        if "million steps" in seen[-1]:
            keyboard.press("Enter")
            break
    scene.wait("They reached")

    assert scene.slider("Step").input_value() == "76"
    assert "You bet on" in scene.closing
    scene.wait("You bet on", "[role=status]")


def test_an_own_policy_races_too(show):
    tasks = target_tasks(Race().problem)
    wise = tasks.possible * 1.0
    wise[:, :4] *= 9  # labels that head to the goal
    wise /= wise.sum(axis=1, keepdims=True)
    race = Race(steps=SHORT, policy=wise, tau=6_000_000)
    scene = show(race).bet("yours")
    learned(scene)

    run = python_run(race, "yours", tau=6e6, policy=wise)
    assert scene.column("yours") == run.goals.tolist()
    assert "yours" in race.still().caption


def test_an_address_runs_the_race_and_a_reset_clears_it(show, race):
    scene = show(race, "#race.full=true&race.t=5").wait("They reached")
    assert scene.slider("Step").input_value() == "5"
    scene.button("Reset").click()
    scene.settle()

    assert scene.closing == ""
    assert scene.slider("Step").input_value() == "39"
    scene.page.wait_for_function("!location.hash.includes('race')")
    assert not scene.button("million steps").is_visible()


def test_ends_of_sliders_and_quick_changes(show, race):
    scene = show(race).bet("ND")
    luck = scene.slider("Luck")
    for slider in (scene.slider("Step"), luck):
        for end in ("min", "max"):
            slider.fill(slider.get_attribute(end))
            scene.settle()
    scene.button("million steps").click()
    for value in ["7", "50", "3", "20", "4"]:
        luck.fill(value)
    scene.settle()
    assert scene.is_idle(), "a change of luck stops the runs"
    learned(scene)

    other = Race(steps=SHORT, luck=4)
    wanted = python_run(other, "nd", tau=TAU["nd"]).goals.tolist()
    assert scene.column("ND") == wanted
    assert scene.problems == []


# Two presses of one button, some pictures apart.
STOPPED = """async (button) => {
    button.click();
    for (let i = 0; i < 4; i++) await new Promise(requestAnimationFrame);
    button.click();
}"""


def test_a_stopped_race_goes_on_to_the_same_end(show, race, runs):
    scene = show(race).bet("Prob")
    scene.button("million steps").evaluate(STOPPED)
    scene.settle()
    again = scene.root.locator(".ab-primary:visible", has_text="Go on").or_(
        scene.button("million steps")
    )
    if again.count():  # a short race may have been over
        again.first.click()
    scene.wait("They reached")

    for name, run in runs.items():
        assert scene.column(NAMES[name]) == run.goals.tolist()


def test_a_double_click_begins_a_race_and_does_not_stop_it(show, race):
    scene = show(race).bet("Prob")
    scene.button("million steps").dblclick()

    assert "They reached" in scene.wait("They reached").closing


def test_leaving_while_it_learns_ends_the_workers(show):
    scene = show(Race(), "#race.full=true")
    scene.page.wait_for_function("document.querySelector('.ab-chart .ab-line')")
    assert len(scene.page.workers) == 4
    scene.bet("ND").button("Stop").click()
    scene.settle()
    assert scene.is_idle()
    assert scene.root.locator(".ab-line").count() == 4, "what was learned stays"
    assert scene.root.get_by_text("Stopped after").is_visible()
    scene.button("Go on").click()
    scene.wait_for_worker()
    scene.page.goto("about:blank")

    assert scene.is_idle()
    assert scene.problems == []


def test_on_a_phone_with_little_motion(show, race):
    options = {"color_scheme": "dark", "reduced_motion": "reduce"}
    scene = show(race, width=400, **options).bet("ND")
    learned(scene)

    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert scene.small_controls() == []
    assert scene.violations() == []


def test_a_step_moves_the_robots_and_paints_no_building(show, race):
    scene = show(race)

    assert max(scene.writes_by_moves(".ab-timeline input", 100)) < 100
    assert race.map.n_cells > 500
