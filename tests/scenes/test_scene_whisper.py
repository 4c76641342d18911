"""Whispered advice: Python's numbers for each whisper, by mouse and by keyboard."""

import json

import pytest
from run_scenes import SHORT, python_run

from abstransfer.experiments.results import read_results
from abstransfer.scenes import Whisper
from abstransfer.scenes.whisper.widget import FOLDER, POWERS, STORED

WHAT = {
    "values": "values by view",
    "half": "half Prob, half eager",
    "prob": "Prob's chances",
    "nd": "ND's chances",
    "exists": "what exists",
}
MORE = "more goals than ND's advice"


@pytest.fixture(scope="module")
def whisper():
    return Whisper(steps=SHORT)


def whispered(scene, what="values", power=9):
    """Choose a whisper and its size, let it learn, and wait for the end."""
    scene.pick("Whispered", WHAT[what])
    scene.slider("Size").fill(str(power))
    scene.settle()
    scene.button("Whisper, and").click()
    return scene.wait("goals. Choose another", ".ab-body > p")


def totals(scene):
    """Goals by robot, as the table shows them."""
    _, _, lines = scene.table()
    return {name: goals for name, goals, _ in lines}


# What Python says


def test_the_rivals_are_those_of_the_other_scenes(whisper):
    assert whisper.goals("none").tolist() == python_run(whisper, None).goals.tolist()
    advised = python_run(whisper, "nd", "hard", 3.5e6)
    assert whisper.goals("advice").tolist() == advised.goals.tolist()


def test_a_whole_run_is_that_of_the_stored_bench():
    bench, scene = read_results(FOLDER), Whisper(luck=2, power=20)
    settings = {arm["name"]: arm for arm in bench.record["parameters"]["arms"]}

    assert settings["whisper"]["setting"] == 1e-20
    assert scene.goals("values", 20).sum() == bench.totals("whisper")[1]


def test_the_page_carries_both_rivals_and_the_stored_means(whisper):
    bench, scene = read_results(FOLDER), Whisper()

    assert list(whisper.options()["curves"]) == [
        f"none - 1 {SHORT}",
        f"advice - 1 {SHORT}",
    ]
    assert "stored" not in whisper.options()
    assert scene.options()["stored"] == {
        name: round(bench.totals(name).mean()) for name in STORED
    }
    assert len(json.dumps(scene.options())) < 1500


def test_the_still_states_the_finding(whisper):
    still = whisper.still()

    for goals in (whisper.goals("values", 9), whisper.goals("values", 0)):
        assert f"{goals.sum():,}" in still.caption
    assert len(still.frames) == 3


# In the page


@pytest.mark.parametrize("what", WHAT)
def test_each_whisper_has_pythons_numbers(show, whisper, what):
    scene = whispered(show(whisper).bet(MORE), what, 20)
    found = totals(scene)

    assert found[f"{WHAT[what]} \u00d7 1e\u221220"] == (
        f"{whisper.goals(what, 20).sum():,}"
    )
    assert found["ND's advice, hard"] == f"{whisper.goals('advice').sum():,}"
    assert scene.problems == []


def test_it_asks_first_and_then_says_who_was_right(show, whisper):
    scene = show(whisper)
    assert scene.button("Whisper, and").is_disabled()
    whispered(scene.bet(MORE))
    quiet, advice = (
        int(goals.sum())
        for goals in (whisper.goals("values", 9), whisper.goals("advice"))
    )

    assert quiet > 1.02 * advice, "or the bet below is lost"
    assert "You bet on" in scene.closing
    assert "right" in scene.closing
    assert f"lead to {quiet:,} goals, ND's advice to {advice:,}" in scene.closing
    assert scene.violations() == []


def test_seven_sizes_are_learned_by_one_button(show, whisper):
    scene = show(whisper).bet("about as many, within 2 %")
    scene.button("Seven sizes").click()
    scene.wait("goals. Choose another", ".ab-body > p")  # when all are done
    found = totals(scene)

    assert "as loud as they are" in scene.closing
    for power in POWERS:
        size = f"1e\u2212{power}" if power else "1"
        assert found[f"values by view \u00d7 {size}"] == (
            f"{whisper.goals('values', power).sum():,}"
        )
    assert scene.button("Seven sizes").is_disabled()
    assert scene.problems == []


def test_by_keyboard_alone_in_the_dark_on_a_phone(show, whisper):
    options = {"color_scheme": "dark", "reduced_motion": "reduce"}
    scene = show(whisper, "#whisper.what=exists", width=360, **options)
    scene.tab_past_the_bet_to("Whisper, and").wait(
        "goals. Choose another", ".ab-body > p"
    )

    goals = whisper.goals("exists", 9).sum()
    assert totals(scene)["what exists \u00d7 1e\u22129"] == f"{goals:,}"
    assert scene.page.evaluate("document.documentElement.scrollWidth") <= 360
    assert scene.violations() == []


def test_a_moment_has_an_address_and_a_reset(show, whisper):
    scene = show(whisper, "#whisper.power=20&whisper.what=half").bet(MORE)
    scene.wait("half Prob, half eager \u00d7 1e\u221220: not learned yet.")
    scene.button("Reset").click()
    scene.page.wait_for_function("!location.hash.includes('whisper')")

    assert scene.slider("Size").input_value() == "9"
    assert scene.is_idle()
