"""Addresses that ask a scene for what it cannot show, and steps back in the history."""

import os
import random

import pytest
from scene_tab import bare, quick

from abstransfer.scenes import KINDS, Microscope, Race

NO_GOAL = "+---+\n|   |\n+---+"
ODD = {  # by what a field holds: what an address may ask for
    "flag": ["maybe", "[]"],
    "whole": ["1.5", "-7", "1e9", "[1]", "none"],
    "number": ["1e-300", "Infinity", "[]"],
    "choice": ["constructor", "[]"],
    "text": ["", "no map", "[" * 50_000],
    "map": [
        "no map",
        NO_GOAL,
        "+---+\n|\t *|\n+---+",
        "+---+\n|  *|\n+--",
        "*" * 1_000_000,
    ],
    "list": ["[1]", "{}", "nd"],
    "json": ["[[0.5, 0.5, 0.5]]", "[null, 1]", "{}", "[" * 50_000],
}
# States that are drawn, for each scene; in the night: make nightly
N = int(os.environ.get("DISTURBANCES", 4))
AT_ONCE = 10  # scenes on a page
# Mount the scene in some odd states at once, where they have a place and no picture;
# what is wrong then, if anything.
TRY = """async ([name, cases]) => {
    const wrong = [];
    const texts = cases.map((odd) =>
        Object.entries(odd).map((each) => `${each}`.slice(0, 40)).join("&"));
    const complain = ({ message }) => {
        if (!message.startsWith("ResizeObserver loop")) wrong.push([texts, message]);
    };
    addEventListener("error", complain);
    const mounted = cases.map((odd, i) => {
        const div = document.body.appendChild(document.createElement("div"));
        div.className = "abstransfer-scene";
        div.style.visibility = "hidden";
        try {
            const { leave } = said[name].mount(div, odd, { url: false });
            return [div, leave];
        } catch (error) {
            wrong.push([texts[i], `${error}`]);
            return [div, () => {}];
        }
    });
    await new Promise(requestAnimationFrame);
    await new Promise(requestAnimationFrame);
    mounted.forEach(([div, leave], i) => {
        if (!div.matches(".ab-live")) wrong.push([texts[i], "it does not live"]);
        leave();
        div.remove();
    });
    removeEventListener("error", complain);
    return wrong;
}"""


def drawn(rng, fields):
    """Return an odd state: some fields, with values of any kind, or of no kind."""
    few = rng.sample(fields, min(len(fields), rng.randint(1, 3)))
    values = [odd for odds in ODD.values() for odd in odds if len(odd) < 1000]
    letters = '0123456789.-+e[]{}",: |*d\n%_x'
    values += ["".join(rng.choices(letters, k=rng.randrange(12))) for _ in values]
    return {field: rng.choice(values) for field in few}


@pytest.mark.timeout(1200 + 30 * N)
@pytest.mark.parametrize("name", KINDS)
def test_no_odd_value_of_any_field_stops_a_scene(open_scene, name):
    tab = open_scene(quick(name))
    fields = {
        of: field["kind"]
        for of, field in KINDS[name].spec()["fields"].items()
        if not (field["isLocal"] and field["kind"] == "json")  # no part of an address
    }
    cases = [{of: odd} for of, kind in fields.items() for odd in ODD[kind]]
    rng = random.Random(f"{name} {N}")
    cases += [drawn(rng, list(fields)) for _ in range(N)]

    assert len(cases) > N
    for i in range(0, len(cases), AT_ONCE):
        assert tab.page.evaluate(TRY, [name, cases[i : i + AT_ONCE]]) == []
    assert tab.problems == []


# A scene that starts with n = start, and fails, built or drawn, where n is 5.
FAILS = """([at, start, options]) => {
    const fail = (state) => { if (state.n === 5) throw new Error("five"); };
    const spec = {
        title: "A test",
        fields: { n: { start, kind: "whole", bounds: [0, 9], isLocal: false } },
        state: { n: start },
        limits: { n: [0, 9] },
        local: [],
        build(scene) {
            scene.onLeave(() => left++);
            if (at === "build") fail(scene.state);
            scene.add(scene.slider("n", { label: "Number" }));
            return fail;
        },
    };
    const div = document.body.appendChild(document.createElement("div"));
    div.id = "fails";
    window.left = 0;
    try {
        window.fails = probe.mount(div, "fails", spec, options);
        return "";
    } catch (error) {
        return error.message;
    }
}"""


@pytest.mark.parametrize(
    "asked", ["by the page, built", "by the page, drawn", "by an address"]
)
def test_a_state_in_which_a_scene_fails_gives_the_start_and_a_sentence(
    open_scene, asked
):
    query = "#fails.n=5" if asked == "by an address" else ""
    tab = open_scene(bare(Microscope), query=query)
    options = {} if query else {"n": 5}
    at = "build" if "built" in asked else "draw"
    assert tab.ask(FAILS, [at, 3, options]) == ""
    tab.settle()

    root = tab.page.locator("#fails")
    sentence = "What was asked for cannot be shown: the scene began at its start."
    assert root.locator(".ab-scene").count() == 1
    assert root.get_by_role("slider").input_value() == "3"
    assert root.get_by_text(sentence).first.is_visible()
    assert tab.page.evaluate("left") == 1, "what was half built is gone"
    root.get_by_role("button", name="Reset").click()
    tab.settle()
    assert not root.locator(".ab-now").is_visible()
    assert tab.problems == []


def test_a_scene_that_fails_at_its_start_leaves_nothing(open_scene):
    tab = open_scene(bare(Microscope))

    assert tab.ask(FAILS, ["draw", 5, {}]) == "five"
    assert tab.page.locator("#fails > *").count() == 0
    assert tab.page.locator("#fails").get_attribute("data-ab-id") is None
    assert tab.problems == []


@pytest.mark.parametrize("name", ["race", "ballot", "ripple", "tau"])
def test_a_map_that_is_none_leaves_the_start_and_a_sentence(open_scene, name):
    tab = open_scene(quick(name), query=f"#{name}.map=no%20map")
    warning = tab.root.locator(".ab-body").locator("xpath=preceding-sibling::p")

    assert warning.inner_text().startswith("“map” stays as it was: ")
    assert tab.problems == []


def test_the_first_address_of_a_page_restores_the_start(open_scene):
    tab = open_scene(bare(Microscope))
    slider = tab.root.get_by_role("slider", name="Step")
    tab.page.evaluate("location.hash = '#microscope.t=150&microscope.luck=7'")
    tab.page.wait_for_function("document.querySelector('[type=range]').value === '7'")
    assert slider.input_value() == "150"

    tab.page.go_back()
    tab.page.wait_for_function("document.querySelector('[type=range]').value === '4'")
    assert slider.input_value() == "111"


def test_a_link_within_the_page_leaves_a_scene_as_it_is(open_scene):
    tab = open_scene(bare(Race), query="#race.t=77")
    tab.page.evaluate("location.hash = '#a-scene'")
    tab.settle()

    assert tab.root.get_by_role("slider", name="Step").input_value() == "77"
