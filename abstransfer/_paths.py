"""Where the package keeps its maps and stored results."""

from pathlib import Path

_INSTALLED = Path(__file__).parent / "data"
DATA = _INSTALLED if _INSTALLED.is_dir() else Path(__file__).parents[1] / "data"
