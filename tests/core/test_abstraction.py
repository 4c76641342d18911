"""What a robot sees, and what its abstract states say."""

import numpy as np
import pytest

from abstransfer import FEATURES, LABELS, describe, parse_map, unseen_share
from abstransfer.abstraction import NO_LABEL, abstract_states, look

EXAMPLE = (
    "see_door_far_head_to_goal ^ see_empty_space_opposite_to_goal ^ almost_near_goal"
)
ROOM = parse_map("+-----+-+\n|.   .d*|\n+-----+-+".replace(".   .", ". . ."))


def test_there_are_eleven_features_and_eight_labels():
    assert len(FEATURES) == 11
    assert FEATURES[:8] == LABELS
    assert set(FEATURES[8:]) == {"near_goal", "almost_near_goal", "in_room"}


# Seeing


def test_each_kind_is_seen_on_the_side_where_it_stands():
    """Three corridor cells, a door, and the room of the goal, in a row."""
    sight = look(ROOM, goal=3)
    names = [
        [LABELS[label] if label != NO_LABEL else None for label in row[[1, 3]]]
        for row in sight.labels  # E, W
    ]

    assert names == [
        ["see_empty_space_head_to_goal", None],
        ["see_door_far_head_to_goal", "see_empty_space_opposite_to_goal"],
        ["see_room_head_to_goal", "see_empty_space_opposite_to_goal"],
        [None, "see_corridor_opposite_to_goal"],
    ]
    assert sight.distance.tolist() == [3, 2, 1, 0]
    assert sight.in_room.tolist() == [False, False, False, True]


def test_abstract_states_are_the_bits_of_what_is_seen():
    sight = look(ROOM, goal=3)
    rho = abstract_states(*sight[1:], near=1, almost_near=2)

    assert [describe(z) for z in rho] == [
        "see_empty_space_head_to_goal",
        "see_door_far_head_to_goal ^ see_empty_space_opposite_to_goal"
        " ^ almost_near_goal",
        "see_room_head_to_goal ^ see_empty_space_opposite_to_goal ^ near_goal",
        "see_corridor_opposite_to_goal ^ near_goal ^ in_room",
    ]


@pytest.mark.parametrize("goal", [-1, 4, "a", None, 0.5])
def test_a_goal_outside_the_map_is_refused(goal):
    with pytest.raises(ValueError, match=rf"^goal must lie in 0\.\.3, got {goal!r}$"):
        look(ROOM, goal)


# Describing


def test_a_description_names_the_true_features():
    assert describe(0) == "(no feature holds)"
    assert describe(1 << 10) == "in_room"
    assert describe(np.int64(2047)) == " ^ ".join(FEATURES)


def test_the_paper_s_example_is_the_conjunction_of_three_features():
    bits = [FEATURES.index(name) for name in EXAMPLE.split(" ^ ")]

    assert describe(sum(1 << bit for bit in bits)) == EXAMPLE


@pytest.mark.parametrize(
    ("z", "said"),
    [
        ("3", "must hold numbers, got <U1"),
        (0.5, "must hold int64, got float64"),
        (None, "must hold numbers, got object"),
        ([1], "must have shape 0 axes"),
    ],
)
def test_what_is_no_number_is_refused(z, said):
    with pytest.raises(ValueError, match=f"^z {said}"):
        describe(z)


@pytest.mark.parametrize(("z", "features"), [(-1, FEATURES), (2048, FEATURES), (1, ())])
def test_a_number_that_is_no_abstract_state_is_refused(z, features):
    said = rf"z must lie in 0\.\.{2 ** len(features) - 1}, got {z}"

    with pytest.raises(ValueError, match=said):
        describe(z, features)


# Unseen


@pytest.mark.parametrize(
    ("rho", "voted", "share"),
    [([0, 1, 1, 2], [0, 1], 1 / 4), ([3, 3], [3], 0), ([3, 3, 4], [], 1)],
)
def test_the_unseen_share_counts_states(rho, voted, share):
    assert unseen_share(np.array(rho), np.array(voted, int)) == share


@pytest.mark.parametrize(
    ("rho", "voted", "said"),
    [
        (None, None, "rho must hold numbers, got object"),
        ([0, 1], None, "voted must hold numbers, got object"),
        ([], [0], "rho must have shape 1 axes, none of length 0"),
        ([0.5], [0], "rho must hold int64, got float64"),
        (3, [0], "rho must have shape 1 axes"),
    ],
)
def test_what_is_no_abstract_states_is_refused(rho, voted, said):
    with pytest.raises(ValueError, match=f"^{said}"):
        unseen_share(rho, voted)
