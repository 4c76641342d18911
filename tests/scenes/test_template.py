"""The scene to copy: a copy of it, renamed as the guide says, is a working scene."""

import importlib
import shutil
import subprocess
import sys

import pytest
from scene_tab import number

from abstransfer import scenes
from abstransfer.scenes import KINDS, bundle
from abstransfer.scenes import files as front

TEMPLATE = bundle.FOLDER / "_template"


@pytest.fixture
def coin(tmp_path, monkeypatch):
    """The class of a scene `coin`, copied from the template, among the scenes."""
    folder = tmp_path / "scenes"
    kept = shutil.ignore_patterns("_bundles", "__pycache__", "*.py")
    shutil.copytree(bundle.FOLDER, folder, ignore=kept)
    shutil.copytree(TEMPLATE, folder / "coin", ignore=kept)
    (folder / "coin" / "template.js").rename(folder / "coin" / "coin.js")
    for path in TEMPLATE.glob("*.py"):
        shutil.copy(path, folder / "coin")
    for path in (folder / "coin").iterdir():
        text = path.read_text("utf-8")
        text = text.replace("template", "coin").replace("Template", "Coin")
        path.write_text(text, encoding="utf-8")

    # Made before the folder is another: the package's own bundles stay as they are.
    own = bundle.bundle_one(folder / "coin" / "coin.js")
    made = {"coin": own, "worker": front.bundled("worker")}

    monkeypatch.setattr(scenes, "__path__", [*scenes.__path__, str(folder)])
    monkeypatch.setattr(front, "bundled", made.__getitem__)
    kind = importlib.import_module("abstransfer.scenes.coin.widget").Coin
    monkeypatch.setitem(KINDS, "coin", kind)
    monkeypatch.setattr(bundle, "FOLDER", folder)
    yield kind
    for name in [
        name for name in sys.modules if name.startswith("abstransfer.scenes.coin")
    ]:
        del sys.modules[name]


def test_it_is_no_scene_itself():
    assert TEMPLATE.is_dir()
    assert "_template" not in {*KINDS, *bundle.scenes()}
    assert not hasattr(scenes, "Template")


@pytest.mark.parametrize("command", [["fmt", "--check"], ["check"], ["lint"]], ids=str)
def test_its_script_is_in_order(command):
    done = subprocess.run(
        [bundle.find_deno(), *command, TEMPLATE / "template.js"],
        capture_output=True,
        encoding="utf-8",
        env=bundle.environment(),
    )

    assert done.returncode == 0, done.stdout + done.stderr


def test_a_copy_is_found_and_works_as_a_widget(coin):
    scene = coin(n=7)

    assert "coin" in bundle.scenes()
    assert "coin" in scene.get_state()["_esm"]
    assert scene.html().count("<svg") == 3
    assert "7 throws" in scene.still().caption


def test_a_copy_works_in_a_page_with_pythons_numbers(coin, open_scene):
    tab = open_scene(coin())
    tab.root.get_by_role("slider", name="Luck").fill("3")
    tab.root.get_by_role("slider", name="Throws").fill("200")
    tab.settle()

    shown = [number(share) for share, *_ in tab.rows().values()]
    assert shown == pytest.approx(coin(luck=3).shares, abs=6e-5)
    assert tab.closing == ""
    tab.pick("Bet first", "yes")
    assert f"{coin(luck=3).shares[-1]:.2f} after all" in tab.closing
    assert "coin.luck=3" in tab.url_with("luck")
    assert tab.violations() == []
    assert tab.problems == []


def test_a_scene_without_a_script_of_its_name_says_so():
    state = importlib.import_module("abstransfer.scenes._template.widget").Template()

    assert "there is no script scenes/template/template.js" in state.get_state()["_esm"]
