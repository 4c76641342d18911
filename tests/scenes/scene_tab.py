"""A page that holds one scene, opened from a file with the network cut."""

import re
from functools import cache
from pathlib import Path

import pytest
from legible import faults, pale
from support import Visit

from abstransfer.scenes import KINDS, Filling, bundle
from abstransfer.scenes import files as front
from abstransfer.scenes.parts.student import STUDENT

PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>A scene</title>
<meta name="viewport" content="width=device-width"><style>{style}</style></head>
<body><main><h1>A scene</h1>{scene}</main>{scripts}</body></html>"""
# Nobody looks, so nothing is painted: all else is as it is for a reader.
UNPAINTED = "body { opacity: 0; }"
PROBE = Path(__file__).parent / "js" / "probe.js"
# Two pictures, and more while a scene works at what it is to show first.
SETTLED = """async () => {
    const isAtWork = ({ textContent }) => textContent === "Sweeping \u2026";
    do {
        await new Promise((f) => requestAnimationFrame(() => requestAnimationFrame(f)));
    } while ([...document.querySelectorAll(".ab-body > p")].some(isAtWork));
}"""
# A clock that the test turns, for what plays: `pass(700)`.
CLOCK = """() => {
    const beats = new Map();
    let [now, n] = [0, 0];
    performance.now = () => now;
    window.setInterval = (act, every) => {
        beats.set(++n, { act, every, at: now + every });
        return n;
    };
    window.clearInterval = (id) => beats.delete(id);
    window.pass = (time) => {
        const end = now + time;
        for (;;) {
            const [next] = [...beats.values()].sort((a, b) => a.at - b.at);
            if (!next || next.at > end) break;
            now = next.at;
            next.at += next.every;
            next.act();
        }
        now = end;
    };
}"""
# Counts the workers that a page begins, in `nWorkers`.
COUNTED = """
window.nWorkers = 0;
window.Worker = class extends Worker {
  constructor(...all) {
    super(...all);
    nWorkers++;
  }
};
"""
GO = """(hash) => new Promise((f) => {
    addEventListener("hashchange", f, { once: true });
    location.hash = hash;
})"""

# What an act costs a reader's machine, in a measure that all machines agree on: how
# many nodes and attributes of the scene are written until two pictures later.
WRITTEN = """async (acts) => {
    const pictures = () =>
        new Promise((f) => requestAnimationFrame(() => requestAnimationFrame(f)));
    let n = 0;
    const observer = new MutationObserver((records) => {
        for (const { addedNodes, removedNodes } of records)
            n += Math.max(addedNodes.length + removedNodes.length, 1);
    });
    const all = { attributes: true, characterData: true, childList: true };
    const root = document.querySelector(".abstransfer-scene");
    observer.observe(root, { ...all, subtree: true });
    // What an earlier act left to a timer, such as the names of all cells, comes first.
    for (let turn = 0; turn < 30; turn++) {
        n = 0;
        await new Promise((f) => setTimeout(f, 20));
        if (n) turn = 0;
    }
    const counts = [];
    for (const act of acts) {
        n = 0;
        act();
        await pictures();
        counts.push(n);
    }
    observer.disconnect();
    return counts;
}"""
MOVES = """([slider, step]) => [1, 2, 3, 4, 5, 6, 7, 8, 9].map((i) => () => {
    const input = document.querySelector(slider);
    input.value = step * i;
    input.dispatchEvent(new Event("input"));
})"""
AT_ONCE = """(name) => {
    const div = document.body.appendChild(document.createElement("div"));
    div.className = "abstransfer-scene";
    const { leave } = said[name].mount(div);
    const n = div.querySelectorAll(".ab-body *").length;
    leave();
    return [n, div.childNodes.length];
}"""


# States in which scenes learn least.
SHORT = {"steps": 600_000}
QUICK = {"dial": SHORT, "race": SHORT, "tau": SHORT, "project": {"lives": 1}}


class SceneTab:
    """A scene as a reader handles it."""

    def __init__(self, visit):
        self.visit, self.page = visit, visit.page
        self.root = self.page.locator(".abstransfer-scene")
        self.grid = self.root.locator(".ab-building")

    @property
    def problems(self):
        return self.visit.problems

    def is_idle(self, *seconds):
        return self.visit.is_idle(*seconds)

    def settle(self):
        self.page.evaluate(SETTLED)
        return self

    def go(self, hash_):
        """Follow a link to another moment of the scene."""
        self.page.evaluate(GO, hash_)
        return self.settle()

    def wait_for_worker(self):
        while not self.page.workers:
            self.page.wait_for_timeout(20)
        return self

    @property
    def plays(self):
        """Whether the time line goes on by itself."""
        return self.root.get_by_role("button", name="Pause").count() > 0

    def pictures(self, n):
        """What the scene holds in each of some pictures: one, if nothing moves."""
        nameless = "[role=gridcell]:not([aria-label])"  # until a scene rests
        self.page.wait_for_function(f"!document.querySelector('{nameless}')")
        seen = set()
        for _ in range(n):
            seen.add(self.settle().root.inner_html())
        return seen

    def ask(self, code, *arguments):
        """Evaluate code that looks at parts of the front end, in `probe`."""
        self.page.evaluate(probe())
        return self.page.evaluate(code, *arguments)

    def click(self, name):
        self.root.get_by_role("button", name=name).click()
        return self.settle()

    def pick(self, group, text):
        inside = self.root.get_by_role("group", name=group)
        inside.get_by_text(text, exact=True).click()
        return self.settle()

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)
        return self.settle()

    def cell(self, number):
        return self.root.locator(f'[data-cell="{number}"]')

    def click_cell(self, number, x=0.5, y=0.5):
        """Click in a cell, x and y in shares of its width and height."""
        box = self.cell(number).bounding_box()
        self.page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])
        return self.settle()

    def focus_grid(self):
        self.grid.locator('[tabindex="0"]').focus()
        return self

    @property
    def focused(self):
        """The name of what has the focus."""
        return self.page.evaluate(
            "(e => e.getAttribute('aria-label') || e.textContent)"
            "(document.activeElement)"
        )

    @property
    def closing(self):
        return self.root.locator(".ab-closing").inner_text()

    def rows(self):
        """The table of numbers, by the text in its first column."""
        twin = self.root.locator(".ab-twin")
        if twin.get_attribute("open") is None:
            twin.locator("summary").click()
        self.settle()
        return self.page.evaluate(
            "() => Object.fromEntries("
            "[...document.querySelectorAll('.ab-twin tbody tr')]"
            ".map(row => [...row.cells].map(cell => cell.textContent))"
            ".map(([name, ...rest]) => [name, rest]))"
        )

    def writes(self, acts, *arguments):
        """How much is written by each of some acts: code that returns functions."""
        code = f"(argument) => ({WRITTEN})(({acts})(argument))"
        return self.page.evaluate(code, *arguments)

    def writes_by_moves(self, slider, step):
        """How much is written by each of nine moves of a slider."""
        return self.writes(MOVES, [slider, step])

    def nodes_at_once(self, name):
        """How many nodes a scene has as soon as it is mounted, and when it is left."""
        return self.page.evaluate(AT_ONCE, name)

    def url_with(self, part):
        self.page.wait_for_function("part => location.hash.includes(part)", arg=part)
        return self.page.url[self.page.url.index("#") :]

    def violations(self):
        """What is wrong; in the dark only colours are others."""
        self.page.evaluate("document.body.style.opacity = 1")
        found = faults(self.page, ".abstransfer-scene")
        self.page.evaluate("document.documentElement.dataset.theme = 'dark'")
        found += pale(self.page, ".abstransfer-scene")
        self.page.evaluate("delete document.documentElement.dataset.theme")
        self.page.evaluate("document.body.style.opacity = ''")
        return found

    def small_controls(self):
        """Controls that are less than 24 px wide or high."""
        return self.root.locator(
            "button, input, select, summary, textarea"
        ).evaluate_all(
            "all => all.map(e => [e.outerHTML, (e.closest('label') ?? e)"
            ".getBoundingClientRect()]).filter(([, box]) => box.width)"
            ".filter(([, box]) => box.width < 24 || box.height < 24)"
        )


def scripts(body):
    """The scripts of the scenes in a page; what Python said to each is in `said`."""
    names = sorted(set(re.findall(r'data-scene="(\w+)"', body)))
    texts = [
        f"<script>said.{name} = {front.said(spec=KINDS[name].spec())};"
        f"((python) => {{\n{front.script(name)}}})(said.{name});</script>"
        for name in names
    ]
    return "<script>const said = {};</script>" + "".join(texts)


@cache
def probe():
    """A script that puts parts of the front end into the object `probe` of a page."""
    scenes = KINDS["hill"].spec() | KINDS["microscope"].spec()
    spec = scenes | {"student": STUDENT}
    said = front.said(spec=spec, isWidget=True)
    worker = f"python.worker = (self) => {{\n{front.bundled('worker')}}};\n"
    return f"((python) => {{\n{worker}{bundle.bundle_one(PROBE)}}})({said})"


@pytest.fixture
def open_scene(tabs, tmp_path):
    """
    Open a page with a scene: ``open_scene(widget, width=400, query="#...")``.

    ``first`` is a script that runs before the scene's.
    """

    def open_page(widget, query="", first="", **looks):
        return opened(tabs.lend(tmp_path, **looks), widget, query, first)

    return open_page


@pytest.fixture(scope="module")
def all_scenes(chromium, tmp_path_factory):
    """A page with all scenes, which no test touches."""
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    visit = Visit(context)
    visit.folder = tmp_path_factory.mktemp("scenes")
    yield opened(visit, "".join(map(quick, KINDS)))
    context.close()


def opened(visit, widget, query="", first=""):
    """Open a page with a scene, or with what holds some, in a tab."""
    body = widget if isinstance(widget, str) else widget.html()
    html = PAGE.format(
        style=front.style() + UNPAINTED,
        scripts=f"<script>{first}</script>{scripts(body)}",
        scene=body,
    )
    (visit.folder / "scene.html").write_text(html, encoding="utf-8")
    visit.open("scene", query)
    visit.page.wait_for_selector(".ab-live")
    return SceneTab(visit).settle()


def bare(kind, **options):
    """Return what a scene mounts on, without its still picture: quick."""
    scene = kind(**options)
    scene.still = lambda: _Nothing()
    found = scene.options() if kind is Filling else scene.changed  # it needs results
    scene.options = lambda: found
    return scene.html()


def quick(name):
    """Return what a scene mounts on, with little to learn."""
    return bare(KINDS[name], **QUICK.get(name, {}))


class _Nothing:
    def html(self):
        return ""


def number(text):
    """Return the number that a scene prints."""
    return float(text.replace("\u2212", "-").replace(",", ""))
