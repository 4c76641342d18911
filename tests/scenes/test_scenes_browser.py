"""Scenes on a built page: from files, without a network, by mouse and by keyboard."""

import json
import re

import numpy as np
import pytest
from legible import faults, pale
from scene_tab import CLOCK, SETTLED, bare, probe

from abstransfer import maps, navigation, scenes
from abstransfer.learning import q_learning
from abstransfer.scenes.microscope.widget import BET, STARTS, STEPS, TWO_ROOMS


class Microscope:
    """The first scene of a page, as a reader handles it."""

    def __init__(self, tab, which=0):
        self.tab, self.page = tab, tab.page
        self.root = self.page.locator(".abstransfer-scene").nth(which)

    def settle(self):
        self.page.evaluate(SETTLED)
        return self

    def click(self, name):
        self.root.get_by_role("button", name=name, exact=True).click()
        return self.settle()

    def pick(self, group, text):
        inside = self.root.get_by_role("group", name=group)
        inside.get_by_text(text, exact=True).click()
        return self.settle()

    def pass_time(self, milliseconds):
        """Turn the clock of the page, once it is `CLOCK`."""
        self.page.evaluate("time => pass(time)", milliseconds)
        return self.settle()

    @property
    def slider(self):
        return self.root.get_by_role("slider", name="Step")

    @property
    def step(self):
        return int(self.slider.input_value())

    @property
    def closing(self):
        return self.root.locator(".ab-closing")

    def rows(self):
        """The table of numbers, opened: its caption, and its lines as text."""
        details = self.root.locator("details")
        if details.get_attribute("open") is None:
            details.locator("summary").click()
        self.settle()
        cells = details.locator("tbody tr").evaluate_all(
            "lines => lines.map(({ cells }) => [...cells].map(c => c.innerText))"
        )
        return details.locator("caption").inner_text(), cells


@pytest.fixture
def microscope(at_scenes):
    return Microscope(at_scenes())


def python_trace(map_=TWO_ROOMS, start="goal", luck=4, task=0, n=STEPS):
    reward, q0, _ = STARTS[start]
    tasks = navigation.navigation_tasks(
        maps.parse_map(map_), reward=reward, keep=[task]
    )
    return q_learning(tasks.mdp, n, rng=luck, q0=q0, trace=n)


def shown(x, digits=6):
    return f"{x:.{digits}f}".replace("-", "\u2212").replace(
        "\u22120.000000", "0.000000"
    )


def assert_rows_are_those_of(trace, rows, t):
    for row, i in zip(rows, range(t - 1, -1, -1), strict=False):
        assert row[0] == str(i + 1)
        assert row[6:] == [shown(trace.before[i]), shown(trace.after[i])]
    assert len(rows) == min(t, 40)


# What Python and the page say


def test_every_step_is_the_one_that_python_takes(microscope):
    buildings = {"two rooms": TWO_ROOMS, "the source": str(maps.read_map("source"))}
    microscope.click("To the end")
    for which, text in buildings.items():
        microscope.pick("Building", which)
        for start, (_, _, words) in STARTS.items():
            microscope.pick("Reward and first values", words)
            _, rows = microscope.rows()
            assert_rows_are_those_of(python_trace(text, start).trace, rows, STEPS)
    assert microscope.tab.problems == []


def test_the_engine_takes_the_same_steps_to_the_bit(microscope):
    microscope.page.evaluate(probe())
    found = microscope.page.evaluate(
        """([text, start]) => {
            const { parseMap, take } = probe;
            const map = parseMap(text);
            const { steps } = take(map, { start, task: 1, luck: 9 }, 300);
            return steps.map(({ s, a, next, reward, before, after }) =>
                [s, a, next, reward, before, after]);
        }""",
        [TWO_ROOMS, "cost"],
    )
    trace = python_trace(start="cost", luck=9, task=1).trace
    wanted = np.column_stack(
        [trace.state, trace.action, trace.next_state, *trace[4:7]]
    ).tolist()

    assert found == wanted


def test_the_closing_sentence_counts_as_python_does(microscope):
    assert microscope.closing.is_hidden()
    microscope.pick(re.compile("^Bet first"), STARTS["cost"][2])
    text = microscope.closing.inner_text()

    for start in STARTS:
        cells = []
        for luck in range(1, 21):
            trace = python_trace(start=start, luck=luck, n=BET).trace
            cells.append(len({*trace.state, *trace.next_state}))
        assert f"{np.mean(cells):.1f} ({STARTS[start][2]})" in text
    assert text.startswith(f"You bet on \u201c{STARTS['cost'][2]}\u201d: right.")


def test_a_rule_from_python_is_shown(at_scenes):
    scene = Microscope(at_scenes(), 2).click("To the end")
    html = scene.root.get_attribute("data-options")
    _, rows = scene.rows()

    last = json.loads(html)["trace"][-1]
    assert rows[0][6:] == [shown(last[5]), shown(last[6])]
    assert "your rule" in scene.root.locator(".ab-equation").inner_text()


# By mouse and by keyboard


def test_steps_are_taken_and_taken_back(microscope):
    seen = []
    for name in ["One step back", "One step", "One step back", "One step"]:
        microscope.click(name)
        seen.append(
            (microscope.step, microscope.root.locator(".ab-equation").inner_text())
        )

    assert [t for t, _ in seen] == [110, 111, 110, 111]
    assert seen[0] == seen[2]
    assert seen[1] == seen[3]
    assert "0.1000" in seen[1][1]


def test_by_keyboard_alone_to_the_end(microscope):
    page = microscope.page
    microscope.root.get_by_role("radio", name="two rooms").focus()
    reached = []
    for _ in range(25):
        page.keyboard.press("Tab")
        name = page.evaluate(
            "(e => e.getAttribute('aria-label') || e.name || e.id || e.textContent)"
            "(document.activeElement)"
        )
        reached.append(name)
        kind = page.evaluate("document.activeElement.type ?? ''")
        if name == "To the end":
            page.keyboard.press("Enter")
        if kind == "radio" and page.evaluate(
            "document.activeElement.closest('.ab-bet') !== null"
        ):
            page.keyboard.press("ArrowDown")
            break
    microscope.settle()

    assert len({n for n in reached if "row " in n}) == 1, reached
    assert microscope.step == STEPS
    assert "cells" in microscope.closing.inner_text()
    assert microscope.tab.problems == []


def test_arrow_keys_walk_the_grid_and_choose_a_goal(microscope):
    page, view = microscope.page, microscope.root.locator(".ab-building")
    view.locator('[tabindex="0"]').focus()
    for key in ["ArrowDown", "End", "ArrowLeft"]:
        page.keyboard.press(key)
    place = page.evaluate("document.activeElement.getAttribute('aria-label')")
    page.keyboard.press("Enter")
    microscope.settle()
    page.keyboard.press("?")

    assert place.startswith("row 2, column 5: ")
    assert "goal" in place
    assert view.locator(".ab-goal:not(.ab-othergoal)").count() == 1
    assert microscope.root.locator(".ab-keys").is_visible()
    assert "microscope.task=1" in wait_for_url(page, "task=1")
    assert view.locator('[tabindex="0"]').count() == 1


def test_a_click_chooses_a_goal(microscope):
    microscope.root.locator('[data-cell="10"]').click()
    microscope.settle()

    assert_rows_are_those_of(python_trace(task=1).trace, microscope.rows()[1], 111)


def test_play_and_pause(microscope):
    microscope.page.evaluate(CLOCK)
    microscope.click("To the start").click("Play").pass_time(1000)
    assert microscope.step == 8, "steps a second"
    microscope.click("Pause").pass_time(9000)

    assert microscope.step == 8


def test_a_reset_ends_playing(microscope):
    microscope.click("To the start").click("Play").click("Reset")
    microscope.root.get_by_role("button", name="Play", exact=True).wait_for()

    assert microscope.step == 111


# State


def wait_for_url(page, part):
    page.wait_for_function("part => location.hash.includes(part)", arg=part)
    return page.url


def test_a_moment_has_an_address(at_scenes):
    first = Microscope(at_scenes())
    first.slider.fill("200")
    first.pick("Reward and first values", STARTS["cost"][2])
    url = wait_for_url(first.page, "start=cost")

    second = Microscope(at_scenes(query=url[url.index("#") :]))
    other = Microscope(second.tab, 1)
    assert second.step == 200
    assert other.step == 20, "two scenes on one page do not share their state"
    assert second.rows() == first.rows()

    second.click("Reset")
    assert second.step == 111
    second.page.wait_for_function("!location.hash.includes('microscope.t=')")


# The test says when a scene writes its address.
LATE = """window.late = [];
const later = window.setTimeout;
window.setTimeout = (act, pause, ...rest) =>
    pause === 400 ? (late.push(act), 0) : later(act, pause, ...rest);"""


def test_a_link_is_followed_even_as_the_scene_writes_its_address(open_scene):
    tab = open_scene(bare(scenes.Hill), first=LATE)
    step = tab.root.get_by_role("slider", name="Iteration")
    step.fill("7")
    tab.page.wait_for_function("late.length")
    write = "late.splice(0).forEach((act) => act())"
    tab.page.evaluate(f"() => {{ location.hash = '#hill.t=3'; {write}; }}")
    tab.settle()
    assert step.input_value() == "3"
    tab.page.evaluate(write)
    assert tab.page.url.endswith("#hill.t=3")


def test_two_kinds_of_scenes_on_a_page_bring_a_script_each(at_scenes):
    tab = at_scenes("two", query="#hill.t=20&microscope.t=30&hill-2.t=40")
    page = tab.page
    page.wait_for_function("document.querySelectorAll('.ab-live').length === 3")
    scripts = page.evaluate(
        "[...document.scripts].map(s => s.src.match(/scenes\\/(\\w+)\\.js/)?.[1])"
    )
    ids = page.evaluate("[...document.querySelectorAll('[id^=ab-]')].map(e => e.id)")
    names = page.evaluate(
        "[...document.querySelectorAll('[type=radio]')].map(e => e.name)"
    )

    assert sorted(filter(None, scripts)) == ["hill", "microscope"]
    assert len(ids) == len({*ids}) == 8
    assert not {*ids} & {*names}
    for scene, name, step in (("hill", "Iteration", 20), ("hill-2", "Iteration", 40)):
        root = page.locator(f"[data-ab-id={scene}]")
        assert root.get_by_role("slider", name=name).input_value() == str(step)
    scene = Microscope(tab, 1)
    assert scene.step == 30
    scene.slider.fill("31")
    url = wait_for_url(page, "microscope.t=31")
    assert "hill.t=20" in url
    assert "hill-2.t=40" in url
    assert tab.problems == []


@pytest.mark.parametrize(
    "query", ["#microscope.t=abc", "#microscope.t=1e9", "#microscope.start=x", "#a"]
)
def test_a_wrong_address_does_no_harm(at_scenes, query):
    scene = Microscope(at_scenes(query=query))

    assert scene.step in (111, STEPS)
    assert scene.tab.problems == []


def test_ends_of_sliders_and_quick_changes(microscope):
    luck = microscope.root.get_by_role("slider", name="Luck")
    for slider in (microscope.slider, luck):
        for value in ("min", "max"):
            slider.fill(slider.get_attribute(value))
            microscope.settle()
            assert slider.input_value() == slider.get_attribute(value)
    for value in ["7", "99", "3", "50", "8"]:  # five in a row, within one picture
        luck.evaluate(
            "(e, v) => { e.value = v; e.dispatchEvent(new Event('input')); }", value
        )
    microscope.settle()

    assert_rows_are_those_of(python_trace(luck=8).trace, microscope.rows()[1], STEPS)
    assert microscope.tab.problems == []


# Looks


@pytest.mark.parametrize(("color_scheme", "wrong"), [("light", faults), ("dark", pale)])
def test_scenes_are_accessible(at_scenes, color_scheme, wrong):
    """In the dark only colours are others."""
    scene = Microscope(at_scenes(color_scheme=color_scheme))
    scene.pick(re.compile("^Bet first"), STARTS["cost"][2]).rows()
    scene.page.evaluate("document.body.style.opacity = 1")

    assert wrong(scene.page, "[data-ab-id=microscope]") == []


def test_a_phone_and_a_change_of_theme_while_playing(at_scenes):
    scene = Microscope(at_scenes()).click("Play")
    ground = (
        "getComputedStyle(document.querySelector('.abstransfer-scene')).backgroundColor"
    )
    before = scene.page.evaluate(ground)
    scene.page.set_viewport_size({"width": 400, "height": 800})
    scene.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    scene.settle()

    assert scene.page.evaluate(ground) != before
    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert scene.root.get_by_role("button", name="Pause").is_visible()
    small = scene.root.locator("button, input, select, summary").evaluate_all(
        "all => all.filter(e => e.checkVisibility())"
        ".map(e => (e.closest('label') ?? e).getBoundingClientRect())"
        ".filter(box => box.width < 24 || box.height < 24).length"
    )
    assert small == 0
    assert scene.tab.problems == []


def test_less_motion_means_slow_steps_and_nothing_glides(at_scenes):
    scene = Microscope(at_scenes(reduced_motion="reduce"))
    assert scene.step == 111
    scene.root.get_by_role("button", name="Play", exact=True).wait_for()
    robot = scene.root.locator(".ab-robot")
    assert robot.evaluate("e => getComputedStyle(e).transitionDuration") == "0s"

    scene.root.get_by_role("combobox", name="Speed").select_option("30")
    scene.page.evaluate(CLOCK)
    scene.click("Play").pass_time(900)
    assert scene.step == 112, "a step every half second, not 30 a second"
    assert scene.pass_time(5000).step == 122


def test_the_still_picture_is_for_print_and_without_script(at_scenes):
    tab = at_scenes()
    still = tab.page.locator(".ab-still").first
    assert still.is_hidden()
    tab.page.emulate_media(media="print")
    assert still.locator("svg:visible").count() == 3
    assert tab.page.locator(".ab-scene:visible").count() == 0
    tab.page.emulate_media(media="null")

    page = tab.page.context.browser.new_page(java_script_enabled=False)
    page.goto(tab.page.url)
    assert page.locator(".ab-still").first.locator("svg:visible").count() == 1
    assert (
        "Q-learning, one step at a time"
        in page.locator("figcaption").first.inner_text()
    )
    scene = page.locator(".abstransfer-scene").first
    word = scene.evaluate("scene => getComputedStyle(scene, '::after').content")
    assert "its script does not run here" in word
    page.close()


# Workers


LEARN = """() => {
    const at = probe;
    const spec = {
      title: "A test",
      fields: { n: { start: 0, kind: "whole", bounds: [0, 9], isLocal: false } },
      state: { n: 0 },
      limits: { n: [0, 9] },
      local: [],
      build(scene) {
        const map = at.parseMap(at.mapTexts.target);
        const world = at.makeWorld(at.navigationTasks(map, { reward: "goal" }));
        const axes = { x: { label: "window" }, y: { label: "goals" } };
        const chart = at.lineChart({ label: "goals", ...axes });
        const points = (window.points = []);
        scene.add(chart.node);
        const job = { world, guide: null, rule: {}, seed: 1, steps: 30e6, window: 1e5 };
        const onWindow = (_, i, goals) => points.push([i, goals]);
        window.job = scene.learn([job], { onWindow });
        const curve = { name: "Q-learning", arm: "none", points };
        return () => chart.set({ curves: [curve] });
      },
    };
    const div = document.body.appendChild(document.createElement("div"));
    div.className = "abstransfer-scene";
    window.mounted = at.mount(div, "test", spec);
}"""


def test_curves_grow_and_leaving_stops_the_worker(at_scenes):
    tab = at_scenes()
    tab.page.evaluate(probe())
    tab.page.evaluate(LEARN)
    tab.page.wait_for_function("points.length > 3")
    tab.page.evaluate(SETTLED)
    assert tab.page.locator(".ab-chart .ab-line").count() == 1
    assert tab.page.evaluate("mounted.scene.isLearning")
    assert len(tab.page.workers) == 1
    tab.page.evaluate("mounted.leave()")

    assert tab.page.evaluate("job.finished") is False
    assert tab.page.locator(".ab-chart").count() == 0
    assert tab.is_idle()

    tab.page.evaluate(LEARN)
    tab.page.wait_for_function("points.length > 3")
    tab.page.goto("about:blank")
    assert tab.is_idle()
    assert tab.problems == []
