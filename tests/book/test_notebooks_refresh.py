"""The tool that runs the notebooks: what is random is settled, all else is kept."""

import json

import nbformat
import pytest
import refresh_notebooks
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from refresh_notebooks import (
    drop_scenes,
    fold_solutions,
    join_streams,
    numbered,
    settled,
    take_alt_text,
)

A, B, C, D = (letter * 32 for letter in "abcd")
WIDGETS = """
import ipywidgets as widgets
left, right = widgets.IntSlider(), widgets.IntSlider()
link = widgets.jslink((left, "value"), (right, "value"))
widgets.VBox([left, right])
"""


def test_names_are_numbered_in_the_order_of_use():
    state = {A: {"child": f"IPY_MODEL_{C}"}, B: {}, C: {}}

    names = numbered(f"first {B}, then {A}", state)

    assert [int(names[name]) for name in (B, A, C)] == [1, 2, 3]


def test_widgets_that_nothing_names_are_kept_and_numbered_by_content():
    state = {D: {"source": A, "kind": 2}, C: {"source": A, "kind": 1}, A: {}}

    names = numbered(A, state)

    assert [int(names[name]) for name in (A, C, D)] == [1, 2, 3]


def test_longer_hashes_are_no_names():
    assert numbered("0" * 64, {}) == {}


def test_pieces_of_one_stream_are_joined():
    pieces = [
        new_output("stream", name="stdout", text="a"),
        new_output("stream", name="stdout", text="b"),
        new_output("stream", name="stderr", text="c"),
        new_output("stream", name="stdout", text="d"),
    ]

    assert [o["text"] for o in join_streams(pieces)] == ["ab", "c", "d"]


def test_of_a_scene_only_its_html_is_kept():
    state = {A: {"state": {"layout": f"IPY_MODEL_{B}"}}, B: {}, C: {}, D: {}}
    view = "application/vnd.jupyter.widget-view+json"
    scene, slider = (
        new_output("display_data", data={view: {"model_id": name}}) for name in (A, C)
    )
    scene["data"]["text/html"] = "<div></div>"

    drop_scenes([scene, slider, new_output("stream", text="")], state)

    assert scene["data"] == {"text/html": "<div></div>"}
    assert slider["data"] == {view: {"model_id": C}}
    assert set(state) == {C, D}


@pytest.mark.parametrize("html", [True, False])
def test_widgets_are_stored_only_where_an_output_shows_one(html):
    view = "application/vnd.jupyter.widget-view+json"
    output = new_output("display_data", data={view: {"model_id": A}})
    if html:
        output["data"]["text/html"] = "<div></div>"
    notebook = new_notebook(cells=[new_code_cell(outputs=[output])])
    state = {A: {"state": {}}, B: {"state": {}}}  # b: made on the way to a scene
    kind = "application/vnd.jupyter.widget-state+json"
    notebook.metadata["widgets"] = {kind: {"state": state}}

    metadata = json.loads(settled(notebook))["metadata"]

    assert ("widgets" in metadata) == (not html)


def test_the_alt_text_of_a_figure_reaches_the_cell():
    output = new_output(
        "display_data",
        data={"image/svg+xml": "<svg/>"},
        metadata={"image/svg+xml": {"alt": "A line that rises."}},
    )
    cell = new_code_cell(outputs=[output], metadata={"tags": ["hide-input"]})

    take_alt_text(cell)

    assert cell.metadata == {
        "tags": ["hide-input"],
        "mystnb": {"image": {"alt": "A line that rises."}},
    }


def test_times_and_versions_are_dropped_and_names_of_cells_kept():
    cell = new_code_cell("1", id="one", metadata={"execution": {"started": "now"}})
    notebook = new_notebook(cells=[new_markdown_cell("x", id="text"), cell])
    notebook.metadata["language_info"] = {"name": "python", "version": "3.99"}

    text = settled(notebook)

    assert [c["id"] for c in json.loads(text)["cells"]] == ["text", "one"]
    assert "now" not in text
    assert "3.99" not in text


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "page.ipynb"
    cells = [new_code_cell("print('here')", id="a"), new_code_cell(WIDGETS, id="b")]
    nbformat.write(new_notebook(cells=cells), path)
    return path


def test_a_page_is_stored_once_and_then_found_unchanged(page, capsys):
    assert refresh_notebooks.main(["--check", str(page)]) == 1  # never run yet
    assert refresh_notebooks.main([str(page)]) == 0
    first = page.read_bytes()
    assert refresh_notebooks.main(["--check", str(page)]) == 0

    notebook = json.loads(first)
    (state,) = notebook["metadata"]["widgets"].values()
    kinds = [model["model_name"] for model in state["state"].values()]
    assert kinds.count("IntSliderModel") == 2
    assert kinds.count("LinkModel") == 1
    assert "unchanged" in capsys.readouterr().out


def test_a_cell_that_fails_is_an_error(page):
    nbformat.write(new_notebook(cells=[new_code_cell("1 / 0", id="a")]), page)

    with pytest.raises(Exception, match="ZeroDivisionError"):
        refresh_notebooks.main([str(page)])


def test_jupyterlab_folds_the_code_of_a_solution_and_no_other():
    cells = [
        new_code_cell("1"),
        new_markdown_cell("```{solution-start} ex-1-1\n:class: dropdown\n```"),
        new_code_cell("2"),
        new_markdown_cell("```{solution-end}\n```"),
        new_code_cell("3"),
    ]
    fold_solutions(cells)

    folded = {"outputs_hidden": True, "source_hidden": True}
    assert cells[2].metadata == {"jupyter": folded}
    assert cells[0].metadata == cells[4].metadata == {}
