"""
All scenes in three browser engines: they live, and say the same to the digit.

From a file; with SERVED in the environment, as in ``make test-browsers``, from a server
too.
"""

import os
from urllib.parse import quote

import pytest
from engines import ENGINES
from scene_tab import PAGE, bare, scripts
from support import PATIENCE, served

from abstransfer.scenes import KINDS
from abstransfer.scenes import files as front

SHORT = {"steps": 600_000, "bet": "skip"}
# In which a scene closes soon; one that never does is not here.
STATES = {
    "ballot": {"bet": "skip", "bet_more": "skip"},
    "dial": SHORT,
    "filling": {"bet": "skip", "signed": 10},
    "hill": {"bet": "skip", "t": 300, "earlier": [[0.9, 0.9]]},
    "ladder": {"order": "skip", "gap": "skip"},
    "microscope": {"bet": "skip", "t": 300},
    "paint": {"bet": "skip", "bet_new": "skip"},
    "project": {"bet": "skip", "lives": 1},
    "race": {**SHORT, "full": True, "t": 1000},
    "ripple": {"bet": "skip", "ties": "skip", "arrows": True},
    "studio": {"bet": "skip", "show": "grad"},
    "tau": {**SHORT, "all": True},
}
# What starts something: a button of the scene, by the begin of its name.
PRESSED = {"dial": "Let β = 1", "project": "Race", "ripple": "To the end"}
ASKED = [PRESSED, list(STATES)]
# Press, wait until all have closed, and return all that is said: by scene.
READ = """async ([pressed, closing]) => {
    const scenes = [...document.querySelectorAll(".abstransfer-scene")];
    const drawn = async () => {
        for (const _ of [1, 2]) await new Promise(requestAnimationFrame);
    };
    // A table is written when its details say that they are open, some time later.
    const open = (details) => new Promise((f) => {
        if (details.open) return f();
        details.addEventListener("toggle", f, { once: true });
        details.open = true;
    });
    const nameOf = (button) => button.getAttribute("aria-label") ?? button.textContent;
    const press = (scene, name) => {
        const of = (each) => nameOf(each).startsWith(name);
        const button = [...scene.querySelectorAll("button")].find(of);
        if (button?.getAttribute("aria-disabled") === "true") return false;
        button?.click();
        return Boolean(button);
    };
    const isBusy = (scene) =>
        closing.includes(scene.dataset.scene) &&
        (scene.querySelector(".ab-closing")?.hidden ?? true);
    const waiting = { ...pressed };
    const end = Date.now() + 600_000;
    const left = () => scenes.filter((scene) => isBusy(scene) || /…|Stop \\(/.test(
        scene.querySelector(".ab-body").textContent));
    do {
        for (const [name, button] of Object.entries(waiting)) {
            const scene = document.querySelector(`[data-scene="${name}"]`);
            if (press(scene, button)) delete waiting[name];
        }
        await new Promise((f) => setTimeout(f, 100));
        await drawn(); // or what was closed before a press would count
    } while ((left().length || Object.keys(waiting).length) && Date.now() < end);
    await Promise.all([...document.querySelectorAll(".ab-twin")].map(open));
    await drawn();
    const said = scenes.map((scene) => {
        const body = scene.querySelector(".ab-body").cloneNode(true);
        body.querySelectorAll("svg, option").forEach((each) => each.remove());
        const rows = [...scene.querySelectorAll(".ab-twin tr")].map((row) =>
            [...row.cells].map((cell) => cell.textContent).join(" | "));
        const end = scene.querySelector(".ab-closing").textContent;
        const isLive = scene.matches(".ab-live");
        return [scene.dataset.scene, [isLive, body.textContent, end, ...rows]];
    });
    const busy = left().map((scene) => scene.dataset.scene);
    return { busy, ...Object.fromEntries(said) };
}"""


pytestmark = pytest.mark.timeout(900)  # all that scenes compute, at once


ORIGINS = ["file", "http"] if os.environ.get("SERVED") else ["file"]


@pytest.fixture(scope="module", params=ORIGINS)
def address(request, tmp_path_factory):
    """A page with all scenes."""
    body = "".join(bare(kind, **STATES.get(name, {})) for name, kind in KINDS.items())
    page = tmp_path_factory.mktemp("engines") / "all scenes, ünï #1 100%.html"
    page.write_text(
        PAGE.format(style=front.style(), scripts=scripts(body), scene=body),
        encoding="utf-8",
    )
    if request.param == "file":
        yield page.as_uri()
    else:
        with served(page.parent) as host:
            yield f"{host}/{quote(page.name)}"


@pytest.fixture(scope="module")
def in_chromium(address, chromium):
    page = chromium.new_page()
    page.set_default_timeout(1000 * PATIENCE)
    page.goto(address)
    found = page.evaluate(READ, ASKED)
    page.close()
    return found


def test_each_scene_comes_to_its_end(in_chromium):
    assert in_chromium["busy"] == []
    for name in KINDS:
        is_live, _, closing, *rows = in_chromium[name]
        assert is_live
        assert bool(closing) or name not in STATES
        assert len(rows) > 1 or name == "surgery"  # waits for a robot to operate on


@pytest.mark.parametrize("name", ENGINES)
def test_an_engine_says_the_same(address, in_chromium, tmp_path, name):
    engine = ENGINES[name]
    if engine.missing():
        pytest.skip(f"{name} is not installed; run: make test-browsers")
    browser = engine(tmp_path)
    try:
        browser.open(address)
        found = browser.ask(READ, ASKED)
    finally:
        browser.close()

    assert found["busy"] == []
    for scene in KINDS:
        assert found[scene] == in_chromium[scene], scene
