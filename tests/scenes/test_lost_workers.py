"""A worker that the page loses while it learns: every number stays what it was."""

import re
from pathlib import Path

import pytest
from run_scenes import Shown
from scene_tab import bare
from support import PATIENCE

from abstransfer import scenes
from abstransfer.scenes import Dial, Project, Race, Surgery, TauSlider, Whisper

STEPS = 600_000
OPERATION = {"patient": "nd", "operation": "erase"}
SKIP = "I do not bet: show me"
# A page that seldom draws: how a scene looks while it learns is not asked here.
SELDOM = """
window.requestAnimationFrame = (draw) => setTimeout(draw, 100);
window.cancelAnimationFrame = clearTimeout;
"""
# `losing` tells the first message of a worker that the page does not hear any more.
LOSING = """
window.losing = () => false;
window.nLost = 0;
window.Worker = class extends Worker {
  set onmessage(hear) {
    super.onmessage = (event) => {
      if (this.isLost) return;
      this.isLost = losing(event.data);
      if (!this.isLost) return hear(event);
      nLost++;
      this.terminate();
      this.onerror(new ErrorEvent("error"));
    };
  }
};
"""
WHEN = {
    "before its first window": "({ i }) => i === 0",
    "after half its windows": "({ i }) => i === HALF",
    "while it sends its values": "({ q }) => q",
}
# Mounts the scene again in the place of itself; its workers are lost as told.
AGAIN = """([html, when]) => {
    [losing, nLost] = [eval(when), 0];
    sessionStorage.clear();
    const old = document.querySelector(".abstransfer-scene");
    old.outerHTML = html;
    const scene = document.querySelector(".abstransfer-scene");
    const { scene: name, options } = scene.dataset;
    said[name].mount(scene, JSON.parse(options ?? "{}"), { url: false });
}"""


def race(tab):
    return tab.wait("They reached", ".ab-closing")


def tau(tab):
    tab.wait("if ever less often (soft).", ".ab-body > p")
    for _ in range(10 * PATIENCE):  # until all three runs are in the table
        _, head, lines = tab.table()
        if len(head) == 1 + 3 and "–" not in f"{lines}":
            break
        tab.page.wait_for_timeout(100)
    return tab


def dial(tab):
    tab.bet(SKIP).click(re.compile("^Let β = .* teach"))
    return tab.wait("Taught by it, a robot reaches")


def project(tab):
    tab.bet(SKIP).click(re.compile("^Race: "))
    return tab.wait("with the same luck", ".ab-closing")


def surgery(tab):
    tab.bet("some of it").button("Operate").click()
    return tab.wait("goals after the advice.", ".ab-body > p")


def whisper(tab):
    tab.bet("more goals than ND's advice").button("Whisper, and").click()
    return tab.wait("goals. Choose another", ".ab-body > p")


CASES = {
    "race": (Race, {"full": True, "steps": STEPS}, race, 30),
    "tau": (TauSlider, {"steps": STEPS}, tau, 30),
    "dial": (Dial, {"steps": STEPS}, dial, 30),
    "project": (Project, {"lives": 1}, project, 5),
    "surgery": (Surgery, {"steps": STEPS, **OPERATION}, surgery, 20),
    "whisper": (Whisper, {"steps": STEPS}, whisper, 30),
}


def told(tab):
    """Return all numbers that a scene shows, those of the result card as well."""
    card = tab.root.locator("textarea[aria-label='The result card as text']")
    return tab.table(), card.count() and card.input_value()


def test_each_scene_that_learns_is_tried():
    learns = re.compile(r"\bscene\.learn\(")
    folders = Path(scenes.__file__).parent.glob("[a-z]*/")
    assert {
        folder.name
        for folder in folders
        if any(learns.search(path.read_text("utf-8")) for path in folder.glob("*.js"))
    } - {"ui", "_bundles"} == set(CASES)


@pytest.mark.parametrize("name", CASES)
def test_a_lost_worker_changes_no_number(open_scene, name):
    kind, options, learn, half = CASES[name]
    html = bare(kind, **options)
    tab = learn(Shown(open_scene(html, first=SELDOM + LOSING).visit))
    wanted = told(tab)

    for when in WHEN.values():
        tab.page.evaluate(AGAIN, [html, when.replace("HALF", f"{half}")])
        assert told(learn(tab)) == wanted
        assert tab.page.evaluate("nLost") > 0
        assert tab.problems == []
