"""Experiments: the same to the bit, however they are run, stored or interrupted."""

import gzip
import json
import os
import socket
import subprocess
import sys
import threading
import tracemalloc
from concurrent.futures import Executor, ThreadPoolExecutor
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import ROOT, NoExecutor, unavailable

from abstransfer import read_map
from abstransfer.driving import advised, executed_values
from abstransfer.experiments import results, workers
from abstransfer.experiments.arms import ARMS, SCALES, TAUS, Arm, Scale, tau_cells
from abstransfer.experiments.plan import make_plan, parameters
from abstransfer.experiments.problem import (
    Problem,
    build_guides,
    driving_tasks,
    target_tasks,
)
from abstransfer.experiments.results import Results, load_results, save_results
from abstransfer.experiments.run import run_experiment
from abstransfer.experiments.store import claim
from abstransfer.experiments.surgery import leave
from abstransfer.learning import q_learning
from abstransfer.policies import restrict_policy
from abstransfer.project.racing import race

SMALL = Scale(30_000, 10_000)
PROBLEM = Problem(target=read_map("source"))
THREE = (ARMS[0], ARMS[3], ARMS[6])  # none, nd-hard, prob-soft
N_RUNS = 8  # more than a job holds


def run(arms=THREE, problem=PROBLEM, **options):
    options = {"scale": SMALL, "n_runs": N_RUNS} | options
    if "executor" in options or "n_workers" in options:
        return run_experiment(arms, problem, **options)
    with ThreadPoolExecutor(2) as executor:
        return run_experiment(arms, problem, executor=executor, **options)


@pytest.fixture(scope="module")
def expected():
    return run()


class Backwards(Executor):
    """Runs what it was given last first."""

    def __init__(self):
        self.pool, self.waiting = ThreadPoolExecutor(1), []

    def submit(self, function, job):
        from concurrent.futures import Future

        future = Future()
        self.waiting.append((future, function, job))
        n_jobs = 2 * len(THREE)
        if len(self.waiting) == n_jobs:
            for future_, function_, job_ in reversed(self.waiting):
                future_.set_result(function_(job_))
        return future


def test_each_run_is_the_one_that_its_seed_and_arm_make(expected):
    """Run 7 of prob-soft, alone, through the learner's own front door."""
    tasks = target_tasks(PROBLEM)
    guide = build_guides(PROBLEM, ["prob"])["prob"][tasks.rho]
    alone = q_learning(
        tasks.mdp,
        SMALL.steps,
        guide=restrict_policy(guide, tasks.mdp.allowed),
        strategy="soft",
        tau=SMALL.tau(THREE[2]),
        window=SMALL.window,
        rng=np.random.SeedSequence(2015, spawn_key=(0, 7)),
    )

    assert expected.goals.shape == (3, N_RUNS, 3)
    assert expected.goals.any(axis=(1, 2)).all(), "an arm never reached a goal"
    np.testing.assert_array_equal(expected.curves("prob-soft")[7], alone.goals)


@pytest.mark.parametrize("n_workers", [1, 2])
def test_the_number_of_processes_does_not_matter(n_workers, expected):
    np.testing.assert_array_equal(run(n_workers=n_workers).goals, expected.goals)


def test_workers_leave_it_to_their_parent_to_say_that_it_is_slow(tmp_path):
    """Here as nothing may be compiled: they would say so, were they not workers."""
    code = (
        "from abstransfer.experiments.arms import ARMS, Scale\n"
        "from abstransfer.experiments.run import run_experiment\n"
        "if __name__ == '__main__':\n"
        "    tiny = Scale(steps=1_000, window=500)\n"
        "    run_experiment(ARMS[:2], n_runs=1, n_workers=2, scale=tiny)\n"
    )
    script = tmp_path / "two.py"
    script.write_text(code, encoding="utf-8")

    done = subprocess.run(
        [sys.executable, script],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )

    assert done.stderr.count("numba is disabled") == 1


def test_the_order_of_jobs_does_not_matter(expected):
    np.testing.assert_array_equal(run(executor=Backwards()).goals, expected.goals)


def test_a_dask_cluster_gives_the_same(expected):
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        unavailable("distributed is not installed; pip install abstransfer[dask]")
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": ":0"}
    with LocalCluster(**options) as cluster, Client(cluster) as client:
        found = run(executor=client.get_executor())

    np.testing.assert_array_equal(found.goals, expected.goals)


def test_the_number_of_runs_does_not_change_a_run(expected):
    np.testing.assert_array_equal(run(n_runs=2).goals, expected.goals[:, :2])


def test_run_i_of_every_arm_has_the_same_luck():
    twins = (Arm("a", None, "hard", 0), Arm("b", None, "hard", 0))
    goals = run(twins).goals

    np.testing.assert_array_equal(goals[0], goals[1])
    assert len({tuple(curve) for curve in goals[0]}) > 1, "all runs are equal"


def test_seeds_that_tune_are_none_of_those_that_report(expected):
    tuning = run(stream="tune")

    assert not (tuning.goals == expected.goals).all(axis=2).any()


def test_a_worker_that_is_told_to_stop_leaves_its_job(monkeypatch):
    job = workers.Job(PROBLEM, "hard", 0, None, SMALL, (np.random.SeedSequence(1),))
    monkeypatch.setattr(workers, "STOP", threading.Event())
    calls = []

    def after_the_first_window(n_steps):
        calls.append(n_steps)
        if n_steps:
            workers.STOP.set()

    with pytest.raises(InterruptedError):
        workers.run_job(job, after_the_first_window)
    assert calls == [0, SMALL.window]


def test_own_guides_can_be_passed():
    policy = build_guides(PROBLEM, ["nd"])["nd"]
    named = run(
        (Arm("mine", "my policy", "hard", 3_500_000),), guides={"my policy": policy}
    )

    np.testing.assert_array_equal(named.goals[0], run(THREE[1:2]).goals[0])


def test_progress_is_told_in_steps():
    told = []
    run(THREE[:1], on_progress=lambda done, total: told.append((done, total)))

    total = N_RUNS * SMALL.steps
    assert told == [(0, total), *told[1:-1], (total, total)]
    assert [done for done, _ in told] == sorted({done for done, _ in told})


def test_what_is_stored_is_what_was_found(tmp_path, expected):
    stored = run(out=tmp_path / "a")
    loaded = load_results(tmp_path / "a")

    np.testing.assert_array_equal(stored.goals, expected.goals)
    np.testing.assert_array_equal(loaded.goals, expected.goals)
    assert loaded.arms == THREE
    assert sorted(os.listdir(tmp_path / "a")) == ["experiment.json", "goals.csv.gz"]


def test_the_table_is_tidy_and_stable_to_the_byte(tmp_path, expected):
    save_results(tmp_path / "a", expected)
    save_results(tmp_path / "b", expected)
    a, b = ((tmp_path / x / "goals.csv.gz").read_bytes() for x in "ab")
    lines = gzip.decompress(a).decode().splitlines()

    assert a == b
    assert lines[0] == "arm,tau,run,window,goals"
    assert lines[1] == f"none,0,0,0,{expected.goals[0, 0, 0]}"
    assert len(lines) == 1 + expected.goals.size


def test_the_record_says_what_made_it_and_nothing_of_the_machine(tmp_path):
    run(out=tmp_path / "a")
    text = (tmp_path / "a" / "experiment.json").read_text(encoding="utf-8")
    record = json.loads(text)

    assert record["parameters"]["reading"]["target"]["name"] == "source"
    assert record["parameters"]["runs"] == N_RUNS
    assert set(record["versions"]) == {
        "python",
        "abstransfer",
        "numpy",
        "scipy",
        "numba",
    }
    assert record["seconds"]["cores"] > 0
    assert str(tmp_path) not in text
    assert os.getcwd() not in text
    assert f'"{socket.gethostname()}"' not in text


def test_a_finished_experiment_is_read_not_run(tmp_path, expected):
    run(out=tmp_path)
    again = run(out=tmp_path, executor=NoExecutor())

    np.testing.assert_array_equal(again.goals, expected.goals)


def test_only_missing_runs_are_made(tmp_path, expected):
    """A part with impossible goals stays: its runs were not repeated."""
    plan, folder = make_plan(THREE, PROBLEM, SMALL, N_RUNS), tmp_path / "a"
    with claim(folder, parameters(plan), plan.shape) as store:
        store.save(1, 3, np.full((2, 3), 9_999), 1.0)
    told = []
    found = run(out=folder, on_progress=lambda done, total: told.append(done))

    assert told[0] == 2 * SMALL.steps
    assert (found.goals[1, 3:5] == 9_999).all()
    found.goals[1, 3:5] = expected.goals[1, 3:5]
    np.testing.assert_array_equal(found.goals, expected.goals)


@pytest.mark.parametrize(
    ("options", "difference"),
    [
        ({"n_runs": 9}, "parameters.runs is 8 there and 9 here"),
        ({"seed": 1}, "parameters.seed is 2015 there and 1 here"),
        ({"problem": Problem(target=PROBLEM.target, reward="cost")}, "reading.reward"),
        ({"problem": Problem(target=PROBLEM.target, alpha=0.2)}, "alpha is 0.1 there"),
        ({"problem": Problem()}, "target.name is 'source' there and 'target' here"),
        ({"scale": Scale(30_000, 15_000)}, "parameters.window"),
        ({"arms": THREE[:2]}, "parameters.arms is a list of 3 there"),
        ({"arms": (*THREE[:2], THREE[2]._replace(tau=7))}, r"arms\[2\].tau is 6000000"),
    ],
)
def test_a_folder_of_another_experiment_is_refused_by_name(
    tmp_path, expected, options, difference
):
    record = {"parameters": parameters(make_plan(THREE, PROBLEM, SMALL, N_RUNS))}
    save_results(tmp_path, expected._replace(record=record))
    with pytest.raises(ValueError, match=difference):
        run(out=tmp_path, executor=NoExecutor(), **options)


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"n_runs": 0}, "n_runs must be a whole number from 1 to .*, got 0"),
        ({"scale": "huge"}, r"scale must be one of \('page', 'class', 'paper'\)"),
        ({"scale": Scale(10, 3)}, "whole windows"),
        ({"stream": "x"}, "stream must be one of"),
        ({"seed": -1}, "seed must be an int >= 0"),
        ({"seed": 1.0}, "seed must be an int >= 0, not a float, got 1.0"),
        ({"n_runs": 10_000_000}, "at most 10,000,000, .* got 90,000,000"),
        ({"n_workers": 0}, "n_workers must be a whole number from 1 to 1,000, got 0"),
        ({"arms": ()}, "at least one arm"),
        (
            {"arms": (ARMS[0], ARMS[0])},
            r"differ in name or tau, got \('none', 0\) twice",
        ),
        ({"arms": (Arm("x", "nd", "medium", 0),)}, "strategy of arm 'x'"),
        ({"arms": (Arm("x", "nd", "hard", -5),)}, "tau of arm 'x' .* got -5"),
        ({"arms": (Arm("x", "nd", "hard", float("nan")),)}, "tau of arm 'x'"),
        ({"arms": (Arm("x", "best", "hard", 5),)}, "guide of arm 'x' must be one of"),
        (
            {"arms": (Arm("x", None, "hard", 0, float("inf")),)},
            "hint of arm 'x' must be a number from .*, got inf",
        ),
    ],
)
def test_bad_arguments_are_refused_before_a_step(tmp_path, options, complaint):
    options = {"executor": NoExecutor(), "out": tmp_path / "new"} | options
    with pytest.raises(ValueError, match=complaint):
        run(**options)

    assert not (tmp_path / "new").exists()


def doors(tasks):
    """Return all that take a guide, each as a function of an abstract policy."""
    mdp, none = tasks.mdp, np.zeros((tasks.mdp.n_states, 8), bool)
    grounded = {"tau": 5, "rng": 0}
    return {
        "run_experiment": lambda guide: run(
            THREE[:1], guides={"x": guide}, executor=NoExecutor()
        ),
        "race": lambda guide: race(tasks, {"x": guide}, steps=10, tau=5, n_runs=1),
        "executed_values": lambda guide: executed_values(tasks, {"x": guide}),
        "q_learning": lambda guide: q_learning(
            mdp, 10, guide=guide[tasks.rho % len(guide)], **grounded
        ),
        "leave": lambda guide: leave(
            mdp, none, {"x": guide[tasks.rho % len(guide)]}, 5, seed=0
        ),
    }


NO_POLICY = {
    "not a number": np.full((2048, 8), np.nan),
    "negative": np.tile([2.0, -1, 0, 0, 0, 0, 0, 0], (2048, 1)),
    "all zero": np.zeros((2048, 8)),
    "a sum of 8": np.ones((2048, 8)),
    "too few actions": np.full((2048, 4), 0.25),
}


@pytest.mark.parametrize("guide", NO_POLICY.values(), ids=NO_POLICY)
@pytest.mark.parametrize("door", doors(target_tasks(PROBLEM)))
def test_a_guide_that_is_no_policy_is_refused_at_every_door(door, guide):
    tasks = target_tasks(PROBLEM)

    with pytest.raises(ValueError, match="guide|advice|policy"):
        doors(tasks)[door](guide)
    doors(tasks)["executed_values"](np.full((2048, 8), 1 / 8))  # which is one


@settings(max_examples=50, deadline=None)
@given(st.text() | st.sampled_from(["a,b", "na\xefve", "a\x85", "a\r", "a b", '"']))
def test_an_arm_has_a_name_that_can_be_stored_or_no_step_is_made(name):
    arms = (Arm(name, None, "hard", 0),)
    if not name or not (name.isascii() and name.isprintable()) or {*name} & set("\"',"):
        with pytest.raises(ValueError, match="must be a plain word"):
            make_plan(arms, PROBLEM, SMALL, 1)
        return
    plan = make_plan(arms, PROBLEM, SMALL, 1)
    goals = np.zeros(plan.shape, np.int64)
    with TemporaryDirectory() as folder:
        save_results(folder, Results(arms, goals, {"parameters": parameters(plan)}))
        assert load_results(folder).arms == arms


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("reward", "gold"),
        ("actions", "dance"),
        ("unavailable", "jump"),
        ("success", 0.0),
        ("q0", float("inf")),
        ("alpha", 1.5),
        ("epsilon", -0.1),
        ("epsilon", float("nan")),
        ("gamma", 1.1),
        ("max_episode", 0),
    ],
)
def test_a_bad_reading_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f"{name} must .* got {value!r}"):
        Problem(**{name: value})


def test_an_unfinished_folder_cannot_be_loaded(tmp_path):
    with pytest.raises(FileNotFoundError, match="no results here"):
        load_results(tmp_path)
    plan = make_plan(THREE, PROBLEM, SMALL, N_RUNS)
    with claim(tmp_path, parameters(plan), plan.shape):
        pass
    with pytest.raises(FileNotFoundError, match="not finished"):
        load_results(tmp_path)


def test_a_table_that_does_not_fit_its_record_is_refused(tmp_path, expected):
    record = {"parameters": parameters(make_plan(THREE, PROBLEM, SMALL, N_RUNS))}
    for other in (
        Results(THREE[::-1], expected.goals, record),
        Results(THREE, expected.goals - expected.goals.max() - 1, record),
        Results(THREE, expected.goals + SMALL.window, record),
        Results(THREE[:2], expected.goals[:2], record),
    ):
        save_results(tmp_path, other)
        with pytest.raises(ValueError, match="goals.csv.gz: not a table of goals as"):
            load_results(tmp_path)


@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda: gzip.compress(bytes(2_500_000)), "not a table of goals as"),
        (lambda: bytes(50_000_000), "50,000,000 bytes, where at most "),
    ],
    ids=["unpacks to a large one", "is large"],
)
def test_a_file_of_another_size_than_its_record_can_mean_is_not_read_whole(
    tmp_path, expected, monkeypatch, make, complaint
):
    record = {"parameters": parameters(make_plan(THREE, PROBLEM, SMALL, N_RUNS))}
    monkeypatch.setattr(results, "_table", lambda results: make())
    save_results(tmp_path, expected._replace(record=record))

    tracemalloc.start()
    with pytest.raises(ValueError, match=f"goals.csv.gz: {complaint}"):
        load_results(tmp_path)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 1_000_000


@pytest.mark.parametrize(
    "table",
    [b"no archive", gzip.compress(b"arm")[:-9], gzip.compress(b"")[:10] + b"\xff"],
    ids=["never packed", "cut off", "a stream that breaks"],
)
def test_a_table_that_cannot_be_unpacked_is_refused_by_name(
    tmp_path, expected, monkeypatch, table
):
    record = {"parameters": parameters(make_plan(THREE, PROBLEM, SMALL, N_RUNS))}
    monkeypatch.setattr(results, "_table", lambda results: table)
    save_results(tmp_path, expected._replace(record=record))

    with pytest.raises(ValueError, match="goals.csv.gz: not a table of goals as"):
        load_results(tmp_path)


@pytest.mark.parametrize("changed", [{"runs": 10**9}, {"runs": 0}, {"window": "all"}])
def test_a_record_of_a_table_that_cannot_be_is_refused(tmp_path, expected, changed):
    there = parameters(make_plan(THREE, PROBLEM, SMALL, N_RUNS)) | changed
    save_results(tmp_path, expected._replace(record={"parameters": there}))

    with pytest.raises(ValueError, match="experiment.json: describes no table"):
        load_results(tmp_path)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "not JSON"),
        ('{"parameters": ', "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[]", "no sha256"),
        ("3", "no sha256"),
        ("null", "no sha256"),
        ('{"parameters": {}}', "no sha256"),
        ('{"sha256": {"goals.csv.gz": "", "experiment.json": ""}}', "edited"),
    ],
)
def test_a_record_that_is_none_is_refused_by_name(tmp_path, text, complaint):
    (tmp_path / "experiment.json").write_text(text, encoding="utf-8")
    for read in (load_results, lambda folder: run(out=folder)):
        with pytest.raises(ValueError, match=f"experiment.json: .*{complaint}"):
            read(tmp_path)


def test_the_nine_arms_have_the_papers_tau_and_the_grid_holds_them():
    assert [arm.tau / 1e6 for arm in ARMS] == [0, 9, 19, 3.5, 11, 3.5, 6, 3.5, 6]
    assert {arm.tau for arm in ARMS if arm.guide} <= set(TAUS)
    assert len(tau_cells()) == 8 * len(TAUS)


@pytest.mark.parametrize(("scale", "share"), [("page", 30), ("class", 3), ("paper", 1)])
def test_a_smaller_scale_shrinks_steps_and_tau_alike(scale, share):
    assert SCALES[scale].steps * share == 30_000_000
    assert SCALES[scale].steps % SCALES[scale].window == 0
    assert SCALES[scale].tau(ARMS[3]) == round(3_500_000 / share)


def test_masked_actions_and_the_cost_reward_can_be_learned_with():
    goals = [
        run(
            THREE, Problem(target=PROBLEM.target, unavailable="masked", reward=reward)
        ).goals
        for reward in ("goal", "cost")
    ]

    assert (goals[0] != goals[1]).any()


# First notes on what can be done, and a learner with a compass


def test_a_hint_is_a_first_note_on_the_actions_that_exist():
    hinted = Arm("hinted", None, "hard", 0, 1e-12)
    tasks = target_tasks(PROBLEM)
    by_hand = q_learning(
        tasks.mdp,
        SMALL.steps,
        rng=np.random.SeedSequence(2015, spawn_key=(0, 0)),
        q0=np.where(tasks.available, 1e-12, 0.0),
        window=SMALL.window,
    )

    results = run((hinted,), n_runs=1)

    assert by_hand.goals.any()
    np.testing.assert_array_equal(results.curves("hinted")[0], by_hand.goals)


def test_a_stored_arm_comes_back_with_its_hint(tmp_path):
    arms = (ARMS[0], Arm("hinted", None, "hard", 0, 1e-12))
    run(arms, n_runs=1, out=tmp_path)

    assert load_results(tmp_path).arms == arms


def test_an_arm_without_hint_is_recorded_as_before_there_was_one():
    assert "hint" not in parameters(make_plan(THREE, PROBLEM, SMALL, 1))["arms"][0]
    assert "actions" not in PROBLEM.record()


def test_a_learner_with_a_compass_is_advised_in_labels_and_moves_by_compass():
    """Random draws from its four moves; the advice reaches open ways only."""
    problem = Problem(
        source=read_map("source"), target=read_map("source"), actions="compass"
    )
    tasks, guides = target_tasks(problem), build_guides(problem, ["rand", "nd"])
    policy = advised(tasks, guides["nd"])

    assert tasks.actions == ("N", "E", "S", "W")
    assert guides["nd"].shape[1] == 8
    assert (policy[tasks.labels < 0] == 0).all()
    np.testing.assert_array_equal(advised(tasks, guides["rand"]), 0.25)
    assert run(problem=problem, n_runs=1).goals.shape == (3, 1, 3)


def test_compass_voters_give_the_papers_source_column_within_two_percent():
    """Table 1: -44.61 for ND, -36.91 for Prob, -30.65 for Grad."""
    problem = Problem(target=read_map("source"), actions="compass")
    guides = build_guides(problem, ["nd", "prob", "grad"])
    values = executed_values(driving_tasks(problem), guides)

    assert values["nd"] == pytest.approx(-44.61, rel=0.02)
    assert values["prob"] == pytest.approx(-36.91, rel=0.02)
    assert values["grad"] == pytest.approx(-30.65, rel=0.02)
