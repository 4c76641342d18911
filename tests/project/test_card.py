"""Races in a building of one's own, and the cards they leave."""

import re

import numpy as np
import pytest

from abstransfer import (
    abstract_policies,
    evaluate_policy,
    navigation_tasks,
    parse_map,
    read_map,
    uniform_policy,
)
from abstransfer.abstraction import FEATURES
from abstransfer.learning import q_learning
from abstransfer.project.card import card_text, verify
from abstransfer.project.prediction import Prediction
from abstransfer.project.racing import race
from abstransfer.project.setup import Setup, run, scale
from abstransfer.project.student import building_of, seed_of

ROOMS = parse_map(
    "+-----+-----+\n"
    "|     |     |\n"
    "|     |     |\n"
    "|  *  d  *  |\n"
    "|     |     |\n"
    "|     |     |\n"
    "+--d--+-----+\n"
    "|. . . . . .|\n"
    "+-----------+"
)


@pytest.fixture(scope="module")
def tasks():
    return navigation_tasks(ROOMS, reward="goal")


@pytest.fixture(scope="module")
def guides(tasks):
    source = navigation_tasks(read_map("source"))
    advice = abstract_policies(source, ("nd", "prob"))
    return advice | {"eager": uniform_policy(tasks.possible)}


@pytest.fixture(scope="module")
def ran(tasks, guides):
    return race(tasks, guides, steps=20_000, tau=2_000, n_runs=5)


# The race


def test_every_robot_has_the_same_luck_and_its_own_guide(tasks, guides, ran):
    alone = q_learning(
        tasks.mdp,
        20_000,
        rng=np.random.SeedSequence(2015, spawn_key=(0, 3)),
        guide=guides["nd"][tasks.rho],
        tau=2_000,
    )

    assert list(ran.goals) == ["none", "nd", "prob", "eager"]
    assert ran.goals["nd"][3] == alone.goals.sum() > 0
    assert len({goals.sum() for goals in ran.goals.values()}) == 4


def test_a_race_takes_features_of_ones_own():
    own = {"features": ("near_goal", "in_room"), "near": 2}
    tasks = navigation_tasks(ROOMS, reward="goal", **own)
    guide = abstract_policies(navigation_tasks(read_map("source"), **own), ("nd",))

    found = race(tasks, guide, steps=5_000, tau=500, n_runs=1)

    assert guide["nd"].shape == (4, 8)
    assert found.goals["nd"] > 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"guides": {"none": np.ones((1, 1))}}, "called 'none'"),
        ({"guides": {"nd": np.ones((4, 8))}}, r"'nd' must have shape \(2048, 8\)"),
        ({"n_runs": 0}, "n_runs must be a whole number from 1"),
        ({"seed": 2015.0}, "seed must be an int >= 0, not a float, got 2015.0"),
        ({"strategy": "firm"}, "strategy must be one of"),
    ],
)
def test_a_bad_argument_is_refused_by_name(tasks, guides, options, message):
    settings = {"guides": guides, "steps": 100, "tau": 10} | options

    with pytest.raises(ValueError, match=message):
        race(tasks, **settings)


def test_gains_compare_each_robot_with_the_one_without_advice(ran):
    gains = ran.gains()
    none = ran.goals["none"].mean()

    assert list(gains) == ["nd", "prob", "eager"]
    for name, gain in gains.items():
        assert gain.estimate == pytest.approx(ran.goals[name].mean() / none - 1)
        assert gain.low <= gain.estimate <= gain.high
    assert ran.gains() == gains


# The card


SMALL = parse_map("+---+---+\n|. .d*  |\n+---+---+")
SETUP = Setup(SMALL, FEATURES[8:], ("eager", "rand"), "own", "soft", runs=2)


@pytest.fixture(scope="module")
def card():
    return card_text(SETUP, run(SETUP).goals)


def test_a_card_says_how_advice_drives_as_table_1_does():
    setup = Setup(ROOMS, guides=("nd", "rand"), runs=1)
    tasks = navigation_tasks(ROOMS)  # at a cost of 1 a step
    nd = abstract_policies(navigation_tasks(read_map("source")), ["nd"])["nd"]
    value = evaluate_policy(tasks.mdp, nd[tasks.rho]).mean()
    text = card_text(setup, {"none": [5], "nd": [6], "rand": [5]})
    table = text.partition("```")[0].splitlines()
    rows = [line.split(" | ") for line in table if line.startswith("| ")]

    assert [row[0] for row in rows[2:]] == ["| none", "| nd", "| rand", "| optimal"]
    assert rows[3][1:] == [f"{value:.2f}", "6", "+20.0 %", "6 |"]
    assert "- Building: 24 cells, 2 rooms, 2 goals, " in text
    assert text.endswith(f"```text\n{ROOMS}\n```\n")


def test_a_card_is_confirmed_by_the_race_run_again(card):
    [found] = verify(card)

    assert found.setup == SETUP
    assert card_text(found.setup, found.race.goals) == card


def quoted(text, mark="> "):
    return "".join(f"{mark}{line}".rstrip() + "\n" for line in text.splitlines())


BY_MAIL = {
    "line ends of another system": lambda card: card.replace("\n", "\r\n"),
    "blanks at line ends": lambda card: card.replace("\n", "  \t\n"),
    "quoted": quoted,
    "quoted twice": lambda card: quoted(quoted(card)),
    "quoted without a blank": lambda card: quoted(card, ">"),
    "set in": lambda card: quoted(card, "    "),
    "blanks that do not break": lambda card: card.replace(" ", "\xa0"),
    "empty lines lost": lambda card: card.replace("\n\n", "\n"),
    "empty lines between": lambda card: card.replace("\n", "\n\n"),
    "words around": lambda card: f"Dear all,\n\n{card}\n- Tau: 5\n| I | 5 |\n",
    "no line end": lambda card: card.strip(),
}


@pytest.mark.parametrize("sent", BY_MAIL.values(), ids=BY_MAIL)
def test_a_card_may_come_by_mail(card, sent):
    assert sent(card) != card
    assert [found.setup for found in verify(sent(card))] == [SETUP]


def test_all_cards_of_a_text_are_run_again(card):
    other = SETUP._replace(runs=1, strategy="hard")
    text = f"Ann:\n{card}\nBen:\n{quoted(card_text(other, run(other).goals))}"

    assert [found.setup for found in verify(text)] == [SETUP, other]
    lines = text.splitlines()
    tau = max(i for i, line in enumerate(lines) if line.startswith("> - Tau: "))
    lines[tau] += "0"
    with pytest.raises(ValueError, match=f"^line {tau + 1}: the card says '- Tau: "):
        verify("\n".join(lines))


def test_no_digit_can_be_changed_unseen(card):
    """Each of them; the line that is named is the line that was changed."""
    places = [i for i, sign in enumerate(card) if sign.isdecimal()]
    for i in places:
        other = "1" if card[i] != "1" else "2"
        line = card[:i].count("\n") + 1
        with pytest.raises(ValueError, match=f"^line {line}: the card says"):
            verify(card[:i] + other + card[i + 1 :])

    assert len(places) > 60


def test_no_line_can_be_left_out_or_added(card):
    """But the row of a robot with advice: that is the card of a race without it."""
    lines = card.splitlines()
    for i, line in enumerate(lines):
        if line and not line.startswith(("| eager", "| rand")):
            with pytest.raises(ValueError, match=r"line \d|text must|row \d|H x W"):
                verify("\n".join(lines[:i] + lines[i + 1 :]))
        if i:
            with pytest.raises(ValueError, match=r"line \d+|row \d"):
                verify("\n".join([*lines[:i], "me too", *lines[i:]]))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("# Result card", "# Result", "text must hold a card, which begins with '# R"),
        ("- Seed", "- Seeds", "line 10: the card says '- Seeds: 2015', the race ag"),
        ("- Strategy", "Strategy", "line 1: the card must hold '- Strategy: ...'"),
        ("```text", "", "line 1: the card must hold a building between ```text and"),
        ("Lives: 2", "Lives: 999999", "line 9: the card says '- Lives: 999999', its"),
        ("from: own", "from: me", "advice must be one of"),
        ("| eager", "| common sense", "own must hold 'common sense': the card has"),
    ],
)
def test_what_is_no_card_is_refused_by_what_it_lacks(card, old, new, said):
    with pytest.raises(ValueError, match=f"^{re.escape(said)}"):
        verify(card.replace(old, new))


# What was predicted


SEALED = Prediction(12, "eager", "+", 30)


@pytest.fixture(scope="module")
def sealed_card():
    setup = SETUP._replace(student="Ann Lee")
    return card_text(setup, run(setup).goals, prediction=SEALED)


def test_a_card_tells_what_was_predicted_and_what_became_of_it(sealed_card, card):
    assert f"- Prediction: {SEALED.line('Ann Lee')}\n- Found: " in sealed_card
    assert verify(sealed_card)[0].prediction == SEALED
    assert verify(card)[0].prediction is None, "a card of before"


def test_no_digit_of_a_prediction_can_be_changed_unseen(sealed_card):
    start = sealed_card.index("- Prediction")
    end = sealed_card.index("\n", sealed_card.index("- Found"))
    places = [i for i in range(start, end) if sealed_card[i] in "0123456789abcdef"]
    for i in places:
        other = "1" if sealed_card[i] != "1" else "2"
        line = sealed_card[:i].count("\n") + 1
        with pytest.raises(ValueError, match=f"^line {line}: "):
            verify(sealed_card[:i] + other + sealed_card[i + 1 :])

    assert len(places) > 20


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("Prediction: eager, direction +", "Prediction: eager, direction -"),
        ("refuted below", "refuted above"),
        ("Prediction: eager", "Prediction: rand"),
        ("Student: Ann Lee", "Student: Ann Leo"),
        ("- Found: ", "- Found: not "),
    ],
)
def test_a_prediction_cannot_be_turned_after_the_race(sealed_card, old, new):
    assert sealed_card.count(old) == 1
    with pytest.raises(ValueError, match=r"^line \d+: the card says"):
        verify(sealed_card.replace(old, new))


def test_a_prediction_that_cannot_be_read_is_refused_by_its_line(sealed_card):
    with pytest.raises(ValueError, match="^line 12: a prediction must be 'none' or "):
        verify(sealed_card.replace("direction +", "up"))


@pytest.mark.parametrize(
    ("direction", "percent", "nd", "word"),
    [
        ("+", 5, 105, "as predicted"),
        ("+", 5, 104, "refuted"),
        ("-", 5, 95, "as predicted"),
        ("-", 5, 96, "refuted"),
        ("-", 0, 101, "refuted"),
        ("0", 5, 105, "as predicted"),
        ("0", 5, 94, "refuted"),
        ("0", 0, 100, "as predicted"),
    ],
)
def test_a_prediction_is_compared_at_its_border(direction, percent, nd, word):
    goals = {"none": [40, 60], "nd": [nd - 10, 10]}
    found = Prediction(1, "nd", direction, percent).compare(goals)

    assert found == f"{nd - 100:+.1f} %, {word}"


def test_nothing_is_compared_with_a_robot_that_did_not_race():
    assert Prediction(robot="nd").compare({"none": [5]}) == "nothing to compare"
    assert Prediction(robot="nd").compare({"none": [0], "nd": [5]}) == (
        "nothing to compare"
    )
    assert Prediction().compare({"none": [5]}) == ""


def test_advice_of_ones_own_is_handed_in_beside_the_card(card):
    possible = navigation_tasks(SMALL, features=SETUP.features).possible
    own = {"common sense": uniform_policy(possible)}  # as the eager robot's
    setup = SETUP._replace(guides=("eager", "common sense"))
    text = card_text(setup, run(setup, own).goals, own)
    [found] = verify(text, own)
    rows = {x[0]: x[1:] for x in (line.split(" | ") for line in text.splitlines())}

    assert found.setup == setup
    assert rows["| common sense"] == rows["| eager"]


def test_the_seed_and_the_building_of_a_card_are_the_students():
    setup = SETUP._replace(student="Zoë Ångström")
    text = card_text(setup, run(setup).goals)
    seed = seed_of("Zoë Ångström")
    alone = race(
        navigation_tasks(SMALL, reward="goal", features=SETUP.features),
        {},
        steps=scale(SMALL)[0],
        tau=0,
        n_runs=2,
        seed=seed,
    )

    assert "- Student: Zoë Ångström\n- Building: 4 cells" in text
    assert f"- Seed: {seed}\n" in text
    assert run(setup).goals["none"].tolist() == alone.goals["none"].tolist()
    assert [found.setup for found in verify(quoted(text))] == [setup]
    for wrong in (text.replace("Zoë", "Bob"), text.replace(f"Seed: {seed}", "Seed: 1")):
        with pytest.raises(ValueError, match="^line 11: the card says '- Seed: "):
            verify(wrong)


def test_a_name_is_one_however_it_is_typed_and_each_has_its_building():
    names = ["Ann Lee", "Ann Li", "Bob", "Zoë", "李雷"]

    assert len({seed_of(name) for name in names}) == len(names)
    assert len({str(building_of(name)) for name in names}) == len(names)
    for typed in ("ann lee", "  Ann\tLee ", "ANN LEE"):
        assert seed_of(typed) == seed_of("Ann Lee")
    assert seed_of("Zoe\u0308") == seed_of("Zo\xeb")


@pytest.mark.parametrize("name", ["...", " ", "", 5, None])
def test_without_a_name_there_is_no_seed(name):
    with pytest.raises(ValueError, match="student must be"):
        seed_of(name)


def test_a_race_without_a_goal_has_no_gain():
    text = card_text(SETUP, {"none": [0, 0], "eager": [0, 0], "rand": [0, 0]})

    assert re.search(
        r"^\| eager \| -\d+\.\d\d \| 0 \|  \| 0 \| 0 \|$", text, re.MULTILINE
    )
