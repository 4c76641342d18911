"""Surgery on notes: Python's numbers for each operation, by mouse and by keyboard."""

import json

import numpy as np
import pytest
from run_scenes import SHORT

from abstransfer.experiments.results import read_results
from abstransfer.scenes import Surgery
from abstransfer.scenes.surgery.operations import KINDS, operate

NAMES = {"nd": "ND's robot", "prob": "Prob's robot"}
WORDS = {
    "erase": "erase its notes where the other has none",
    "graft": "give it the other's notes where it has none",
    "deal": "deal the notes of each state to other actions",
    "thin": "erase half of the states, by chance",
}
ROWS = {
    ("nd", "erase"): "ND, blank where Prob is",
    ("nd", "thin"): "ND, half of the states",
    ("prob", "graft"): "Prob, + ND's notes",
    ("prob", "deal"): "Prob, notes dealt anew",
}


@pytest.fixture(scope="module")
def surgery():
    return Surgery(steps=SHORT)


def operated(scene, patient, operation):
    """Choose a robot and an operation, operate, and wait for the end."""
    scene.pick("On the table", NAMES[patient])
    scene.pick("The operation", WORDS[operation])
    scene.button("Operate").click()
    return scene.wait("goals after the advice.", ".ab-body > p")


# What Python says


def test_operations_do_what_their_names_say():
    rng = np.random.default_rng(0)
    available = rng.random((2000, 8)) < 0.4
    mine = np.where(available, rng.random((2000, 8)), 0)
    mine[::2] = 0
    other = np.where(np.arange(2000)[:, None] % 3, 0, rng.random((2000, 8)))
    found = {kind: operate(kind, mine, other, available, 1) for kind in KINDS}
    has, helps = mine.any(axis=1), other.any(axis=1)

    np.testing.assert_array_equal(found["none"], mine)
    np.testing.assert_array_equal(found["erase"].any(axis=1), has & helps)
    np.testing.assert_array_equal(found["graft"][has], mine[has])
    np.testing.assert_array_equal(found["graft"][~has], other[~has])
    np.testing.assert_array_equal(np.sort(found["deal"]), np.sort(mine))
    assert not found["deal"][~available].any(), "no note on what is not there"
    assert (found["deal"] != mine).any(axis=1)[has].mean() > 0.5
    kept = found["thin"].any(axis=1)
    assert 0.45 < kept[has].mean() < 0.55
    np.testing.assert_array_equal(found["thin"][kept], mine[kept])


def test_the_still_states_what_erasing_and_grafting_do(surgery):
    still = surgery.still()
    erased, grafted = (
        surgery.goals(*pair).sum() for pair in (("nd", "erase"), ("prob", "graft"))
    )

    assert f"it reaches {erased:,}; " in still.caption
    assert f"it reaches {grafted:,}." in still.caption
    assert [row[0] for row in still.rows][:2] == ["ND", "Prob"]
    assert len(still.frames) == 3


def test_the_page_carries_what_no_operation_leads_to(surgery):
    known = surgery.options()["curves"]

    assert list(known) == [f"{name} none 1 {SHORT}" for name in NAMES]
    assert known[f"nd none 1 {SHORT}"][1:] == surgery.goals("nd", "none").tolist()
    assert len(json.dumps(Surgery(steps=SHORT).options())) < 1000


def test_a_whole_run_is_that_of_the_stored_operations():
    stored, scene = read_results("operations-target"), Surgery(luck=2)
    pairs = {"nd-erased": ("nd", "erase"), "prob-grafted": ("prob", "graft")}

    for name, pair in pairs.items():
        assert scene.goals(*pair).sum() == stored.totals(name)[1]
        assert round(scene.noted(*pair), 4) == stored.record["noted"][name][1]


# In the page


@pytest.mark.parametrize(("patient", "operation"), ROWS)
def test_each_operation_has_pythons_numbers(show, surgery, patient, operation):
    scene = operated(show(surgery).bet("some of it"), patient, operation)
    _, _, lines = scene.table()
    rows = {name: rest for name, *rest in lines}
    share, total = rows[ROWS[patient, operation]]

    wanted = 100 * surgery.noted(patient, operation)
    assert float(share.removesuffix(" %")) == pytest.approx(wanted, abs=0.051)
    assert total == f"{surgery.goals(patient, operation).sum():,}"
    as_left = surgery.goals("nd", "none").sum()
    assert rows["ND, as left"][1] == f"{as_left:,}"
    assert scene.problems == []


def test_it_asks_first_and_then_says_how_much_of_the_lead_is_left(show):
    widget = Surgery(steps=6_000_000)
    scene = show(widget)
    assert scene.button("Operate").is_disabled()
    operated(scene.bet("most of it"), "nd", "erase")
    nd, prob, erased = (
        int(widget.goals(*pair).sum())
        for pair in (("nd", "none"), ("prob", "none"), ("nd", "erase"))
    )

    assert nd > prob, "or there is no lead to lose"
    left = f"{100 * (erased - prob) / (nd - prob):.0f} %".replace("-", "\u2212")
    assert f"In this run {left} of ND's lead is left" in scene.closing
    assert "You bet on" in scene.closing
    assert scene.root.locator(".ab-building").is_visible()
    assert scene.violations() == []
    assert scene.problems == []


def test_another_luck_is_operated_on_anew(show, surgery):
    scene = show(surgery, "#surgery.luck=3").bet("some of it")
    operated(scene, "nd", "thin")
    other = Surgery(steps=SHORT, luck=3)
    _, _, lines = scene.table()

    totals = {name: total for name, _, total in lines}
    assert totals["Prob, as left"] == f"{other.goals('prob', 'none').sum():,}"
    assert totals[ROWS["nd", "thin"]] == f"{other.goals('nd', 'thin').sum():,}"
    scene.button("Reset").click()
    scene.page.wait_for_function("!location.hash.includes('surgery')")
    assert scene.problems == []


def test_by_keyboard_alone_in_the_dark_on_a_phone(show, surgery):
    options = {"color_scheme": "dark", "reduced_motion": "reduce"}
    scene = show(surgery, "#surgery.operation=graft", width=400, **options)
    scene.tab_past_the_bet_to("Operate").wait("goals after the advice.", ".ab-body > p")

    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 400
    assert scene.small_controls() == []
    assert scene.violations() == []
    assert scene.problems == []


def test_stopping_and_leaving_end_the_workers(show):
    scene = show(Surgery(), "#surgery.operation=deal")
    scene.bet("some of it").button("Operate").click()
    scene.wait_for_worker().button("Stop").click()
    scene.settle()
    assert scene.is_idle()
    scene.button("Operate").click()
    scene.wait_for_worker()
    scene.page.goto("about:blank")

    assert scene.is_idle()
    assert scene.problems == []
