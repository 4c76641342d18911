"""The stored notebooks: run in order, described, free of what is random."""

import json
import re
from html import escape

import nbformat
import pytest
import refresh_notebooks
from support import ROOT

NOTEBOOKS = sorted((ROOT / "book").glob("*.ipynb"))
WIDGET = "application/vnd.jupyter.widget-view+json"
# The cells whose output is not compared, and why: {(page, id of the cell): reason}.
NOT_COMPARED = {}
TAGS = {  # what a cell may be marked with
    "hide-input",
    "hide-output",
    "remove-input",
    "raises-exception",
    "nbval-ignore-output",
}


@pytest.fixture(params=NOTEBOOKS, ids=lambda path: path.stem)
def notebook(request):
    return request.param, json.loads(request.param.read_text(encoding="utf-8"))


def code_cells(notebook):
    cells = [c for c in notebook["cells"] if c["cell_type"] == "code"]
    return [cell for cell in cells if "".join(cell["source"]).strip()]


def outputs(notebook):
    return [output for cell in code_cells(notebook) for output in cell["outputs"]]


def test_all_cells_were_run_once_and_in_order(notebook):
    counts = [cell["execution_count"] for cell in code_cells(notebook[1])]

    assert counts == list(range(1, len(counts) + 1))
    for cell in code_cells(notebook[1]):
        of_outputs = {o.get("execution_count", 0) for o in cell["outputs"]} - {0}
        assert of_outputs <= {cell["execution_count"]}


def test_a_page_asks_for_the_kernel_that_every_installation_has(notebook):
    """Not one of an editor or of conda: their names are known on one machine only."""
    assert notebook[1]["metadata"] == refresh_notebooks.METADATA
    assert refresh_notebooks.METADATA["kernelspec"]["name"] == "python3"


def test_a_page_stores_its_outputs(notebook):
    assert outputs(notebook[1]), "the outputs were stripped, so nothing is compared"


def test_no_output_names_an_address_or_a_place_on_a_machine(notebook):
    found = re.findall(
        r"0x[0-9a-f]{6,}|/home/\w+|/Users/\w+|/tmp/\w+|site-packages|\.venv",
        json.dumps(outputs(notebook[1])),
    )

    assert found == []


def test_nothing_is_printed_to_the_error_stream(notebook):
    assert [o for o in outputs(notebook[1]) if o.get("name") == "stderr"] == []


def test_every_picture_comes_with_a_description(notebook):
    for cell in code_cells(notebook[1]):
        kinds = [kind for o in cell["outputs"] for kind in o.get("data", {})]
        pictures = [kind for kind in kinds if kind.startswith("image/")]
        if pictures:
            alt = cell["metadata"].get("mystnb", {}).get("image", {}).get("alt", "")
            assert pictures == ["image/svg+xml"], "one figure per cell, as SVG"
            assert 40 <= len(alt) <= 300, f"cell {cell['id']}: {alt!r}"


def test_where_a_picture_is_not_trusted_its_finding_stands(notebook):
    """JupyterLab shows no SVG that another wrote, but the plain text beside it."""
    for output in outputs(notebook[1]):
        if svg := "".join(output.get("data", {}).get("image/svg+xml", "")):
            text = "".join(output["data"]["text/plain"])
            assert f'<svg role="img" aria-label="{escape(text)}"' in svg


def test_a_widget_has_a_form_that_the_built_page_shows(notebook):
    for output in outputs(notebook[1]):
        if WIDGET in output.get("data", {}):
            assert "text/html" in output["data"]


def test_only_known_cells_escape_the_comparison(notebook):
    path, content = notebook
    tags = {c["id"]: c["metadata"].get("tags", []) for c in content["cells"]}
    ignored = {(path.stem, i) for i, t in tags.items() if "nbval-ignore-output" in t}
    known = {key for key in NOT_COMPARED if key[0] == path.stem}

    assert ignored == known
    assert {tag for cell in tags.values() for tag in cell} <= TAGS
    assert "NBVAL_" not in "".join("".join(c["source"]) for c in content["cells"])


def test_a_page_is_stored_as_the_tool_stores_it(notebook):
    """That another run gives the same outputs is for nbval; see conftest.py."""
    path, _ = notebook

    settled = refresh_notebooks.settled(nbformat.read(path, as_version=4))

    assert settled == path.read_text(encoding="utf-8")
