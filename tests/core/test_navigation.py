"""
What a robot can do and what it sees, entry by entry.

The expected transitions and labels are worked out here anew, slowly, from the
text of a map and the words of the definition; nothing of Map is used.
"""

from collections import defaultdict
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.sparse import coo_array
from strategies import map_texts

from abstransfer import (
    FEATURES,
    LABELS,
    action_values,
    describe,
    navigation,
    navigation_tasks,
    optimal_values,
    parse_map,
    read_map,
)
from abstransfer.navigation import tasks_in_parts

STEPS = {"N": (-1, 0), "E": (0, 1), "S": (1, 0), "W": (0, -1)}
EXAMPLE = (
    "see_door_far_head_to_goal ^ see_empty_space_opposite_to_goal ^ almost_near_goal"
)

# The corridor's two cells, a room of one cell, and the room of the goal.
BUILDING = """\
+---+-+
|. .d |
+d--+-+
|  *| |
|   +d+
|     |
+-----+"""


@cache
def shipped_tasks(name, **options):
    return navigation_tasks(read_map(name), **options)


# The definition, read off the text


def cells_of(text):
    """Return the cells of a text, (row, column), row by row."""
    lines = text.split("\n")
    height, width = len(lines) // 2, len(lines[0]) // 2
    return [(i, j) for i in range(height) for j in range(width)]


def goals_of(text):
    lines = text.split("\n")
    return [(i, j) for i, j in cells_of(text) if lines[2 * i + 1][2 * j + 1] == "*"]


def edge_of(text, cell, direction):
    (i, j), (di, dj) = cell, STEPS[direction]
    return text.split("\n")[2 * i + 1 + di][2 * j + 1 + dj]


def distance(a, b):
    return abs(a[0] - b[0]) + abs(a[1] - b[1])


def look(text, goal, cell):
    """Return label and next cell by open direction, as design 1.3 has it in words."""
    lines, seen = text.split("\n"), {}
    for direction, (di, dj) in STEPS.items():
        edge = lines[2 * cell[0] + 1 + di][2 * cell[1] + 1 + dj]
        if edge in "-|":
            continue
        there = cell[0] + di, cell[1] + dj
        if edge == "d":
            is_corridor = lines[2 * there[0] + 1][2 * there[1] + 1] == "."
            kind = "see_corridor" if is_corridor else "see_room"
        elif any(
            lines[2 * there[0] + 1 + ei][2 * there[1] + 1 + ej] == "d"
            for ei, ej in STEPS.values()
        ):
            kind = "see_door_far"
        else:
            kind = "see_empty_space"
        heads = distance(there, goal) < distance(cell, goal)
        side = "head_to_goal" if heads else "opposite_to_goal"
        seen[direction] = (f"{kind}_{side}", there)
    return seen


def features_of(text, goal, cell):
    """Return the names of the features that hold."""
    names = {label for label, _ in look(text, goal, cell).values()}
    far = distance(cell, goal)
    names |= {"near_goal"} if far <= 5 else set()
    names |= {"almost_near_goal"} if 5 < far <= 8 else set()
    in_corridor = text.split("\n")[2 * cell[0] + 1][2 * cell[1] + 1] == "."
    return names if in_corridor else names | {"in_room"}


def expected_transitions(text, success=0.9):
    """Return probabilities by (state, action, next state), for relational actions."""
    cells = cells_of(text)
    number = {cell: i for i, cell in enumerate(cells)}
    probability = defaultdict(float)
    for k, goal in enumerate(goals_of(text)):
        for cell in cells:
            s = k * len(cells) + number[cell]
            ways = defaultdict(list)
            for label, there in look(text, goal, cell).values():
                ways[label].append(k * len(cells) + number[there])
            for a, label in enumerate(LABELS):
                for s_next in ways[label]:
                    probability[s, a, s_next] += success / len(ways[label])
                stays = 1 - success if ways[label] else 1.0
                probability[s, a, s] += stays
    return probability


def as_matrix(keys, values, tasks):
    """Return (S * A, S) sparse; entries of one place are summed."""
    s, a, s_next = np.transpose(list(keys))
    n_states, n_actions = tasks.mdp.n_states, tasks.mdp.n_actions
    place = (s * n_actions + a, s_next)
    return coo_array((values, place), shape=(n_states * n_actions, n_states)).tocsr()


def check_transitions(text, tasks, success=0.9):
    expected = expected_transitions(text, success)
    expected = as_matrix(expected, list(expected.values()), tasks)
    mdp = tasks.mdp
    keys = [
        (s, a, s_next)
        for s, rows in enumerate(mdp.next_state.tolist())
        for a, row in enumerate(rows)
        for s_next in row
    ]
    actual = as_matrix(keys, mdp.prob.ravel(), tasks)

    assert expected.nnz > mdp.n_states
    assert abs(actual - expected).max() < 1e-12
    np.testing.assert_allclose(mdp.prob.sum(axis=2), 1, atol=1e-12)


def check_labels(text, tasks):
    cells, goals = cells_of(text), goals_of(text)
    labels = tasks.labels.reshape(len(goals), len(cells), 4)
    for k, goal in enumerate(goals):
        for i, cell in enumerate(cells):
            seen = look(text, goal, cell)
            expected = [LABELS.index(seen[d][0]) if d in seen else -1 for d in STEPS]
            assert labels[k, i].tolist() == expected, (goal, cell)


def check_rho(text, tasks):
    states = [(goal, cell) for goal in goals_of(text) for cell in cells_of(text)]
    assert len(states) == len(tasks.rho)
    for (goal, cell), z in zip(states, tasks.rho, strict=True):
        holds = {f for bit, f in enumerate(FEATURES) if z >> bit & 1}
        assert holds == features_of(text, goal, cell), (goal, cell)


CHECKS = pytest.mark.parametrize(
    "check",
    [check_transitions, check_labels, check_rho],
    ids=["transitions", "labels", "features"],
)


@CHECKS
@pytest.mark.parametrize("name", ["source", "target"])
def test_every_entry_of_a_shipped_map_is_as_the_definition_says(name, check):
    check(str(read_map(name)), shipped_tasks(name))


@CHECKS
@given(text=map_texts())
@settings(deadline=None, max_examples=25)
def test_every_entry_of_a_random_map_is_as_the_definition_says(check, text):
    check(text, navigation_tasks(parse_map(text)))


@pytest.mark.parametrize("success", [0.25, 1.0])
def test_every_entry_follows_the_probability_of_success(success):
    text = str(read_map("source"))

    check_transitions(text, shipped_tasks("source", success=success), success)


@pytest.mark.parametrize("name", ["source", "target"])
def test_no_move_crosses_a_wall(name):
    """Where a robot may come is next to where it was, behind an edge without wall."""
    tasks, text = shipped_tasks(name), str(read_map(name))
    cells = cells_of(text)
    open_pairs = {
        (i, cells.index((cell[0] + STEPS[d][0], cell[1] + STEPS[d][1])))
        for i, cell in enumerate(cells)
        for d in STEPS
        if edge_of(text, cell, d) not in "-|"
    }
    s, a, k = np.nonzero(tasks.mdp.prob)
    s_next = tasks.mdp.next_state[s, a, k]
    moved = s != s_next
    pairs = zip(tasks.cell[s[moved]], tasks.cell[s_next[moved]], strict=True)

    assert set(pairs) == open_pairs
    assert (tasks.task[s] == tasks.task[s_next]).all()


# By hand


@pytest.fixture
def small():
    return navigation_tasks(parse_map(BUILDING))


@pytest.mark.parametrize(
    ("cell", "abstract_state"),
    [
        # The door below leads to the room; on the right, a cell with a door.
        (0, "see_room_head_to_goal ^ see_door_far_head_to_goal ^ near_goal"),
        # The door on the right, away from the goal; on the left, a cell with one.
        (1, "see_door_far_opposite_to_goal ^ see_room_opposite_to_goal ^ near_goal"),
        (2, "see_corridor_head_to_goal ^ near_goal ^ in_room"),
    ],
)
def test_what_is_seen_in_a_small_building_is_as_worked_out_on_paper(
    small, cell, abstract_state
):
    holds = set(describe(small.rho[cell]).split(" ^ "))

    assert holds == set(abstract_state.split(" ^ "))


def test_the_label_of_an_action_picks_its_directions_uniformly():
    """In an empty room a side has one, two or three ways."""
    blank = "|       |"
    lines = ["+-------+", *[blank] * 4, "|    *  |", "+-------+"]
    tasks = navigation_tasks(parse_map("\n".join(lines)))
    away = LABELS.index("see_empty_space_opposite_to_goal")
    to = LABELS.index("see_empty_space_head_to_goal")

    # Cell (0, 0) is 0: E and S head to the goal at (2, 2), cell 10.
    assert outcomes(tasks, 0, to) == {1: 0.45, 4: 0.45, 0: pytest.approx(0.1)}
    assert outcomes(tasks, 0, away) == {0: 1.0}
    # Cell (1, 2) is 6: three ways lead away, one leads to the goal.
    assert outcomes(tasks, 6, to) == {10: 0.9, 6: pytest.approx(0.1)}
    assert outcomes(tasks, 6, away) == {
        2: pytest.approx(0.3),
        5: pytest.approx(0.3),
        7: pytest.approx(0.3),
        6: pytest.approx(0.1),
    }


def outcomes(tasks, s, a):
    """Return the probability of each next state that is not impossible."""
    probability = defaultdict(float)
    for s_next, share in zip(
        tasks.mdp.next_state[s, a], tasks.mdp.prob[s, a], strict=True
    ):
        probability[int(s_next)] += float(share)
    return {s_next: share for s_next, share in probability.items() if share}


# The paper's facts


@pytest.mark.parametrize(
    ("name", "sizes"), [("source", (11, 135, 88)), ("target", (35, 540, 96))]
)
def test_tasks_states_and_abstract_states_are_as_many_as_stated(name, sizes):
    tasks = shipped_tasks(name)
    n_tasks, n_cells, n_abstract = sizes

    assert len(tasks.goal) == n_tasks
    assert tasks.mdp.n_states == len(tasks.rho) == n_tasks * n_cells
    assert len(np.unique(tasks.rho[~tasks.mdp.terminal])) == n_abstract


def test_the_example_state_of_the_paper_occurs_in_the_source_map():
    tasks = shipped_tasks("source")

    assert EXAMPLE in {describe(z) for z in tasks.rho}


# Invariants


@pytest.mark.parametrize("name", ["source", "target"])
def test_available_actions_are_exactly_the_labels_that_are_seen(name):
    tasks = shipped_tasks(name)
    seen = tasks.rho[:, None] >> np.arange(len(LABELS)) & 1

    assert 0 < seen.mean() < 1
    np.testing.assert_array_equal(tasks.available, seen)
    np.testing.assert_array_equal(tasks.available, tasks.possible[tasks.rho])


def test_each_open_direction_carries_one_label_and_each_wall_none():
    tasks = shipped_tasks("source")
    building = tasks.maps[0]

    behind_wall = building.neighbors[tasks.cell] < 0
    assert behind_wall.any()
    np.testing.assert_array_equal(tasks.labels == -1, behind_wall)
    assert set(tasks.labels[~behind_wall]) == set(range(8))


def test_states_are_task_and_cell_in_order():
    tasks = shipped_tasks("source")
    state = np.arange(11 * 135)

    np.testing.assert_array_equal(tasks.task, state // 135)
    np.testing.assert_array_equal(tasks.cell, state % 135)
    np.testing.assert_array_equal(tasks.goal, read_map("source").goals)
    np.testing.assert_array_equal(
        np.flatnonzero(tasks.mdp.terminal), np.arange(11) * 135 + tasks.goal
    )


# Options


def test_cost_is_paid_for_every_cell_but_the_goal():
    mdp = shipped_tasks("source").mdp

    np.testing.assert_array_equal(mdp.reward, np.where(mdp.terminal, 0, -1))


def test_the_goal_pays_one_and_nothing_else_does():
    mdp = shipped_tasks("source", reward="goal").mdp

    np.testing.assert_array_equal(mdp.reward, np.where(mdp.terminal, 1, 0))


def test_gamma_is_the_one_given():
    assert shipped_tasks("source").mdp.gamma == 0.99
    assert shipped_tasks("source", gamma=0.9).mdp.gamma == 0.9


def test_an_unavailable_action_spends_a_step():
    tasks = shipped_tasks("source")
    s, a = np.nonzero(~tasks.available)
    stays = (tasks.mdp.next_state == np.arange(tasks.mdp.n_states)[:, None, None])[s, a]

    assert len(s) > 1000
    np.testing.assert_allclose((tasks.mdp.prob[s, a] * stays).sum(axis=1), 1)
    assert tasks.mdp.allowed.all()


def test_an_unavailable_action_may_not_be_chosen_when_masked():
    tasks = shipped_tasks("source", unavailable="masked")

    np.testing.assert_array_equal(tasks.mdp.allowed, tasks.available)
    np.testing.assert_array_equal(
        tasks.mdp.next_state, shipped_tasks("source").mdp.next_state
    )


def test_masking_does_not_change_what_is_optimal():
    """Waiting is never better than going."""
    masked = optimal_values(shipped_tasks("source", unavailable="masked").mdp)

    np.testing.assert_allclose(
        masked, optimal_values(shipped_tasks("source").mdp), atol=1e-9
    )


def test_compass_moves_go_where_they_say_or_stay():
    tasks = shipped_tasks("source", actions="compass")
    text = str(read_map("source"))
    cells = cells_of(text)
    assert tasks.actions == ("N", "E", "S", "W")

    for s, cell in enumerate(cells):
        for a, (direction, (di, dj)) in enumerate(STEPS.items()):
            expected = {s: 1.0}
            if edge_of(text, cell, direction) not in "-|":
                there = cells.index((cell[0] + di, cell[1] + dj))
                expected = {there: 0.9, s: pytest.approx(0.1)}
            assert outcomes(tasks, s, a) == expected
            assert tasks.available[s, a] == (len(expected) == 2)
    assert 0 < tasks.available.mean() < 1


def test_the_abstract_states_do_not_depend_on_the_actions():
    compass = shipped_tasks("source", actions="compass")

    np.testing.assert_array_equal(compass.rho, shipped_tasks("source").rho)
    assert compass.possible.all()
    assert compass.possible.shape == (2048, 4)


def test_compass_moves_reach_the_goal_sooner_than_relational_ones():
    """A robot that can name a direction need not draw it."""
    compass = optimal_values(shipped_tasks("source", actions="compass").mdp)
    relational = optimal_values(shipped_tasks("source").mdp)

    assert (compass >= relational - 1e-9).all()
    assert compass.mean() > relational.mean() + 1


@pytest.mark.parametrize(("near", "almost_near"), [(5, 8), (0, 0), (2, 2), (3, 30)])
def test_near_and_almost_near_are_distances_to_the_goal(near, almost_near):
    tasks = shipped_tasks("source", near=near, almost_near=almost_near)
    text = str(read_map("source"))
    states = [(goal, cell) for goal in goals_of(text) for cell in cells_of(text)]
    far = np.array([distance(goal, cell) for goal, cell in states])

    np.testing.assert_array_equal(tasks.rho >> 8 & 1, far <= near)
    between = (far > near) & (far <= almost_near)
    np.testing.assert_array_equal(tasks.rho >> 9 & 1, between)


# Features left out


def test_features_left_out_make_fewer_abstract_states():
    tasks = shipped_tasks("source", features=("near_goal", "in_room"))
    full = shipped_tasks("source").rho

    assert tasks.features == ("near_goal", "in_room")
    assert tasks.n_abstract == 4
    np.testing.assert_array_equal(tasks.rho, (full >> 8 & 1) | (full >> 10 & 1) << 1)
    assert describe(3, tasks.features) == "near_goal ^ in_room"


def test_features_are_kept_in_their_order_and_once():
    features = ("in_room", "near_goal", "in_room")
    tasks = shipped_tasks("source", features=features)

    assert tasks.features == ("near_goal", "in_room")


def test_without_features_all_states_look_alike():
    tasks = shipped_tasks("source", features=())

    assert tasks.n_abstract == 1
    assert not tasks.rho.any()
    assert tasks.possible.tolist() == [[True] * 8]


def test_an_action_whose_feature_is_left_out_counts_as_possible():
    features = ("see_room_head_to_goal", "in_room")
    tasks = shipped_tasks("source", features=features)
    seen = LABELS.index("see_room_head_to_goal")

    assert tasks.possible[:, seen].tolist() == [False, True, False, True]
    assert np.delete(tasks.possible, seen, axis=1).all()


def test_an_abstract_state_that_sees_nothing_counts_every_action_as_possible():
    possible = shipped_tasks("source").possible
    sees_nothing = np.arange(2048) % 256 == 0

    assert possible[sees_nothing].all()
    np.testing.assert_array_equal(
        possible[~sees_nothing],
        (np.arange(2048)[~sees_nothing, None] >> np.arange(8) & 1).astype(bool),
    )


# Several maps, some tasks


def test_tasks_of_several_maps_are_the_tasks_of_each_one_after_the_other():
    small, source = parse_map(BUILDING), read_map("source")
    both = navigation_tasks([source, small])
    parts = [navigation_tasks(source), navigation_tasks(small)]
    n = parts[0].mdp.n_states

    assert both.building.tolist() == [0] * 11 + [1]
    assert both.maps == (source, small)
    for name in ("rho", "available", "labels", "cell"):
        joined = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_array_equal(getattr(both, name), joined)
    for name in ("prob", "reward", "terminal"):
        joined = np.concatenate([getattr(part.mdp, name) for part in parts])
        np.testing.assert_array_equal(getattr(both.mdp, name), joined)
    np.testing.assert_array_equal(both.mdp.next_state[:n], parts[0].mdp.next_state)
    np.testing.assert_array_equal(both.mdp.next_state[n:], parts[1].mdp.next_state + n)


@pytest.mark.parametrize("keep", [[3], [0, 10], [7, 2], np.array([5], np.uint8)])
def test_kept_tasks_are_those_of_all(keep):
    full, kept = (
        shipped_tasks("source"),
        navigation_tasks(read_map("source"), keep=keep),
    )
    states = np.concatenate([np.flatnonzero(full.task == k) for k in keep])

    np.testing.assert_array_equal(kept.goal, full.goal[keep])
    np.testing.assert_array_equal(kept.rho, full.rho[states])
    np.testing.assert_allclose(
        optimal_values(kept.mdp), optimal_values(full.mdp)[states], atol=1e-9
    )
    v = np.random.default_rng(0).random(full.mdp.n_states)
    np.testing.assert_allclose(
        action_values(kept.mdp, v[states]), action_values(full.mdp, v)[states]
    )


def test_tasks_to_keep_are_numbered_over_all_maps():
    small = parse_map(BUILDING)
    kept = navigation_tasks([read_map("source"), small], keep=[11])

    assert kept.building.tolist() == [1]
    np.testing.assert_array_equal(kept.rho, navigation_tasks(small).rho)


# In parts


@pytest.mark.parametrize("states", [1, 500, 1485, 10_000])
def test_the_parts_one_after_the_other_are_the_union(states):
    maps = [read_map("source"), parse_map(BUILDING)]
    options = {"gamma": 0.9, "unavailable": "masked", "success": 0.8}
    union, parts = (
        navigation_tasks(maps, **options),
        list(tasks_in_parts(maps, states=states, **options)),
    )

    sizes = [part.mdp.n_states for part in parts]
    assert len(parts) == {1: 12, 500: 3, 1485: 2, 10_000: 1}[states]
    before = np.cumsum([0, *sizes[:-1]])
    shifted = [
        part.mdp.next_state + first for part, first in zip(parts, before, strict=True)
    ]
    np.testing.assert_array_equal(np.concatenate(shifted), union.mdp.next_state)
    for name in ("prob", "reward", "terminal", "allowed"):
        found = np.concatenate([getattr(part.mdp, name) for part in parts])
        np.testing.assert_array_equal(found, getattr(union.mdp, name))
    for name in ("rho", "available", "labels", "cell", "building", "goal"):
        found = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_array_equal(found, getattr(union, name))
    assert {part.mdp.gamma for part in parts} == {0.9}


def test_a_part_is_made_when_it_is_asked_for(monkeypatch):
    made = []

    def watched(*arguments, **options):
        made.append(options["keep"])
        return navigation_tasks(*arguments, **options)

    monkeypatch.setattr(navigation, "navigation_tasks", watched)
    parts = tasks_in_parts(read_map("target"), states=600)
    next(parts)

    assert [list(keep) for keep in made] == [[0, 1]]


@pytest.mark.parametrize(
    ("tasks", "got"),
    [
        (parse_map(BUILDING), "Map"),
        (shipped_tasks("source").mdp, "MDP"),
        (None, "NoneType"),
        ([parse_map(BUILDING)], "Map"),
        ([], "no part of any"),
    ],
    ids=["map", "mdp", "none", "maps", "empty"],
)
def test_what_is_no_tasks_is_refused(tasks, got):
    with pytest.raises(ValueError, match=f"^road must be NavigationTasks, got {got}$"):
        list(navigation.parts_of(tasks, "road"))


# Refusals


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"success": 0}, "success must satisfy 0 < success <= 1, got 0"),
        ({"success": 1.5}, "success must satisfy 0 < success <= 1, got 1.5"),
        ({"success": np.nan}, "success must satisfy 0 < success <= 1, got nan"),
        ({"gamma": 1}, "gamma must satisfy 0 <= gamma < 1, got 1"),
        ({"reward": "costs"}, "reward must be one of ('cost', 'goal'), got 'costs'"),
        (
            {"actions": "north"},
            "actions must be one of ('relational', 'compass'), got 'north'",
        ),
        (
            {"unavailable": "stay"},
            "unavailable must be one of ('wait', 'masked'), got 'stay'",
        ),
        ({"near": -1}, "0 <= near <= almost_near must hold, got -1, 8"),
        ({"near": 9}, "0 <= near <= almost_near must hold, got 9, 8"),
        ({"near": "5"}, "near must hold numbers, got <U1"),
        ({"near": 0.5}, "near must hold int64, got float64"),
        ({"almost_near": None}, "almost_near must hold numbers, got object"),
        ({"gamma": "0.9"}, "gamma must hold numbers, got <U3"),
        ({"success": None}, "success must satisfy 0 < success <= 1, got None"),
        ({"features": None}, f"features must be among {FEATURES}, got None"),
        (
            {"features": ["near_goal", "sees_gold"]},
            f"features must be among {FEATURES}, got 'sees_gold'",
        ),
        ({"keep": []}, "keep must name tasks among 0..10, got []"),
        ({"keep": [11]}, "keep must name tasks among 0..10, got [11]"),
        ({"keep": [-1]}, "keep must name tasks among 0..10, got [-1]"),
        ({"keep": [0.5]}, "keep must name tasks among 0..10, got [0.5]"),
        ({"keep": [True]}, "keep must name tasks among 0..10, got [ True]"),
        ({"keep": 3}, "keep must name tasks among 0..10, got 3"),
        ({"keep": [[3]]}, "keep must name tasks among 0..10, got [[3]]"),
    ],
)
def test_a_bad_option_is_refused_by_name(options, said):
    with pytest.raises(ValueError) as refusal:  # noqa: PT011 (compared below)
        navigation_tasks(read_map("source"), **options)

    assert str(refusal.value) == said


@pytest.mark.parametrize("maps", [[], "ab", [BUILDING], None, 5], ids=repr)
def test_what_is_no_map_is_refused(maps):
    with pytest.raises(ValueError, match="maps must be one Map or several, got"):
        navigation_tasks(maps)
