"""Learning: values that can be checked on paper, chances, counts and refusals."""

import inspect
import json
import shutil
import subprocess
import sys
from dataclasses import fields, replace
from decimal import Decimal
from fractions import Fraction
from hashlib import sha256
from math import inf, nan, nextafter
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import chisquare

import abstransfer
from abstransfer import (
    MDP,
    action_values,
    navigation_tasks,
    optimal_values,
    read_map,
    uniform_policy,
)
from abstransfer.learning import Learner, q_learning, q_learning_runs
from abstransfer.learning.settings import LIMITS, check
from abstransfer.mdp import LARGEST

LEFT, RIGHT = 0, 1
GUIDED, EXPLORED, GREEDY = 0, 1, 2


def corridor(n_cells=5, success=1.0):
    """Cells in a row; LEFT and RIGHT succeed or stay; the last cell pays 1."""
    cell = np.arange(n_cells)
    left, right = np.maximum(cell - 1, 0), np.minimum(cell + 1, n_cells - 1)
    next_state = np.stack([left, cell, right, cell], axis=1).reshape(-1, 2, 2)
    prob = np.broadcast_to([success, 1 - success], next_state.shape)
    last = cell == n_cells - 1
    return MDP(next_state, prob, last.astype(float), last, 0.9)


def fan(prob, n_actions=1):
    """State 0 leads to one of K terminal states, whatever the action."""
    prob = np.asarray(prob)
    n_states = len(prob) + 1
    return MDP(
        np.broadcast_to(np.arange(1, n_states), (n_states, n_actions, len(prob))),
        np.broadcast_to(prob, (n_states, n_actions, len(prob))),
        np.zeros(n_states),
        np.arange(n_states) > 0,
        0.9,
    )


def p_value(counts, expected):
    """Chance of counts as uneven as these; 0 where the impossible happened."""
    counts, expected = np.asarray(counts, float), np.asarray(expected, float)
    possible = expected > 0
    if counts[~possible].any():
        return 0.0
    expected = expected[possible] / expected.sum() * counts.sum()
    return chisquare(counts[possible], expected).pvalue


# What is learned


def test_learned_values_are_the_ones_worked_out_by_hand():
    """Walking right from cell i is worth 0.9 ** (3 - i); a terminal state 0."""
    q = q_learning(corridor(), 20_000, alpha=0.5, epsilon=0.5, rng=0).q

    np.testing.assert_allclose(q.max(axis=1), [0.729, 0.81, 0.9, 1, 0], atol=1e-6)
    assert (q[:4].argmax(axis=1) == RIGHT).all()


@pytest.mark.parametrize("trace", [0, 400_000], ids=["fast", "plain"])
@pytest.mark.parametrize("q0", [0.0, 2.0])
def test_learned_values_come_near_the_exact_ones(q0, trace):
    """A slippery corridor, small steps: what is left is the noise of alpha."""
    mdp = corridor(success=0.8)
    result = q_learning(
        mdp, 400_000, alpha=0.002, epsilon=1.0, q0=q0, rng=1, trace=trace
    )
    exact = action_values(mdp, optimal_values(mdp))[:4]

    np.testing.assert_allclose(result.q[:4], exact, atol=0.02)


def test_each_step_is_the_update_of_the_paper_to_the_bit():
    mdp = corridor(success=0.8)
    result = q_learning(mdp, 2000, alpha=0.3, gamma=0.7, q0=0.25, rng=2, trace=2000)
    q = np.where(mdp.terminal[:, None], 0.0, np.full((5, 2), 0.25))

    for s, a, _, s_next, r, before, after in zip(*result.trace, strict=True):
        assert before == q[s, a]
        assert r == mdp.reward[s_next]
        assert mdp.prob[s, a][mdp.next_state[s, a] == s_next].sum() > 0
        q[s, a] = (1.0 - 0.3) * q[s, a] + 0.3 * (r + 0.7 * q[s_next].max())
        assert after == q[s, a]
    np.testing.assert_array_equal(result.q, q)


def test_a_cut_is_no_goal_and_its_step_learns_as_any_other():
    """One state, one way, back to itself: it is worth 1 + 0.5 of itself."""
    mdp = MDP([[[0]], [[1]]], np.ones((2, 1, 1)), [1, 0], [False, True], 0.9)
    result = q_learning(mdp, 7, max_episode=3, alpha=1, gamma=0.5, window=4, rng=0)

    assert result.goals.tolist() == [0, 0]
    assert result.cuts.tolist() == [1, 1]
    assert result.q[0, 0] == 2 - 0.5**6


@pytest.mark.parametrize("trace", [0, 100], ids=["fast", "plain"])
def test_an_episode_that_arrives_in_its_last_step_is_a_goal(trace):
    result = q_learning(
        corridor(3), 100, start=[0], epsilon=0, q0=[[0, 1]] * 3, max_episode=2,
        window=30, rng=0, trace=trace,
    )  # fmt: skip

    assert result.goals.tolist() == [15, 15, 15, 5]
    assert result.cuts.tolist() == [0, 0, 0, 0]


@pytest.mark.parametrize("trace", [0, 5000], ids=["fast", "plain"])
@pytest.mark.parametrize("strategy", ["hard", "soft"])
def test_masked_actions_are_not_taken_and_do_not_count(strategy, trace):
    """The masked action would pay 9; its value says so and must not be read."""
    mdp = MDP(
        [[[1], [0], [0]], [[1], [1], [1]]],
        np.ones((2, 3, 1)),
        [0, 1],
        [False, True],
        0.9,
        [[True, False, True], [True, True, True]],
    )
    q0 = [[0, 9, 0], [0, 0, 0]]
    result = q_learning(
        mdp, 5000, guide=[[0.5, 0, 0.5], [1, 0, 0]], strategy=strategy, tau=2500,
        q0=q0, epsilon=0.5, alpha=1, rng=0, trace=trace,
    )  # fmt: skip

    assert set(result.trace.action) <= {0, 2}
    assert result.q[0].tolist() == [1, -inf, 0.9]
    assert result.q[1].tolist() == [0, 0, 0]


# Chances


def test_outcomes_come_as_often_as_they_should():
    prob = [0.5, 0.0, 0.25, 0.125, 0.12, 0.005]
    trace = q_learning(fan(prob), 100_000, rng=3, trace=100_000).trace

    assert p_value(np.bincount(trace.next_state, minlength=7)[1:], prob) > 0.001


@pytest.mark.parametrize("epsilon", [0, 1], ids=["ties", "explore"])
@pytest.mark.parametrize("n_actions", [2, 3, 7, 11])
def test_equal_actions_are_chosen_equally_often(n_actions, epsilon):
    """All values are 0 and stay so: every choice is a tie."""
    mdp = fan([1.0], n_actions)
    trace = q_learning(mdp, 50_000, epsilon=epsilon, rng=4, trace=50_000).trace
    counts = np.bincount(trace.action, minlength=n_actions)

    assert set(trace.how) == {EXPLORED if epsilon else GREEDY}
    assert p_value(counts, np.ones(n_actions)) > 0.001


def test_ties_are_broken_among_the_largest_only():
    mdp = fan([1.0], 4)
    q0 = np.tile([0.0, 1.0, 0.5, 1.0], (2, 1))
    options = {"epsilon": 0, "alpha": 1e-300, "q0": q0, "rng": 5, "trace": 20_000}
    counts = np.bincount(q_learning(mdp, 20_000, **options).trace.action, minlength=4)

    assert p_value(counts, [0, 1, 0, 1]) > 0.001


def test_epsilon_is_the_share_of_random_actions():
    trace = q_learning(fan([1.0], 2), 100_000, epsilon=0.1, rng=6, trace=100_000).trace
    counts = np.bincount(trace.how, minlength=3)

    assert p_value(counts, [0, 0.1, 0.9]) > 0.001


@pytest.mark.parametrize("start", [None, [0, 2, 3, 3]])
def test_episodes_start_where_they_should_equally_often(start):
    """Every episode is one step long, so each step starts one."""
    n_states = 6
    mdp = MDP(
        np.full((n_states, 1, 1), n_states - 1),
        np.ones((n_states, 1, 1)),
        np.zeros(n_states),
        np.arange(n_states) == n_states - 1,
        0.9,
    )
    trace = q_learning(mdp, 50_000, start=start, rng=7, trace=50_000).trace
    expected = [1, 1, 1, 1, 1, 0] if start is None else [1, 0, 1, 2, 0, 0]

    assert p_value(np.bincount(trace.state, minlength=n_states), expected) > 0.001


def test_a_hard_guide_decides_alone_up_to_tau():
    guide = np.tile([0.0, 0.7, 0.0, 0.3, 0.0], (2, 1))
    trace = q_learning(
        fan([1.0], 5), 100_000, guide=guide, tau=50_000, rng=8, trace=100_000
    ).trace
    counts = np.bincount(trace.action[:50_000], minlength=5)

    assert (trace.how[:50_000] == GUIDED).all()
    assert (trace.how[50_000:] != GUIDED).all()
    assert p_value(counts, guide[0]) > 0.001
    assert len(set(trace.action[50_000:])) == 5


def test_a_soft_guide_fades_in_a_straight_line():
    """Guided with probability (tau - t) / tau, else epsilon-greedy."""
    tau, parts = 200_000, 10
    trace = q_learning(
        fan([1.0], 2), tau + 1000, guide=np.full((2, 2), 0.5), strategy="soft",
        tau=tau, epsilon=0.25, rng=9, trace=tau + 1000,
    ).trace  # fmt: skip
    faded = (np.arange(parts) + 0.5) / parts

    for how, f in zip(trace.how[:tau].reshape(parts, -1), faded, strict=True):
        counts = np.bincount(how, minlength=3)
        assert p_value(counts, [1 - f, f * 0.25, f * 0.75]) > 0.001
    assert (trace.how[tau - 1 :] != GUIDED).all()


def test_no_decision_tells_anything_about_another():
    """How, which action and which outcome: independent, all 24 combinations."""
    trace = q_learning(
        fan([0.25, 0.75], 4), 200_000, guide=np.full((3, 4), 0.25), strategy="soft",
        tau=200_000, epsilon=0.5, rng=10, trace=200_000,
    ).trace  # fmt: skip
    counts = np.zeros((3, 4, 2))
    np.add.at(counts, (trace.how, trace.action, trace.next_state - 1), 1)
    share = np.einsum("h,a,o->hao", [0.5, 0.25, 0.25], np.full(4, 0.25), [0.25, 0.75])

    assert p_value(counts.ravel(), share.ravel()) > 0.001


# Records


def test_the_same_seed_gives_the_same_run_and_another_seed_another():
    one, same, other = (
        q_learning(corridor(success=0.8), 5000, rng=rng) for rng in (1, 1, 2)
    )

    np.testing.assert_array_equal(one.q, same.q)
    assert (one.q != other.q).any()


def test_arms_with_one_seed_share_their_luck():
    """The e-th episode starts in the same state, whatever the agents do."""
    guide = np.tile([0.5, 0.5], (5, 1))
    options = {"rng": 11, "trace": 4000}
    traces = (
        q_learning(corridor(), 4000, **options, **led).trace
        for led in ({}, {"guide": guide, "tau": 4000})
    )
    one, other = (t.state[1:][t.next_state[:-1] == 4] for t in traces)
    n_episodes = min(len(one), len(other))

    assert len(one) != len(other)
    assert n_episodes > 50
    np.testing.assert_array_equal(one[:n_episodes], other[:n_episodes])


def test_checkpoints_hold_what_a_shorter_run_would_have_learned():
    mdp = corridor(success=0.8)
    result = q_learning(mdp, 1000, checkpoints=[1, 300, 1000, 2000], rng=12)

    assert result.checkpoints.shape == (3, 5, 2)
    for q, n_steps in zip(result.checkpoints, (1, 300, 1000), strict=True):
        np.testing.assert_array_equal(q, q_learning(mdp, n_steps, rng=12).q)


def test_windows_add_up_and_the_last_may_be_shorter():
    whole = q_learning(corridor(), 1000, window=1000, rng=13)
    parts = q_learning(corridor(), 1000, window=300, rng=13)

    assert parts.goals.shape == parts.cuts.shape == (4,)
    assert parts.goals.sum() == whole.goals.sum() > 0


def test_no_steps_give_no_windows_and_the_first_values():
    result = q_learning(corridor(), 0, q0=0.5, rng=0)

    assert result.goals.tolist() == []
    assert result.q.tolist() == [[0.5, 0.5]] * 4 + [[0, 0]]


def test_progress_is_told_and_an_interrupted_run_goes_on():
    mdp, told = corridor(success=0.8), []
    expected = q_learning_runs(mdp, 5000, rngs=range(4), window=1000)

    def interrupt(n_steps):
        told.append(n_steps)
        if len(told) == 3:
            raise KeyboardInterrupt

    learner = Learner(mdp, rngs=range(4), window=1000)
    with pytest.raises(KeyboardInterrupt):
        learner.advance(5000, on_progress=interrupt)
    learner.advance(0, on_progress=interrupt)

    assert sum(told) == 4 * 5000
    for one, other in zip(learner.results(), expected, strict=True):
        np.testing.assert_array_equal(one.q, other.q)
        np.testing.assert_array_equal(one.goals, other.goals)


# Refusals

REFUSALS = {
    "n_steps": [-1, 2.5, "many", nan, None, True],
    "tau": [-1, 0.5, nan],
    "alpha": [0, -0.1, 1.1, nan, "x"],
    "epsilon": [-0.1, 1.1, nan, None],
    "gamma": [-0.1, 1.1, nan],
    "q0": [nan, inf, [1.0, 2.0]],
    "start": [[4], [9], [-1], [], [0.5], 3, "0"],
    "max_episode": [0, -5, 1.5],
    "window": [0, 2.5],
    "trace": [-1, 0.5],
    "checkpoints": [[0], [5, 5], [7, 3], [1.5]],
    "strategy": ["Hard", None],
    "guide": [
        np.full((5, 2), 0.6),
        np.full((5, 3), 1 / 3),
        np.tile([1.5, -0.5], (5, 1)),
        np.tile([nan, 1.0], (5, 1)),
    ],
}


@pytest.mark.parametrize(
    ("name", "wrong"), [(name, value) for name in REFUSALS for value in REFUSALS[name]]
)
def test_a_wrong_setting_is_refused_by_its_name(name, wrong):
    options = {"n_steps": 10, "guide": np.full((5, 2), 0.5), name: wrong}
    with pytest.raises(ValueError, match=f"^{name} must"):
        q_learning(corridor(), rng=0, **options)


ODD = [
    *(
        None,
        True,
        -1,
        0,
        1,
        0.5,
        1e300,
        -1e300,
        inf,
        nan,
        10**400,
        2**36 + 1,
        "x",
        b"1",
    ),
    *(
        [],
        [1],
        [[1, 2], [3]],
        {},
        {"a": 1},
        {1},
        object(),
        1j,
        Fraction(1, 2),
        slice(3),
    ),
    *(Decimal("0.5"), np.float32(0.5), np.int8(1), np.datetime64("2020"), range(3)),
    *(np.array(3), np.full((2, 2), 0.5), np.full((2, 2), 1e308), np.array(["a"])),
    *(np.zeros((2, 2), object), np.array([2**63], np.uint64), np.ones((2, 2), bool)),
]
WAYS = MDP([[[1, 0], [0, 1]]] * 2, np.full((2, 2, 2), 0.5), [0, 1], [False, True], 0.9)


def refusal(function, *args, **options):
    """Return the text of the ValueError that a call raises, or None."""
    try:
        function(*args, **options)
    except ValueError as error:
        return str(error)
    return None


@pytest.mark.parametrize("name", [*inspect.signature(q_learning).parameters])
def test_an_odd_argument_is_taken_or_refused_by_its_name(name):
    """Nothing else is raised, and no process ends."""
    given = {"mdp": WAYS, "n_steps": 20, "rng": 0}
    said = [refusal(q_learning, **{**given, name: value}) for value in ODD]
    refused = [text for text in said if text]

    assert len(refused) > len(ODD) / 3
    assert all(text.startswith(f"{name} must ") for text in refused)


@pytest.mark.parametrize("name", [f.name for f in fields(MDP)])
def test_an_odd_array_is_taken_or_refused_by_its_name(name):
    said = [refusal(replace, WAYS, **{name: value}) for value in ODD]
    refused = [text for text in said if text]

    assert len(refused) > len(ODD) / 2
    assert all(text.startswith(f"{name} must ") for text in refused)


@pytest.mark.parametrize("trace", [0, 2000], ids=["fast", "plain"])
def test_the_largest_rewards_leave_finite_values(trace):
    """What ends a run of 1e308, without a word, at a reward that is taken."""
    cost = np.array([-LARGEST, -LARGEST, LARGEST, 0])
    mdp = MDP([[[0]], [[2]], [[1]], [[3]]], np.ones((4, 1, 1)), cost, cost == 0, 0.9)
    for q0 in (-LARGEST, LARGEST):
        options = {"alpha": 1, "gamma": 1, "q0": q0, "rng": 0, "trace": trace}
        assert np.isfinite(q_learning(mdp, 2000, **options).q).all()


def test_a_reward_that_could_overflow_is_refused():
    with pytest.raises(ValueError, match="reward must lie in .* state 0 it was -1e"):
        replace(WAYS, reward=[-1e308, 0])


def test_no_run_is_longer_than_steps_can_be_counted_exactly():
    learner = Learner(WAYS, rngs=[0])
    learner.advance(10)
    with pytest.raises(ValueError, match=f"n_steps must .* to {2**36 - 10:,}, got"):
        learner.advance(2**36)


def test_a_signature_shows_the_defaults_that_settings_keep():
    shown = inspect.signature(q_learning).parameters

    assert {name: shown[name].default for name in LIMITS} == {
        name: known["default"] for name, known in LIMITS.items()
    }
    assert json.loads(json.dumps(LIMITS)).keys() == LIMITS.keys()


@pytest.mark.parametrize("name", LIMITS)
def test_a_default_lies_within_its_limits_and_they_are_the_ones_checked(name):
    default, limits = LIMITS[name]["default"], LIMITS[name]["limits"]

    assert check(name, default) == default
    for value in [limits[end] for end in ("least", "most") if end in limits]:
        outside = nextafter(value, inf if value == limits["most"] else -inf)
        with pytest.raises(ValueError, match=f"^{name} must be a"):
            check(name, outside)
        if not (limits.get("above") and value == limits["least"]):
            assert check(name, value) == value


def test_a_guide_that_takes_a_masked_action_is_refused():
    free = corridor()
    allowed = [[True, False]] + [[True, True]] * 4
    mdp = MDP(free.next_state, free.prob, free.reward, free.terminal, 0.9, allowed)

    with pytest.raises(ValueError, match="guide must use allowed actions only: at st"):
        q_learning(mdp, 10, guide=np.full((5, 2), 0.5), tau=5, rng=0)


def test_tau_without_a_guide_is_refused():
    with pytest.raises(ValueError, match="tau must be 0 without a guide, got 5"):
        q_learning(corridor(), 10, tau=5, rng=0)


def test_no_seeds_are_refused():
    with pytest.raises(ValueError, match="rngs must hold at least one seed"):
        q_learning_runs(corridor(), 10, rngs=[])


# The paper's task


@pytest.mark.parametrize(
    ("strategy", "tau", "goals", "digest"),
    [
        ("hard", 0, [182, 232, 279, 402], "23b6ab36e1cef97a"),
        ("hard", 2_000_000, [426, 1813, 5951, 33692], "bfa523a8a5937880"),
        ("soft", 2_000_000, [424, 340, 455, 631], "dca70e32c85e7b42"),
    ],
)
def test_a_run_on_the_target_map_is_the_same_on_every_machine(
    strategy, tau, goals, digest
):
    """Integers and doubles in one order: these numbers may never change."""
    tasks = navigation_tasks(read_map("target"), reward="goal")
    guide = uniform_policy(tasks.available)
    result = q_learning(
        tasks.mdp, 8e6, guide=guide, strategy=strategy, tau=tau, window=2e6, rng=1
    )

    assert result.goals.tolist() == goals
    assert sha256(result.q.tobytes()).hexdigest()[:16] == digest


@pytest.mark.slow
def test_loops_are_compiled_once_which_is_said_until_a_file_of_theirs_changes(tmp_path):
    package = Path(abstransfer.__file__).parent
    shutil.copytree(package, tmp_path / "abstransfer")
    code = (
        "import numpy as np; from abstransfer import MDP;"
        "from abstransfer.learning import _fast, q_learning;"
        "mdp = MDP([[[1]]] * 2, np.ones((2, 1, 1)), [0, 1], [False, True], 0.5);"
        "q_learning(mdp, 5, rng=0); q_learning(mdp, 5, rng=0);"
        "print(sum(_fast.advance_one.stats.cache_hits.values()))"
    )

    def told(code=code):
        done = subprocess.run(
            [sys.executable, "-P", "-c", code],
            env={"NUMBA_CACHE_DIR": str(tmp_path), "PYTHONPATH": str(tmp_path)},
            capture_output=True,
            encoding="utf-8",
            check=True,
        )
        return int(done.stdout), done.stderr.count("compiling the learning loops")

    assert told() == (0, 1)
    assert told() == (1, 0)
    with (tmp_path / "abstransfer" / "learning" / "_simd.py").open(
        "a", encoding="utf-8"
    ) as file:
        file.write("# another file than that of the loop\n")
    in_a_notebook = 'import sys; sys.modules["ipykernel"] = sys;' + code
    assert told(in_a_notebook) == (0, 0), "a page of a fresh clone is as stored"


def test_runs_that_start_from_tables_of_their_own_are_those_of_q0():
    mdp = navigation_tasks(read_map("source"), reward="goal").mdp
    tables = [np.full((mdp.n_states, mdp.n_actions), x) for x in (0.0, 1e-3, 0.5, 1.0)]
    together = q_learning_runs(mdp, 9_000, rngs=[4] * 4, q0s=tables)

    for table, run in zip(tables, together, strict=True):
        alone = q_learning(mdp, 9_000, rng=4, q0=table)
        np.testing.assert_array_equal(run.q, alone.q)
        assert run.goals.tolist() == alone.goals.tolist()
    with pytest.raises(ValueError, match="one table a run, 4, got 1"):
        q_learning_runs(mdp, 10, rngs=[4] * 4, q0s=tables[:1])
