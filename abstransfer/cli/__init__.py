"""
The command line; one module a command.

``--json`` gives output that programs read.  Bad input ends with a message and
exit code 2, Ctrl-C with one line and 130, whenever it comes: what takes time is
imported after `main` has begun.
"""

from __future__ import annotations

# Nothing more here: until `main` has begun, Ctrl-C is a traceback.
import os
import signal
import sys

MODULES = {
    name: name for name in ("table1", "learn", "experiment", "figures", "doctor")
}
MODULES["class"] = "classes"  # a word of Python's own names no module


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
    seen = []  # whether Ctrl-C came: code that is cut off may make another error of it

    def note(number, frame):
        seen.append(number)
        raise KeyboardInterrupt

    before = _on_interrupt(note)
    try:
        _open_streams()
        arguments = _parser().parse_args(argv)
        code = arguments.run(arguments)
        sys.stdout.flush()
        return code
    except SystemExit:
        raise
    except BaseException as error:
        interrupted = isinstance(error, KeyboardInterrupt)
        if seen or interrupted:
            how_to_go_on = interrupted or isinstance(error, ChildProcessError)
            words = map(str, error.args) if how_to_go_on else ()
            code, text = 130, "; ".join(["interrupted", *words])
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
    finally:
        _on_interrupt(before)


def _parser():
    import argparse
    from importlib import import_module

    parser = argparse.ArgumentParser(
        prog="abstransfer",
        description="Transfer learning by abstract policies (Freire & Costa 2015).",
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, place in MODULES.items():
        module = import_module(f".{place}", __package__)
        command = commands.add_parser(
            name, help=module.HELP, description=module.DESCRIPTION
        )
        module.add_options(command)
        command.set_defaults(run=module.run)
    return parser


def _on_interrupt(handler):
    """Set what Ctrl-C does; return what it did, or None."""
    try:
        return handler and signal.signal(signal.SIGINT, handler)
    except ValueError:  # not in the main thread: Ctrl-C does not come here
        return None


def _open_streams() -> None:
    """Send to nowhere what goes to a closed stream, and never into another file."""
    while (nowhere := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(nowhere)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
