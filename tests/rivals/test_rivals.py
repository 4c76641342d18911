"""
Rivals, step by step: each can be followed with a pencil.

State 0 has four actions.  `at(0.3, 0.6)` is the luck of a step whose `mode`, who
decides, is 0.3 of its range, and whose `field`, which action, is 0.6 of its own.
"""

import os
import subprocess
import sys

import numpy as np
import pytest
from support import ROOT

from abstransfer import MDP, q_learning
from abstransfer.learning._rng import next_word
from abstransfer.learning._tables import integer_bounds
from abstransfer.learning.loop import EXPLORED, GREEDY, GUIDED, Guide, Run, World
from abstransfer.rivals import (
    PLAIN,
    choosing,
    count_bonus,
    decaying_epsilon,
    guided_exploration,
    held_label,
    heuristic,
    improving,
    jump_start,
    learn_as,
    policy_library,
    policy_reuse,
    q_lambda,
    replay,
    shaping,
    z_greedy,
)
from abstransfer.rivals.choosing import HELD
from abstransfer.rivals.loops import Rule

# The guide: action 0 or 3, a half each.
GUIDE = Guide(np.zeros(2, int), integer_bounds(np.array([[0.5, 0, 0, 0.5]]), 16))
Q = np.array([[0.0, 0.5, 0.5, 0.1], [0.0, 0.0, 0.0, 0.0]])  # state 1 is terminal
WORLD = World(
    np.ones((2, 4, 1), np.int32),
    np.full((2, 4, 1), 1 << 32),
    np.array([0.0, 1.0]),
    np.array([False, True]),
    np.array([0]),
)


def at(mode, field):
    return int(mode * 65536) << 16 | int(field * 65536)


def rule(rival, epsilon=0.25, luck=(1, 2, 3, 4)):
    """How a rival learns; alpha 0.5, gamma 0.9, an episode is 9 steps."""
    own = rival.memory(np.array(luck, np.uint32))
    return Rule(0.5, 0.9, int(epsilon * 65536), 9, 0, False, own)


def chooser(rival, q=Q, **options):
    """Return a function of state and luck: what the rival chooses next, and how."""
    its = rule(rival, **options)
    return its, lambda mode, field, s=0, t=1: rival.choose(
        t, s, at(mode, field), q, GUIDE, its
    )


def end(rival, its, s=1):
    """End an episode in a state; return the state and steps of the next."""
    run = Run(Q, np.ones((2, 4), np.uint32), np.zeros(2, int), np.zeros(2, int))
    found = rival.restart(s, WORLD, its, run)
    assert run.ended.tolist() == ([1, 0] if s == 1 else [0, 1])
    return found


# Who chooses


def test_the_guide_explores_and_greed_is_left_as_it_is():
    _, choose = chooser(guided_exploration())

    assert choose(0.24, 0.4) == (0, EXPLORED)
    assert choose(0.24, 0.6) == (3, EXPLORED)
    assert choose(0.26, 0.4) == (1, GREEDY)
    assert choose(0.26, 0.6) == (2, GREEDY)


def test_a_policy_is_reused_less_in_each_step_and_anew_in_each_episode():
    """psi is 1, 0.5, 0.25; beyond it a quarter of the rest explores."""
    rival = policy_reuse(0.5)
    its, choose = chooser(rival)

    assert choose(0.99, 0.4) == (0, GUIDED)
    assert choose(0.49, 0.6) == (3, GUIDED)
    assert choose(0.24, 0.6) == (3, GUIDED)
    its.own.psi[0] = 0.5
    assert choose(0.62, 0.3) == (1, EXPLORED)  # below 0.5 + 0.5 / 4 = 0.625
    its.own.psi[0] = 0.5
    assert choose(0.63, 0.3) == (1, GREEDY)
    assert end(rival, its) == (0, 9)
    assert its.own.psi[0] == 1


def test_in_the_other_reading_the_rest_is_random_the_more_the_less_is_reused():
    """psi 0.5: random below 0.5 + 0.5 x 0.5; psi 0.25: below 0.25 + 0.75 x 0.75."""
    its, choose = chooser(policy_reuse(0.5, "random"))

    its.own.psi[0] = 0.5
    assert choose(0.74, 0.1) == (0, EXPLORED)
    assert choose(0.81, 0.1) == (0, EXPLORED)
    its.own.psi[0] = 0.25
    assert choose(0.82, 0.1) == (1, GREEDY)


def test_a_library_is_judged_by_what_its_episodes_returned():
    """
    None of both is reused first, and arrives in 3 steps: its worth is 0.9^2 = 0.81.

    In the next such episode it does not arrive: 0.405.  With heat ln 2 / 0.405 it is
    then twice as likely as either policy, which have worth 0.
    """
    policies = np.eye(4)[[[0], [3]]]  # one always 0, the other always 3
    rival = policy_library(policies, np.zeros(2, int), fade=0.5, heat=0.0)
    its, choose = chooser(rival)
    own, drawn = its.own, []
    for mode in (0.3, 0.3, 0.1):
        assert choose(mode, 0.3)[1] == (GREEDY if mode == 0.3 else EXPLORED)
    end(rival, its)
    assert own.worth.round(9).tolist() == [0, 0, 0.81]
    own.who[:] = 2, 5
    end(rival, its, 0)
    assert own.worth.round(9).tolist() == [0, 0, 0.405]
    assert own.used.tolist() == [0, 0, 2]

    own.heat[0] = np.log(2) / 0.405
    for _ in range(20):
        u = next_word(own.luck.copy()) / 2**32  # of 4 parts: 1, 1 and 2
        own.worth[:], own.used[:], own.who[:] = (0, 0, 0.405), 1e12, (0, 1)
        end(rival, its, 0)
        assert own.who[0] == min(int(4 * u), 2)
        assert own.psi[0] == 1
        drawn.append(int(own.who[0]))
    assert set(drawn) == {0, 1, 2}
    own.who[0] = 1
    assert choose(0.9, 0.1) == (3, GUIDED)
    assert choose(0.4, 0.1) == (3, GUIDED)  # psi is 0.5
    assert choose(0.9, 0.3) == (1, GREEDY)


def test_a_guide_begins_each_episode_for_a_number_of_steps_drawn_anew():
    rival = jump_start(3)
    its, choose = chooser(rival)

    assert [choose(0.9, 0.6) for _ in range(3)] == [(3, GUIDED)] * 3
    assert choose(0.9, 0.6) == (2, GREEDY)
    assert choose(0.2, 0.6) == (2, EXPLORED)
    steps = []
    for _ in range(60):
        expected = (next_word(its.own.luck.copy()) * 3) >> 32
        end(rival, its)
        assert its.own.left[0] == expected
        steps.append(expected)
    assert set(steps) == {0, 1, 2}


def test_a_curriculum_goes_down_a_stage_while_as_many_arrive():
    """H is 20 in 10 stages: two steps a stage, looked at every hundred episodes."""
    rival = jump_start(20, curriculum=True)
    its, steps = rule(rival), []
    for arrived in (60, 57, 56, 57, 80, 70):
        for i in range(100):
            end(rival, its, 1 if i < arrived else 0)
        steps.append(int(its.own.left[0]))

    # 57 is 0.95 of the best, 60; after 80 it takes 76.
    assert steps == [18, 16, 16, 14, 12, 12]


def test_a_heuristic_is_worth_eta_and_no_more():
    """Advised actions 0 and 3 look 0.45 better: 0.45 and 0.55; or 0.35 better."""
    bonus = np.array([[1.0, 0, 0, 1.0]])
    _, choose = chooser(heuristic(0.45 * bonus, np.zeros(2, int)))
    _, warily = chooser(heuristic(0.35 * bonus, np.zeros(2, int)))

    assert choose(0.3, 0.1) == choose(0.3, 0.9) == (3, GREEDY)
    assert warily(0.3, 0.1) == (1, GREEDY)
    assert warily(0.3, 0.9) == (2, GREEDY)
    assert choose(0.2, 0.3) == (1, EXPLORED)


def test_a_label_is_held_until_the_view_changes_or_for_its_longest():
    q = np.zeros((3, 4))
    q[:, 1], q[0, 1] = 1, 0
    rival = held_label(np.array([7, 7, 8]), longest=3)
    its, choose = chooser(rival, q)

    assert choose(0.1, 0.8, s=0) == (3, EXPLORED)
    assert choose(0.9, 0.1, s=1) == (3, HELD)
    assert choose(0.9, 0.1, s=0) == (3, HELD)
    assert choose(0.9, 0.1, s=1) == (1, GREEDY)  # after three steps
    assert choose(0.9, 0.1, s=1) == (1, HELD)
    assert choose(0.1, 0.8, s=2) == (3, EXPLORED)  # another view
    end(rival, its)
    assert choose(0.9, 0.1, s=2) == (1, GREEDY)  # another episode


def test_who_explores_keeps_the_action_as_long_as_drawn():
    """With mu 2, one step has chance 1 / (1 + 1/4 + 1/9 + ...) = 6 / pi^2 = 0.61."""
    rival = z_greedy(2)
    its, choose = chooser(rival)
    lengths = []
    for _ in range(4000):
        assert choose(0.2, 0.8) == (3, EXPLORED)
        kept = int(its.own.kept[1])
        if kept:
            assert choose(0.9, 0.1) == (3, HELD)
            assert its.own.kept[1] == kept - 1
        end(rival, its)
        lengths.append(kept + 1)
        assert choose(0.9, 0.1) == (1, GREEDY)

    share = np.array([lengths.count(n) for n in (1, 2, 3)]) / len(lengths)
    np.testing.assert_allclose(share, [0.608, 0.152, 0.068], atol=0.025)


def test_epsilon_falls_in_a_line():
    """From 0.5 to 0.1 in 100 steps: 0.3 in step 50, 0.1 from step 100 on."""
    _, choose = chooser(decaying_epsilon(0.5, 0.1, 100))

    assert choose(0.29, 0.3, t=50) == (1, EXPLORED)
    assert choose(0.31, 0.3, t=50) == (1, GREEDY)
    assert choose(0.09, 0.3, t=500) == (1, EXPLORED)
    assert choose(0.11, 0.3, t=500) == (1, GREEDY)


# What is learned

LINE = MDP(  # three steps to the goal
    [[[1]], [[2]], [[3]], [[3]]],
    np.ones((4, 1, 1)),
    [0, 0, 0, 1],
    [False, False, False, True],
    0.9,
)


def notes(rival, n_steps, **options):
    """Return the notes on the three steps of the line."""
    options = {"alpha": 0.5, "gamma": 0.5, "start": [0]} | options
    return learn_as(rival, LINE, n_steps, rng=0, **options).q.ravel()[:3].tolist()


def test_a_surprise_goes_back_along_the_trail():
    """alpha, gamma and lambda are 1/2: each step further back, a quarter of it."""
    assert notes(q_lambda(0.5, 0.5), 2) == [0, 0, 0]
    assert notes(q_lambda(0.5, 0.5), 3) == [1 / 32, 1 / 8, 1 / 2]
    # Then Q(0) += (0 + 1/2 x 1/8 - 1/32) / 2, and the goal was half expected.
    first = 1 / 32 + 1 / 64
    second = 1 / 8 + (1 / 4 - 1 / 8) / 2
    first += (1 / 4 - 1 / 8) / 8
    assert notes(q_lambda(0.5, 0.5), 5) == [first, second, 1 / 2]
    assert notes(q_lambda(0.5, 0.5), 6) == [first + 1 / 64, second + 1 / 16, 3 / 4]


def test_without_lambda_it_is_q_learning():
    plain = q_learning(LINE, 60, rng=0, alpha=0.5, gamma=0.5, start=[0])

    assert notes(q_lambda(0.0, 0.5), 60) == plain.q.ravel()[:3].tolist()


def test_the_trail_is_cut_where_what_is_explored_is_not_best():
    rival = q_lambda(0.5)
    its, choose = chooser(rival)
    its.own.length[0] = 7

    assert choose(0.2, 0.3) == (1, EXPLORED)  # a best one: 0.5
    assert its.own.length[0] == 7
    assert choose(0.2, 0.1) == (0, EXPLORED)
    assert its.own.length[0] == 0
    its.own.length[0] = 7
    end(rival, its)
    assert its.own.length[0] == 0


def test_the_trail_holds_its_last_steps_and_forgets_older_ones():
    rival = q_lambda(1.0, 1.0)
    its, q = rule(rival)._replace(gamma=1.0), np.zeros((101, 1))
    world = World(*[None] * 2, np.eye(101)[100], np.arange(101) == 100, None)
    for s in range(100):
        rival.improve(s, 0, s + 1, world._replace(next_state=q, bound=q), q, its)

    assert (q[:36, 0] == 0).all()
    assert (q[36:100, 0] == 0.5).all()


def test_a_stored_step_is_learned_from_again():
    """With one place to store, each step is learned twice: 1/2, then 3/4."""
    assert notes(replay(0, 1), 3) == [0, 0, 1 / 2]
    assert notes(replay(1, 1), 3) == [0, 0, 3 / 4]
    assert notes(replay(2, 1), 3) == [0, 0, 7 / 8]


def test_steps_to_learn_from_again_are_drawn_from_those_that_are_stored():
    rival = replay(1, 2)
    its, q = rule(rival), np.zeros((4, 1))
    reward = np.array([0.0, 0, 0, 1])
    world = World(q, q, reward, LINE.terminal, None)
    for s in (2, 1, 0):  # backwards, so that each has news
        expected = q.copy()
        n = int(its.own.count[0]) + 1
        stored = [(2, 3), (1, 2), (0, 1)][max(n - 2, 0) : n]
        at_row = {
            row % 2: stored[row - max(n - 2, 0)] for row in range(max(n - 2, 0), n)
        }
        drawn = at_row[(next_word(its.own.luck.copy()) * min(n, 2)) >> 32]
        for a, b in ((s, s + 1), drawn):
            expected[a] += 0.5 * (reward[b] + 0.9 * expected[b] - expected[a])
        rival.improve(s, 0, s + 1, world, q, its)
        np.testing.assert_allclose(q, expected, rtol=1e-15)


def test_a_bonus_falls_with_each_try_and_is_not_learned():
    """C is 1, M is 1: 1 untried, 1/2 after one try, 1/3 after two."""
    q = np.array([[0.0, 0.4], [0.0, 0.0]])
    rival = count_bonus(q.shape, 1.0, 1.0)
    its, choose = chooser(rival, q)

    assert choose(0.3, 0.1) == (1, GREEDY)  # 1.0, 1.4
    its.own.bonus[0, 1] = 0.5
    assert choose(0.3, 0.1) == (0, GREEDY)  # 1.0, 0.9
    its.own.bonus[0, 1] = 1
    rival.improve(0, 0, 1, WORLD, q, its)
    assert q[0].tolist() == [0.5, 0.4]  # half of the goal's 1: no bonus in it
    rival.improve(0, 0, 1, WORLD, q, its)
    assert its.own.bonus.tolist() == [[1 / 3, 1.0], [1.0, 1.0]]


def test_shaping_adds_the_gain_in_potential():
    """From potential 0.2 to 0.4: 0.9 x 0.4 - 0.2 = 0.16 beside the reward."""
    q = np.array([[0.0, 0.4], [0.1, 0.3]])
    rival = shaping(np.array([0.2, 0.4]))
    rival.improve(0, 0, 1, WORLD, q, rule(rival))

    assert q[0, 0] == pytest.approx(0.5 * (1 + 0.16 + 0.9 * 0.3))


def test_shaping_equals_first_notes_step_by_step():
    """
    Wiewiora (2003): same steps, and notes that differ by the potential.

    Potentials are quarters, alpha and gamma a half: nothing is rounded, for a while.
    """
    rng = np.random.default_rng(0)
    mdp = MDP(
        rng.integers(0, 6, (6, 3, 1)),
        np.ones((6, 3, 1)),
        (np.arange(6) == 5) * 1.0,
        np.arange(6) == 5,
        0.5,
    )
    phi = np.array([0.25, 0.5, 0.75, 0.0, 0.25, 0.0])
    options = {"alpha": 0.5, "gamma": 0.5, "trace": 20, "epsilon": 0.3}
    for seed in range(30):
        shaped = learn_as(shaping(phi), mdp, 20, rng=seed, **options)
        first = np.repeat(phi[:, None], 3, axis=1)
        noted = q_learning(mdp, 20, rng=seed, q0=first, **options)
        for name in ("state", "action", "how", "next_state", "reward"):
            mine, theirs = getattr(shaped.trace, name), getattr(noted.trace, name)
            np.testing.assert_array_equal(mine, theirs)
        np.testing.assert_array_equal(shaped.q + phi[:, None], noted.q)
        np.testing.assert_array_equal(
            shaped.trace.after + phi[shaped.trace.state], noted.trace.after
        )
    assert noted.trace.after.any()


# The loop


@pytest.mark.parametrize("strategy", ["hard", "soft"])
def test_a_rival_with_no_part_of_its_own_is_the_learner_of_the_book(strategy):
    rng = np.random.default_rng(1)
    mdp = MDP(
        rng.integers(0, 9, (9, 4, 2)),
        np.full((9, 4, 2), 0.5),
        (np.arange(9) == 8) * 1.0,
        np.arange(9) == 8,
        0.9,
    )
    options = {
        "guide": np.full((9, 4), 0.25),
        "strategy": strategy,
        "tau": 500,
        "window": 300,
        "trace": 50,
        "checkpoints": [700],
    }
    ours = learn_as(PLAIN, mdp, 2000, rng=3, **options)
    theirs = q_learning(mdp, 2000, rng=3, **options)

    for mine, its in zip(ours[:6], theirs[:6], strict=True):
        for one, other in zip(np.atleast_1d(mine), np.atleast_1d(its), strict=True):
            np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(ours.checkpoints, theirs.checkpoints)


def test_progress_is_told_in_steps():
    told = []
    learn_as(PLAIN, LINE, 25, rng=0, window=10, on_progress=told.append)

    assert told == [10, 10, 5]


@pytest.mark.parametrize(
    ("make", "wrong"),
    [
        (lambda: policy_reuse(1.5), "fade must be a number from 0 to 1, got 1.5"),
        (lambda: policy_reuse(0.5, "none"), "rest must be one of .* got 'none'"),
        (lambda: jump_start(0), "most must be a whole number from 1"),
        (lambda: held_label(np.zeros(1, int), 0), "longest must be a whole number"),
        (lambda: z_greedy(-1), "mu must be a number from 0 to 100, got -1"),
        (lambda: decaying_epsilon(2, 0, 9), "first must be a number from 0 to 1"),
        (lambda: q_lambda(2), "trace must be a number from 0 to 1, got 2"),
        (lambda: replay(1, 0), "size must be a whole number from 1"),
        (lambda: count_bonus((1, 1), -1), "size must be a number from 0"),
    ],
)
def test_a_wrong_setting_of_a_rival_is_refused_by_its_name(make, wrong):
    with pytest.raises(ValueError, match=wrong):
        make()


SAME = """
import sys
import numpy as np
sys.path[:0] = [{tests!r}, {tests!r} + "/learning"]
from test_loops import random_guide, random_mdp
from abstransfer.rivals import *
mdp = random_mdp(8, masked=0.2)
rho, shape = np.arange(12) % 3, (12, 8)
policies = np.random.default_rng(0).dirichlet(np.ones(8), (2, 3))
for rival in (
    guided_exploration(), policy_reuse(0.9), policy_reuse(0.9, "random"),
    policy_library(policies, rho, 0.9, 0.5), jump_start(9), jump_start(9, True),
    heuristic(policies[0], rho), held_label(rho, 4), z_greedy(2.0),
    decaying_epsilon(0.5, 0.1, 900), q_lambda(0.9), replay(2, 50), shaping(mdp.reward),
    count_bonus(shape, 0.5),
):
    run = learn_as(rival, mdp, 1500, rng=1, guide=random_guide(mdp), max_episode=40)
    print(run.goals, run.cuts, np.round(run.q, 9).tolist())
"""


@pytest.mark.slow
def test_rivals_compiled_and_in_plain_python_agree():
    """With masked actions, too."""
    said = [
        subprocess.run(
            [sys.executable, "-c", SAME.format(tests=str(ROOT / "tests"))],
            env=os.environ | variables,
            cwd=ROOT,
            capture_output=True,
            encoding="utf-8",
            check=True,
        ).stdout.splitlines()
        for variables in ({}, {"NUMBA_DISABLE_JIT": "1"})
    ]

    assert len(set(said[0])) == len(said[0]) == 14
    assert said[0] == said[1]
    assert not any("nan" in line for line in said[0])


def test_no_two_parts_of_rivals_share_a_name():
    """By their names the compiler keeps loops apart."""
    parts = [
        getattr(each, "py_func", each).__name__
        for module in (choosing, improving)
        for name, each in vars(module).items()
        if name.startswith(("choose_", "improve_", "restart_"))
        and getattr(each, "py_func", each).__module__ == module.__name__
    ]

    assert len(parts) == len(set(parts)) > 12
