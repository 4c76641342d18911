"""Run the command line: ``python -m abstransfer``."""

from .cli import program

program()
