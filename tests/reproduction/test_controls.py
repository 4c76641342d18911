"""Controls, traps and drawn buildings: what their names say, and legal."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from abstransfer import navigation_tasks, read_map
from abstransfer.experiments.arms import ARMS, TAUS, Scale
from abstransfer.experiments.problem import Problem, target_tasks
from abstransfer.reproduction.buildings import draw_building
from abstransfer.reproduction.catalogue import (
    EXPERIMENTS,
    FINE,
    reproduce,
)
from abstransfer.reproduction.guides import make_guides
from abstransfer.reproduction.traps import trap_views

SMALL = Scale(30_000, 10_000)


@pytest.fixture(scope="module")
def prob():
    return make_guides(["beta-1"])["beta-1"]


def test_the_fine_grid_has_no_point_of_the_first():
    assert not set(FINE) & set(TAUS)


def test_traps_are_the_fewest_views_that_hold_nine_tenths_of_the_late():
    """22 of 96, as two people counted before; without the least of them, too few."""
    problem = Problem()
    prob = make_guides(["beta-1"])["beta-1"]

    assert trap_views(problem, prob).sum() == 22
    assert trap_views(problem, prob, 0.0).sum() == 1
    assert trap_views(problem, prob, 0.5).sum() < 22


def test_exchanged_rows_are_the_others_in_the_traps_and_its_own_elsewhere(prob):
    traps = trap_views(Problem(), prob)
    names = ("beta-0", "beta-1", "prob-nd-in-traps", "nd-prob-in-traps")
    nd, prob, mixed, other = make_guides(names).values()

    np.testing.assert_array_equal(mixed[traps], nd[traps])
    np.testing.assert_array_equal(mixed[~traps], prob[~traps])
    np.testing.assert_array_equal(mixed + other, nd + prob)


def test_controls_of_all_kinds_run_and_a_tuned_one_reads_its_grid(tmp_path):
    folders = ("controls-target", "compass-target-tau", "compass-target-tuned")
    chosen = [one for one in EXPERIMENTS if one.folder in folders]
    with ThreadPoolExecutor(2) as pool:
        found = reproduce(
            tmp_path, experiments=chosen, scale=SMALL, n_runs=1, executor=pool
        )

    hint = found["controls-target"].arms[0]
    assert hint.hint == 1e-12
    tuned = found["compass-target-tuned"].arms
    assert [arm.name for arm in tuned] == [arm.name for arm in ARMS]
    assert {arm.tau for arm in tuned[1:]} <= set(TAUS[:8])


@pytest.mark.parametrize("seed", range(3))
def test_a_drawn_building_has_the_counts_of_the_target(seed):
    drawn, target = draw_building(seed), read_map("target")

    assert drawn.shape == target.shape
    for count in ("n_rooms", "n_doors"):
        assert getattr(drawn, count) == getattr(target, count)
    assert len(drawn.goals) == len(target.goals)
    assert navigation_tasks(drawn).mdp.n_states == target_tasks(Problem()).mdp.n_states
    assert str(drawn) != str(draw_building(seed + 1))
    assert drawn == draw_building(seed)
