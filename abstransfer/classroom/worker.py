"""
Run one notebook in a fresh kernel: a process of its own, which `collect` limits.

After each cell a line of JSON goes to a file: what is known is kept when the process
must be stopped.  The notebook is read, never written.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from .handed_in import (
    asked_in,
    cards_said,
    digest,
    predictions_said,
    replies_in,
    student_of,
    texts_of,
)

HUNG = "hung"


def main(path: str, out: str, seconds: int, megabytes: int) -> None:
    """Run a notebook; a cell may take so long, each process so much memory."""
    import nbformat
    from jupyter_client.manager import AsyncKernelManager
    from nbclient import NotebookClient
    from nbclient.exceptions import DeadKernelError

    _limit_memory(megabytes)
    try:
        notebook = nbformat.reads(Path(path).read_text("utf-8-sig"), as_version=4)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        said = {
            "student": student_of(notebook),
            "asked": asked_in(notebook),
            "digest": digest(notebook),
        }
        handed_in = [text for cell in notebook.cells for text in texts_of(cell)]
    except Exception:  # whatever a file can be that is none
        _tell(out, {"outcome": "no notebook"})
        return
    said |= {"outcome": "ran", "replies": {}, "cards": ""}
    _tell(out, said)

    def note(cell, cell_index, execute_reply):
        content = (execute_reply or {}).get("content", {})
        if content.get("status") == "error" and said["outcome"] == "ran":
            name, number = content["ename"], 1 + code.index(cell)
            word = HUNG if name == HUNG else f"raised {name}"
            said["outcome"] = f"{word} in code cell {number}"
        for text in texts_of(cell):
            said["replies"] |= replies_in(text)
        _tell(out, said)

    client = NotebookClient(
        notebook,
        km=AsyncKernelManager(
            transport="tcp" if sys.platform == "win32" else "ipc",  # needs no network
            connection_file=str(Path.cwd() / "kernel.json"),
        ),
        timeout=seconds,
        interrupt_on_timeout=True,
        error_on_timeout={"ename": HUNG, "evalue": "", "traceback": []},
        allow_errors=True,
        on_cell_executed=note,
    )
    for cell in code:
        cell.outputs = []
    try:
        client.execute()
    except DeadKernelError:
        said["outcome"] = "the kernel died"
    _tell(out, said)
    again = [text for cell in notebook.cells for text in texts_of(cell)]
    said["predictions"] = predictions_said(handed_in, again)
    said["cards"] = cards_said([*handed_in, *again])
    _tell(out, said)


def _tell(out: str, said: dict) -> None:
    with Path(out).open("a", encoding="utf-8") as file:
        file.write(json.dumps(said) + "\n")


def _limit_memory(megabytes: int) -> None:
    try:
        import resource
    except ImportError:  # no such limits on Windows
        return
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (megabytes * 2**20, most))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
