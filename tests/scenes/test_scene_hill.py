"""Climbing with two knobs: land, climbs and ends are Python's; mouse and keyboard."""

import json

import numpy as np
import pytest
from scene_tab import bare, number
from support import ROOT
from traitlets import TraitError

from abstransfer.builders.deduced import absprob_pi, abstract_gradient
from abstransfer.scenes.hill.still import RING
from abstransfer.scenes.hill.widget import HALL, LAST, RHO, STARTS, Hill, advice

LAND = "(probe.land)"


@pytest.fixture
def hill(show):
    return show(bare(Hill))


def to_the_end(scene, bet="not always"):
    scene.bet(bet).click("To the end")
    return scene.wait("the climb ends", ".ab-closing")


def drop(scene, p, q):
    """Click on the land."""
    box = scene.root.locator(".ab-lowland").bounding_box()
    x, y = box["x"] + p * box["width"], box["y"] + (1 - q) * box["height"]
    scene.page.mouse.click(x, y)
    return scene.settle()


def shown(x, digits=2):
    return f"{x:.{digits}f}".replace("-", "\u2212")


def knobs(scene):
    return [float(scene.slider(f"Start: {name}").input_value()) for name in "pq"]


# Python


def test_the_problem_is_the_one_that_page_6_defines():
    page_6 = (ROOT / "book" / "06_deducing.ipynb").read_text(encoding="utf-8")
    cells = json.loads(page_6)["cells"]
    code = next("".join(c["source"]) for c in cells if "hall = at.MDP" in str(c))
    here = {}
    exec("import numpy as np\nimport abstransfer as at\n" + code, here)

    for name in ("next_state", "prob", "reward", "terminal", "gamma"):
        np.testing.assert_array_equal(getattr(here["hall"], name), getattr(HALL, name))
    assert here["rho"].tolist() == RHO.tolist()
    np.testing.assert_array_equal(here["advice"](0.2, 0.7), advice(0.2, 0.7))


@pytest.mark.parametrize("start", STARTS)
def test_the_still_picture_states_the_finding(start):
    scene = Hill(start=start)
    still = scene.still()
    options = {"initial": advice(0.3, 0.3), "start": np.array(STARTS[start])}
    climb = absprob_pi(HALL, RHO, np.ones((3, 2), bool), **options)

    assert len(set(still.frames)) == 3
    both = Hill(start=start, earlier=[[0.2, 0.6]]).still()
    assert [frame.count(RING) for frame in both.frames] == [1, 2, 2]
    assert f"from {shown(climb.history[0])} to {shown(climb.history[-1])}" in (
        still.caption
    )
    assert f"Of 100 starts, {scene.ends.sum()} end at left and up" in still.caption
    assert still.rows[-1][1:3] == tuple(shown(x, 3) for x in climb.policy[:2, 0])
    best = max(scene.value(p, q) for p in (0, 0.5, 1) for q in (0, 0.5, 1))
    assert f"best is worth {shown(best)}" in still.caption


# The page's numbers are Python's


@pytest.mark.parametrize("start", STARTS)
def test_land_slopes_climbs_and_ends_are_pythons(hill, start):
    starts = [(0.3, 0.3), (0.2, 0.6), (0.93, 0.34), (1, 0), (0, 0)]
    heights, ways, sides, later = hill.ask(
        f"""([start, starts]) => {{
            const {{ heights, climb, sides, LAST }} = {LAND};
            const ends = [];
            for (const _ of sides(start, ends));
            return [heights(start), starts.map((knobs) => climb(...knobs, start)),
                ends.map(({{ isLeft }}) => isLeft),
                ends.map(({{ p, q }}) => climb(p, q, start).at(-1).p > 0.5)];
        }}""",
        [start, starts],
    )
    scene = Hill(start=start)
    for i in (0, 7, 40, 41 * 17 + 9, 41 * 40, 41 * 41 - 1):
        wanted = scene.value(i % 41 / 40, i // 41 / 40)
        assert heights[i] == pytest.approx(wanted, abs=1e-9)
    for (p, q), way in zip(starts, ways, strict=True):
        here = Hill(start=start, p=p, q=q)
        history = [each["value"] for each in way]
        np.testing.assert_allclose(history, here.climb().history, atol=1e-9)
        for t in (0, 1, 2, 5, LAST):
            policy = here.climb(t).policy
            at = way[t]["p"], way[t]["q"]
            np.testing.assert_allclose(at, policy[:2, 0], atol=1e-9)
            _, slope, _ = abstract_gradient(HALL, policy, RHO, np.array(STARTS[start]))
            up = slope[:2, 0] - slope[:2, 1]
            np.testing.assert_allclose(way[t]["up"], up, atol=1e-7)
    assert sides == scene.ends.ravel().tolist()
    assert sides == later, "who is on a side after 30 iterations stays there"
    assert len(set(sides)) == 2


def test_shades_and_contours_lie_where_the_land_is_as_high(hill):
    wrong, checked, cuts, labels = hill.ask(
        f"""() => {{
            const {{ heights, region, labels, value, LEVELS, N }} = {LAND};
            const land = heights("both");
            const draw = document.createElement("canvas").getContext("2d");
            let [wrong, checked] = [0, 0];
            const cuts = [];
            for (const level of LEVELS) {{
                const {{ fill, rim }} = region(land, level);
                const path = new Path2D(fill);
                for (let i = 0; i < N * N; i++) {{
                    const [x, y] = [i % N, Math.floor(i / N)];
                    const first = y * (N + 1) + x;
                    const corners = [0, 1, N + 1, N + 2].map((k) => land[first + k]);
                    const isHigh = corners.every((h) => h >= level);
                    if (!isHigh && corners.some((h) => h >= level)) continue;
                    checked++;
                    if (draw.isPointInPath(path, x + 0.5, y + 0.5) !== isHigh) wrong++;
                }}
                const at = (a, b) => land[Math.min(b, N) * (N + 1) + Math.min(a, N)];
                for (const [, a, b] of rim.matchAll(/([\\d.]+) ([\\d.]+)/g)) {{
                    const [x, y] = [Number(a), Number(b)];
                    const [i, j] = [Math.floor(x), Math.floor(y)];
                    const slope = (x > i ? at(i + 1, j) : at(i, j + 1)) - at(i, j);
                    const h = at(i, j) + (x > i ? x - i : y - j) * slope;
                    cuts.push(Math.abs(h - level) / (Math.abs(slope) || 1));
                }}
            }}
            return [wrong, checked, cuts,
                labels("hall").map((o) => [value(o.p, o.q, "hall"), o.level])];
        }}"""
    )

    assert wrong == 0
    assert checked > 10_000
    assert len(cuts) > 300
    assert max(cuts) < 0.006, "places are written with two decimals"
    assert len(labels) > 6
    np.testing.assert_allclose(*np.array(labels).T, rtol=0.02)


def test_the_table_and_the_words_follow_the_time_line(hill):
    scene = Hill()
    for t in (5, 0, 1, 80, LAST):
        hill.slider("Iteration").fill(str(t))
        hill.settle()
        _, _, lines = hill.table()
        policy, history = scene.climb(t).policy, scene.climb().history
        assert len(lines) == t + 1
        found = [number(x) for x in lines[-1]]
        np.testing.assert_allclose(found, [t, *policy[:2, 0], history[t]], atol=1e-6)
        assert f"This advice is worth {shown(history[t])}" in hill.root.inner_text()
    assert hill.problems == []


# By mouse and by keyboard


def test_climbs_from_where_a_click_drops_them(hill):
    assert not hill.root.get_by_role("checkbox").is_visible()
    for p, q in ((0.7, 0.6), (0.2, 0.6), (0.93, 0.34)):
        drop(hill, p, q)
    np.testing.assert_allclose(knobs(hill), (0.93, 0.34), atol=0.011)
    to_the_end(hill, "always on the same")
    hill.root.get_by_role("checkbox").check()
    hill.settle()
    scene = Hill(p=knobs(hill)[0], q=knobs(hill)[1])

    assert (
        "\u201calways on the same\u201d; it was \u201cnot always\u201d" in hill.closing
    )
    assert f"worth {shown(scene.climb().history[-1])} after 300" in hill.closing
    assert "best advice is worth \u22121.99" in hill.closing
    assert f"{scene.ends.sum()} end at left and up" in hill.closing
    assert "Of your 4 climbs, 3 end at left and up." in hill.closing
    dashes = hill.root.locator(".ab-climb").evaluate_all(
        "all => all.map(path => path.getAttribute('stroke-dasharray'))"
    )
    assert len(dashes) == len(set(dashes)) == 4
    assert dashes[-1] is None
    marks = hill.root.locator(".ab-leftside, .ab-rightside").evaluate_all(
        "all => all.map(path => path.getAttribute('d').split('M').length - 1)"
    )
    assert marks == [scene.ends.sum(), 100 - scene.ends.sum()]
    settled = int(hill.closing.split("from iteration ")[1].split()[0])
    apart = abs(scene.climb().history - scene.climb().history[-1])
    assert (apart[settled:] <= 0.1).all()
    assert apart[settled - 1] > 0.1
    assert hill.violations() == []
    hill.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    assert hill.settle().violations() == []

    hill.root.get_by_text("on the right landing", exact=True).click()
    hill.wait("12 end at left and up", ".ab-closing")
    hill.button("Forget the earlier").click()
    hill.settle()
    assert hill.root.locator(".ab-climb").count() == 1
    assert "Of your" not in hill.closing
    assert hill.problems == []


def test_by_keyboard_alone_to_the_end(show):
    options = {"reduced_motion": "reduce", "color_scheme": "dark", "width": 400}
    scene = show(bare(Hill), **options)
    assert not scene.plays
    assert scene.slider("Iteration").input_value() == "5", "nothing plays by itself"
    scene.root.get_by_role("radio", name="not always").focus()
    scene.press("Space", "Tab")
    assert scene.focused.startswith("The land of values")
    scene.press(*["ArrowRight"] * 8, *["ArrowUp"] * 5)
    scene.wait(
        f"p 0.70, q 0.55: worth {shown(Hill(p=0.7, q=0.55).value())}", ".ab-said"
    )
    assert scene.root.locator(".ab-cross").count() == 1
    scene.press("Enter")
    assert knobs(scene) == [0.7, 0.55]
    for _ in range(12):
        scene.press("Tab")
        if scene.focused == "To the end":
            scene.press("Enter")
            break
    scene.wait("You bet on", ".ab-closing")

    assert "\u201cnot always\u201d: right." in scene.closing
    assert "From p = 0.70, q = 0.55 the climb ends at left and up" in scene.closing
    assert scene.root.locator(".ab-cross").count() == 0
    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert scene.small_controls() == []
    assert scene.violations() == []
    assert scene.problems == []


# State


def test_a_moment_has_an_address_and_a_reset(show):
    query = "#hill.p=0.2&hill.q=0.6&hill.t=300&hill.earlier=[[0.7,0.6]]&hill.start=both"
    scene = show(bare(Hill), query)
    wanted = Hill(p=0.2, q=0.6, start="both").climb().history[-1]
    assert f"This advice is worth {shown(wanted)}" in scene.root.inner_text()
    assert scene.root.locator(".ab-climb").count() == 2
    drop(scene, 0.5, 0.9)
    scene.url_with("0.2%2C0.6")
    scene.button("Reset").click()
    scene.page.wait_for_function("!location.hash.includes('hill')")
    assert knobs(scene) == [0.3, 0.3]

    scene.go("#hill.p=9&hill.t=x&hill.start=y&hill.earlier=[1,[2],[3,4]]")
    assert knobs(scene) == [1, 0.3]
    assert scene.root.locator(".ab-climb").count() == 1
    assert scene.problems == []


def test_ends_of_sliders_quick_changes_and_what_they_draw_anew(hill):
    for label in ("Start: p", "Start: q", "Iteration"):
        for value in ("min", "max", "min"):
            slider = hill.slider(label)
            slider.fill(slider.get_attribute(value))
            hill.settle()
            assert slider.input_value() == slider.get_attribute(value)
    hill.slider("Start: q").evaluate(
        "(e, values) => { for (const v of values) { e.value = v;"
        " e.dispatchEvent(new Event('input')); } }",
        ["0.9", "0.1", "0.5", "0", "0.62"],
    )
    hill.settle()
    _, _, (line,) = hill.table()
    assert line == ["0", "0.000000", "0.620000", shown(Hill(p=0, q=0.62).value(), 6)]
    hill.root.locator("summary").click()

    for label, step in (("Start: p", 0.1), ("Iteration", 30)):
        hill.slider(label).evaluate(
            "(e, id) => { e.id = id; }", f"s{step}".replace(".", "")
        )
        moves = hill.writes_by_moves(f"#s{step}".replace(".", ""), step)
        assert max(moves) < 70, "the land stays"
    for start in ("on the right landing", "in either, equally often", "in the hall"):
        before = hill.root.locator(".ab-land g").first.inner_html()
        hill.root.get_by_text(start, exact=True).click()
        hill.settle()
        now = hill.root.locator(".ab-land g").first.inner_html()
        assert now != before, "drawn anew, and at once"
    assert hill.problems == []


def test_a_wrong_value_is_refused():
    for name, wrong in {"p": 1.1, "start": "roof", "t": 301}.items():
        with pytest.raises(TraitError, match=f"'?{name}'? trait .*{wrong}"):
            Hill(**{name: wrong})
    assert repr(Hill(q=0.5, start="both")) == "Hill(q=0.5, start='both')"


def test_a_click_beside_the_land_does_nothing(hill):
    box = hill.root.locator(".ab-lowland").bounding_box()
    y = box["y"] + box["height"]
    for dx, dy in [(0.5, 20), (0.5, 32), (1.2, -40)]:  # ticks, an axis, the scale
        hill.page.mouse.click(box["x"] + dx * box["width"], y + dy)
    hill.settle()

    assert not hill.button("Forget the earlier climbs").is_visible()
    assert hill.slider("Start: q").input_value() == "0.3"
    drop(hill, 0.5, -0.01)  # a little below: its border
    assert hill.slider("Start: q").input_value() == "0"


def test_a_bet_is_answered_before_the_climb_is_over(hill):
    hill.bet("not always").wait("Of 100 starts", ".ab-closing")

    assert "right" in hill.closing
    assert "the climb ends" not in hill.closing
