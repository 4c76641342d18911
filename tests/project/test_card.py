"""Races in a building of one's own, and the cards they leave."""

import json

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
from abstransfer.learning import q_learning
from abstransfer.project.card import make_card, read_card
from abstransfer.project.racing import race

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


@pytest.fixture(scope="module")
def card(ran):
    return make_card(ran, title="Two rooms", by="A. Student")


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
        ({"n_runs": 0}, "n_runs must be at least 1"),
        ({"strategy": "firm"}, "strategy must be one of"),
    ],
)
def test_a_bad_argument_is_refused_by_name(tasks, guides, options, message):
    settings = {"guides": guides, "steps": 100, "tau": 10} | options

    with pytest.raises(ValueError, match=message):
        race(tasks, **settings)


# The card


def test_a_card_says_how_the_guides_drive_as_table_1_does(card, guides):
    tasks = navigation_tasks(ROOMS)  # at a cost of 1 a step
    value = evaluate_policy(tasks.mdp, guides["nd"][tasks.rho]).mean()

    assert card.drives["nd"] == pytest.approx(value, abs=1e-4)
    assert card.drives["rand"] < card.drives["prob"] < card.drives["optimal"] < 0


def test_a_card_counts_and_compares(card, ran):
    assert card.counts == {
        "cells": 24,
        "rooms": 2,
        "goals": 2,
        "abstract_states": len(np.unique(ran.tasks.rho[~ran.tasks.mdp.terminal])),
    }
    means = {name: goals.mean() for name, goals in ran.goals.items()}
    assert card.goals["nd"].estimate == pytest.approx(means["nd"])
    gain = means["nd"] / means["none"] - 1
    assert card.gains["nd"].estimate == pytest.approx(gain, abs=1e-6)
    assert card.gains["nd"].low <= gain <= card.gains["nd"].high
    assert list(card.gains) == ["nd", "prob", "eager"]


def test_the_same_race_gives_the_same_card(card, tasks, guides):
    again = race(tasks, guides, steps=20_000, tau=2_000, n_runs=5)
    again = make_card(again, title="Two rooms", by="A. Student")

    assert again == card
    assert str(again) == str(card)


def test_a_card_shows_when_it_was_touched(card, ran):
    other = make_card(ran, title="Two rooms", by="B. Student")

    assert other.fingerprint != card.fingerprint


def test_a_card_is_read_back_from_its_file(card, tmp_path):
    again = read_card(card.save(tmp_path / "card.json"))

    assert again == card
    assert again.fingerprint == card.fingerprint
    assert parse_map(again.building) == ROOMS


def test_the_text_of_a_card_has_a_row_for_each_robot(card, tmp_path):
    text = card.save(tmp_path / "card.md").read_text()
    table = text.split("```")[0].split("\n")
    rows = [line for line in table if line.startswith("| ")]

    assert text.startswith("# Two rooms\n\nBy A. Student. Building ")
    assert [row.split()[1] for row in rows[1:]] == [
        "none",
        "nd",
        "prob",
        "eager",
        "rand",
        "optimal",
    ]
    assert all(row.count("|") == 5 for row in rows)
    assert str(ROOMS) in text
    assert card.fingerprint in text
    assert "numpy" in text
    assert "numpy" not in str(card)


def test_one_run_has_no_interval(tasks, guides):
    card = make_card(race(tasks, guides, steps=5_000, tau=50, n_runs=1), title="Once")

    assert "nan" not in str(card)


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"goals": 3}'])
def test_what_is_no_card_is_refused_with_its_name(tmp_path, text):
    path = tmp_path / "other.json"
    path.write_text(text)

    with pytest.raises(ValueError, match=r"other\.json: not a card"):
        read_card(path)


def test_a_card_is_saved_as_text_or_data_only(card, tmp_path):
    with pytest.raises(ValueError, match=r"end in \.md or \.json, got 'card\.pdf'"):
        card.save(tmp_path / "card.pdf")

    counts = json.loads(json.dumps(card.counts))  # numbers of Python, not of numpy
    assert counts == card.counts
    assert counts
