"""A worker that the page loses while it learns: every number stays what it was."""

import re

import pytest
from run_scenes import Shown
from scene_tab import bare

from abstransfer.scenes import Dial, Project, Race, TauSlider

STEPS = 600_000
SKIP = "I do not bet: show me"
# The first message that the page does not hear any more, and what it hears instead.
LOSING = """
window.nLost = 0;
window.Worker = class extends Worker {{
  set onmessage(hear) {{
    super.onmessage = (event) => {{
      if (this.isLost) return;
      const {{ i, q }} = event.data;
      this.isLost = {when};
      if (!this.isLost) return hear(event);
      nLost++;
      this.terminate();
      this.onerror(new ErrorEvent("error"));
    }};
  }}
}};
"""
WHEN = {
    "before its first window": "i === 0",
    "after half its windows": "i === {half}",
    "while it sends its values": "q",
}


def race(tab):
    return tab.wait("They reached", ".ab-closing")


def tau(tab):
    tab.rows()
    tab.page.wait_for_function(  # until all three runs are in the table
        "() => { const cells = [...document.querySelectorAll('.ab-twin td')];"
        " return cells.length === 3 * 60 && cells.every(c => c.textContent !== '–'); }"
    )
    return tab


def dial(tab):
    tab.bet(SKIP).click(re.compile("^Let β = .* teach"))
    return tab.wait("Taught by it, a robot reaches")


def project(tab):
    tab.bet(SKIP).click(re.compile("^Race: "))
    return tab.wait("with the same luck", ".ab-closing")


CASES = {
    "race": (Race, {"full": True, "steps": STEPS}, race, 30),
    "tau": (TauSlider, {"steps": STEPS}, tau, 30),
    "dial": (Dial, {"steps": STEPS}, dial, 30),
    "project": (Project, {"lives": 1}, project, 5),
}


@pytest.mark.parametrize("name", CASES)
def test_a_lost_worker_changes_no_number(open_scene, name):
    kind, options, learn, half = CASES[name]
    html = bare(kind, **options)
    wanted = learn(Shown(open_scene(html).visit)).table()

    for when in WHEN.values():
        losing = LOSING.format(when=when.format(half=half))
        tab = learn(Shown(open_scene(html, first=losing).visit))
        assert tab.page.evaluate("nLost") > 0
        assert tab.table() == wanted
        assert tab.problems == []
