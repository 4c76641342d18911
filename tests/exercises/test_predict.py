"""Predictions are sealed before a run and compared after it."""

import re

import pytest

from abstransfer.exercises import _predict, predict


@pytest.fixture(autouse=True)
def nothing_sealed(monkeypatch):
    monkeypatch.setattr(_predict, "_sealed", {})


def test_a_seal_follows_from_the_prediction_and_changes_with_each_part_of_it():
    options = {"key": "ex-10-1", "direction": "+", "refuted_below": 0.05}
    first = predict(**options)
    others = [{"key": "ex-10-4"}, {"direction": "-"}, {"refuted_below": 0.06}]
    seals = {predict(**options | other).seal for other in others}

    assert re.fullmatch("[0-9a-f]{8}", first.seal)
    assert first.seal == predict(**options).seal
    assert len(seals | {first.seal}) == 4
    assert repr(first).startswith(f"ex-10-1: sealed {first.seal}, direction +, ")


@pytest.mark.parametrize(
    ("direction", "found", "word"),
    [
        ("+", 0.05, "as predicted"),
        ("+", 0.04, "refuted"),
        ("+", -0.2, "refuted"),
        ("-", -0.06, "as predicted"),
        ("-", 0.06, "refuted"),
        ("0", 0.05, "as predicted"),
        ("0", -0.01, "as predicted"),
        ("0", -0.06, "refuted"),
    ],
)
def test_a_result_is_compared_with_what_was_sealed(direction, found, word):
    bet = predict("ex-10-1", direction=direction, refuted_below=0.05)

    assert bet.compare(found).startswith(f"ex-10-1: {word}. Sealed {bet.seal}: ")


def test_a_second_prediction_says_that_it_is_the_second():
    first = predict("ex-10-1", direction="+", refuted_below=0.05)
    second = predict("ex-10-1", direction="-", refuted_below=0.05)
    again = predict("ex-10-1", direction="+", refuted_below=0.05)

    assert "Prediction 2 for this" in repr(second)
    assert repr(again) == repr(first)
    assert "Prediction" not in repr(predict("ex-8-4", direction="0", refuted_below=0))


@pytest.mark.parametrize(
    "wrong",
    [
        {"key": "ex-77-1"},
        {"key": 3},
        {"direction": "up"},
        {"refuted_below": -1},
        {"refuted_below": "0.05"},
        {"refuted_below": float("nan")},
    ],
)
def test_a_prediction_that_cannot_be_compared_is_refused_by_name(wrong):
    options = {"key": "ex-10-1", "direction": "+", "refuted_below": 0.05}

    with pytest.raises(ValueError, match=f"^{next(iter(wrong))} must be"):
        predict(**options | wrong)


def test_only_a_number_is_compared():
    bet = predict("ex-10-1", direction="+", refuted_below=0.05)

    with pytest.raises(ValueError, match="found must be a finite number, got nan"):
        bet.compare(float("nan"))
