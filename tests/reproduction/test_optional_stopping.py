"""When would you sign?  Verdicts run by run, and a reader who looks often."""

import numpy as np
import pytest

from abstransfer.experiments.results import read_results
from abstransfer.experiments.stats import gain_interval
from abstransfer.reproduction.claims import ledger
from abstransfer.reproduction.optional_stopping import (
    KEYS,
    SAME,
    comparisons,
    orders,
    read_along,
    tracks,
)
from abstransfer.reproduction.verdicts import judge


@pytest.fixture(scope="module")
def results():
    return read_results("goal-target")


def test_the_verdicts_of_all_lives_are_those_of_the_ledger(results):
    entries = ledger(results)[:5]

    for key, entry in zip(KEYS, entries, strict=False):
        texts = [finding.text for finding in entry.findings]
        assert [c.text for c in comparisons(results, key)] == texts
        ends = {track[-1] for track in tracks(results, key)}
        assert ends == {entry.verdict}


@pytest.mark.parametrize("n", [5, 6])
def test_the_verdicts_of_some_lives_are_those_of_an_experiment_of_so_many(results, n):
    shuffled = orders(50)[3][:n]
    short = results._replace(goals=results.goals[:, shuffled])

    for entry, key in zip(ledger(short)[:5], KEYS, strict=False):
        assert tracks(results, key)[3][n - 5] == entry.verdict


def test_orders_hold_each_run_once_and_the_first_is_as_run():
    found = orders(50)

    assert (np.sort(found) == np.arange(50)).all()
    assert (found[0] == np.arange(50)).all()
    assert len(np.unique(found, axis=0)) == 5


def test_an_arm_meets_itself_with_other_luck_and_many_looks_err(results):
    found = tracks(results, SAME)
    reading = read_along(found)
    x = results.totals("none")
    last = gain_interval(x[:25], x[25:])

    assert [len(track) for track in found] == [21] * 45  # looks from 5 runs to 25
    assert found[0][-1] == judge(last, 0.0)
    assert last.estimate != 0, "no run meets itself"
    signed = sum(map(bool, reading.stops))
    assert signed > 0.05 * 45, "many looks err more often than one"


def test_a_reader_who_stops_too_soon_is_wrong():
    track = ["holds", "undecided", "does not hold"]

    assert read_along([track]) == ("does not hold", 7, (5,), 1)
    assert read_along([["undecided"] * 3]) == ("undecided", 5, (None,), 0)


def test_a_claim_that_has_no_goals_to_compare_is_refused(results):
    with pytest.raises(ValueError, match="key must be one of 1, .*, same, got '6a'"):
        comparisons(results, "6a")
