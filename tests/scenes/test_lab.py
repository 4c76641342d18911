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
from jupyter_client import BlockingKernelClient
from nbformat.v4 import new_code_cell, new_notebook
from playwright.sync_api import expect
from scene_tab import UNPAINTED
from support import PATIENCE, unavailable

from abstransfer import scenes

expect.set_options(timeout=1000 * PATIENCE)

CELL = "from abstransfer import scenes\n\n{0} = scenes.{0}({1})\n{0}"
# What stands for a scene where no script runs is shown elsewhere, and takes seconds.
QUICK = (
    "from abstransfer.scenes.base import Scene\n\nScene.html = lambda _: '<p>-</p>'\n"
)
SHORT = "steps=600_000"  # of what learns as soon as it is shown
SLIDERS = {  # scene: label of a slider, its trait, a value to drag to, one to push
    "Microscope": ("Step", "t", 110, 7),
    "Race": ("Step", "t", 38, 7),
    "TauSlider": ("Advice until step τ", "tau", 8_500_000, 6_000_000),
    "Ballot": ("The dial: β", "beta", 2.5, 0.5),
    "Paint": ("Goal of the small building", "task", 5, 2),
    "Hill": ("Iteration", "t", 20, 7),
    "Ripple": ("Sweep", "k", 8, 3),
    "Dial": ("Luck: run", "luck", 2, 5),
    "Ladder": ("A move succeeds with probability", "success", 0.8, 0.65),
    "Project": ("Runs of each", "lives", 3, 7),
    "Filling": ("Runs", "n", 20, 7),
}
SCENES = [*SLIDERS, "Studio"]
# anywidget waits two seconds for the module of a scene, then hears Python no more.
PATIENT = """
const limit = AbortSignal.timeout.bind(AbortSignal);
AbortSignal.timeout = (milliseconds) => limit(1000 * milliseconds);
"""
# Moves a slider step by step; returns what it was set to meanwhile.
DRAG = """(input, end) => new Promise((tell) => {
    const others = [];
    let i = 0;
    const turn = setInterval(() => {
        if (i && input.valueAsNumber !== i) others.push([i, input.valueAsNumber]);
        if (i === end) return clearInterval(turn), tell(others);
        input.value = ++i;
        input.dispatchEvent(new Event("input"));
    }, 30);
})"""


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """
    A JupyterLab of its own, with one notebook of all scenes.

    The value is its address, and the folder of files that tell how to reach kernels.
    """
    if not find_spec("jupyterlab"):
        unavailable("JupyterLab is not installed; run: pip install -e '.[test]'")
    folder = tmp_path_factory.mktemp("lab")
    short = {
        name: SHORT if hasattr(getattr(scenes, name), "steps") else ""
        for name in SCENES
    }
    cells = [new_code_cell(CELL.format(*each)) for each in short.items()]
    cells[0].source = QUICK + cells[0].source
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    cells.append(new_code_cell("1"))
    notebook = new_notebook(cells=cells, metadata={"kernelspec": kernel})
    nbformat.write(notebook, folder / "scenes.ipynb")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    token = secrets.token_hex(16)
    options = {
        "ServerApp.ip": "127.0.0.1",
        "ServerApp.port": port,
        "ServerApp.root_dir": folder,
        "ServerApp.open_browser": False,
        "ServerApp.allow_root": True,
        "KernelManager.transport": "ipc" if sys.platform == "linux" else "tcp",
        "IdentityProvider.token": token,
    }
    homes = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR")
    env = {**os.environ, **{home: str(folder / home.lower()) for home in homes}}
    kernels = tmp_path_factory.mktemp("r")  # short, for sockets
    env["JUPYTER_RUNTIME_DIR"] = str(kernels)
    settings = folder / "jupyter_config_dir/lab/user-settings/@jupyterlab"
    settings /= "notebook-extension/tracker.jupyterlab-settings"
    settings.parent.mkdir(parents=True)
    seen = '{"windowingMode": "none"}'  # cells out of view exist too
    settings.write_text(seen, encoding="utf-8")
    tool = Path(sys.executable).with_name("jupyter-lab")
    command = [tool, *(f"--{name}={value}" for name, value in options.items())]
    address = f"http://127.0.0.1:{port}"
    with (folder / "log").open("w", encoding="utf-8") as log:
        server = subprocess.Popen(command, env=env, stdout=log, stderr=log)
        try:
            wait_for(f"{address}/api", server, folder / "log")
            yield f"{address}/lab/tree/scenes.ipynb?token={token}", kernels
        finally:
            server.terminate()
            server.wait(PATIENCE)


def wait_for(url, server, log):
    for _ in range(10 * PATIENCE):
        if server.poll() is not None:
            said = log.read_text(encoding="utf-8")[-500:]
            unavailable(f"JupyterLab did not start: {said}")
        try:
            urllib.request.urlopen(url, timeout=1)
            return
        except OSError:
            time.sleep(0.1)
    pytest.fail("JupyterLab does not answer")


@pytest.fixture(scope="module")
def page(lab, chromium):
    """A tab in which the notebook was run; nothing may fail or be fetched there."""
    context = chromium.new_context(viewport={"width": 1400, "height": 1200})
    elsewhere, problems = [], []
    context.route(
        lambda url: (
            "//127.0.0.1:" not in url and not url.startswith(("data:", "blob:"))
        ),
        lambda route: (elsewhere.append(route.request.url), route.abort()),
    )
    context.add_init_script(PATIENT)
    page = context.new_page()
    page.set_default_timeout(1000 * PATIENCE)
    page.on("pageerror", lambda error: problems.append(str(error)))
    address, _ = lab
    page.goto(address)
    page.add_style_tag(content=UNPAINTED)
    page.locator(".jp-CodeCell").last.wait_for()
    page.get_by_text("| Idle").wait_for()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    page.get_by_text("| Idle").wait_for()
    for number in range(len(SCENES)):
        scene_of(page, number).wait_for()
    yield page
    assert problems == []
    assert elsewhere == []
    assert "#" not in page.url
    context.close()


def scene_of(page, number):
    """Return the scene of a cell."""
    page.locator(".jp-CodeCell").nth(number).scroll_into_view_if_needed()
    return (
        page.locator(".jp-CodeCell").nth(number).locator(".abstransfer-scene.ab-live")
    )


@pytest.fixture(scope="module")
def kernel(lab, page):
    """The notebook's kernel, asked past the page: a cell takes long to type and run."""
    _, kernels = lab
    (file,) = kernels.glob("kernel-*.json")
    client = BlockingKernelClient(connection_file=str(file))
    client.load_connection_file()
    client.start_channels()
    yield client
    client.stop_channels()


def run(kernel, code, said="None"):
    """Run code in the kernel, and return what an expression is worth then, as text."""
    expressions = {"said": said}
    reply = kernel.execute(
        code, user_expressions=expressions, reply=True, timeout=PATIENCE
    )["content"]
    assert reply["status"] == "ok", reply
    return reply["user_expressions"]["said"]["data"]["text/plain"]


def wait_until(page, kernel, code):
    """Wait until Python finds that code is true: a change is on its way to it."""
    for _ in range(20 * PATIENCE):
        if run(kernel, "", code) == "True":
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never true in Python: {code}")


@pytest.mark.parametrize("name", SLIDERS)
def test_the_browser_and_python_share_the_state_of_a_scene(page, kernel, name):
    label, trait, moved, pushed = SLIDERS[name]
    slider = scene_of(page, SCENES.index(name)).get_by_role("slider", name=label)

    slider.fill(str(moved))
    wait_until(page, kernel, f"{name}.{trait} == {moved}")
    slider.press("ArrowLeft")  # JupyterLab must not take it for a command
    expect(slider).not_to_have_value(str(moved))
    wait_until(page, kernel, f"{name}.{trait} != {moved}")
    slider.press("ArrowRight")
    expect(slider).to_have_value(str(moved))
    wait_until(page, kernel, f"{name}.{trait} == {moved}")

    run(kernel, f"{name}.{trait} = {pushed}")
    expect(slider).to_have_value(str(pushed))


def test_python_does_not_set_back_a_slider_that_moves_on(page, kernel):
    """It repeats each value that it hears, when the hand may be elsewhere."""
    scene = scene_of(page, SCENES.index("Microscope"))
    slider = scene.get_by_role("slider", name="Step")

    assert slider.evaluate(DRAG, 60) == []
    wait_until(page, kernel, "Microscope.t == 60")


def test_a_building_that_was_drawn_in_the_browser_is_a_map_in_python(page, kernel):
    scene = scene_of(page, SCENES.index("Studio"))

    scene.get_by_role("button", name="The target").click()
    target = "Map(18 x 30 cells, 35 rooms, 35 goals)"
    wait_until(page, kernel, f"repr(Studio.map) == {target!r}")

    page.locator(".jp-CodeCell").last.locator(".cm-content").click()
    page.keyboard.press("Control+a")
    page.keyboard.insert_text("Studio.map = 'source'")
    page.keyboard.press("Control+Enter")
    expect(scene.get_by_text("135 cells").first).to_be_visible()


def test_scenes_of_one_notebook_do_not_share_names(page):
    """Each brings the scripts anew; a label must still find its own control."""
    ids = page.locator(".abstransfer-scene [id]").evaluate_all(
        "all => all.map(e => e.id)"
    )

    assert ids
    assert len(ids) == len(set(ids))
