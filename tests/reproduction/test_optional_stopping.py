"""When would you sign?  Verdicts life by life, and a reader who looks often."""

import numpy as np
import pytest

from abstransfer.experiments import stats
from abstransfer.experiments.results import read_results
from abstransfer.reproduction.claims import ledger
from abstransfer.reproduction.optional_stopping import (
    KEYS,
    SAME,
    comparisons,
    orders,
    read_along,
    running_gains,
    tracks,
)


@pytest.fixture(scope="module")
def results():
    return read_results("goal-target")


def test_running_gains_are_those_of_the_pages_bootstrap(results):
    a = np.stack([results.totals(arm) for arm in ("grad-soft", "nd-soft")], axis=1)
    b = np.stack([results.totals(arm) for arm in ("prob-soft", "nd-hard")], axis=1)
    gains = running_gains(a, b)

    assert gains.low.shape == (49, 2)
    for n in (2, 3, 20, 50):
        for k in range(2):
            wanted = stats.relative_gain(a[:n, k], b[:n, k], rng=0)
            found = [end[n - 2, k] for end in gains]
            np.testing.assert_allclose(found, wanted, rtol=1e-12)


def test_the_verdicts_of_all_lives_are_those_of_the_ledger(results):
    entries = ledger(results)[:5]

    for key, entry in zip(KEYS, entries, strict=False):
        texts = [finding.text for finding in entry.findings]
        assert [c.text for c in comparisons(results, key)] == texts
        ends = {track[-1] for track in tracks(results, key)}
        assert ends == {entry.verdict}


@pytest.mark.parametrize("n", [2, 6])
def test_the_verdicts_of_some_lives_are_those_of_an_experiment_of_so_many(results, n):
    shuffled = orders(50)[0][3][:n]
    short = results._replace(goals=results.goals[:, shuffled])

    for entry, key in zip(ledger(short)[:5], KEYS, strict=False):
        assert tracks(results, key)[3][n - 2] == entry.verdict


def test_orders_hold_each_life_once_and_the_first_is_as_run():
    lives, partners = orders(50)

    assert (np.sort(np.concatenate([lives, partners])) == np.arange(50)).all()
    assert (lives[0] == np.arange(50)).all()
    assert len(np.unique(np.concatenate([lives, partners]), axis=0)) == 10


def test_an_arm_equals_itself_after_all_lives_but_often_not_before(results):
    found = tracks(results, SAME)
    reading = read_along(found)

    assert len(found) == 45
    assert {track[-1] for track in found} == {"undecided"}
    assert reading.wrong == sum(stop is not None for stop in reading.stops)
    assert reading.wrong > 0.05 * 45, "many looks err more often than one"


def test_a_reader_who_stops_too_soon_is_wrong():
    track = ["undecided"] * 3 + ["holds", "undecided", "does not hold"]

    assert read_along([track]) == ("does not hold", 7, (5,), 1)
    assert read_along([["holds"] + ["undecided"] * 5]) == ("undecided", 3, (None,), 0)


def test_a_claim_that_has_no_goals_to_compare_is_refused(results):
    with pytest.raises(ValueError, match="key must be one of 1, .*, same, got '6a'"):
        comparisons(results, "6a")
