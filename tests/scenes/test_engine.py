"""The browser's engine finds what Python finds: golden files, and its own tests."""

import math
import re
import subprocess
from pathlib import Path

import pytest
from golden.write_golden import GOLDEN, as_json, read

from abstransfer.project.student import building_of, seed_of, written
from abstransfer.scenes import KINDS, bundle
from abstransfer.scenes import files as front

HERE = Path(__file__).parent
IMPORT = re.compile(r'^import (?:[^;"]* from )?"([^"]+)";$', re.MULTILINE)
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
        + "\nIf the change is meant: cd tests; python -m golden.write_golden"
    )


def test_a_changed_number_is_noticed():
    golden = {"a": [1, 0.5, "x"]}

    assert not list(differences({"a": [1, 0.5 + 1e-14, "x"]}, golden))
    for other in ([2, 0.5, "x"], [1, 0.5001, "x"], [1, 0.5, "y"], [1, 0.5], [1.0, 0.5]):
        assert list(differences({"a": other}, golden))


def students():
    """Names with their seeds and buildings, and signs as seeds take them."""
    names = ["Ann Lee", " ann  lee", "Zoë Ångström", "Zoe\u0308 \xc5ngstro\u0308m"]
    names += [
        "Straße",
        "ΣΟΦΟΣ σοφος",
        "Işık İpek",
        "李小龙",
        "a\x1cb\x85c\ufeffd",
        ". .",
    ]
    names += [f"student {number}" for number in range(30)]
    told = [
        {
            "name": name,
            "one": written(name),
            "seed": seed_of(name),
            "building": str(building_of(name)),
        }
        for name in names
    ]
    known = (chr(code) for code in range(0x110000) if not 0xD800 <= code < 0xE000)
    # A sign that one side does not know yet has no capitals there.
    changed = (sign for sign in known if sign.upper().lower() != sign)
    signs = [(sign, sign.upper().lower()) for sign in changed]
    return {"students": told, "signs": signs}


@pytest.mark.parametrize("path", sorted((HERE / "js").glob("*.test.js")), ids=str)
def test_the_front_end_without_a_page(path, tmp_path):
    said = tmp_path / "said.json"
    fields = {name: kind.spec()["fields"] for name, kind in KINDS.items()}
    more = {"isWidget": True, "fields": fields, "worker": front.bundled("worker")}
    if path.name == "project.test.js":
        more |= students()
    said.write_text(front.said(**more), encoding="utf-8")
    test = [bundle.find_deno(), "test", "--no-check", "--allow-read"]
    done = subprocess.run(
        [*test, path, "--", said],
        capture_output=True,
        encoding="utf-8",
        timeout=300,
        env=bundle.environment(),
    )

    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-1000:]
    assert re.search(r"ok \| [1-9]\d* passed", done.stdout), "no test was run"


def test_every_script_imports_only_what_is_below_it():
    order = [["python"], ["engine"], ["ui"], ["parts"]]
    order += [[*bundle.scenes(), "_template"], ["page"]]  # the last: of the exercises
    ranks = {name: rank for rank, names in enumerate(order) for name in names}
    for path in bundle.sources():
        room = room_of(path)
        for imported in IMPORT.findall(path.read_text("utf-8")):
            other = room_of((path.parent / imported).resolve())
            assert other == room or ranks[other] < ranks[room], f"{path}: {imported}"


def room_of(path):
    """Return the room of a script: its folder, or its own name."""
    return path.relative_to(bundle.FOLDER.parent).parts[1].removesuffix(".js")
