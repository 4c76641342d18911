"""
Whether this machine is ready for the book, and what to do if it is not.

Only the standard library is used: it answers where nothing else is installed.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

PYTHON = "3.11"
BROWSERS = (
    "chromium-headless-shell",  # first: without windows it needs a quarter less
    *("chromium", "chromium-browser", "google-chrome", "chrome", "msedge"),
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
)
INSTALL = 'pip install -c constraints.txt -e ".[test]"'
ASK = (
    "import sys; sys.path.insert(0, sys.argv[1]);"
    "from abstransfer.learning._rng import fill;"
    "print(fill.stats.cache_path or '' if hasattr(fill, 'stats') else '')"
)

HELP = "is this machine ready, and what to do if not"
DESCRIPTION = "Check versions, kernel and browser."


class Check(NamedTuple):
    """One thing that was looked at."""

    name: str  #: what is looked at
    ok: bool  #: whether it is as it should be
    found: str  #: a version, a path, or "nothing"
    remedy: str  #: what to do if not ok; else ""


def add_options(parser) -> None:
    """Add the options of the command."""
    parser.add_argument("--json", action="store_true", help="print JSON")


def run(arguments) -> int:
    """Print what was found; return 1 where something is missing."""
    checks = diagnose()
    if arguments.json:
        print(json.dumps([check._asdict() for check in checks], indent=2))
    else:
        for check in checks:
            print(f"{'ok' if check.ok else 'MISSING':8} {check.name}: {check.found}")
            if not check.ok:
                print(f"{'':8} {check.remedy}")
    return 0 if all(check.ok for check in checks) else 1


def diagnose() -> list[Check]:
    """Look at everything the book and its tests need; one record for each."""
    tools = (check_kernel(), check_cache(), check_browser())
    return [check_python(), *check_packages(), *tools]


def check_python() -> Check:
    """Say whether this Python is new enough."""
    found = ".".join(map(str, sys.version_info[:3]))
    ok = _release(found) >= _release(PYTHON)
    return _check("python", ok, found, f"install Python {PYTHON} or newer")


def check_packages(extras: tuple[str, ...] = ("book",)) -> list[Check]:
    """Compare installed packages with what the package and `extras` ask for."""
    try:
        lines = metadata.requires("abstransfer") or []
    except metadata.PackageNotFoundError:
        return [_check("abstransfer", False, "nothing", INSTALL)]
    asked = (re.split(r"\s*;\s*", line, maxsplit=1) for line in lines)
    wanted = [f"extra == '{extra}'" for extra in extras]
    return [check_package(spec) for spec, *of in asked if not of or of[0] in wanted]


def check_package(spec: str) -> Check:
    """Check one requirement, as in ``numpy>=2.0``."""
    name = re.match(r"[\w.-]+", spec)[0]
    try:
        version = metadata.version(name)
    except metadata.PackageNotFoundError:
        return _check(name, False, "nothing", INSTALL)
    bounds = re.findall(r"(>=|<)\s*([\d.]+)", spec)
    ok = all((_release(version) >= _release(b)) == (op == ">=") for op, b in bounds)
    return _check(name, ok, version, f"needs {spec}: {INSTALL}")


def check_kernel() -> Check:
    """Say whether notebooks find a kernel that runs this Python."""
    place = Path(sys.prefix, "share", "jupyter", "kernels", "python3", "kernel.json")
    found = str(place) if place.is_file() else "nothing"
    return _check("jupyter kernel", place.is_file(), found, INSTALL)


def check_cache(patience: float = 60) -> Check:
    """Say where compiled loops are kept; else they compile at each start."""
    remedy = "set NUMBA_CACHE_DIR to a folder you may write to; it is made"
    if os.environ.get("NUMBA_DISABLE_JIT", "0") != "0":
        remedy = "unset NUMBA_DISABLE_JIT: uncompiled, learning takes hours"
    # Another process asks the compiler: on some systems it waits for ever.
    asking = [sys.executable, "-c", ASK, str(Path(__file__).parents[2])]
    told = {"stdin": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    try:
        place = subprocess.check_output(
            asking, **told, encoding="utf-8", timeout=patience
        ).strip()
    except subprocess.TimeoutExpired:
        place = ""
    except subprocess.CalledProcessError:  # the package cannot be imported
        place, remedy = "", INSTALL
    return _check("compiled code", bool(place), place or "nothing", remedy)


def check_browser() -> Check:
    """Say whether the browser tests can run; to read, any browser will do."""
    found = next(filter(None, map(shutil.which, BROWSERS)), "nothing")
    remedy = "for the browser tests install Chromium (Debian: apt-get install chromium)"
    return _check("browser", found != "nothing", found, remedy)


def _release(version: str) -> tuple[int, ...]:
    """Return the numbers of a version, as in (1, 0, 4, 0) for 1.0.4.post1."""
    numbers = re.match(r"(?:\d+(?:\.\d+)*)?", version)[0].split(".")
    return tuple(int(n or 0) for n in [*numbers, "0", "0", "0", "0"][:4])


def _check(name: str, ok: bool, found: str, remedy: str) -> Check:
    return Check(name, ok, found, "" if ok else remedy)
