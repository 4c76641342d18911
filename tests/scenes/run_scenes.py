"""What the tests of the scenes of learning share: a reader's hand, Python's runs."""

from functools import cache

import pytest
from scene_tab import SceneTab

from abstransfer.experiments.problem import build_guides, target_tasks
from abstransfer.learning import q_learning

SHORT = 1_200_000  # steps of a run where its length does not matter


class Shown(SceneTab):
    """A scene of learning, as a reader handles it."""

    def button(self, name):
        return self.root.get_by_role("button", name=name)

    def slider(self, name):
        return self.root.get_by_role("slider", name=name)

    def bet(self, text):
        self.root.locator(".ab-bet").get_by_text(text, exact=True).click()
        return self.settle()

    def tab_past_the_bet_to(self, text):
        """By Tab, Space at the bet and Enter at a button that says the text."""
        focus = "document.activeElement"
        for _ in range(20):
            self.page.keyboard.press("Tab")
            if self.page.evaluate(f"{focus}.closest('.ab-bet') !== null"):
                self.page.keyboard.press("Space")
                self.settle()
            if text in self.page.evaluate(f"{focus}.innerText ?? ''"):
                self.page.keyboard.press("Enter")
                break
        return self

    @property
    def closing(self):
        closing = self.root.locator(".ab-closing")
        return closing.inner_text() if closing.is_visible() else ""

    @property
    def words(self):
        """The sentence above the pictures."""
        return self.root.locator(".ab-body > p").first.inner_text()

    def wait(self, text, where=".abstransfer-scene"):
        """Wait until a text is to be seen."""
        self.page.wait_for_function(
            "([text, where]) => document.querySelector(where).innerText.includes(text)",
            arg=[text, where],
        )
        return self.settle()

    def table(self):
        """The table of numbers, opened: its caption, head and lines."""
        self.rows()
        twin = self.root.locator(".ab-twin")
        cells = "[...row.cells].map(cell => cell.textContent)"
        head, *lines = twin.locator("tr").evaluate_all(
            f"rows => rows.map(row => {cells})"
        )
        return twin.locator("caption").inner_text(), head, lines

    def column(self, name):
        """Goals by window of one run, as the table shows them."""
        _, head, lines = self.table()
        return [int(line[head.index(name)].replace(",", "")) for line in lines]


@pytest.fixture
def show(open_scene):
    """Open a page with a scene: ``show(widget, "#race.t=5", width=400)``."""

    def open_page(widget, query="", **options):
        return Shown(open_scene(widget, query, **options).visit)

    return open_page


def python_run(scene, guide, strategy="hard", tau=0, policy=None, **options):
    """The run of a scene by Python's own learner; `guide` is a name or None."""
    tasks, scale = target_tasks(scene.problem), scene.scale
    if guide and policy is None:
        policy = built(scene.problem, guide)
    if policy is not None:
        tau = round(tau * scene.steps / 30e6)
        options |= {"guide": policy[tasks.rho], "strategy": strategy, "tau": tau}
    return q_learning(
        tasks.mdp, scale.steps, rng=scene.seed, window=scale.window, **options
    )


@cache
def built(problem, guide):
    """An abstract policy, built once."""
    return build_guides(problem, [guide])[guide]
