"""
The command ``figures``.
"""

from __future__ import annotations

from .._paths import DATA
from .options import add_folder

HELP = "Figures 3 and 4, table of tau and ledger, from stored results"
DESCRIPTION = "Make figures (SVG, PNG) and tables (CSV, Markdown)."


def add_options(parser) -> None:
    """Add the options of the command."""
    add_folder(parser, "out", "folder to write to", required=True)
    text = "folder of experiments (the stored ones)"
    add_folder(parser, "results", text, default=str(DATA / "results"))


def run(arguments) -> int:
    """Write the files, and print their names."""
    from ..reproduction.figures import make_figures

    make_figures(arguments.results, arguments.out, on_file=print)
    return 0
