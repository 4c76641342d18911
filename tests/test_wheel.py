"""The package as others install it: a wheel that brings its maps along."""

import os
import subprocess
import sys
import zipfile

from support import ROOT

READ = """
from abstransfer._paths import DATA
print(DATA)
print((DATA / "maps" / "source.txt").read_text(), end="")
"""


def test_the_wheel_brings_its_maps(tmp_path):
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", tmp_path]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    place = tmp_path / "installed"
    zipfile.ZipFile(wheel).extractall(place)

    # PYTHONPATH comes before the editable installation, -P keeps this folder out.
    told = subprocess.run(
        [sys.executable, "-P", "-c", READ],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(place)},
        check=True,
        capture_output=True,
        text=True,
    )

    where, _, text = told.stdout.partition("\n")
    assert where == str(place / "abstransfer" / "data")
    assert text == (ROOT / "data" / "maps" / "source.txt").read_text()
