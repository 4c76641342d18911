"""
What a screen reader meets in each scene, from its start to its end.

The accessibility tree of Chromium as text, one file a scene in `tests/golden/spoken/`,
to be read by a person.  ``SPOKEN=write python -m pytest tests/scenes/test_spoken.py``
writes them anew.
"""

import os
from pathlib import Path

import pytest
from scene_tab import bare, opened
from support import Visit

from abstransfer.scenes import KINDS

FOLDER = Path(__file__).parents[1] / "golden" / "spoken"
SILENT = {"none", "generic", "InlineTextBox", "ListMarker", "LabelText", "Legend"}
STATES = ("checked", "disabled", "expanded", "readonly")
# All scenes at rest: all is solved that is solved by itself, and all cells have a name.
REST = """async () => {
    const main = document.querySelector("main");
    const isBusy = () => /…|Learning:|Grad climbs|climbing:/.test(main.textContent) ||
        main.querySelector("[role=gridcell]:not([aria-label])");
    let last = performance.now();
    const all = { attributes: true, characterData: true, childList: true };
    new MutationObserver(() => last = performance.now())
        .observe(main, { ...all, subtree: true });
    while (performance.now() < last + 1000 || isBusy())
        await new Promise((f) => setTimeout(f, 100));
}"""


VALUES = "all => all.map((each) => each.getAttribute('aria-valuetext'))"


def told(nodes, title, values):
    """
    Return the tree of a scene as lines: role, name, value and states, indented.

    `values` are those of its sliders, in their order, as they are said.
    """
    values = iter(values)
    by_id = {node["nodeId"]: node for node in nodes}
    root = next(
        node
        for node in nodes
        if node["role"]["value"] == "region"
        and node.get("name", {}).get("value", "") == title
    )
    lines = []

    def children(node):
        return [by_id[i] for i in node.get("childIds", ()) if i in by_id]

    def cells(node):
        role = node["role"]["value"]
        if role == "gridcell":
            return [node["name"]["value"]]
        return [name for child in children(node) for name in cells(child)]

    def visit(node, depth):
        role = node["role"]["value"]
        name = node.get("name", {}).get("value", "")
        properties = {
            each["name"]: each["value"].get("value")
            for each in node.get("properties", ())
        }
        value = node.get("value", {}).get("value", "")
        value = next(values) if role == "slider" else value
        isaloud = not node["ignored"] and role not in SILENT
        if isaloud and (name or value or role not in ("paragraph", "StaticText")):
            words = [role, f"“{name}”" if name else "", f"= {value}" if value else ""]
            words += [
                state
                for state in STATES
                if properties.get(state, False) not in (False, "false")
            ]
            line = "  " * depth + " ".join(filter(None, words))
            is_label = role == "StaticText" and lines and f"“{name}”" in lines[-1]
            if not is_label:
                lines.append(line)
        if role in ("grid", "image", "slider", "combobox"):
            all_names = cells(node)
            if all_names:
                lines.append("  " * (depth + 1) + f"{len(all_names)} cells, as")
                lines.extend("  " * (depth + 2) + f"“{each}”" for each in all_names[:3])
            return
        for child in children(node):
            inner = child["role"]["value"] == "StaticText"
            if inner and name == child.get("name", {}).get("value", ""):
                continue  # the name of a control, once
            visit(child, depth + isaloud)

    visit(root, 0)
    return "\n".join(lines) + "\n"


@pytest.fixture(scope="module")
def spoken(chromium, tmp_path_factory):
    """By scene what is met, all on one page."""
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    visit = Visit(context)
    visit.folder = tmp_path_factory.mktemp("scenes")
    learns = {
        name: {"steps": 600_000} if "steps" in kind.state_names() else {}
        for name, kind in KINDS.items()
    }
    body = "".join(bare(KINDS[name], **options) for name, options in learns.items())
    page = opened(visit, body).page
    page.evaluate(REST)
    session = context.new_cdp_session(page)
    session.send("Accessibility.enable")
    nodes = session.send("Accessibility.getFullAXTree")["nodes"]
    found = {}
    for name in KINDS:
        scene = page.locator(f'[data-scene="{name}"]')
        title = scene.locator(".ab-scene").first.get_attribute("aria-label")
        values = scene.locator("[type=range]:visible").evaluate_all(VALUES)
        found[name] = told(nodes, title, values)
    yield found
    context.close()


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.timeout(900)
def test_what_a_screen_reader_meets_is_as_it_was_read(spoken, name):
    found = spoken[name]
    path = FOLDER / f"{name}.txt"
    if os.environ.get("SPOKEN") == "write":
        path.parent.mkdir(exist_ok=True)
        path.write_text(found, encoding="utf-8", newline="\n")
    assert found == path.read_text(encoding="utf-8")
