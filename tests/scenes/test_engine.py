"""The browser's engine finds what Python finds: golden files, and node's tests."""

import math
import subprocess
from pathlib import Path

import pytest
from golden.write_golden import GOLDEN, as_json, read
from support import unavailable

from abstransfer.cli.doctor import check_node

ROOT = Path(__file__).parents[2]
TOLERANCE = 1e-10  # of values; another processor may round them in another way


def differences(found, golden, where="$"):
    """Yield the places where two JSON values differ: floats by more than rounding."""
    if isinstance(found, dict) and isinstance(golden, dict):
        for key in found | golden:
            yield from differences(found.get(key), golden.get(key), f"{where}.{key}")
    elif isinstance(found, list) and isinstance(golden, list):
        if len(found) != len(golden):
            yield f"{where}: {len(found)} entries, {len(golden)} in the golden file"
        for i, pair in enumerate(zip(found, golden, strict=False)):
            yield from differences(*pair, f"{where}[{i}]")
    elif isinstance(found, float) and isinstance(golden, float):
        if not math.isclose(found, golden, rel_tol=TOLERANCE, abs_tol=TOLERANCE):
            yield f"{where}: {found}, {golden} in the golden file"
    elif type(found) is not type(golden) or found != golden:
        yield f"{where}: {found!r}, {golden!r} in the golden file"


@pytest.mark.parametrize("name", sorted(GOLDEN))
def test_a_golden_file_holds_what_the_code_finds_today(name):
    found = list(differences(as_json(GOLDEN[name]()), read(name)))

    assert not found, (
        "\n".join(found[:5])
        + "\nIf the change is meant: python tests/golden/write_golden.py"
    )


def test_a_changed_number_is_noticed():
    golden = {"a": [1, 0.5, "x"]}

    assert not list(differences({"a": [1, 0.5 + 1e-14, "x"]}, golden))
    for other in ([2, 0.5, "x"], [1, 0.5001, "x"], [1, 0.5, "y"], [1, 0.5], [1.0, 0.5]):
        assert list(differences({"a": other}, golden))


def test_the_engine_in_javascript_finds_the_same():
    node = check_node()
    if not node.ok:
        unavailable(node.remedy)
    folder = Path(__file__).parent / "js"
    tests = sorted(str(path) for path in folder.glob("*.test.mjs"))
    done = subprocess.run(
        ["node", "--test", "--test-reporter=tap", *tests],
        capture_output=True,
        text=True,
        timeout=300,
    )

    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-1000:]
    assert "# pass 0" not in done.stdout, "no test was run"


def test_the_engine_stays_small():
    files = (ROOT / "abstransfer" / "scenes" / "engine").glob("*.js")

    assert sum(path.stat().st_size for path in files) < 60_000
