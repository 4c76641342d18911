"""The operations of page 10 do to notes what their names say."""

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from support import NoExecutor

from abstransfer import read_map
from abstransfer.driving import executed_values
from abstransfer.experiments import workers
from abstransfer.experiments.arms import ARMS, Scale
from abstransfer.experiments.problem import Problem, build_guides, driving_tasks
from abstransfer.experiments.results import UNFINISHED, load_results
from abstransfer.experiments.surgery import Left, noted
from abstransfer.reproduction.buildings import draw_building
from abstransfer.reproduction.interventions import run_operations
from abstransfer.reproduction.operations import OPERATIONS

PROBLEM = Problem(target=read_map("source"))
SCALE, TINY = Scale(30_000, 30_000), Scale(6_000, 6_000)
FEW = ("nd", "blank", "nd-erased", "wanderer-digested")


@pytest.fixture
def left():
    """Nine states, three actions; ND has notes in seven, Prob in the last two."""
    notes = {name: np.zeros((9, 3)) for name in ("nd", "prob", "half")}
    notes["nd"][:7, 0] = np.logspace(-1, -13, 7)
    notes["nd"][:7, 1] = notes["nd"][:7, 0] / 2
    notes["prob"][5:7, 0] = 0.5
    notes["half"][:, 2] = 0.25
    best = np.linspace(1, 0.2, 9)[:, None] * np.array([1, 0.9, 0.8])
    return Left(notes, {}, best, np.ones((9, 3), bool), np.random.default_rng(0))


def where(operation, left):
    return np.flatnonzero(noted(OPERATIONS[operation](left))).tolist()


@pytest.mark.parametrize(
    ("operation", "states"),
    [
        ("blank", []),
        ("perfect", list(range(9))),
        ("nd-erased", [5, 6]),
        ("prob-grafted", [0, 1, 2, 3, 4, 5, 6]),
        ("nd-nearest", [0, 1]),
        ("half-on-nd", [0, 1, 2, 3, 4, 5, 6]),
        ("nd-large", [0, 1, 2, 3, 4, 5]),  # 1e-13 is below 1e-12
        ("prob-near", [0, 1, 5, 6]),  # 0, 1 of 0 to 4
        ("prob-middle", [2, 3, 5, 6]),
        ("prob-far", [4, 5, 6]),
        ("perfect-on-prob", [5, 6]),
        ("perfect-on-nd", [0, 1, 2, 3, 4, 5, 6]),
        ("nd-elsewhere", [0, 1, 2, 3, 4, 5, 6]),
    ],
)
def test_an_operation_leaves_notes_where_its_name_says(operation, states, left):
    assert where(operation, left) == states


def test_thinning_leaves_as_many_states_as_the_other_robot_has(left):
    assert len(where("nd-thinned", left)) == 2
    assert len(where("half-thinned", left)) == 7


def test_grafting_keeps_what_prob_has_noted_itself(left):
    grafted = OPERATIONS["prob-grafted"](left)

    np.testing.assert_array_equal(grafted[5:7], left.notes["prob"][5:7])
    np.testing.assert_array_equal(grafted[:5], left.notes["nd"][:5])


def test_levelled_notes_are_as_large_as_the_largest_of_their_state(left):
    level, nd = OPERATIONS["nd-level"](left), left.notes["nd"]

    np.testing.assert_array_equal(level[:7, 1], nd[:7, 0])
    assert (level[:, 2] == 0).all()


class Until(ThreadPoolExecutor):
    """A pool that is interrupted when it is to do its n-th job."""

    def __init__(self, n):
        super().__init__(1)
        self.n = n

    def submit(self, do, job):
        self.n -= 1
        return super().submit(do if self.n > 0 else self.stop, job)

    def stop(self, job):
        raise KeyboardInterrupt


def test_operations_are_stored_and_read_again_and_do_not_depend_on_workers(tmp_path):
    options = {"operations": FEW, "n_runs": 2, "scale": SCALE}
    with ThreadPoolExecutor(2) as pool:
        first = run_operations(PROBLEM, executor=pool, out=tmp_path, **options)
    with ThreadPoolExecutor(1) as pool:
        again = run_operations(PROBLEM, executor=pool, **options)
    options |= {"out": tmp_path, "executor": NoExecutor()}

    assert first.goals.any()
    np.testing.assert_array_equal(first.goals, again.goals)
    np.testing.assert_array_equal(load_results(tmp_path).goals, first.goals)
    assert run_operations(PROBLEM, **options).record == first.record
    assert first.record["noted"]["blank"] == [0, 0]
    assert list(first.record["ready"]) == ["nd"]
    with pytest.raises(ValueError, match="seed is 2015 there and 3 here"):
        run_operations(PROBLEM, **options | {"seed": 3})


def test_interrupted_operations_go_on_with_what_remains(tmp_path):
    """Also where the kill came between two operations of a run."""
    options = {"operations": FEW, "n_runs": 2, "scale": SCALE}
    with ThreadPoolExecutor(1) as pool:
        whole = run_operations(PROBLEM, executor=pool, **options)
    with Until(2) as pool, pytest.raises(KeyboardInterrupt):
        run_operations(PROBLEM, executor=pool, out=tmp_path, **options)
    path = tmp_path / UNFINISHED
    lines = path.read_bytes().splitlines(keepends=True)
    assert len(lines) == 1 + len(FEW), "run 0 is done"
    path.write_bytes(b"".join(lines[:-1]))
    seen = []
    with ThreadPoolExecutor(1) as pool:
        resumed = run_operations(
            PROBLEM,
            executor=pool,
            out=tmp_path,
            on_progress=lambda *steps: seen.append(steps),
            **options,
        )

    np.testing.assert_array_equal(resumed.goals, whole.goals)
    for measure in ("noted", "ready"):
        assert resumed.record[measure] == whole.record[measure]
    alone = SCALE.steps - SCALE.tau(ARMS[3])
    assert seen == [(n * alone, 8 * alone) for n in (3, 4, 8)]


def test_a_job_whose_parent_wants_no_more_stops(monkeypatch):
    stop = threading.Event()
    monkeypatch.setattr(workers, "STOP", stop)
    stop.set()
    with (
        ThreadPoolExecutor(1) as pool,
        pytest.raises(InterruptedError, match="was interrupted"),
    ):
        run_operations(PROBLEM, operations=FEW, n_runs=1, scale=SCALE, executor=pool)


def test_an_operation_does_not_depend_on_which_others_there_are():
    options = {"n_runs": 1, "scale": SCALE}
    with ThreadPoolExecutor(1) as pool:
        alone, both = (
            run_operations(PROBLEM, operations=names, executor=pool, **options)
            for names in (["nd-wrong-way"], ["nd-thinned", "nd-wrong-way"])
        )

    np.testing.assert_array_equal(alone.goals[0], both.goals[1])


def test_in_drawn_buildings_every_run_has_its_own(tmp_path):
    """And what Grad, ND and Prob do there as drivers is measured, exactly."""
    options = {
        "operations": ("nd", "grad"),
        "drawn": True,
        "scale": Scale(6_000, 6_000),
    }
    with ThreadPoolExecutor(1) as pool:
        results = run_operations(n_runs=2, executor=pool, out=tmp_path, **options)

    assert results.goals.shape == (2, 2, 1)
    record = load_results(tmp_path).record
    assert record["parameters"]["reading"]["target"]["name"] == "drawn"
    problem = Problem(target=draw_building(1))
    advice = build_guides(problem, ["grad"])
    value = executed_values(driving_tasks(problem), advice)["grad"]
    assert record["value"]["grad"][1] == pytest.approx(value, abs=1e-4)
    assert record["letters"]["nd"][0] != record["letters"]["nd"][1]


def test_what_cannot_be_operated_on_is_refused():
    with pytest.raises(ValueError, match="operations must be among"):
        run_operations(PROBLEM, operations=["nd", "appendix"])
    with pytest.raises(ValueError, match="problem must pay at the goal"):
        run_operations(Problem(reward="cost"))
