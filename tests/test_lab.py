"""A scene in a real JupyterLab: the browser and Python change the same state."""

import os
import secrets
import socket
import subprocess
import sys
import time
import urllib.request
from importlib.util import find_spec
from pathlib import Path

import nbformat
import pytest
from conftest import unavailable
from nbformat.v4 import new_code_cell, new_notebook

CELLS = ["from abstransfer import widgets\n\nscene = widgets.Microscope()\nscene", "1"]


@pytest.fixture
def lab(tmp_path):
    """The address of a JupyterLab of its own, with one notebook."""
    if not find_spec("jupyterlab"):
        unavailable("JupyterLab is not installed; run: pip install -e '.[test]'")
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook = new_notebook(
        cells=[new_code_cell(source) for source in CELLS],
        metadata={"kernelspec": kernel},
    )
    nbformat.write(notebook, tmp_path / "scene.ipynb")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    token = secrets.token_hex(16)
    options = {
        "ServerApp.ip": "127.0.0.1",
        "ServerApp.port": port,
        "ServerApp.root_dir": tmp_path,
        "ServerApp.open_browser": False,
        "ServerApp.allow_root": True,
        "IdentityProvider.token": token,
    }
    homes = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR")
    env = {**os.environ, **{home: str(tmp_path / home.lower()) for home in homes}}
    tool = Path(sys.executable).with_name("jupyter-lab")
    command = [tool, *(f"--{name}={value}" for name, value in options.items())]
    address = f"http://127.0.0.1:{port}"
    with (tmp_path / "log").open("w") as log:
        server = subprocess.Popen(command, env=env, stdout=log, stderr=log)
        try:
            wait_for(f"{address}/api", server, tmp_path / "log")
            yield f"{address}/lab/tree/scene.ipynb?token={token}"
        finally:
            server.terminate()
            server.wait(10)


def wait_for(url, server, log):
    for _ in range(300):
        if server.poll() is not None:
            unavailable(f"JupyterLab did not start: {log.read_text()[-500:]}")
        try:
            urllib.request.urlopen(url, timeout=1)
            return
        except OSError:
            time.sleep(0.1)
    pytest.fail("JupyterLab does not answer")


def run_last_cell(page, code):
    """Type a line into the last cell, run it, and return what it printed."""
    cell = page.locator(".jp-CodeCell").last
    cell.locator(".cm-content").click()
    page.keyboard.press("Control+a")
    page.keyboard.type(f"{code}; print('said', scene.t, scene.start)")
    page.keyboard.press("Control+Enter")
    output = cell.locator(".jp-OutputArea-output", has_text="said")
    output.wait_for(timeout=20_000)
    return output.inner_text().strip()


def test_the_browser_and_python_share_the_state_of_a_scene(lab, chromium):
    context = chromium.new_context(viewport={"width": 1400, "height": 1200})
    elsewhere, problems = [], []
    context.route(
        lambda url: (
            "//127.0.0.1:" not in url and not url.startswith(("data:", "blob:"))
        ),
        lambda route: (elsewhere.append(route.request.url), route.abort()),
    )
    page = context.new_page()
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(lab)
    page.locator(".jp-CodeCell").last.wait_for(timeout=60_000)
    page.get_by_text("| Idle").wait_for(timeout=60_000)
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    scene = page.locator(".abstransfer-scene.ab-live")
    scene.wait_for(timeout=60_000)
    step = scene.get_by_role("slider", name="Step")
    assert step.input_value() == "111"

    scene.get_by_role("button", name="One step back", exact=True).click()
    page.wait_for_timeout(500)  # the change is on its way
    assert run_last_cell(page, "x = 1") == "said 110 goal"

    assert run_last_cell(page, "scene.t, scene.start = 7, 'cost'") == "said 7 cost"
    page.wait_for_function("document.querySelector('.ab-timeline input').value == '7'")
    assert scene.get_by_role(
        "radio", name="\u22121 a step, Q starts at 0"
    ).first.is_checked()
    assert "microscope" not in page.url
    assert problems == []
    assert elsewhere == []
    context.close()
