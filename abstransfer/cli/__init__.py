"""
The command line; one module a command.

``--json`` gives output that programs read.  Bad input ends with a message and
exit code 2, Ctrl-C with one line and 130, whenever it comes: what takes time is
imported after `main` has begun.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
from contextlib import contextmanager
from importlib import import_module

COMMANDS = ("table1", "learn", "experiment", "figures", "doctor")


def program() -> None:
    """Run one command as a process of its own, and end with its exit code."""
    try:
        code = main()
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # while Python tidies up
    except KeyboardInterrupt:  # just after all was said
        code = 130
    # An interrupt that once left an `exec` would end Python by a signal, although
    # it was caught; another `exec` makes it forget.
    exec("")
    sys.exit(code)


def main(argv: list[str] | None = None) -> int:
    """Run one command; return its exit code."""
    _open_streams()
    with _interrupts() as seen:
        try:
            arguments = _parser().parse_args(argv)
            code = arguments.run(arguments)
            sys.stdout.flush()
            return code
        except SystemExit:
            raise
        except BaseException as error:
            if seen or isinstance(error, KeyboardInterrupt):
                code, text = 130, "; ".join(["interrupted", *map(str, error.args)])
            elif isinstance(error, BrokenPipeError):
                # The reader has seen enough, as `| head` does.
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
                return 0
            elif isinstance(error, ValueError | OSError):
                code, text = 2, error
            elif isinstance(error, MemoryError):
                code, text = 2, "there is not enough memory for this"
            else:
                raise
            print(f"abstransfer: {text}", file=sys.stderr)
            return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="abstransfer",
        description="Transfer learning by abstract policies (Freire & Costa 2015).",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name in COMMANDS:
        module = import_module(f".{name}", __package__)
        command = commands.add_parser(
            name, help=module.HELP, description=module.DESCRIPTION
        )
        module.add_options(command)
        command.set_defaults(run=module.run)
    return parser


@contextmanager
def _interrupts():
    """
    Yield a list which fills when Ctrl-C comes.

    Code that is cut off may make another error of the interrupt.
    """
    seen = []

    def note(number, frame):
        seen.append(number)
        raise KeyboardInterrupt

    try:
        before = signal.signal(signal.SIGINT, note)
    except ValueError:  # not in the main thread: Ctrl-C does not come here
        yield seen
        return
    try:
        yield seen
    finally:
        signal.signal(signal.SIGINT, before)


def _open_streams() -> None:
    """Send to nowhere what goes to a closed stream, and never into another file."""
    while (nowhere := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(nowhere)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
