"""The operations of page 10 do to notes what their names say."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from abstransfer import read_map
from abstransfer.experiments.problem import Problem
from abstransfer.experiments.results import load_results
from abstransfer.experiments.surgery import Left, noted
from abstransfer.reproduction.interventions import MAIN, OPERATIONS, run_operations

PROBLEM = Problem(target=read_map("source"))
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


def test_operations_are_stored_and_read_again_and_do_not_depend_on_workers(tmp_path):
    options = {"operations": FEW, "n_runs": 2, "tau": 4_000, "n_steps": 20_000}
    with ThreadPoolExecutor(2) as pool:
        first = run_operations(PROBLEM, executor=pool, out=tmp_path, **options)
    with ThreadPoolExecutor(1) as pool:
        again = run_operations(PROBLEM, executor=pool, **options)

    assert first.goals.any()
    np.testing.assert_array_equal(first.goals, again.goals)
    np.testing.assert_array_equal(load_results(tmp_path).goals, first.goals)
    assert run_operations(PROBLEM, out=tmp_path, **options).record == first.record
    assert first.record["noted"]["blank"] == [0, 0]
    assert list(first.record["ready"]) == ["nd"]
    with pytest.raises(ValueError, match="holds another experiment"):
        run_operations(PROBLEM, out=tmp_path, **options | {"tau": 5_000})


def test_an_operation_does_not_depend_on_which_others_there_are():
    options = {"n_runs": 1, "tau": 4_000, "n_steps": 20_000}
    with ThreadPoolExecutor(1) as pool:
        alone, both = (
            run_operations(PROBLEM, operations=names, executor=pool, **options)
            for names in (["nd-wrong-way"], ["nd-thinned", "nd-wrong-way"])
        )

    np.testing.assert_array_equal(alone.goals[0], both.goals[1])


def test_in_drawn_buildings_every_run_has_its_own(tmp_path):
    with ThreadPoolExecutor(1) as pool:
        results = run_operations(
            operations=MAIN[:2],
            n_runs=2,
            drawn=True,
            tau=2_000,
            n_steps=6_000,
            executor=pool,
            out=tmp_path,
        )

    assert results.goals.shape == (2, 2, 1)
    assert "drawn" in load_results(tmp_path).record["parameters"]["reading"]["target"]


def test_what_cannot_be_operated_on_is_refused():
    with pytest.raises(ValueError, match="operations must be among"):
        run_operations(PROBLEM, operations=["nd", "appendix"])
    with pytest.raises(ValueError, match="problem must pay at the goal"):
        run_operations(Problem(reward="cost"))
