"""Hypotheses are judged as they were written, on numbers worked out by hand."""

import numpy as np
import pytest

from abstransfer._paths import DATA
from abstransfer.experiments.arms import Arm
from abstransfer.experiments.results import Results
from abstransfer.reproduction.hypotheses import (
    OPERATED,
    judge_operations,
    share_of_lead,
)
from abstransfer.reproduction.interventions import OPERATIONS

# Lead 100; erased loses 90 of it, grafted gains 90, perfect notes on Prob gain 10.
GOALS = {"nd": 500, "prob": 400, "nd-erased": 410, "prob-grafted": 490}
GOALS |= {"perfect-on-prob": 410, "nd-directions": 470, "nd-digested": 560}
GOALS |= {"prob-digested": 520}


@pytest.fixture
def results():
    arms = tuple(Arm(name, None, "hard", 0) for name in GOALS)
    luck = np.array([-2, -1, 0, 1, 2])  # of every arm: it cancels where weights do
    goals = np.array(list(GOALS.values()))[:, None, None] + luck[:, None]
    return Results(arms, goals, {})


def test_contrasts_are_those_worked_out_by_hand(results):
    """Less half the lead: 90 - 50 = 40; a quarter less 10 = 15; and so on."""
    found = {finding.text.split()[0]: finding for finding in judge_operations(results)}

    estimates = {key: finding.effect.estimate for key, finding in found.items()}
    assert estimates == pytest.approx(
        {"N1": 40, "N2": 40, "N3": 15, "N4": -5, "N11": 60}
    )
    assert {key: finding.verdict for key, finding in found.items()} == {
        "N1": "holds",
        "N2": "holds",
        "N3": "holds",
        "N4": "does not hold",
        "N11": "holds",
    }


def test_shares_of_the_lead(results):
    assert share_of_lead(results, "prob-grafted") == pytest.approx(0.9)
    assert share_of_lead(results, "nd") == 1


def test_every_hypothesis_stands_in_the_file_and_asks_for_operations_there_are():
    words = (DATA / "hypotheses.md").read_text(encoding="utf-8")

    for hypothesis in OPERATED:
        assert f"| {hypothesis.key.rstrip('ab')} |" in words
        assert hypothesis.weights.keys() <= OPERATIONS.keys()
        assert sum(hypothesis.weights.values()) == 0
        for arm in hypothesis.weights.keys() - {"nd", "prob"}:
            assert f"`{arm}`" in words
