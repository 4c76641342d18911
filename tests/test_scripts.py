"""The tests of the scenes' scripts, which node runs."""

import subprocess

import pytest
from conftest import ROOT, unavailable

from abstransfer.doctor import check_node

SCRIPTS = sorted((ROOT / "tests" / "js").glob("*.test.mjs"))


def test_the_scripts_pass_their_tests():
    if not SCRIPTS:
        pytest.skip("the book has no scenes yet")
    node = check_node()
    if not node.ok:
        unavailable(node.remedy)

    run = subprocess.run(["node", "--test", *SCRIPTS], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
