"""The package as others install it: a wheel that brings its maps and scenes along."""

import json
import os
import subprocess
import sys
import zipfile

import pytest
from support import ROOT

from abstransfer.scenes import Race

# What a reader's Python says who has none of the tools.
READ = """
import json
import sys
sys.modules["deno"] = None

from abstransfer._paths import DATA
from abstransfer.scenes import Race, bundle

print(json.dumps({
    "data": str(DATA),
    "map": (DATA / "maps" / "source.txt").read_text(),
    "scripts": str(bundle.FOLDER),
    "fresh": bundle.is_fresh(),
    "esm": Race().get_state()["_esm"],
}))
"""


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A folder that the wheel was unpacked to."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder / "installed")
    return folder / "installed"


def test_the_wheel_brings_its_maps_and_its_scenes(installed):
    # PYTHONPATH comes before the editable installation, -P keeps this folder out.
    done = subprocess.run(
        [sys.executable, "-P", "-c", READ],
        cwd=installed.parent,
        env={**os.environ, "PYTHONPATH": str(installed), "PATH": ""},
        check=True,
        capture_output=True,
        encoding="utf-8",
    )

    told = json.loads(done.stdout)
    assert told["data"] == str(installed / "abstransfer" / "data")
    assert told["map"] == (ROOT / "data" / "maps" / "source.txt").read_text(
        encoding="utf-8"
    )
    assert told["scripts"] == str(installed / "abstransfer" / "scenes")
    assert told["fresh"]
    assert told["esm"] == Race().get_state()["_esm"]
    assert len(told["esm"]) > 20_000, "the scene, not a sentence in its place"
