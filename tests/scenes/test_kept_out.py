"""All scenes from a server that forbids things: each lives, or says it does not."""

from html import escape

import pytest
from scene_tab import PAGE, bare
from support import PATIENCE, served

from abstransfer.scenes import KINDS
from abstransfer.scenes import files as front

STATES = {"tau": {"steps": 600_000}}
WORD = "A picture of the scene: its script does not run here."
# What stands after a scene once its wait is over, by scene.
SAID = """() => Object.fromEntries(
    [...document.querySelectorAll(".abstransfer-scene")].map((scene) => {
        scene.getAnimations({ subtree: true }).forEach((each) => each.finish());
        const { content, visibility } = getComputedStyle(scene, "::after");
        return [scene.dataset.scene, visibility === "visible" ? content : "none"];
    }))"""
# What a scene that learns at once says when it has learned.
LEARNED = """() => {
    const said = document.querySelector('[data-scene="tau"]').textContent;
    return /[\\d,]+ goals if it decides.*?\\(soft\\)/.exec(said)?.[0];
}"""


def write(folder, names, without):
    """Write a page with scenes, its scripts and style beside it, but for some."""
    folder.mkdir()
    kinds = {name: KINDS[name] for name in names}
    body = "".join(bare(kind, **STATES.get(name, {})) for name, kind in kinds.items())
    names = [f"{name}.js" for name in kinds]
    page = PAGE.format(
        style="",
        scene=f'<link rel="stylesheet" href="scenes.css">{body}',
        scripts="".join(f'<script src="{escape(name)}"></script>' for name in names),
    )
    texts = {"index.html": page, "scenes.css": front.style()}
    texts |= {f"{n}.js": front.page_script(n, kind.spec()) for n, kind in kinds.items()}
    for name, text in texts.items():
        if name not in without:
            (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture
def opened(chromium, tmp_path):
    """Open a page with scenes: ``opened(policy, names, without)``."""
    pages = []

    def open_(policy="", names=tuple(KINDS), without=()):
        page = chromium.new_page()
        pages.append(page)
        page.set_default_timeout(1000 * PATIENCE)
        folder = write(tmp_path / f"{len(pages)}", names, without)
        with served(folder, policy) as host:
            page.goto(f"{host}/index.html")
        return page

    yield open_
    for page in pages:
        page.close()


@pytest.mark.parametrize("why", ["the policy", "missing files"])
def test_a_scene_whose_script_does_not_run_says_so(opened, why):
    if why == "the policy":
        page = opened("script-src 'none'")
    else:
        page = opened(without=[f"{name}.js" for name in KINDS])

    assert page.locator(".ab-live").count() == 0
    assert page.evaluate(SAID) == dict.fromkeys(KINDS, f'"{WORD}"')


def test_one_missing_script_keeps_one_scene_still(opened):
    page = opened(names=["hill", "ripple"], without=["hill.js"])

    assert page.evaluate(SAID) == {"hill": f'"{WORD}"', "ripple": "none"}
    assert page.locator(".ab-live").count() == 1


def test_where_workers_are_forbidden_all_scenes_live_and_learn_the_same(opened):
    policy = "default-src 'self'; worker-src 'self'"
    free, kept = opened(names=["tau"]), opened(policy)
    assert kept.locator(".ab-live").count() == len(KINDS)

    said = free.wait_for_function(LEARNED).json_value()
    assert kept.wait_for_function(LEARNED).json_value() == said
