"""The ballot box: votes of one abstract state, and the advice of the dial."""

import re

import numpy as np
import pytest
from bs4 import BeautifulSoup
from buildings import tile_map
from scene_tab import bare, number
from traitlets import TraitError

from abstransfer import maps
from abstransfer.abstraction import LABELS
from abstransfer.driving import PAPER
from abstransfer.navigation import navigation_tasks
from abstransfer.scenes import Ballot
from abstransfer.scenes.ballot.widget import ADVICE, WINNER
from abstransfer.scenes.parts.betas import BETAS

SMALL = maps.read_map("source")
THREE = "+-+-+-+\n|. . .|\n+d+d+d+\n|*|*|*|\n+ + + +\n| | | |\n+-+-+-+"
WHOLE = "the whole advice, small building", "the whole advice, large building"


def counted(tab):
    """Wait until all votes are counted."""
    tab.page.wait_for_function(
        "() => !/^$|Counting/.test(document.querySelector('.ab-body > p').textContent)"
    )
    return tab.settle()


def bet(tab, best="Winner", more="no"):
    tab.pick(re.compile("^Bet first"), best).pick(re.compile("^And is there"), more)
    tab.wait("places of the dial")
    return tab


def with_large(tab):
    """Ask for the large building, too, once all is known of it."""
    tab.root.get_by_label(re.compile("^The large building, too")).check()
    return tab.settle()


def dial(tab, beta):
    tab.slider("The dial").fill(str(beta))
    return tab.settle()


def lit(tab):
    return tab.root.locator(".ab-lit").evaluate_all(
        "all => all.map(tile => Number(tile.dataset.cell))"
    )


def assert_box(tab, scene):
    """The table is what Python finds: votes, and probabilities of four places."""
    _, _, lines = tab.table()
    actions = [line for line in lines if line[0] not in WHOLE]
    votes = {line[0]: number(line[1]) for line in actions}
    assert sum(votes.values()) == pytest.approx(scene.votes.sum(), abs=1e-3)
    possible = navigation_tasks(scene.source).possible[scene.z]
    wanted = [scene.votes[a] for a in np.flatnonzero(possible)]
    assert [*votes.values()] == pytest.approx(wanted, abs=1e-4)
    for column, beta in enumerate([scene.beta, *ADVICE.values()], 2):
        page = Ballot(source=scene.source, z=scene.z, beta=beta).advice[scene.z]
        found = [number(line[column]) for line in actions]
        assert found == pytest.approx(page[possible], abs=1e-6)


@pytest.fixture
def ballot(show):
    return counted(show(bare(Ballot)))


# Numbers


def test_boxes_and_their_advice_are_those_of_python(ballot):
    tasks = navigation_tasks(SMALL)
    commonest = np.bincount(tasks.rho[~tasks.mdp.terminal]).argmax()
    for z, beta in zip([19, commonest] * 3, [0, 0.5, 1, 3, 8, np.inf], strict=True):
        ballot.go(f"#ballot.z={z}")
        dial(ballot, WINNER if beta == np.inf else beta)
        assert_box(ballot, Ballot(z=int(z), beta=beta))
    assert ballot.problems == []


def test_what_advice_is_worth_is_exact_and_the_papers_are_hollow_marks(ballot):
    with_large(bet(ballot))
    scene = Ballot()
    for beta in (0.25, 0.5, 2.75, 8.0, np.inf):
        dial(ballot, WINNER if beta == np.inf else beta)
        rows = ballot.rows()
        for name, where in zip(WHOLE, ("source", "target"), strict=True):
            now, *others = map(number, rows[name][1:])
            assert now == pytest.approx(scene.driving(where, beta), abs=1e-7)
            wanted = [scene.driving(where, at) for at in ADVICE.values()]
            assert others == pytest.approx(wanted, abs=1e-7)
        assert f"{scene.driving('source', beta):.2f}".replace("-", "−") in (
            ballot.root.inner_text()
        )

    marks = ballot.ask(
        "[0, 1].map(i => ['source', 'target'].map(name =>"
        " [probe.PAPER[name].nd, probe.PAPER[name].prob][i]))"
    )
    assert marks == [
        [PAPER[name][of] for name in ("source", "target")] for of in ("nd", "prob")
    ]
    hollow = ballot.root.locator(".ab-chart .ab-marker").evaluate_all(
        "all => all.filter(mark => /arm-(nd|prob)/.test(mark.getAttribute('style'))"
        " && /fill:var\\(--ab-ground\\)/.test(mark.getAttribute('style'))).length"
    )
    assert hollow == 4


def test_a_bet_comes_first_and_the_closing_names_the_best_advice(ballot):
    assert ballot.closing == ""
    assert not ballot.root.locator(".ab-chart").is_visible()
    assert ballot.rows()[WHOLE[0]][1:] == ["–"] * 4
    bet(ballot)
    assert "“Winner”; it was “Prob”" in ballot.closing
    assert "it was “yes, between ND and Prob”" in ballot.closing
    assert ballot.root.locator(".ab-chart").is_visible()
    counted(ballot.click("Reset"))
    bet(ballot, "Prob", "yes, between ND and Prob")
    scene = Ballot()
    places = [*BETAS, np.inf]

    assert ballot.closing.count("right.") == 2
    with_large(ballot)
    for where in ("source", "target"):
        values = [scene.driving(where, beta) for beta in places]
        best = f"β = {places[int(np.argmax(values))]:.2f} with {max(values):.1f} a cell"
        assert best.replace("-", "−") in ballot.closing
        for name, beta in ADVICE.items():
            value = f"{name} {scene.driving(where, beta):.1f}"
            assert value.replace("-", "−") in ballot.closing


def test_the_bet_of_page_7_is_not_answered_before_a_reader_asks(ballot):
    values = {f"{Ballot().driving('target', beta):.1f}"[1:] for beta in (0, 1)}
    values |= {str(-PAPER["target"][name])[:4] for name in ("nd", "prob")}
    assert not any(value in Ballot().html() for value in values)
    bet(ballot)
    assert [*ballot.rows()][-1] == WHOLE[0]
    assert not any(value in ballot.root.inner_text() for value in values)

    with_large(ballot)
    assert [*ballot.rows()][-1] == WHOLE[1]
    assert all(f"−{value}" in ballot.closing for value in ("81.0", "70.2"))
    ballot.click("Reset")
    assert not ballot.root.get_by_label(re.compile("^The large")).is_checked()


# By mouse and by keyboard


def test_by_mouse(ballot):
    tasks = navigation_tasks(SMALL, keep=[7])
    assert lit(ballot) == [53, 101] == np.flatnonzero(tasks.rho == 19).tolist()
    assert ballot.root.locator(".ab-arrow:not([hidden])").count() == 2
    ballot.click_cell(20)
    assert f"z={tasks.rho[20]}" in ballot.url_with("z=")
    assert lit(ballot) == np.flatnonzero(tasks.rho == tasks.rho[20]).tolist()
    assert_box(ballot, Ballot(z=int(tasks.rho[20])))

    ballot.click_cell(SMALL.goals[0])
    other = navigation_tasks(SMALL, keep=[0])
    alike = (other.rho == tasks.rho[20]) & ~other.mdp.terminal
    assert lit(ballot) == np.flatnonzero(alike).tolist()
    assert "Goal1 of 11" in ballot.root.inner_text().replace("\n", "")


def test_boxes_come_by_the_number_of_their_votes(ballot):
    tasks = navigation_tasks(SMALL)
    size = np.bincount(tasks.rho[~tasks.mdp.terminal], minlength=tasks.n_abstract)
    order = np.sort(size[size > 0])[::-1]
    place = int(re.match(r"Box (\d+) of 88", ballot.words)[1])
    for step, name in ((1, "A box with fewer votes"), (0, "A box with more votes")):
        ballot.click(name)
        assert f"Box {place + step} of 88" in ballot.words
        states = order[place + step - 1]
        assert (
            f". {states} state{'s' * int(states != 1)} of 11 tasks vote" in ballot.words
        )
    commonest = int(size.argmax())
    ballot.go(f"#ballot.z={commonest}").wait("Box 1 of 88")
    assert ballot.button("A box with more votes").is_disabled()


def test_by_keyboard_alone(ballot):
    stops = []
    ballot.button("A box with more votes").focus()
    ballot.press("Enter")
    for _ in range(7):
        ballot.press("Tab")
        stops.append(ballot.focused)
        kind = ballot.page.evaluate("document.activeElement.type ?? ''")
        if stops[-1].startswith("row "):
            ballot.press("ArrowDown", "ArrowDown", "Enter")
        elif kind == "range" and ballot.page.evaluate(
            "document.activeElement.max == 8.25"
        ):
            ballot.press("End")
        elif kind == "radio":
            ballot.press("Space")
    ballot.wait("places of the dial")

    rho = navigation_tasks(SMALL, keep=[7]).rho
    assert_box(ballot, Ballot(z=int(rho[30]), beta=np.inf))
    assert sum(name.startswith("row ") for name in stops) == 1
    assert "∞ (the winner takes all)" in ballot.root.inner_text()
    assert "Of 34 places of the dial" in ballot.closing
    assert ballot.problems == []


# State


def test_ends_quick_changes_and_reset(ballot):
    bet(ballot)
    for slider in ballot.root.get_by_role("slider").all():
        for value in ("min", "max"):
            slider.fill(slider.get_attribute(value))
            ballot.settle()
    for value in ("1", "7.75", "0", "8.25", "0.5"):
        ballot.slider("The dial").evaluate(
            "(e, v) => { e.value = v; e.dispatchEvent(new Event('input')); }", value
        )
    ballot.settle()
    assert_box(ballot, Ballot(beta=0.5))
    wanted = f"{Ballot().driving('source', 0.5):.2f}".replace("-", "−")
    assert f"At β = 0.50 the whole advice is worth {wanted}" in ballot.root.inner_text()
    ballot.url_with("ballot.beta=0.5")

    assert "places of the dial" in ballot.closing, "all work is done"
    assert max(ballot.writes_by_moves('[max="8.25"]', 0.75)) < 50
    ballot.click("Reset")
    assert ballot.closing == ""
    assert "1.00 (Prob)" in ballot.root.inner_text()
    assert ballot.problems == []


def test_a_moment_has_an_address_and_wrong_ones_do_no_harm(show):
    first = counted(show(bare(Ballot), query="#ballot.beta=8.25&ballot.task=0"))
    assert "∞" in first.root.inner_text()
    assert lit(first) == [67, 70]
    other = show(bare(Ballot), query="#ballot.beta=x&ballot.z=1e9&ballot.task=99")
    other.wait("No state of the small building looks like this")
    assert "Goal11 of 11" in other.root.inner_text().replace("\n", "")
    assert other.problems == []


def test_it_is_there_at_once(ballot):
    n, left = ballot.nodes_at_once("ballot")

    assert n > SMALL.n_cells
    assert left == 0


def test_a_tiny_and_a_huge_building(show):
    scene = Ballot(source=THREE, map=THREE, task=0)
    options = {"source": THREE, "map": THREE, "task": 0}
    tab = counted(show(bare(Ballot, **options)))
    z = int(navigation_tasks(scene.source, keep=[0]).rho[0])
    tab.click_cell(0)
    bet(tab)
    assert_box(tab, Ballot(**options | {"z": z}))
    now = number(tab.rows()[WHOLE[0]][1])
    assert now == pytest.approx(scene.driving(), abs=1e-7)
    assert "the paper's" not in tab.root.inner_text()

    huge = tile_map(SMALL, 7, 4)
    assert huge.n_cells >= 3600
    tab = show(bare(Ballot, map=huge))
    counted(tab).pick(re.compile("^Bet first"), "ND")
    tab.pick(re.compile("^And is there"), "no")
    dial(tab, 2)
    assert "At β = 2.00 the whole advice is worth" in tab.root.inner_text()
    tab.page.goto("about:blank")
    assert tab.problems == []


# Looks


def test_it_is_accessible(show):
    options = {"width": 400, "reduced_motion": "reduce"}
    tab = bet(counted(show(bare(Ballot), **options)))
    tab.rows()

    assert tab.violations() == []
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert tab.small_controls() == []
    assert len(tab.pictures(6)) == 1, "nothing moves by itself"


# In Python


def test_infinity_has_a_place_on_the_slider():
    scene = Ballot(beta=np.inf)
    assert scene.get_state()["beta"] == WINNER
    assert scene.advice.max(axis=1)[19] == 1
    scene.set_state({"beta": 0.5})  # as the browser does
    assert scene.beta == 0.5
    scene.set_state({"beta": WINNER})
    assert scene.beta == np.inf
    for wrong in (8.1, -1, np.nan):
        with pytest.raises(TraitError, match="a number in 0..8, or infinity"):
            scene.beta = wrong


def test_the_still_picture_says_who_drives_best():
    scene = Ballot()
    soup = BeautifulSoup(scene.html(), "html.parser")
    caption = soup.find("figcaption").get_text()
    best = max(BETAS, key=lambda beta: scene.driving("source", beta))

    assert f"that at β = {best:g} drives best" in caption
    assert f"{scene.driving('source', np.inf):.1f}".replace("-", "−") in caption
    assert len(soup.find_all("svg")) == 3
    named = [LABELS[a].replace("_", " ") for a in np.flatnonzero(scene.votes)]
    assert all(name in soup.get_text() for name in named)
