"""Values that ripple out: every sweep is Python's, by mouse and by keyboard."""

import numpy as np
import pytest
from scene_tab import bare, number

from abstransfer import solvers
from abstransfer.maps import read_map
from abstransfer.scenes import Ripple
from abstransfer.scenes.ripple.widget import RIGHT


def room(n):
    """Return one room of n x n cells, its goal in the middle."""
    rows = [["|", *" " * (2 * n - 1), "|"] for _ in range(2 * n - 1)]
    rows[n // 2 * 2][n // 2 * 2 + 1] = "*"
    wall = "+" + "-" * (2 * n - 1) + "+"
    return "\n".join([wall, *map("".join, rows), wall])


def opened(show, query="", **options):
    return show(bare(Ripple, **options), query)


def believed(scene):
    """What the table shows: the values now, in the end, and numbers of best actions."""
    _, _, lines = scene.table()
    columns = np.array(
        [[number(cell) for cell in line[2:]] for line in lines], dtype=float
    )
    return columns.T


def assert_pythons(scene, widget, k):
    now, then, best = believed(scene)

    np.testing.assert_allclose(now, widget.sweeps[k], atol=1e-6)
    np.testing.assert_allclose(then, widget.sweeps[-1], atol=1e-6)
    assert best.tolist() == widget.best_actions.sum(axis=1).tolist()


def last(widget):
    return len(widget.sweeps) - 1


def both_bets(scene, sweeps="about 75", ties="in hardly any"):
    for text in (sweeps, ties):
        scene.root.get_by_text(text, exact=True).click()
    return scene.settle()


# Python


def test_the_last_sweep_is_the_first_that_is_right_everywhere():
    scene = Ripple(task=7)
    exact = solvers.optimal_values(scene.tasks.mdp)
    errors = [abs(v - exact).max() for v in scene.sweeps]

    assert last(scene) == 77, "the number that page 2 prints"
    assert errors[-1] < RIGHT <= errors[-2]
    assert scene.errors.tolist() == errors
    np.testing.assert_allclose(scene.sweeps[3], -(1 - 0.99**4) / 0.01, atol=5)


def test_news_travels_a_cell_a_sweep():
    scene = Ripple()
    for k, v in enumerate(scene.sweeps):
        deaf = -(1 - 0.99 ** (k + 1)) / 0.01  # pays in every sweep so far
        heard = v > deaf + 1e-12
        # Beyond 12 sweeps what has come is less than rounding shows.
        if k < 12:
            assert (heard == (scene.news <= k)).all()
    assert scene.news.max() == 23


def test_the_still_picture_states_the_finding():
    still = Ripple().still()
    waves = [Ripple(task=task) for task in range(11)]
    ties = [(wave.best_actions.sum(axis=1) > 1).sum() for wave in waves]

    assert len(set(still.frames)) == 3
    assert f"at most {max(map(last, waves))} sweeps" in still.caption
    assert f"and {sum(ties)} of 1474 cells have" in still.caption
    assert f"after {last(waves[0])} sweeps" in still.caption
    assert len(Ripple(map=room(3), success=1, k=0).still().frames) == 3


# The page


def test_every_sweep_is_pythons(show):
    scene, widget = opened(show), Ripple()
    assert_pythons(scene, widget, 5)
    assert "20 of 135 cells" in scene.root.inner_text()
    assert "\u22125.85" in scene.root.inner_text()
    for k in (0, 1, 22, last(widget)):
        scene.slider("Sweep").fill(str(k))
        scene.settle()
        assert_pythons(scene, widget, k)
        text = scene.root.inner_text()
        assert f"wrong by {widget.errors[k]:.2f}" in text
    assert scene.slider("Sweep").get_attribute("max") == str(last(widget))

    scene.slider("Task").fill("6")  # the seventh of eleven
    scene.slider("succeeds").fill("0.6")
    scene.settle()
    other = Ripple(task=6, success=0.6)
    assert scene.slider("Sweep").input_value() == str(last(other)), "still at the end"
    assert_pythons(scene, other, last(other))
    assert scene.problems == []


def test_a_cell_shows_the_backup_of_the_next_sweep(show):
    scene, widget = opened(show), Ripple()
    mdp = widget.tasks.mdp
    for cell, k in ((78, 5), (4, 0), (134, 30), (62, 12)):
        scene.slider("Sweep").fill(str(k))
        scene.click_cell(cell)
        q = solvers.action_values(mdp, widget.sweeps[k])[cell]
        wanted = [-1 + 0.99 * q.max(), -1, 0.99, q.max()]
        assert abs(widget.sweeps[k + 1][cell] - wanted[0]) < 1e-12
        np.testing.assert_allclose(backup(scene), wanted, atol=5e-5)
        moves = mdp.next_state[cell, q.argmax()] != cell
        share = mdp.prob[cell, q.argmax()][moves]
        cells = mdp.next_state[cell, q.argmax()][moves]
        ahead = f"to {share @ widget.sweeps[k][cells] / 0.9:.4f} on average"
        assert ahead.replace("-", "\u2212") in scene.root.inner_text()

    scene.click_cell(16)  # the goal of the task: nothing comes after it
    assert backup(scene) == [0, 0]
    assert scene.problems == []


def backup(scene):
    """The numbers of the formula."""
    return [number(term) for term in scene.root.locator(".ab-term b").all_inner_texts()]


def test_bets_arrows_and_the_closing_sentence(show):
    scene = opened(show)
    chart = scene.root.locator(".ab-chart")
    assert chart.is_hidden()
    assert not scene.root.get_by_role("checkbox").is_visible()
    both_bets(scene, ties="in most").click("To the end")
    assert chart.is_visible()
    scene.root.get_by_role("checkbox").check()
    scene.wait("In all 11 tasks", ".ab-closing")
    widget = Ripple()
    n_best = widget.best_actions.sum(axis=1)

    assert "You bet on \u201cabout 75\u201d: right." in scene.closing
    assert "in most\u201d; it was \u201cin hardly any\u201d" in scene.closing
    assert f"after {last(widget)} sweeps" in scene.closing
    assert f"best in {(n_best > 1).sum()} of 134 cells" in scene.closing
    assert "at most 23 steps, 77 sweeps, 64 of 1,474 cells." in scene.closing
    framed = scene.root.locator(".ab-tile.ab-lit").evaluate_all(
        "all => all.map(tile => Number(tile.dataset.cell))"
    )
    assert framed == np.flatnonzero(n_best > 1).tolist()
    assert scene.root.locator(".ab-arrow:not([hidden])").count() == 134
    assert scene.violations() == []
    scene.page.evaluate("document.documentElement.dataset.theme = 'dark'")
    assert scene.settle().violations() == []
    assert scene.problems == []


def test_arrows_lead_where_the_best_actions_may(show):
    scene = opened(show)
    found = scene.ask(
        """([task, success]) => {
            const { waves, parseMap, mapTexts } = probe;
            const work = waves.ripple(parseMap(mapTexts.source), task, success);
            let step;
            do step = work.next(); while (!step.done);
            return [...waves.arrowsOf(step.value)];
        }""",
        [4, 0.9],
    )
    widget = Ripple(task=4)
    policy = at_ties(widget)
    mdp = widget.tasks.mdp
    weights = np.zeros((135, 4))
    for s, d in np.argwhere(widget.map.neighbors >= 0):
        for a in np.flatnonzero(policy[s]):
            to = mdp.next_state[s, a] == widget.map.neighbors[s, d]
            weights[s, d] += policy[s, a] * mdp.prob[s, a][to].sum() / 0.9

    np.testing.assert_allclose(np.reshape(found, (135, 4)), weights, atol=1e-12)
    assert weights.sum() == pytest.approx(134)


def at_ties(widget):
    """The policy that shares between equally good actions."""
    optimal = widget.best_actions.astype(float)
    return optimal / np.maximum(optimal.sum(axis=1, keepdims=True), 1)


def test_by_keyboard_alone_to_the_end(show):
    scene = show(bare(Ripple), reduced_motion="reduce", color_scheme="dark")
    assert not scene.plays
    assert scene.slider("Sweep").input_value() == "5", "nothing plays by itself"
    scene.root.get_by_role("radio", name="about 25").focus()
    scene.press("Space")
    stops = []
    for _ in range(16):
        scene.press("Tab")
        stops.append(scene.focused)
        if scene.focused.startswith("row "):
            scene.press("Home", "ArrowRight", "ArrowRight", "ArrowRight", "Enter")
        if scene.page.evaluate("document.activeElement.closest('.ab-bet') !== null"):
            scene.press("ArrowDown")
        if scene.focused == "To the end":
            scene.press("Enter")
            break
    scene.wait("You bet on", ".ab-closing")

    assert sum(stop.startswith("row ") for stop in stops) == 1, "one tab stop"
    assert scene.focused == "To the end"
    assert "about 25\u201d; it was \u201cabout 75\u201d" in scene.closing
    assert "row 1, column 4, in sweep" in scene.root.inner_text()
    scene.wait("You bet on", "[role=status]")
    assert scene.small_controls() == []


def test_a_goal_is_chosen_with_a_click_and_a_moment_has_an_address(show):
    goal = read_map("source").goals[8]
    scene = opened(show, "#ripple.k=20&ripple.success=0.75")
    scene.click_cell(goal)
    scene.url_with("ripple.task=8")
    assert_pythons(scene, Ripple(task=8, success=0.75), 20)
    scene.button("Reset").click()
    scene.page.wait_for_function("!location.hash.includes('ripple')")
    assert_pythons(scene.settle(), Ripple(), 5)
    scene.go("#ripple.k=1e9&ripple.task=-3&ripple.cell=x")
    assert scene.slider("Sweep").input_value() == str(last(Ripple()))
    assert scene.problems == []


def test_ends_of_sliders_quick_changes_and_how_much_they_paint(show):
    scene = opened(show)
    for label in ("Task", "succeeds", "Sweep"):
        slider = scene.slider(label)
        for value in ("min", "max", "min"):
            slider.fill(slider.get_attribute(value))
            scene.settle()
            assert slider.input_value() == slider.get_attribute(value)
    for label, last_ in (("Task", "3"), ("succeeds", "0.95")):
        scene.slider(label).evaluate(
            "(e, values) => { for (const v of values) { e.value = v;"
            " e.dispatchEvent(new Event('input')); } }",
            ["0", "1", "0.5", "0.7", last_],
        )
    scene.settle()
    assert_pythons(scene, Ripple(task=3, success=0.95), 0)

    scene.slider("Task").evaluate("e => e.parentElement.id = 'tasks'")
    cells = scene.page.locator(".ab-tile").count()
    assert max(scene.writes_by_moves("#tasks input", 1)) < 6 * cells
    scene.slider("succeeds").evaluate("e => e.parentElement.id = 'success'")
    assert max(scene.writes_by_moves("#success input", 0.05)) < 6 * cells
    assert scene.problems == []


@pytest.mark.parametrize("n", [3, 60])
def test_small_and_large_buildings(show, n):
    widget = Ripple(map=room(n))
    scene = opened(show, map=room(n), cell=0, k=1)
    scene.wait("have heard")
    both_bets(scene).click("To the end")
    scene.wait("News reaches", ".ab-closing")

    assert f"{2 * (n // 2)} steps away" in scene.closing
    assert f"after {last(widget)} sweeps" in scene.closing
    assert f"of {n * n - 1:,} cells" in scene.closing
    assert "tasks" not in scene.closing
    assert scene.problems == []


def test_nothing_is_swept_after_leaving(show):
    scene = opened(show)
    turns = scene.page.evaluate(
        """async (map) => {
            const later = window.setTimeout;
            let turns = 0; // each slice of sweeping asks for the next
            window.setTimeout = (...all) => (turns++, later(...all));
            // What the page's own scene asks for is over.
            for (let before = -1; before < turns;) {
                before = turns;
                await new Promise((f) => later(f, 1000));
            }
            turns = 0;
            const div = document.body.appendChild(document.createElement("div"));
            const { leave } = said.ripple.mount(div, { map }, { url: false });
            await new Promise((f) => later(f, 100));
            leave();
            div.remove();
            const before = turns;
            await new Promise((f) => later(f, 500));
            return [before, turns];
        }""",
        room(60),
    )

    assert 0 < turns[0] == turns[1]
    assert scene.problems == []
