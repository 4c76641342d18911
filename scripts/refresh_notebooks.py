"""
Run the book's notebooks and store their outputs, the same bytes every time.

    python scripts/refresh_notebooks.py                  all pages
    python scripts/refresh_notebooks.py book/07_*.ipynb  some
    python scripts/refresh_notebooks.py --check          store nothing, and fail
                                                         if a page would change

What differs from run to run is settled: times are dropped, the pieces of a
printed stream are joined, and the random names of widgets become numbers in
the order of their use.  Of a scene only its HTML is kept: the widget would carry
all scripts.  The code of a solution is folded, for JupyterLab.  The alt text that a
figure brings along ("alt" in the metadata of its output) is put where the builder
of the book looks for it.
"""

from __future__ import annotations

import argparse
import difflib
import json
import re
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from student_edition import without_solutions

BOOK = Path(__file__).parents[1] / "book"
RANDOM_NAME = re.compile(r"(?<![0-9a-f])[0-9a-f]{32}(?![0-9a-f])")
WIDGET = "application/vnd.jupyter.widget-view+json"
WIDGETS = "application/vnd.jupyter.widget-state+json"
METADATA = {
    "kernelspec": {
        "display_name": "Python 3",
        "language": "python",
        "name": "python3",
    },
    "language_info": {"name": "python", "pygments_lexer": "ipython3"},
}


def refreshed(path: Path, timeout: float = 300) -> str:
    """Return what the notebook's file holds after a run of all its cells."""
    raw = json.loads(path.read_text(encoding="utf-8"))
    raw.update(metadata=METADATA, nbformat=4, nbformat_minor=5)
    for number, cell in enumerate(raw["cells"]):
        cell.setdefault("id", f"cell-{number}")
        if cell["cell_type"] == "code":
            cell.update(outputs=[], execution_count=None)
    notebook = nbformat.reads(json.dumps(raw), as_version=4)
    folder = str(path.resolve().parent)
    NotebookClient(
        notebook,
        timeout=timeout,
        record_timing=False,
        resources={"metadata": {"path": folder}},
    ).execute()
    return settled(notebook)


def settled(notebook) -> str:
    """Return an executed notebook as text, without what is random in it."""
    widgets = notebook.metadata.get("widgets", {}).get(WIDGETS, {"state": {}})
    notebook.metadata = nbformat.from_dict(METADATA)
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = join_streams(cell.outputs)
            drop_scenes(cell.outputs, widgets["state"])
            take_alt_text(cell)
    fold_solutions(notebook.cells)
    if not any(WIDGET in output.get("data", {}) for output in outputs_of(notebook)):
        widgets["state"].clear()  # what a scene made for itself; nothing shows it
    names = numbered(nbformat.writes(notebook), widgets["state"])
    if widgets["state"]:
        notebook.metadata["widgets"] = {WIDGETS: widgets}
    text = RANDOM_NAME.sub(lambda name: names[name[0]], nbformat.writes(notebook))
    # Read and written again, because the keys were sorted by their old names.
    return nbformat.writes(nbformat.reads(text, as_version=4)) + "\n"


def numbered(text: str, state: dict) -> dict[str, str]:
    """
    Give each random name a number, in the order of its first use.

    The use starts in the cells (`text`) and goes on in the widgets named there
    (`state`); widgets that nothing names, such as links, follow by content.
    """
    names = {}

    def content(name):
        return json.dumps(state[name], sort_keys=True)

    def settled_content(name):
        return RANDOM_NAME.sub(lambda name: names.get(name[0], ""), content(name))

    def visit(text):
        for name in RANDOM_NAME.findall(text):
            if name not in names:
                names[name] = f"{len(names) + 1:032x}"
                if name in state:
                    visit(content(name))

    visit(text)
    for name in sorted(state.keys() - names.keys(), key=settled_content):
        visit(name)
    return names


def outputs_of(notebook) -> list:
    """Return the outputs of all cells."""
    return [o for cell in notebook.cells for o in cell.get("outputs", [])]


def join_streams(outputs: list) -> list:
    """Join pieces of one printed stream; where it is cut depends on time."""
    joined = []
    for output in outputs:
        last = joined[-1] if joined else {}
        if output.output_type == "stream" and output.get("name") == last.get("name"):
            last["text"] += output["text"]
        else:
            joined.append(output)
    return joined


def drop_scenes(outputs: list, state: dict) -> None:
    """Drop the widget of each output that has a form in HTML, with its layout."""
    for output in outputs:
        data = output.get("data", {})
        if "text/html" in data and WIDGET in data:
            name = data.pop(WIDGET)["model_id"]
            layout = state.pop(name, {}).get("state", {}).get("layout", "")
            state.pop(layout.removeprefix("IPY_MODEL_"), None)


def take_alt_text(cell) -> None:
    """Copy the alt text of the cell's figure to the metadata of the cell."""
    for output in cell.outputs:
        for of_type in output.get("metadata", {}).values():
            if isinstance(of_type, dict) and "alt" in of_type:
                page = cell.metadata.setdefault("mystnb", {})
                page.setdefault("image", {})["alt"] = of_type["alt"]


def fold_solutions(cells: list) -> None:
    """Let JupyterLab fold the code of solutions: a page does so by itself."""
    inside = False
    for cell in cells:
        if cell.cell_type == "markdown":
            _, inside = without_solutions(cell.source, inside)
        elif inside:
            cell.metadata["jupyter"] = {"outputs_hidden": True, "source_hidden": True}


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("--check", action="store_true", help="store nothing")
    parser.add_argument("notebooks", nargs="*", type=Path, help="default: all pages")
    options = parser.parse_args(arguments)
    n_changed = 0
    for path in options.notebooks or sorted(BOOK.glob("*.ipynb")):
        before, after = path.read_text(encoding="utf-8"), refreshed(path)
        n_changed += before != after
        print(f"{path.name}: {'unchanged' if before == after else 'changed'}")
        if before != after and options.check:
            lines = before.splitlines(), after.splitlines()
            print(*list(difflib.unified_diff(*lines, lineterm="", n=1))[:40], sep="\n")
        elif before != after:
            path.write_text(after, encoding="utf-8", newline="\n")
    return int(options.check and n_changed > 0)


if __name__ == "__main__":
    sys.exit(main())
