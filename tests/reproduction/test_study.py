"""The study of page 10: its guides, its plan, its stored results; what is noted."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from abstransfer import MDP, induce_nondeterministic, navigation_tasks, read_map
from abstransfer.experiments.arms import ARMS, Scale
from abstransfer.experiments.diagnosis import arrival, can_arrive, notes_after
from abstransfer.experiments.plan import make_plan, parameters
from abstransfer.experiments.problem import Problem, build_guides, target_tasks
from abstransfer.experiments.results import read_results
from abstransfer.learning import q_learning, q_learning_runs
from abstransfer.reproduction.figures import make_figures
from abstransfer.reproduction.study import (
    ADVICE,
    STUDIES,
    TAU,
    Study,
    make_guides,
    run_studies,
)

SMALL = Scale(30_000, 10_000)


@pytest.fixture(scope="module")
def guides():
    return make_guides()


@pytest.fixture(scope="module")
def paper():
    return build_guides(Problem(), ["rand", "nd", "prob", "grad"])


# Guides


def test_the_ends_of_the_dials_are_the_papers_guides(guides, paper):
    for ours, theirs in {
        "beta-0": "nd",
        "beta-1": "prob",
        "grad": "grad",
        "all": "rand",
    }.items():
        np.testing.assert_allclose(guides[ours], paper[theirs], atol=1e-12)


def test_diluting_by_a_quarter_keeps_three_quarters(guides, paper):
    expected = 0.75 * paper["prob"] + 0.25 * paper["rand"]

    np.testing.assert_allclose(guides["prob-all-0.25"], expected, atol=1e-12)


def test_the_dial_changes_how_often_and_never_which(guides):
    support = guides["beta-1"] > 0

    for beta in (0, 0.25, 0.5, 2, 4, 8):
        np.testing.assert_array_equal(guides[f"beta-{beta}"] > 0, support)


def test_only_a_guide_diluted_among_all_takes_steps_that_lead_nowhere(guides):
    tasks = target_tasks(Problem())
    there = ~tasks.mdp.terminal

    for name, (_, _, into, share) in ADVICE.items():
        wasted = np.where(tasks.available, 0, guides[name][tasks.rho])[there].sum()
        assert (wasted > 0) == (into == "all" and share > 0), name


def test_an_unknown_guide_is_refused():
    with pytest.raises(KeyError, match="beta-3"):
        make_guides(["beta-3"])


# Studies


def test_every_guide_of_a_strategy_has_the_same_tau():
    prob = {arm.strategy: arm.tau for arm in ARMS if arm.guide == "prob"}
    assert prob == TAU, "the paper's, of Prob"
    for study in STUDIES:
        first, *guided = study.arms
        found = {(arm.strategy, arm.tau) for arm in guided}
        assert first.name == "none"
        if study.folder == "study-tau-target":  # it asks how much tau matters
            assert len(found) == 5
        else:
            assert found == {(each, prob[each]) for each in study.strategies}


def test_a_study_runs_resumes_and_has_the_luck_of_the_other_experiments(tmp_path):
    study = Study("tiny", ("beta-0", "available"), "source", {"max_episode": 500})
    seen = []

    def run(executor=None):
        return run_studies(
            tmp_path,
            studies=[study],
            scale=SMALL,
            n_runs=2,
            executor=executor,
            on_start=lambda study: lambda done, total: seen.append((done, total)),
        )

    with ThreadPoolExecutor(2) as executor:
        found = run(executor)["tiny"]
    again = run()["tiny"]  # read, or it would start processes

    assert [arm.name for arm in found.arms] == [
        "none",
        "beta-0-hard",
        "beta-0-soft",
        "available-hard",
        "available-soft",
    ]
    assert seen[0] == (0, 10 * SMALL.steps)
    assert seen[-1] == (10 * SMALL.steps, 10 * SMALL.steps)
    np.testing.assert_array_equal(found.goals, again.goals)
    tasks = navigation_tasks(read_map("source"), reward="goal")
    alone = q_learning(
        tasks.mdp,
        SMALL.steps,
        rng=np.random.SeedSequence(2015, spawn_key=(0, 1)),
        guide=make_guides(["beta-0"])["beta-0"][tasks.rho],
        tau=SMALL.tau(study.arms[1]),
        max_episode=500,
        window=SMALL.window,
    )
    np.testing.assert_array_equal(found.curves("beta-0-hard")[1], alone.goals)
    assert alone.goals.any()


@pytest.mark.parametrize("study", STUDIES, ids=lambda study: study.folder)
def test_the_stored_results_are_those_of_the_study(study):
    problem = Problem(target=read_map(study.target), **study.problem)
    guides = make_guides(study.guides, problem)
    plan = make_plan(study.arms, problem, "paper", study.n_runs, guides=guides)

    assert read_results(study.folder).record["parameters"] == parameters(plan)


def test_runs_of_the_study_are_paired_with_those_of_the_figures():
    ours, theirs = read_results("study-goal-target"), read_results("goal-target")

    for ours_, theirs_ in {
        "none": "none",
        "beta-0-hard": "nd-hard",
        "beta-1-soft": "prob-soft",
    }.items():
        expected = theirs.curves(theirs_)[:20]
        np.testing.assert_array_equal(ours.curves(ours_), expected)


def test_a_study_is_left_out_of_the_papers_figures(tmp_path):
    study = Study("guided", ("available",), "source")
    with ThreadPoolExecutor(2) as executor:
        options = {"scale": SMALL, "n_runs": 2, "executor": executor}
        run_studies(tmp_path, studies=[study], **options)

    assert make_figures(tmp_path, tmp_path / "out") == []


# Diagnosis


@pytest.fixture
def corridor():
    """Three cells and the goal; left, right; a step succeeds half of the time."""
    left, right = [[0, 0], [0, 1], [1, 2], [3, 3]], [[0, 1], [1, 2], [2, 3], [3, 3]]
    return MDP(
        next_state=np.stack([left, right], axis=1),
        prob=np.full((4, 2, 2), 0.5),
        reward=[0, 0, 0, 1],
        terminal=[False, False, False, True],
        gamma=0.9,
    )


def test_arrival_is_worked_out_by_hand(corridor):
    found = arrival(corridor, np.tile([0.0, 1.0], (4, 1)), n_steps=3)

    # From cell 1 two of three steps must succeed: 4 of 8 ways.
    np.testing.assert_allclose(found.arrived, [1 / 8, 4 / 8, 7 / 8, 1])
    # Steps are 1 + P(not there after 1) + P(not there after 2).
    np.testing.assert_allclose(found.steps, [3, 1 + 1 + 3 / 4, 1 + 1 / 2 + 1 / 4, 0])
    expected = (1 / 8 + 4 / 8 + 7 / 8) / (3 + 2.75 + 1.75)
    assert found.goals_per_step(~corridor.terminal) == pytest.approx(expected)


def test_arrival_agrees_with_walking(guides):
    tasks = target_tasks(Problem())
    guide = guides["beta-0"][tasks.rho]
    exact = arrival(tasks.mdp, guide).goals_per_step(~tasks.mdp.terminal)
    n = 10_000_000
    options = {"guide": guide, "tau": n, "rngs": range(12)}
    walks = q_learning_runs(tasks.mdp, n, **options)

    walked = np.mean([walk.goals.sum() for walk in walks])
    assert walked == pytest.approx(n * exact, rel=0.03)


def test_a_loop_of_chances_ends_and_a_closed_loop_does_not(corridor):
    policy = np.array([[1.0, 0.0], [1 - 1e-6, 1e-6], [0.0, 1.0], [0.5, 0.5]])

    np.testing.assert_array_equal(
        can_arrive(corridor, policy), [False, True, True, True]
    )


def test_who_arrives_at_all_depends_on_the_support_alone(guides):
    tasks = target_tasks(Problem())
    nd, prob = (can_arrive(tasks.mdp, guides[f"beta-{b}"][tasks.rho]) for b in (0, 1))

    np.testing.assert_array_equal(nd, prob)
    assert not nd.all()
    assert can_arrive(tasks.mdp, guides["available"][tasks.rho]).all()


def test_notes_of_a_walk_that_is_known_step_by_step():
    """From cell 0 to the goal in three steps, for ever: rewards come every third."""
    line = MDP(
        next_state=[[[1], [0]], [[2], [1]], [[3], [2]], [[3], [3]]],
        prob=np.ones((4, 2, 1)),
        reward=[0, 0, 0, 1],
        terminal=[False, False, False, True],
        gamma=0.5,
    )
    guide = np.tile([1.0, 0.0], (4, 1))
    found = notes_after(line, guide, 300, rngs=range(4), gamma=0.5)
    none = notes_after(line, np.tile([0.0, 1.0], (4, 1)), 300, rngs=[0], gamma=0.5)

    assert found.tried == 0.5  # one of two actions, everywhere
    assert found.informed == 1
    assert found.skill == pytest.approx(1)
    assert 100 <= found.goals <= 300  # of one to three steps each
    assert (none.goals, none.informed) == (0, 0)
    assert none.tried == pytest.approx(1 / 6)  # it stays in its first cell
    # Blank notes are obeyed by tossing a coin: V(s) = gamma (V(s) + V(s+1)) / 2,
    v = np.array([1 / 27, 1 / 9, 1 / 3])  # that is V(s+1) / 3
    assert none.skill == pytest.approx(v.sum() / (1 / 8 + 1 / 4 + 1 / 2))


def test_notes_that_zero_flatters_are_refused(corridor):
    cost = navigation_tasks(read_map("source")).mdp

    with pytest.raises(ValueError, match="reward must not be negative"):
        notes_after(cost, np.full((cost.n_states, 8), 1 / 8), 10, rngs=[0])


def test_nd_is_built_by_its_own_formula_too(guides):
    """Two routes: beta = 0, and the set of actions with a vote."""
    votes = guides["beta-1"]
    nd = induce_nondeterministic(votes, np.arange(len(votes)), votes > 0)

    np.testing.assert_allclose(guides["beta-0"], nd, atol=1e-12)
