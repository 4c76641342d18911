"""Whispers: tables say what their names say; they fade, or cannot; in any reading."""

import numpy as np
import pytest

from abstransfer import LABELS, navigation_tasks, q_learning, read_map
from abstransfer.experiments.problem import Problem, target_tasks
from abstransfer.mdp import MDP
from abstransfer.reproduction.guides import make_guides
from abstransfer.reproduction.whispers import (
    POLICIES,
    SIZES,
    STEADY,
    first_notes,
    taught,
)

CHANGED = ("elsewhere", "wrong", "dealt", "other")


@pytest.fixture(scope="module")
def tables():
    return taught()


@pytest.fixture(scope="module")
def source():
    return navigation_tasks(read_map("source"), reward="goal")


def test_chances_are_those_of_the_advice(tables):
    advice = make_guides(POLICIES.values())

    for name, guide in POLICIES.items():
        np.testing.assert_allclose(tables[name], advice[guide], atol=1e-6)


def test_values_are_means_over_the_states_of_a_view(tables, source):
    """Of one view by hand: its states' best values, one after the other."""
    from abstransfer.experiments.surgery import best_notes

    best, way = best_notes(source.mdp), ~source.mdp.terminal
    view = np.bincount(source.rho[way]).argmax()
    states = np.flatnonzero((source.rho == view) & way)
    there = source.available[states[0]]

    by_hand = np.mean([best[s] for s in states], axis=0)
    np.testing.assert_allclose(tables["values"][view, there], by_hand[there], atol=1e-6)
    assert not tables["values"][view, ~there].any()


def test_what_cannot_be_done_is_never_better_than_what_can(tables, source):
    can = source.possible
    for table in (*tables.values(), *taught(Problem(reward="cost")).values()):
        worst = np.where(can, table, np.inf).min(axis=1)
        assert (np.where(can, -np.inf, table).max(axis=1) <= worst).all()


def test_changed_values_are_dealt_from_where_their_names_say(tables, source):
    values, seen = tables["values"], np.unique(source.rho[~source.mdp.terminal])
    can = source.possible

    for view in seen:
        dealt, row = tables["values-dealt"][view, can[view]], values[view, can[view]]
        np.testing.assert_array_equal(np.sort(dealt), np.sort(row))
    mirrored = [LABELS.index(name) for name in LABELS[4:] + LABELS[:4]]
    both = can & can[:, mirrored]
    both[np.setdiff1d(np.arange(len(can)), seen)] = False
    np.testing.assert_array_equal(
        tables["values-wrong"][both], values[:, mirrored][both]
    )
    for name in CHANGED:
        assert (tables[f"values-{name}"] != values)[seen].any(), name


def test_the_best_is_told_from_what_can_be_done_and_nothing_else(tables, source):
    best, values = tables["values-best"], tables["values"]
    top = np.where(source.possible, values, -np.inf).max(axis=1, keepdims=True)

    assert set(np.unique(best)) == {0, 0.5, 1}
    np.testing.assert_array_equal(best == 1, source.possible & (values == top))
    np.testing.assert_array_equal(best > 0, source.possible)


def test_a_robot_with_a_compass_is_told_of_a_move_what_its_label_is_worth(tables):
    tasks = target_tasks(Problem(actions="compass"))
    notes = first_notes(tasks, tables["values"], 0.5)

    for state, move in ((0, 0), (100, 1), (5000, 2), (9999, 3)):
        label = tasks.labels[state, move]
        row = tables["values"][tasks.rho[state]]
        assert notes[state, move] == (0 if label < 0 else row[label] / 2)


def corridor(n):
    """A ring of n cells and no way to the goal: what is obeyed there is in vain."""
    after = np.roll(np.arange(n), -1)[:, None, None]
    moves = np.concatenate([after, np.arange(n)[:, None, None]], axis=1)
    moves = np.vstack([moves, [[[n], [n]]][:1]])
    ends = np.arange(n + 1) == n
    return MDP(moves, np.ones(moves.shape), ends.astype(float), ends, 0.9)


@pytest.mark.parametrize("size", [size for size in SIZES if size < 1])
def test_a_whisper_fades_alike_at_any_size(size):
    """One step takes 1 - gamma of a tenth where all notes are alike: 1 in 100."""
    ring, notes = corridor(3), np.full((4, 2), size)
    once = q_learning(ring, 1, rng=0, q0=notes, start=[0])
    often = q_learning(ring, 5000, rng=0, q0=notes, start=[0])

    assert once.q[0].min() == pytest.approx(0.99 * size)
    assert often.q[:3].max() < 0.5 * size


def test_a_steady_whisper_neither_fades_nor_spreads():
    """Learning would take less than half of the smallest number: it rounds to none."""
    ring = corridor(3)
    notes = STEADY * np.array([[1, 0.5], [0.5, 0], [0, 0], [0, 0]])
    after = q_learning(ring, 5000, rng=0, q0=notes, start=[0, 1, 2])

    assert notes[0].tolist() == [1e-323, 5e-324]
    np.testing.assert_array_equal(after.q, notes)
