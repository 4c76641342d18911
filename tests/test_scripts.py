"""The tests of the scenes' scripts, which node runs."""

import subprocess

import pytest
from conftest import ROOT, unavailable

from abstransfer.doctor import check_node

SCRIPTS = sorted((ROOT / "tests" / "js").glob("*.test.mjs"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.name)
def test_a_script_passes_its_tests(script):
    node = check_node()
    if not node.ok:
        unavailable(node.remedy)

    run = subprocess.run(["node", "--test", script], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
