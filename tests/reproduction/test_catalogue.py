"""The catalogue: the guides of page 10, and every folder of results."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from support import NoExecutor

from abstransfer import induce_nondeterministic, navigation_tasks, read_map
from abstransfer._paths import DATA
from abstransfer.experiments.arms import ARMS, Scale
from abstransfer.experiments.problem import Problem, build_guides, target_tasks
from abstransfer.experiments.results import read_results, stored_results
from abstransfer.learning import q_learning
from abstransfer.reproduction.catalogue import (
    EXPERIMENTS,
    in_place_of_target,
    reproduce,
)
from abstransfer.reproduction.catalogue import study as experiments_of
from abstransfer.reproduction.figures import make_figures
from abstransfer.reproduction.folders import Experiment
from abstransfer.reproduction.guides import ADVICE, TAU, make_guides

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


def test_nd_is_built_by_its_own_formula_too(guides):
    """Two routes: beta = 0, and the set of actions with a vote."""
    votes = guides["beta-1"]
    nd = induce_nondeterministic(votes, np.arange(len(votes)), votes > 0)

    np.testing.assert_allclose(guides["beta-0"], nd, atol=1e-12)


# Experiments


STUDIES = [one for one in EXPERIMENTS if isinstance(one, Experiment) and one.guides]


def test_every_guide_of_a_strategy_has_the_same_tau():
    prob = {arm.strategy: arm.tau for arm in ARMS if arm.guide == "prob"}
    assert prob == TAU, "the paper's, of Prob"
    for study in STUDIES:
        first, *guided = study.arms("")
        found = {(arm.strategy, arm.tau) for arm in guided}
        assert first.name == "none"
        if study.folder == "study-tau-target":  # it asks how much tau matters
            assert len(found) == 5
        else:
            assert found == {(each, prob[each]) for each in study.strategies}


def test_the_catalogue_holds_every_folder_of_stored_results():
    folders = [experiment.folder for experiment in EXPERIMENTS]

    assert sorted(folders) == sorted(stored_results())


def test_experiments_run_resume_and_have_one_luck(tmp_path):
    study = Experiment(
        "tiny",
        2,
        "goal",
        "source",
        {"max_episode": 500},
        guides=("beta-0", "available"),
    )
    seen = []

    def run(executor=None):
        return reproduce(
            tmp_path,
            experiments=[study],
            scale=SMALL,
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
        tau=SMALL.tau(study.arms("")[1]),
        max_episode=500,
        window=SMALL.window,
    )
    np.testing.assert_array_equal(found.curves("beta-0-hard")[1], alone.goals)
    assert alone.goals.any()


@pytest.mark.parametrize("experiment", EXPERIMENTS, ids=lambda e: e.folder)
def test_the_stored_results_are_those_of_the_catalogue(experiment):
    """Without a step: another plan would be refused, a missing table run."""
    found = reproduce(DATA / "results", experiments=[experiment], executor=NoExecutor())

    assert found.keys() == {experiment.folder}


def test_a_study_can_be_had_with_fewer_of_its_drawn_buildings():
    assert [one.n_runs for one in experiments_of("neighbours")] == [2, 5, 24]
    assert [one.n_runs for one in experiments_of("neighbours", 3)] == [2, 5, 3]
    assert [one.n_runs for one in experiments_of("neighbours", 99)] == [2, 5, 24]
    with pytest.raises(ValueError, match="study must be one of .* got 'none'"):
        experiments_of("none")
    with pytest.raises(ValueError, match="n_buildings must be a whole number from 1"):
        experiments_of("neighbours", 0)


def test_runs_of_page_10_are_paired_with_those_of_the_figures():
    ours, theirs = read_results("study-goal-target"), read_results("goal-target")

    for ours_, theirs_ in {
        "none": "none",
        "beta-0-hard": "nd-hard",
        "beta-1-soft": "prob-soft",
    }.items():
        expected = theirs.curves(theirs_)[:20]
        np.testing.assert_array_equal(ours.curves(ours_), expected)


def test_guides_of_ones_own_are_left_out_of_the_papers_figures(tmp_path):
    study = Experiment("guided", 2, target="source", guides=("available",))
    with ThreadPoolExecutor(2) as executor:
        reproduce(tmp_path, experiments=[study], scale=SMALL, executor=executor)

    assert make_figures(tmp_path, tmp_path / "out") == []


def test_all_that_is_done_in_the_target_can_be_done_in_another_building():
    """Grids and what they tune keep their folders, so one finds the other."""
    there = {one.folder: one for one in in_place_of_target("target_b")}
    here = {one.folder: one for one in EXPERIMENTS if one.target == "target"}

    assert there.keys() == here.keys()
    assert {one.target for one in there.values()} == {"target_b"}
    assert there["goal-target-tuned"].tuned_by == "goal-target-tau"
    assert "operations-target" in there
