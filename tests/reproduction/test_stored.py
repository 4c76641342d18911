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
from abstransfer.reproduction.catalogue import EXPERIMENTS
from abstransfer.reproduction.folders import Experiment
from abstransfer.reproduction.guides import make_guides
from abstransfer.reproduction.interventions import run_operations
from abstransfer.reproduction.operations import OPERATIONS

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


def test_the_time_that_all_of_it_takes_is_the_time_it_took():
    seconds = [
        read_results(one.folder).record["seconds"]["cores"] for one in EXPERIMENTS
    ]

    assert pytest.approx(sum(seconds), rel=0.05) == 60 * cost.EVERYTHING
    assert f"{cost.EVERYTHING} minutes of one core" in " ".join(
        catalogue.reproduce.__doc__.split()
    )
