"""The commands that learn: what they print, refuse, store, and survive."""

import json
import multiprocessing.spawn
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from multiprocessing import resource_tracker
from pathlib import Path

import numpy as np
import pytest
from support import PATIENCE

from abstransfer.cli import main
from abstransfer.experiments import workers as pools
from abstransfer.experiments.results import load_results
from abstransfer.reproduction import blind_rules, catalogue
from abstransfer.reproduction.folders import Survey

LEARN = ["learn", "--map", "source", "--steps", "1_500_000", "--window", "5e5"]
PAGE = ["experiment", "--scale", "page", "--jobs", "2", "--target", "source"]


def run(capsys, *arguments):
    code = main(list(arguments))
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def start(*arguments):
    """Start a command in a process group of its own."""
    return subprocess.Popen(
        [sys.executable, "-m", "abstransfer", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        start_new_session=True,
    )


def lines(folder):
    """What is stored of an unfinished experiment; the first line is no part."""
    path = folder / "unfinished.jsonl"
    return path.read_bytes().splitlines() if path.exists() else []


def wait_for_parts(process, folder, n=3):
    """Wait until some jobs are done, and others not."""
    while len(lines(folder)) < 1 + n:
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)


def wait_for_the_end_of(group):
    """Wait until no process of a group is left; end those that stay, and fail."""
    for _ in range(500):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.02)
    os.killpg(group, signal.SIGKILL)
    pytest.fail("a worker went on after its parent had ended")


def test_learn_json_has_the_promised_keys(capsys):
    code, out, _ = run(capsys, *LEARN, "--guide", "nd", "--json")
    result = json.loads(out)

    assert code == 0
    assert list(result) == ["goals", "per_window", "seconds", "ns_per_step"]
    assert len(result["per_window"]) == 3
    assert result["goals"] == sum(result["per_window"]) > 0
    assert result["seconds"] > 0


def test_learn_prints_text_for_people(capsys):
    code, out, _ = run(capsys, *LEARN)

    assert code == 0
    assert "goals in 1,500,000 steps" in out


def test_a_seed_makes_the_run(capsys):
    first, again, other = (
        json.loads(run(capsys, *LEARN, "--json", "--seed", seed)[1])["per_window"]
        for seed in ("1", "1", "2")
    )

    assert first == again != other


def test_seeds_are_exact_whatever_their_size(capsys):
    """2^53 + 1 is no double."""
    runs = [
        json.loads(run(capsys, *LEARN, "--json", "--seed", str(seed))[1])["per_window"]
        for seed in (2**53, 2**53 + 1, 2**200, 2**200 + 1)
    ]

    assert len(set(map(tuple, runs))) == 4


@pytest.mark.parametrize(
    "options",
    [
        ["--guide", "rand", "--tau", "1e6"],
        ["--guide", "prob", "--tau", "1e6", "--strategy", "soft"],
        ["--reward", "cost"],
        ["--unavailable", "masked"],
        ["--success", "1"],
        ["--q0", "1"],
        ["--alpha", "0.5"],
        ["--epsilon", "0.5"],
        ["--gamma", "0.5"],
        ["--max-episode", "20"],
    ],
    ids=lambda options: options[0],
)
def test_every_option_reaches_the_learner(options, capsys):
    usual = json.loads(run(capsys, *LEARN, "--json")[1])["per_window"]
    code, out, _ = run(capsys, *LEARN, "--json", *options)

    assert code == 0
    assert json.loads(out)["per_window"] != usual


def test_tau_is_the_papers_shrunk_to_the_steps(capsys):
    """3.5 of 30 million steps are 175,000 of 1.5 million."""
    guided = [*LEARN, "--json", "--guide", "nd"]
    by_default, out = (
        run(capsys, *guided, *tau)[1] for tau in ([], ["--tau", "175000"])
    )

    assert json.loads(by_default)["per_window"] == json.loads(out)["per_window"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["learn", "--map", "nowhere"], "no map file 'nowhere'"),
        (["learn", "--source", "nowhere", "--guide", "nd"], "no map file 'nowhere'"),
        (["learn", "--tau", "5"], "--tau needs a --guide"),
        (
            ["learn", "--alpha", "2"],
            "alpha must be a number above 0 and at most 1, got 2.0",
        ),
        (
            ["learn", "--epsilon", "nan"],
            "epsilon must be a number from 0 to 1, got nan",
        ),
        (["learn", "--steps", "0"], "--steps must be a whole number from 1 to"),
        (["learn", "--window", "0"], "--window must be a whole number from 1 to"),
        (
            ["experiment", "--out", "x", "--runs", "0"],
            "n_runs must be a whole number",
        ),
        (
            ["experiment", "--out", "x", "--jobs", "0"],
            "n_workers must be a whole number",
        ),
        (
            ["experiment", "--out", "x", "--gamma", "1.1"],
            "gamma must be a number from 0 to 1",
        ),
        (
            ["experiment", "--out", "x", "--tuned", "nowhere"],
            "nowhere: no results here",
        ),
        (
            ["experiment", "--out", "x", "--everything", "--reward", "cost"],
            "--everything has its own",
        ),
        (
            ["experiment", "--out", "x", "--study", "blind", "--runs", "9"],
            "--study has its own --reward, --target and --runs",
        ),
        (["experiment", "--out", "x", "--buildings", "8"], "--buildings needs a"),
        (
            ["experiment", "--out", "x", "--study", "blind", "--buildings", "0"],
            "n_buildings must be a whole number",
        ),
        (["experiment", "--out", "map.txt/x"], "Not a directory"),
        (["experiment", "--out", "x", "--runs", "1e9"], "at most 10,000,000"),
        (["experiment", "--out", "x", "--jobs", "1e6"], "n_workers must be a whole"),
        (["learn", "--steps", "1e18", "--guide", "nd"], "--steps must be a whole"),
        (["learn", "--steps", "1e9", "--window", "1"], "windows must be a whole"),
        (["figures", "--out", "x", "--results", "y"], "y: no finished experiment here"),
    ],
)
def test_bad_input_ends_with_a_message_and_code_2(
    arguments, message, capsys, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "map.txt").write_text("no folder", encoding="utf-8")
    code, out, err = run(capsys, *arguments)

    assert (code, out) == (2, "")
    assert message in err
    assert os.listdir(tmp_path) == ["map.txt"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["learn", "--steps", "7.5"], "--steps: must be a whole number"),
        (["learn", "--seed", "-1"], "--seed: must be a whole number"),
        (["learn", "--seed", "1e99999"], "--seed: must be a whole number"),
        (["learn", "--steps", "many"], "--steps: must be a whole number"),
        (["learn", "--guide", "best"], "invalid choice: 'best'"),
        (["experiment"], "--out"),
        (["experiment", "--out", "x", "--scale", "huge"], "invalid choice: 'huge'"),
        (
            ["experiment", "--out", "x", "--tau-grid", "--everything"],
            "not allowed with",
        ),
        (["experiment", "--out", "x", "--study", "all"], "invalid choice: 'all'"),
    ],
)
def test_a_bad_command_line_ends_with_code_2(arguments, message, capsys):
    with pytest.raises(SystemExit) as ended:
        main(arguments)

    assert ended.value.code == 2
    assert message in capsys.readouterr().err


@contextmanager
def no_workers():
    """Jobs are done in this process, where nothing asks who does them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            pools, "ProcessPoolExecutor", lambda *_, **__: ThreadPoolExecutor(1)
        )
        yield


@pytest.fixture
def at_home():
    with no_workers():
        yield


def test_a_study_prints_its_verdicts_and_whether_they_were_predicted(
    capsys, tmp_path, monkeypatch, at_home
):
    few = tuple(
        one._replace(given=one.given[::5])
        for one in catalogue.TEACHER
        if isinstance(one, Survey) and "teacher-" in one.folder and len(one.seeds) == 8
    )
    monkeypatch.setitem(catalogue.STUDIES, "teacher", few)
    monkeypatch.setitem(blind_rules.OF_STUDY, "teacher", ("M5",))
    options = ["--study", "teacher", "--buildings", "2", "--scale", "page"]
    code, out, _ = run(
        capsys, "experiment", *options, "--jobs", "1", "--out", str(tmp_path)
    )

    assert code == 0
    assert "teacher-large: 2 arms x 6 runs, " in out
    assert out.splitlines()[-1] == "M5: undecided, not as predicted"  # of two buildings


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    """The experiment of the tests below, made in one go by one process: this one."""
    folder = tmp_path_factory.mktemp("experiment") / "whole"
    with no_workers():
        code = main([*PAGE, "--jobs", "1", "--runs", "18", "--out", str(folder)])
    assert code == 0
    return folder


def test_an_experiment_leaves_its_table_and_figures(uninterrupted, capsys, tmp_path):
    results = load_results(uninterrupted)
    code, out, _ = run(
        capsys, "figures", "--results", str(uninterrupted), "--out", str(tmp_path)
    )

    assert results.goals.shape == (9, 18, 50)
    assert code == 0
    assert out.splitlines() == [str(path) for path in sorted(tmp_path.iterdir())] or out
    assert (tmp_path / "ledger.md").is_file()


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as on Unix")
def test_killed_and_resumed_equals_uninterrupted_to_the_byte(
    uninterrupted, tmp_path, capsys
):
    command = [*PAGE, "--runs", "18", "--out", str(tmp_path)]
    process = start(*command)
    wait_for_parts(process, tmp_path)
    process.kill()  # SIGKILL: nothing can be tidied up
    process.wait()
    wait_for_the_end_of(process.pid)
    process.communicate()
    table = "goals.csv.gz"

    assert not (tmp_path / table).exists(), "it ended before it was killed"
    with no_workers():
        assert main([*command, "--jobs", "1"]) == 0
    assert (tmp_path / table).read_bytes() == (uninterrupted / table).read_bytes()
    assert sorted(os.listdir(tmp_path)) == ["experiment.json", table]
    assert load_results(tmp_path).record["seconds"]["wall"] is None, "nothing was kept"


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as on Unix")
def test_ctrl_c_ends_with_130_and_says_how_to_go_on(tmp_path):
    process = start(*PAGE, "--runs", "18", "--out", str(tmp_path))
    wait_for_parts(process, tmp_path, 1)
    os.killpg(process.pid, signal.SIGINT)  # a terminal sends it to the whole group
    _, err = process.communicate(timeout=PATIENCE)

    assert process.returncode == 130
    assert "the same command goes on from there" in err
    assert "Traceback" not in err
    wait_for_the_end_of(process.pid)


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="needs Linux's /proc")
def test_a_dead_worker_ends_with_a_message(tmp_path):
    process = start(*PAGE, "--runs", "18", "--out", str(tmp_path))
    wait_for_parts(process, tmp_path, 1)
    for worker in workers(process.pid):
        os.kill(worker, signal.SIGKILL)
    _, err = process.communicate(timeout=PATIENCE)

    assert process.returncode == 2
    assert "a worker process died" in err
    assert "Traceback" not in err


def workers(pid):
    """Return the worker processes that a process, or one of its threads, started."""
    listed = [
        Path(f"/proc/{pid}/task/{thread}/children").read_text(encoding="utf-8").split()
        for thread in os.listdir(f"/proc/{pid}/task")
    ]
    return [
        int(child)
        for some in listed
        for child in some
        if b"spawn_main" in Path(f"/proc/{child}/cmdline").read_bytes()
    ]


def test_another_experiment_is_not_mixed_in(uninterrupted, capsys):
    before = (uninterrupted / "goals.csv.gz").read_bytes()
    code, _, err = run(
        capsys, *PAGE, "--runs", "18", "--reward", "cost", "--out", str(uninterrupted)
    )

    assert code == 2
    assert "reading.reward is 'goal' there and 'cost' here" in err
    assert (uninterrupted / "goals.csv.gz").read_bytes() == before


def test_a_grid_tunes_the_arms_of_another_experiment(tmp_path, capsys, at_home):
    grid, tuned = tmp_path / "grid", tmp_path / "tuned"
    small = [*PAGE, "--jobs", "2", "--runs", "1"]
    assert main([*small, "--tau-grid", "--out", str(grid)]) == 0
    assert main([*small, "--tuned", str(grid), "--out", str(tuned)]) == 0
    cells, arms = load_results(grid), load_results(tuned).arms
    best = {arm.name: arm.tau for arm in arms}["nd-hard"]
    totals = {arm.tau: cells.totals("nd-hard", arm.tau)[0] for arm in cells.arms[20:30]}

    assert len(cells.arms) == 80
    assert best == max(totals, key=totals.get)
    assert cells.record["parameters"]["stream"] == "tune"


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="needs Linux's /proc")
def test_a_worker_needs_less_than_500_mb():
    """Six runs in the target building at once, learned as a worker does."""
    script = (
        "import numpy as np\n"
        "from abstransfer.experiments.arms import Scale\n"
        "from abstransfer.experiments.problem import Problem, build_guides\n"
        "from abstransfer.experiments.workers import Job, run_job\n"
        "problem = Problem()\n"
        "guide = build_guides(problem, ['nd'])['nd']\n"
        "seeds = tuple(np.random.SeedSequence(1).spawn(6))\n"
        "run_job(Job(problem, 'hard', 5000, guide, Scale(10_000, 1_000), seeds))\n"
        "print(open('/proc/self/status').read())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    peak = next(line for line in done.stdout.splitlines() if line.startswith("VmHWM"))

    assert peak.split()[2] == "kB"
    assert int(peak.split()[1]) < 500_000


def test_only_what_needs_them_imports_numba_and_matplotlib():
    script = (
        "import sys\n"
        "from abstransfer.cli import main\n"
        "import abstransfer.experiments.run\n"
        "import abstransfer.reproduction.claims, abstransfer.reproduction.figures\n"
        "try: main(['experiment', '--help'])\n"
        "except SystemExit: pass\n"
        "slow = {'numba', 'matplotlib', 'tqdm', 'distributed'} & set(sys.modules)\n"
        "assert not slow, slow\n"
    )
    subprocess.run([sys.executable, "-c", script], check=True, capture_output=True)


def test_goals_are_whole_numbers(uninterrupted):
    assert load_results(uninterrupted).goals.dtype == np.int64


def test_closed_streams_are_no_error_and_nothing_is_written_into_results(tmp_path):
    """With 1 and 2 closed, the next file that is opened would be number 1."""
    command = f"{sys.executable} -m abstransfer"
    small = "--scale page --target source --runs 1 --jobs 1 --out"
    for line in (
        f"{command} table1 --source-only >&-",
        f"{command} learn --map source --steps 1000 >&- 2>&-",
        f"{command} experiment {small} {tmp_path / 'out'} >&- 2>&-",
    ):
        done = subprocess.run(["sh", "-c", line], capture_output=True, encoding="utf-8")
        assert (done.returncode, done.stderr) == (0, ""), line
    assert load_results(tmp_path / "out").goals.shape == (9, 1, 50)


def test_workers_that_cannot_start_are_told(tmp_path, capsys):
    resource_tracker.ensure_running()  # it is a process of Python's own
    before = multiprocessing.spawn.get_executable()
    multiprocessing.set_executable("/bin/false")
    try:
        code, _, err = run(capsys, *PAGE, "--runs", "18", "--out", str(tmp_path))
    finally:
        multiprocessing.set_executable(before)

    assert code == 2
    assert "worker process" in err
    assert "the same command goes on from there" in err


def test_what_takes_long_is_said_before(capsys, monkeypatch):
    """The day before it is over, a user can ask for less."""
    monkeypatch.setattr("abstransfer.cli.learn.run_job", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main(["learn", "--map", "source", "--steps", "6e10"])

    assert "this may take about 11 min" in capsys.readouterr().err
