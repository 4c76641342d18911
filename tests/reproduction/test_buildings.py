"""Drawn buildings: of any size they are legal, connected and made of the same parts."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse.csgraph import connected_components

from abstransfer.maps import CORRIDOR, GOAL, parse_map
from abstransfer.reproduction.buildings import draw_building

SEEDS = st.integers(0, 2**32)
BLOCKS = st.tuples(st.integers(1, 3).map(lambda n: 3 * n), st.integers(3, 8))


def joined(map_):
    """Return in how many parts a building falls, by its neighbours."""
    near = np.zeros((map_.n_cells, map_.n_cells), dtype=bool)
    cell, way = np.nonzero(map_.neighbors >= 0)
    near[cell, map_.neighbors[cell, way]] = True
    return connected_components(near, directed=False)[0]


@settings(max_examples=15, deadline=None)
@given(SEEDS, BLOCKS)
def test_a_building_of_any_size_is_one_piece_and_its_text_is_legal(seed, blocks):
    drawn = draw_building(seed, blocks)

    assert drawn.shape == (3 * blocks[0], 3 * blocks[1])
    assert joined(drawn) == 1
    assert parse_map(str(drawn)) == drawn


@settings(max_examples=15, deadline=None)
@given(SEEDS, BLOCKS)
def test_each_room_has_its_goal_and_the_doors_make_a_tree(seed, blocks):
    """A middle row of three is corridor; two blocks link two of them, one is a stub."""
    rows, columns = blocks
    corridors = rows // 3
    rooms = rows * columns - corridors * columns - 2 * 2 * (corridors - 1) - 1
    drawn = draw_building(seed, blocks)

    assert drawn.n_rooms == drawn.n_doors == len(drawn.goals) == rooms
    assert (drawn.cells == CORRIDOR).sum() == 9 * (rows * columns - rooms)
    row, column = np.divmod(np.flatnonzero(drawn.cells == GOAL), drawn.shape[1])
    assert set(row % 3) == set(column % 3) == {1}, "in the centre of its room"


@settings(max_examples=15, deadline=None)
@given(SEEDS, BLOCKS)
def test_a_seed_draws_one_building(seed, blocks):
    assert draw_building(seed, blocks) == draw_building(seed, blocks)


def test_other_seeds_draw_other_buildings():
    assert len({str(draw_building(seed)) for seed in range(124)}) == 124


@pytest.mark.parametrize("blocks", [(0, 6), (4, 6), (3, 2), (-3, 6)])
def test_a_size_without_such_a_building_is_refused(blocks):
    with pytest.raises(ValueError, match=r"blocks must have 3, 6, 9, .* got -?\d x \d"):
        draw_building(0, blocks)
