"""Run the command line: ``python -m abstransfer``."""

import sys

from .cli import main

sys.exit(main())
