"""Surveys: a run among many is the same run alone; searches keep their budget."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from support import NoExecutor

from abstransfer import read_map
from abstransfer.driving import executed_values
from abstransfer.experiments.arms import ARMS, Arm, Scale
from abstransfer.experiments.problem import (
    Problem,
    build_guides,
    driving_tasks,
    target_tasks,
)
from abstransfer.experiments.results import Results
from abstransfer.learning import q_learning
from abstransfer.reproduction.blind import BLOCKS, SEEDS, SIZED
from abstransfer.reproduction.buildings import draw_building
from abstransfer.reproduction.catalogue import STUDIES, reproduce, study
from abstransfer.reproduction.folders import Searched, Survey, per_state
from abstransfer.reproduction.guides import make_guides
from abstransfer.reproduction.surveys import Told, run_survey, settle, told
from abstransfer.reproduction.teachers import mixed
from abstransfer.reproduction.traps import exchange_rows
from abstransfer.reproduction.whispers import first_notes, taught

SCALE = Scale(30_000, 1)
BUILDINGS = [draw_building(seed, (3, 6)) for seed in (0, 1)]
ARMED = (
    *map(Told, ARMS[:4]),
    told("traps", "nd-prob-in-traps", 3_500_000),
    told("whispered", table="values", size=1e-9),
    Told(Arm("hint", None, "hard", 0, 1e-12)),
    told("ceiling", table="ceiling"),
)


@pytest.fixture(scope="module")
def survey():
    with ThreadPoolExecutor(2) as pool:
        return run_survey(
            ARMED, BUILDINGS, n_runs=2, scale=SCALE, drives=["nd-hard"], executor=pool
        )


def alone(building, run, guide=None, **options):
    """Goals of a run by itself."""
    tasks = target_tasks(Problem(target=building))
    luck = np.random.SeedSequence(2015, spawn_key=(0, run))
    guide = None if guide is None else guide[tasks.rho]
    found = q_learning(tasks.mdp, SCALE.steps, rng=luck, guide=guide, **options)
    return found.goals.sum()


def test_a_run_of_a_survey_is_the_same_run_alone(survey):
    """Run 3 is the second of the second building; all arms have its luck."""
    problem, tasks = Problem(), target_tasks(Problem(target=BUILDINGS[1]))
    nd = build_guides(problem, ["nd"])["nd"]
    ends = [make_guides([n])[n] for n in ("beta-0", "beta-1", "available")]
    rows = exchange_rows(replace(problem, target=BUILDINGS[1]), *ends)
    whisper = first_notes(tasks, taught()["values"], 1e-9)
    expected = {
        "none": alone(BUILDINGS[1], 3),
        "nd-hard": alone(BUILDINGS[1], 3, nd, tau=3500),
        "traps": alone(BUILDINGS[1], 3, rows["nd-prob-in-traps"], tau=3500),
        "whispered": alone(BUILDINGS[1], 3, q0=whisper),
        "hint": alone(BUILDINGS[1], 3, q0=1e-12 * tasks.available),
    }

    assert survey.goals.shape == (8, 4, 1)
    assert {name: survey.totals(name)[3] for name in expected} == expected
    assert survey.totals("ceiling").min() > survey.totals("none").max()


def test_advice_is_driven_once_in_each_building(survey):
    nd = build_guides(Problem(), ["nd"])
    values = [
        executed_values(driving_tasks(Problem(target=building)), nd)["nd"]
        for building in BUILDINGS
    ]

    assert survey.record["value"] == {"nd-hard": [round(v, 4) for v in values]}


def test_an_interrupted_survey_goes_on_and_comes_out_the_same(survey, tmp_path):
    def stop_early(done, _):
        if done:
            raise KeyboardInterrupt

    def run(**options):
        with ThreadPoolExecutor(1) as pool:
            return run_survey(
                ARMED,
                BUILDINGS,
                n_runs=2,
                scale=SCALE,
                drives=["nd-hard"],
                out=tmp_path,
                executor=pool,
                **options,
            )

    with pytest.raises(KeyboardInterrupt):
        run(on_progress=stop_early)
    assert (tmp_path / "unfinished.jsonl").read_text("utf-8").count("\n") > 1
    found = run()

    np.testing.assert_array_equal(found.goals, survey.goals)
    assert found.record["value"] == survey.record["value"]


def swept(arms, goals, **record):
    goals = np.array(goals)[:, None, None]
    return Results((), goals, {"parameters": {"arms": arms}} | record)


def test_an_arm_takes_the_best_of_its_kind():
    sweep = swept(
        [
            {"guide": None, "tau": 0, "table": "values", "size": 1},
            {"guide": None, "tau": 0, "table": "values", "size": 1e-9},
            {"guide": None, "tau": 0, "table": "prob", "size": 1e-3},
            {"guide": "beta-0", "tau": 1},
            {"guide": "beta-0", "tau": 2},
            {"guide": "mix-0.5", "tau": 3},
        ],
        [1, 5, 9, 3, 2, 7],
    )

    assert settle(told("a", table="values"), sweep).size == 1e-9
    assert settle(told("a", table="values-wrong"), sweep).size == 1e-9
    assert settle(told("a", "beta-0"), sweep).arm.tau == 1
    assert settle(told("a", "mix-"), sweep).arm[1::2] == ("mix-0.5", 3)
    tried = [{"guide": "mix-0-1-0", "tau": 4}, {"guide": "mix-1-1-0", "tau": 5}]
    assert settle(told("a", "mix-"), swept([], [1, 2], tried=tried)).arm.tau == 5


def test_a_mixture_by_distance_is_one_share_for_each():
    nd, eager = (make_guides([name])[name] for name in ("beta-0", "available"))
    tasks = target_tasks(Problem())
    parts = mixed("mix-0-0.25-1", nd, eager)
    near = np.flatnonzero(tasks.rho >> 8 & 1)[0]
    far = np.flatnonzero((tasks.rho >> 8 & 3) == 0)[0]
    almost = np.flatnonzero(tasks.rho >> 9 & 1)[0]

    for state, share in ((near, 0), (almost, 0.25), (far, 1)):
        view = tasks.rho[state]
        expected = (1 - share) * nd[view] + share * eager[view]
        np.testing.assert_allclose(parts[view], expected)
    half = make_guides(["nd-available-0.5"])["nd-available-0.5"]
    np.testing.assert_allclose(mixed("mix-0.5", nd, eager), half)


def test_a_search_is_stored_with_what_it_tried(tmp_path):
    search = Searched("search", 2, "source")
    with ThreadPoolExecutor(1) as pool:
        found = search.run(tmp_path, scale=SCALE, budget=3, executor=pool)
    again = search.run(tmp_path, scale=SCALE, budget=3, executor=NoExecutor())

    assert found.goals.shape == (3, 2, 1)
    assert found.record["tried"][0] == {"guide": "mix-0.5-0.5-0.5", "tau": 2_000_000}
    assert again.record["tried"] == found.record["tried"]


def test_a_state_has_as_many_steps_in_any_building():
    drawn = {name: draw_building(200, blocks) for name, blocks in BLOCKS.items()}
    steps = {name: per_state("paper", drawn[name]).steps for name in drawn}

    assert steps["middle"] == 30_000_000
    for name, map_ in drawn.items():
        each = steps[name] / (map_.n_cells * len(map_.goals))
        assert each == pytest.approx(30_000_000 / 18_900, rel=1e-4)


def test_no_building_of_a_study_was_looked_at_before():
    looked_at = {str(draw_building(seed)) for seed in range(20)}
    blind = {str(draw_building(seed)) for seed in SEEDS}

    assert len(blind) == 24
    assert not blind & looked_at
    assert not set(SIZED) & set(SEEDS)


def test_a_study_with_fewer_buildings_has_the_first_of_them():
    for name in STUDIES:
        for whole, part in zip(study(name), study(name, 8), strict=True):
            if isinstance(whole, Survey):
                assert part.seeds == whole.seeds[:8]
    assert study("blind", 8)[2].n_runs == 8
    with pytest.raises(ValueError, match="study must be one of blind, .* got 'all'"):
        study("all")


def test_a_survey_of_one_map_stands_in_the_targets_place(tmp_path):
    one = Survey("one", 1, (told("none"),), target="source", stream="tune")
    with ThreadPoolExecutor(1) as pool:
        found = reproduce(tmp_path, experiments=[one], scale=SCALE, executor=pool)

    reading = found["one"].record["parameters"]["reading"]
    assert reading["target"]["name"] == "source"
    assert read_map("source").n_cells == 135
