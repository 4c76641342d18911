"""Stored results come out again: of each folder one run, and what they took."""

from concurrent.futures import ThreadPoolExecutor
from zlib import crc32

import numpy as np
import pytest

from abstransfer._paths import DATA
from abstransfer.cli import cost
from abstransfer.experiments.arms import Scale
from abstransfer.experiments.plan import SEED, STREAMS
from abstransfer.experiments.problem import GUIDES, Problem, build_guides
from abstransfer.experiments.results import read_results
from abstransfer.experiments.workers import Job, run_job
from abstransfer.reproduction import catalogue
from abstransfer.reproduction.bench import TARGET, TUNING, Case, chosen, do_case
from abstransfer.reproduction.blind_rules import OF_STUDY, judge_blind
from abstransfer.reproduction.buildings import draw_building
from abstransfer.reproduction.catalogue import EXPERIMENTS
from abstransfer.reproduction.folders import Experiment
from abstransfer.reproduction.guides import make_guides
from abstransfer.reproduction.interventions import run_operations
from abstransfer.reproduction.operations import OPERATIONS
from abstransfer.reproduction.surveys import run_survey
from abstransfer.reproduction.teachers import search

RUN = [one for one in EXPERIMENTS if isinstance(one, Experiment)]
BEGINNING = Scale(5_000_000, 500_000)  # of a run, beyond most tau: ten windows


@pytest.mark.parametrize("experiment", RUN, ids=lambda e: e.folder)
def test_the_beginning_of_a_stored_run_comes_out_again(experiment):
    """One arm of each folder, another one in each; its last run."""
    arms, problem = experiment.arms(DATA / "results"), experiment.here()
    arm = arms[crc32(experiment.folder.encode()) % len(arms)]
    stored = read_results(experiment.folder).curves(arm.name, arm.tau)
    guide = None
    if arm.guide:
        build = build_guides if arm.guide in GUIDES else _made
        guide = build(problem, [arm.guide])[arm.guide]
    stream = STREAMS["tune" if experiment.grid else "report"]
    seed = np.random.SeedSequence(SEED, spawn_key=(stream, len(stored) - 1))
    job = Job(problem, arm.strategy, arm.tau, guide, BEGINNING, (seed,), arm.hint)
    goals, _ = run_job(job)

    np.testing.assert_array_equal(goals[0], stored[-1][:10])
    assert goals.any()


def _made(problem, names):
    return make_guides(names, problem)


@pytest.mark.parametrize(
    ("folder", "name"),
    [
        ("operations-target", "nd-elsewhere"),
        ("operations-target_b", "prob-digested"),
        ("operations-target_c", "half-thinned"),
        ("operations-target_d", "perfect-on-prob"),
        ("drawn", "prob-grafted"),
    ],
)
def test_a_stored_operation_comes_out_again(folder, name):
    asked = next(one for one in EXPERIMENTS if one.folder == folder)
    stored = read_results(folder)
    with ThreadPoolExecutor(1) as pool:
        found = run_operations(
            asked.here(),
            operations=[name],
            n_runs=1,
            drawn=not asked.target,
            executor=pool,
        )

    assert found.totals(name)[0] == stored.totals(name)[0]
    assert found.record["noted"][name][0] == stored.record["noted"][name][0]
    assert name in OPERATIONS


@pytest.mark.parametrize("name", ["whisper", "library", "q-lambda", "replay"])
def test_the_beginning_of_a_stored_run_of_the_bench_comes_out_again(name):
    """Of methods that do not ask how long a run is."""
    stored = read_results(TARGET)
    tried = chosen(read_results(TUNING))[name]
    last = stored.goals.shape[1] - 1
    seed = np.random.SeedSequence(SEED, spawn_key=(STREAMS["report"], last))
    goals, _ = do_case(Case(Problem(), (tried,), BEGINNING, seed))

    np.testing.assert_array_equal(goals[0], stored.curves(name)[last][:10])
    assert goals.any()


@pytest.mark.parametrize(
    ("folder", "name"),
    [
        ("blind", "nd-prob-in-traps-hard"),
        ("whisper-compass", "values-other"),
        ("teacher", "search-source"),
    ],
)
def test_a_stored_run_of_a_survey_comes_out_again(folder, name):
    """The first run in the first building; what is tuned is read, not searched."""
    asked = next(one for one in EXPERIMENTS if one.folder == folder)
    arms = asked.arms(DATA / "results")
    with ThreadPoolExecutor(1) as pool:
        found = run_survey(
            [one for one in arms if one.arm.name == name],
            [draw_building(asked.seeds[0], asked.blocks)],
            asked.here(),
            executor=pool,
        )

    assert found.totals(name)[0] == read_results(folder).totals(name)[0]


def test_the_first_trials_of_a_stored_search_come_out_again():
    stored = read_results("teacher-search-source").record["tried"]
    tried = []

    def teach(name, tau):
        tried.append({"guide": name, "tau": tau})
        return float(read_results("teacher-search-source").goals[len(tried) - 1].mean())

    search(teach, len(stored))

    assert tried == stored


#: Hypotheses whose verdict in the first twelve buildings is another one.
NEED_ALL = {"M2"}


@pytest.mark.parametrize("name", ["blind", "whisper", "teacher"])
def test_twelve_buildings_give_the_verdicts_of_all_but_in_one(name):
    """What `--study NAME --buildings 12` would find: its runs are the first ones."""

    def first(folder):
        results = read_results(folder)
        if results.record["parameters"]["reading"]["target"]["name"] != "drawn":
            return results
        n = 12 * results.record["parameters"].get("runs_in_a_building", 1)
        record = {
            key: {name: of[:12] for name, of in value.items()}
            if key in ("value", "variation", "letters", "ready", "noted")
            else value
            for key, value in results.record.items()
        }
        return results._replace(goals=results.goals[:, :n], record=record)

    keys = OF_STUDY[name]
    some, whole = judge_blind(keys, first), judge_blind(keys)

    other = {key for key in keys if some[key].verdict != whole[key].verdict}

    assert other == NEED_ALL & set(keys)


def test_the_time_that_all_of_it_takes_is_the_time_it_took():
    seconds = [
        read_results(one.folder).record["seconds"]["cores"] for one in EXPERIMENTS
    ]

    assert pytest.approx(sum(seconds), rel=0.05) == 60 * cost.EVERYTHING
    assert f"{cost.EVERYTHING} minutes of one core" in " ".join(
        catalogue.reproduce.__doc__.split()
    )
