"""
The command line; one module a command.

``--json`` gives output that programs read.  Bad input ends with a message and
exit code 2, Ctrl-C with one line and 130, whenever it comes: what takes time is
imported after `program` has begun.
"""

from __future__ import annotations

# Nothing more here: until `program` has begun, Ctrl-C is a traceback.
import os
import signal
import sys

MODULES = {
    name: name for name in ("table1", "learn", "experiment", "figures", "doctor")
}
MODULES["class"] = "classes"  # a word of Python's own names no module
INTERRUPTED = ["interrupted"]  # what is said; a command adds how to go on


def program() -> None:
    """Run one command as a process of its own, and end with its exit code."""
    signal.signal(signal.SIGINT, _end)
    code = main()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # while Python tidies up
    sys.exit(code)


def main(argv: list[str] | None = None) -> int:
    """Run one command; return its exit code."""
    INTERRUPTED[1:] = []
    try:
        _open_streams()
        arguments = _parser().parse_args(argv)
        code = arguments.run(arguments)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        code, text = 130, "; ".join(INTERRUPTED)
    except BrokenPipeError:
        # The reader has seen enough, as `| head` does.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError) as error:
        code, text = 2, error
    except MemoryError:
        code, text = 2, "there is not enough memory for this"
    print(f"abstransfer: {text}", file=sys.stderr)
    return code


def _end(number, frame) -> None:
    """
    End at once, with one line; what must be tidied up first notes Ctrl-C instead.

    Nothing is raised: some of the code that runs while modules are loaded or
    compiled prints such an exception, or drops it, and goes on.
    """
    line = f"abstransfer: {'; '.join(INTERRUPTED)}\n"
    if os.isatty(2):  # below a bar
        line = "\n" + line
    try:
        os.write(2, line.encode())
    finally:
        os._exit(130)


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


def _open_streams() -> None:
    """Send to nowhere what goes to a closed stream, and never into another file."""
    while (nowhere := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(nowhere)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
