"""The whole learner of page 3, in plain Python: it learns what the package learns."""

import json

import numpy as np
import pytest
from support import ROOT

import abstransfer as at

ROOMS = "+-----+-----+\n|     d    *|\n+-----+-----+"


@pytest.fixture(scope="module")
def page():
    """The names that page 3 defines: `learn`, and who throws the package's luck."""
    path = ROOT / "book" / "03_learning.ipynb"
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    names = {"np": np, "at": at}
    found = 0
    for cell in cells:
        source = "".join(cell["source"])
        if source.startswith("def learn(") or "class Dice" in source:
            exec(source, names)
            found += 1
    assert found == 2
    return names


def fork(rng):
    """Return an MDP with three actions, three outcomes each, and two ends."""
    prob = rng.random((7, 3, 3))
    prob /= prob.sum(axis=2, keepdims=True)
    ends = np.arange(7) >= 5
    return at.MDP(rng.integers(0, 7, (7, 3, 3)), prob, rng.normal(size=7), ends, 0.9)


def both(page, mdp, steps, seed, **options):
    starts = np.flatnonzero(~mdp.terminal)
    luck = at.learning._rng.seed_state(seed)
    dice, restart = page["Dice"](luck[0]), page["Restart"](luck[1])
    q, goals = page["learn"](mdp, starts, steps, dice, restart, **options)
    run = at.q_learning(mdp, steps, rng=seed, **options)
    return q, goals, run


@pytest.mark.parametrize("reward", ["goal", "cost"])
@pytest.mark.parametrize("seed", range(3))
def test_with_the_same_luck_it_learns_the_same_table_to_the_bit(page, reward, seed):
    mdp = at.navigation_tasks(at.parse_map(ROOMS), reward=reward).mdp
    q, goals, run = both(page, mdp, 3_000, seed)

    assert goals == run.goals.sum() > 100
    np.testing.assert_array_equal(q, run.q)


def test_it_cuts_an_episode_as_the_package_does(page):
    mdp = at.navigation_tasks(at.read_map("target"), keep=[0], reward="goal").mdp
    q, goals, run = both(page, mdp, 16_000, 0)

    assert run.cuts.sum() >= 2, "nothing was cut"
    assert goals == run.goals.sum()
    np.testing.assert_array_equal(q, run.q)


@pytest.mark.parametrize("seed", range(3))
def test_it_needs_no_building(page, seed):
    mdp = fork(np.random.default_rng(seed))
    options = {"alpha": 0.3, "gamma": 0.8, "epsilon": 0.25}
    q, goals, run = both(page, mdp, 3_000, seed, **options)

    assert goals == run.goals.sum() > 100
    np.testing.assert_allclose(q, run.q, rtol=0, atol=0)


def test_numpys_own_dice_serve_as_well(page):
    mdp = at.navigation_tasks(at.parse_map(ROOMS), reward="goal").mdp
    starts, rng = np.flatnonzero(~mdp.terminal), np.random.default_rng(0)
    q, goals = page["learn"](mdp, starts, 5_000, rng, rng)

    assert goals > 300
    assert (q[mdp.terminal] == 0).all()
    assert q.max() <= 1
