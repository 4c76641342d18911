"""
Ctrl-C where something must be tidied up: noted, and heard when it is safe.

An exception that comes at any moment can be lost: some callbacks print it and go on.
"""

from __future__ import annotations

import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager

LOOK = 0.1  # seconds between two looks


@contextmanager
def interrupts_noted() -> Iterator[list]:
    """
    Yield a list that Ctrl-C fills; who waits looks at it, and comes to an end.

    Raises KeyboardInterrupt at the end if it came, in place of any other error.
    """
    heard = []
    try:
        before = signal.signal(signal.SIGINT, lambda *_: heard.append(True))
    except ValueError:  # not in the main thread: Ctrl-C does not come here
        yield heard
        return
    try:
        yield heard
    finally:
        signal.signal(signal.SIGINT, before)
        if heard:
            raise KeyboardInterrupt


def ends_in_time(process: subprocess.Popen, seconds: float, heard: list) -> bool:
    """Wait for a process, as long as that, or until Ctrl-C; return whether it ended."""
    until = time.monotonic() + seconds
    while process.poll() is None and time.monotonic() < until and not heard:
        time.sleep(LOOK)
    return process.poll() is not None
