"""The machine check: what it finds, and what it advises."""

import json
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

from abstransfer.cli import doctor

ROOT = Path(__file__).parents[2]


def test_a_machine_that_runs_the_tests_has_all_packages():
    checks = {check.name: check for check in doctor.diagnose()}

    assert checks["numpy"] == ("numpy", True, metadata.version("numpy"), "")
    assert "jupyter-book" in checks
    assert all(check.ok for check in doctor.check_packages(("book", "test")))


@pytest.mark.parametrize(
    ("spec", "ok"),
    [
        ("pytest", True),
        ("pytest>=1.0", True),
        ("pytest>=999", False),
        ("pytest>=1.0,<2", False),
        ("pytest>=1,<999", True),
    ],
)
def test_a_version_is_compared_with_both_bounds(spec, ok):
    assert doctor.check_package(spec).ok is ok


def test_a_whole_version_satisfies_a_longer_bound(monkeypatch):
    monkeypatch.setattr(doctor.metadata, "version", lambda name: "2")

    assert doctor.check_package("numpy>=2.0").ok


def test_post_releases_count_as_their_release(monkeypatch):
    monkeypatch.setattr(doctor.metadata, "version", lambda name: "1.0.4.post1")

    assert doctor.check_package("jupyter-book<2,>=1.0.4").ok


def test_what_is_missing_comes_with_a_remedy(monkeypatch, tmp_path):
    monkeypatch.setattr(doctor.shutil, "which", lambda name: None)
    monkeypatch.setattr(doctor.sys, "prefix", str(tmp_path))
    monkeypatch.setattr(doctor, "ASK", "print()")  # no folder; see test_machines
    missing = [check for check in doctor.diagnose() if not check.ok]

    names = {check.name for check in missing}
    assert names == {"jupyter kernel", "compiled code", "browser"}
    assert all(check.remedy for check in missing)


def test_an_old_python_is_named(monkeypatch):
    monkeypatch.setattr(doctor.sys, "version_info", (3, 10, 2))

    check = doctor.check_python()
    assert not check.ok
    assert check.found == "3.10.2"
    assert "3.11" in check.remedy


def test_without_the_package_installed_it_says_how_to_install(monkeypatch):
    def nothing(name):
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(doctor.metadata, "requires", nothing)

    (check,) = doctor.check_packages()
    assert check.remedy == doctor.INSTALL


def test_the_python_asked_for_is_the_one_of_the_package():
    settings = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    project = tomllib.loads(settings)["project"]

    assert project["requires-python"] == f">={doctor.PYTHON}"


def test_it_answers_where_nothing_else_is_installed():
    look = (
        "import json, runpy, sys; "
        "checks = runpy.run_path(sys.argv[1])['diagnose'](); "
        "print(json.dumps([check[:2] for check in checks]))"
    )
    # -S: without the folder of what was installed, -I: without this one.
    command = [sys.executable, "-I", "-S", "-c", look, doctor.__file__]
    told = dict(json.loads(subprocess.check_output(command, encoding="utf-8")))

    assert told["python"]
    assert not told["abstransfer"]
