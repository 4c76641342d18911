"""
Running what a student wrote: for a limited time, and without a trace.

It runs in a thread of its own, because only that works on every system and in every
place a notebook runs code: an exception is put into the thread when its time is over.
Python looks for such an exception between two of its own steps.  One long call into
compiled code has no steps: if it lets others run meanwhile, it is left behind; if it
does not (``sum(itertools.repeat(1))``), only stopping the kernel helps.
"""

from __future__ import annotations

import builtins
import contextlib
import contextvars
import ctypes
import io
import os
import random
import sys
import threading
import time
import warnings

import numpy as np

from ._read import Unreadable, short

LIMIT = 10.0  # seconds that an answer may take of the processor, which a loop uses
WAITING = 3  # times as long by the clock, for what sleeps and for a busy machine
PATIENCE = 1.0  # seconds that a stopped answer has to end
SLICE = 0.1  # seconds between two looks: no longer, for Windows waits deaf


class Stopped(BaseException):
    """Ends an answer from outside; not an Exception, so that few catch it."""


class Heard(io.TextIOBase):
    """Keeps the beginning of what is printed."""

    def __init__(self):
        self.text = ""

    def write(self, text):
        self.text += text[: max(0, 1000 - len(self.text))]
        return len(text)


def run(work):
    """
    Return what ``work(heard)`` returns, or raise Unreadable; see LIMIT.

    Parameters
    ----------
    work : function of Heard
        What it prints is not shown, but heard.

    Raises
    ------
    Unreadable
        What went wrong in `work`, or that its time is over.
    KeyboardInterrupt
        If the reader interrupts; `work` is stopped first.
    """
    done, ended = [], threading.Event()
    with as_it_was() as heard:
        context = contextvars.copy_context()
        thread = threading.Thread(
            target=context.run, args=(_guarded, work, heard, done, ended), daemon=True
        )
        try:
            thread.start()
            _wait(ended, LIMIT)
        except KeyboardInterrupt:
            raise KeyboardInterrupt("the answer was not judged") from None
        finally:  # also where the reader interrupts
            late = not ended.is_set()
            if late:
                _stop(thread, ended)
    result, problem = (None, _too_long(ended)) if late else done[0]
    if problem:
        reason = Unreadable(problem)
        reason.printed = heard.text
        raise reason
    return result


def _guarded(work, heard, done, ended):
    """Note what `work` returns, or in words why it does not."""
    try:
        with np.errstate(all="ignore"):
            done.append((work(heard), None))
    except Unreadable as reason:
        done.append((None, str(reason)))
    except BaseException as error:
        done.append((None, f"It cannot be read: {described(error)}"))
    finally:
        ended.set()


def described(error: BaseException) -> str:
    """Name an error and what it says, whatever it does when it is asked."""
    name = said = "an error that cannot say what it is"
    with contextlib.suppress(BaseException):
        name = short(type(error).__name__, 60)
        said = short(str(error))
    return f"`{name}: {said}`" if said else f"`{name}`"


def _wait(ended, seconds):
    """Wait for an event; not for a thread: interrupted, that is thought to be dead."""
    worked, end = time.process_time() + seconds, time.monotonic() + WAITING * seconds
    while time.process_time() < worked and time.monotonic() < end:
        if ended.wait(min(seconds, SLICE)):
            return


def _stop(thread, ended):
    """Put an exception into a thread, again and again if it catches it."""
    end = time.monotonic() + PATIENCE
    while not ended.is_set() and time.monotonic() < end:
        if thread.ident:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(thread.ident), ctypes.py_object(Stopped)
            )
        ended.wait(SLICE)


def _too_long(ended) -> str:
    words = f"It did not come to an end within {LIMIT:g} seconds"
    if ended.is_set():
        return f"{words} and was stopped. Is there a loop whose condition stays true?"
    return f"{words}, could not be stopped and still runs. Restart the kernel"


@contextlib.contextmanager
def as_it_was():
    """Put back, at the end, what an answer could change for the rest of a notebook."""
    generator = np.random.get_bit_generator()
    state = np.random.get_state(legacy=False)  # noqa: NPY002, an answer may seed it
    luck, depth = random.getstate(), sys.getrecursionlimit()
    environ, ask = dict(os.environ), builtins.input
    try:
        folder = os.getcwd()
    except OSError:  # it was deleted
        folder = None
    heard = Heard()
    with (
        warnings.catch_warnings(),
        np.errstate(),
        np.printoptions(),
        contextlib.redirect_stdout(heard),
        contextlib.redirect_stderr(heard),
    ):
        warnings.simplefilter("ignore")
        builtins.input = _no_input
        try:
            yield heard
        finally:
            builtins.input = ask
            np.random.set_bit_generator(generator)
            np.random.set_state(state)  # noqa: NPY002
            random.setstate(luck)
            sys.setrecursionlimit(depth)
            if os.environ != environ:
                os.environ.clear()
                os.environ.update(environ)
            if folder:
                os.chdir(folder)


def _no_input(*prompt):
    raise Unreadable("It asks with `input`; all that it needs are its arguments")
