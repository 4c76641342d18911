"""
The scripts of the built page, bundled: one file for each scene, one for its workers,
and one for the exercises.

``python -m abstransfer.scenes.bundle`` makes them anew where a source has changed.
They lie in ``_bundles`` beside the sources, are no part of the repository, and are
part of a wheel, so that who installs one needs no tool.  The build hook of the
project runs this file by itself: it imports nothing of the package.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

FOLDER = Path(__file__).parent
BUNDLES = FOLDER / "_bundles"
WORKER = FOLDER / "engine" / "worker.js"
STAMP = "made-from"  # the digest of the sources that the bundles were made from
COMMAND = "python -m abstransfer.scenes.bundle"


class BundleError(RuntimeError):
    """The scripts of the scenes could not be bundled."""


def scenes() -> list[str]:
    """
    Return the names of the scenes: a folder each, with a script of its name.

    >>> "race" in scenes()
    True
    """
    names = (path.parent.name for path in FOLDER.glob("[a-z]*/*.js"))
    return sorted({n for n in names if (FOLDER / n / f"{n}.js").is_file()})


def answers() -> Path:
    """Return the script of the exercises, beside the folder of the scenes."""
    return FOLDER.parent / "exercises" / "page" / "answers.js"


def sources() -> list[Path]:
    """Return all scripts that bundles are made of: no bundle, be it half made."""
    ours = [*FOLDER.glob("*.js"), *FOLDER.glob("[a-z]*/*.js")]
    return sorted([*ours, *answers().parent.glob("*.js")])


def digest() -> str:
    """Return what changes with any source."""
    return _digest(tuple((path, path.stat().st_mtime_ns) for path in sources()))


@lru_cache(1)
def _digest(seen: tuple[tuple[Path, int], ...]) -> str:
    """Read the sources; not again while nobody has written them."""
    found = hashlib.sha256()
    for path, _ in seen:
        found.update(path.relative_to(FOLDER.parent).as_posix().encode() + b"\0")
        found.update(hashlib.sha256(path.read_bytes()).digest())
    return found.hexdigest()


def is_fresh() -> bool:
    """Return whether all bundles are there, and made from today's sources."""
    try:
        made_from = (BUNDLES / STAMP).read_text("utf-8")
    except OSError:
        return False
    return made_from == digest()


def build() -> bool:
    """
    Bundle all scenes unless their bundles are fresh; return whether that was so.

    Several processes may call this at once: one bundles, the others wait for it.

    Raises
    ------
    BundleError
        If there is no bundler, or it fails.
    """
    if is_fresh():
        return False
    BUNDLES.mkdir(exist_ok=True)
    with _alone(BUNDLES / "lock"):
        if is_fresh():
            return False
        made_from = digest()
        with tempfile.TemporaryDirectory(dir=BUNDLES) as folder:
            paths = [FOLDER / name / f"{name}.js" for name in scenes()]
            paths += [path for path in (WORKER, answers()) if path.is_file()]
            _bundle(paths, Path(folder))
            (BUNDLES / STAMP).unlink(missing_ok=True)
            for path in BUNDLES.glob("*.js"):
                path.unlink()
            for path in Path(folder).glob("**/*.js"):
                path.replace(BUNDLES / path.name)
        (BUNDLES / STAMP).write_text(made_from, encoding="utf-8", newline="\n")
    return True


def bundle_one(path: Path) -> str:
    """Return the bundle of one script, with all that it imports."""
    with tempfile.TemporaryDirectory() as folder:
        _bundle([path], Path(folder))
        return (Path(folder) / path.name).read_text("utf-8")


def find_deno() -> str | None:
    """Return the path of the tool that bundles, checks and tests, or None."""
    try:
        from deno import find_deno_bin

        return os.fspath(find_deno_bin())
    except (ImportError, FileNotFoundError):
        return shutil.which("deno")


def environment() -> dict[str, str]:
    """Return the variables for it: what it fetches stays in the environment."""
    home = os.environ.get("DENO_DIR")
    if home is None and sys.prefix != sys.base_prefix:
        home = os.path.join(sys.prefix, "share", "deno")
    quiet = {"NO_COLOR": "1", "DENO_NO_UPDATE_CHECK": "1"}
    return {**os.environ, **quiet, **({"DENO_DIR": home} if home else {})}


def _bundle(paths: list[Path], folder: Path) -> None:
    """Write the bundles of scripts into a folder."""
    deno = find_deno()
    if deno is None:
        raise BundleError("there is no deno to bundle with: pip install deno")
    form = ["--platform", "browser", "--format", "iife", "--minify", "--no-lock"]
    names = [os.fspath(path) for path in paths]
    if len(paths) == 1:
        out = ["--output", os.fspath(folder / paths[0].name)]
    else:
        out = ["--outdir", os.fspath(folder)]
    done = subprocess.run(
        [deno, "bundle", "--quiet", *form, *out, *names],
        capture_output=True,
        encoding="utf-8",
        env=environment(),
    )
    if done.returncode:
        raise BundleError(f"deno bundle failed:\n{done.stderr.strip()[-2000:]}")


@contextmanager
def _alone(path: Path):
    """Let one process at a time in; a process that ends lets the next one in."""
    with open(path, "a+b") as file:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_LOCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX)
        yield


if __name__ == "__main__":
    try:
        print("bundled" if build() else "the bundles are fresh")
    except BundleError as error:
        sys.exit(f"abstransfer: error: {error}")
