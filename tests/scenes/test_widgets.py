"""Scenes as widgets: what they print, what they show, what they accept."""

import json
import re

import numpy as np
import pytest
import traitlets
from bs4 import BeautifulSoup
from support import ROOT

from abstransfer import maps, scenes
from abstransfer.learning import q_learning
from abstransfer.scenes import Microscope, bundle
from abstransfer.scenes import files as front
from abstransfer.scenes.base import VIEW
from abstransfer.scenes.microscope.widget import STARTS, STEPS, own_trace

SCENES = [
    getattr(scenes, name)
    for name in scenes.__all__
    if getattr(getattr(scenes, name), "scene", "")
]


def parsed(scene):
    return BeautifulSoup(scene.html(), "html.parser")


# Every scene


@pytest.mark.parametrize("kind", SCENES)
def test_a_scene_shows_itself_with_defaults_only(kind):
    data = kind()._repr_mimebundle_()

    assert data["text/plain"] == f"{kind.__name__}()"
    assert set(data) == {"text/plain", "text/html", VIEW}
    assert data["text/html"] == kind().html(), "the same bytes every time"
    most = 50_000 if kind.__name__ == "Sights" else 40_000  # what all cells see
    assert len(data["text/html"]) < most


@pytest.mark.parametrize("kind", SCENES)
def test_a_scene_says_without_script_what_it_finds(kind):
    soup = parsed(kind())
    (root,) = soup.find_all(class_="abstransfer-scene")
    pictures = root.find_all("svg")

    assert root["data-scene"] == kind.scene
    assert set(json.loads(root["data-options"])) <= set(kind.defaults())
    assert len(pictures) == 3
    assert all(len(svg["aria-label"]) >= 20 for svg in pictures)
    assert any(char.isdigit() for char in root.find("figcaption").get_text())
    assert len(root.find_all("tr")) >= 2
    assert not root.find_all(id=True), "ids of two scenes on a page would clash"


@pytest.mark.parametrize("kind", SCENES)
def test_a_scene_refuses_what_it_does_not_have(kind):
    with pytest.raises(ValueError, match="speed must be one of .*, which a"):
        kind(speed=3)


@pytest.mark.parametrize("kind", SCENES)
def test_a_widget_brings_all_it_needs(kind):
    state = kind().get_state()

    assert state["_esm"] == front.module(kind.scene, kind.spec())
    assert not re.search(r"^\s*import\b", state["_esm"], re.MULTILINE)
    hosts = set(re.findall(r"https?://[^/\s\"']*", state["_esm"]))
    assert hosts == {"http://www.w3.org"}, "a name of SVG, and nothing is loaded"
    assert set(kind.defaults()) <= set(state)


# The front end


def test_without_bundles_a_widget_says_what_to_do(monkeypatch):
    def build():
        raise bundle.BundleError("there is no deno")

    monkeypatch.setattr(front, "is_fresh", lambda: False)
    monkeypatch.setattr(front, "digest", lambda: "of sources without bundles")
    monkeypatch.setattr(front, "build", build)

    script = scenes.Race().get_state()["_esm"]
    assert "run: python -m abstransfer.scenes.bundle (there is no deno)" in script
    assert "export default { render:" in script
    with pytest.raises(bundle.BundleError, match="must be bundled anew"):
        front.page_script("race", scenes.Race.spec())


def test_a_changed_source_is_bundled_anew_once(monkeypatch, tmp_path):
    monkeypatch.setattr(bundle, "FOLDER", tmp_path)
    monkeypatch.setattr(bundle, "BUNDLES", tmp_path / "_bundles")
    monkeypatch.setattr(bundle, "WORKER", tmp_path / "worker.js")
    (tmp_path / "one").mkdir()
    source = tmp_path / "one" / "one.js"
    source.write_text("console.log(1 + python.n);", encoding="utf-8")
    (tmp_path / "worker.js").write_text("self.onmessage = () => {};", encoding="utf-8")

    assert bundle.scenes() == ["one"]
    assert bundle.build()
    halfway = tmp_path / "_bundles" / "of_another_process"
    halfway.mkdir()
    (halfway / "one.js").write_text("", encoding="utf-8")
    assert not bundle.build()
    source.write_text("console.log(2 + python.n);", encoding="utf-8")
    assert not bundle.is_fresh()
    assert bundle.build()
    assert "2+python.n" in (tmp_path / "_bundles" / "one.js").read_text(
        encoding="utf-8"
    )


def test_a_script_that_cannot_be_bundled_is_named(tmp_path):
    wrong = tmp_path / "wrong.js"
    wrong.write_text("import { x } from './nowhere.js';", encoding="utf-8")

    with pytest.raises(bundle.BundleError, match="nowhere.js"):
        bundle.bundle_one(wrong)


def test_every_colour_that_is_used_is_defined():
    used = set()
    for path in [*bundle.sources(), *bundle.FOLDER.glob("**/*.css")]:
        used |= {
            part.split(")")[0].split(",")[0]
            for part in path.read_text(encoding="utf-8").split("var(")[1:]
        }
    style = front.style()
    own = {'--ab-arm-${builder in palette.arms ? builder : "none"}'}

    missing = {
        name for name in used - own if f"{name}:" not in style and "$" not in name
    }
    set_by_scripts = {
        "--ab-columns",
        "--ab-rows",
        "--ab-min",
        "--ab-part",
        "--ab-hue",
        "--ab-bar",
    }
    assert missing <= set_by_scripts


# Traits


def test_a_map_may_be_named_drawn_or_given():
    source = maps.read_map("source")

    assert Microscope(map="source").map == source
    assert Microscope(map=str(source)).map == source
    scene = Microscope(map=source)
    assert scene.get_state()["map"] == str(source)
    assert "Map(9 x 15 cells" in repr(scene)
    scene.set_state({"map": "+---+\n|  *|\n+---+"})  # as the browser does
    assert scene.map == maps.parse_map("+---+\n|  *|\n+---+")
    with pytest.raises(ValueError, match="no goal"):
        scene.map = "+---+\n|   |\n+---+"


def test_an_array_is_a_list_in_the_browser():
    class Holder(traitlets.HasTraits):
        policy = scenes.ArrayTrait()

    holder = Holder()
    heard = []
    holder.observe(lambda change: heard.append(change["new"].tolist()), "policy")
    holder.policy = [[0, 1]]
    holder.policy = np.array([[0, 1]])  # the same: nobody is told
    holder.policy = [[1, 0]]

    assert heard == [[[0.0, 1.0]], [[1.0, 0.0]]]
    to_json = Holder.policy.metadata["to_json"]
    assert to_json(holder.policy) == [[1.0, 0.0]]


def test_state_that_differs_goes_to_the_page():
    scene = Microscope(start="cost", t=20)

    assert repr(scene) == "Microscope(start='cost', t=20)"
    assert scene.changed == {"start": "cost", "t": 20}
    assert json.loads(parsed(scene).div["data-options"]) == scene.changed
    scene.t = 111
    assert scene.changed == {"start": "cost"}


@pytest.mark.parametrize("wrong", [{"t": 301}, {"start": "x"}, {"luck": 0}])
def test_a_wrong_value_is_refused(wrong):
    with pytest.raises(traitlets.TraitError):
        Microscope(**wrong)


# The microscope with a rule of the reader's own


def eq_1(q, s, a, r, s_next, alpha, gamma):
    return (1 - alpha) * q[s, a] + alpha * (r + gamma * q[s_next].max())


@pytest.mark.parametrize("start", STARTS)
def test_the_right_rule_gives_the_run_of_q_learning(start):
    scene = Microscope(start=start, update=eq_1)
    q0 = STARTS[start][1]
    trace = q_learning(scene.tasks.mdp, STEPS, rng=4, q0=q0, trace=STEPS).trace

    found = np.array(scene.trace)
    np.testing.assert_array_equal(found[:, :7], np.column_stack(trace))
    assert found[:, 6].any(), "nothing was learned: nothing compared"


def test_a_wrong_rule_leads_elsewhere_and_follows_the_scene():
    scene = Microscope(update=lambda q, s, a, r, s_next, alpha, gamma: r)
    before = scene.trace
    scene.luck = 9

    assert scene.trace != before
    assert repr(scene) == "Microscope(luck=9, trace=...)"


def test_a_rule_may_not_write_into_the_values_or_return_nonsense():
    tasks = Microscope().tasks

    def spoiler(q, *others):
        q[:] = 5
        return 0.0

    assert max(row[6] for row in own_trace(tasks, 0.0, 4, spoiler)) == 0
    with pytest.raises(ValueError, match="update must return a finite number, got inf"):
        own_trace(tasks, 0.0, 4, lambda *_: np.inf)


def test_every_scene_is_in_the_reference():
    reference = (ROOT / "book" / "api_scenes.md").read_text(encoding="utf-8")
    section = reference.split("automodule:: abstransfer.scenes")[1].split("```")[0]
    listed = [line.split(":: ")[1] for line in section.split("\n") if ":: " in line]

    assert sorted(listed[1:]) == sorted(scenes.__all__)  # the first: currentmodule
