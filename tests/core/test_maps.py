"""Buildings as text: exact inverses, refusals, edits, counts."""

import pickle
from contextlib import suppress
from dataclasses import FrozenInstanceError
from itertools import pairwise

import numpy as np
import pytest
from buildings import tile_map
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import map_texts

from abstransfer import navigation_tasks, parse_map, read_map
from abstransfer._paths import DATA
from abstransfer.driving import table1

SHIPPED = ("source", "target", "target_b", "target_c", "target_d")
COUNTS = {"source": (135, 11, 11, 11), "target": (540, 35, 35, 35)}

SMALLEST = """\
+-+-+
|.d*|
+-+-+"""

# A room of 2 x 2 cells, a room of one cell, and a corridor around them.
BUILDING = """\
+---+-+
|  *d |
|   +d+
|   |.|
+d--+ |
|. . .|
+-----+"""


@pytest.fixture
def source():
    return read_map("source")


def edited(row, column, char, text=BUILDING):
    """Return the text with one character changed; row and column from 1."""
    lines = text.split("\n")
    line = lines[row - 1]
    lines[row - 1] = line[: column - 1] + char + line[column:]
    return "\n".join(lines)


# Parsing and printing


@pytest.mark.parametrize("name", SHIPPED)
def test_printing_a_shipped_map_gives_its_file(name):
    path = DATA / "maps" / f"{name}.txt"

    assert f"{read_map(name)}\n" == path.read_text(encoding="utf-8")


def test_every_file_in_the_folder_of_maps_is_tested():
    assert tuple(sorted(p.stem for p in (DATA / "maps").iterdir())) == SHIPPED


@given(map_texts())
@settings(deadline=None, max_examples=60)
def test_a_random_building_is_printed_as_it_was_drawn_but_for_corners(text):
    drawn, printed = text.split("\n"), str(parse_map(text)).split("\n")

    assert [line[1::2] for line in printed[::2]] == [line[1::2] for line in drawn[::2]]
    assert printed[1::2] == drawn[1::2]


@given(map_texts())
@settings(deadline=None, max_examples=60)
def test_reading_what_was_printed_gives_the_same_map(text):
    building = parse_map(text)

    assert parse_map(str(building)) == building
    assert str(parse_map(str(building))) == str(building)


def test_corners_are_drawn_from_the_walls_around_them():
    all_plus = BUILDING.split("\n")
    for row in (0, 2, 4, 6):
        all_plus[row] = "".join("+" + c for c in all_plus[row][1::2]) + "+"
    assert "|   +d+" not in all_plus

    assert str(parse_map("\n".join(all_plus))) == BUILDING


@pytest.mark.parametrize("corner", list("+-| "))
def test_a_corner_of_the_border_carries_no_information(corner):
    assert parse_map(edited(1, 3, corner, SMALLEST)) == parse_map(SMALLEST)


@pytest.mark.parametrize(
    "text",
    [
        SMALLEST + "\n",
        "\n\n  \n" + SMALLEST,
        SMALLEST + "\n \n\n\n",
        SMALLEST.replace("\n", "\r\n"),
        SMALLEST.replace("\n", "\r"),
    ],
    ids=["newline", "blank before", "blank after", "windows", "old mac"],
)
def test_line_ends_and_blank_lines_around_the_picture_do_not_matter(text):
    assert str(parse_map(text)) == SMALLEST


def test_a_file_of_a_windows_editor_is_read(tmp_path):
    path = tmp_path / "windows.txt"
    path.write_bytes(b"\xef\xbb\xbf" + SMALLEST.replace("\n", "\r\n").encode())

    assert read_map(path) == parse_map(SMALLEST)


def test_a_map_is_read_from_a_path_given_as_text(tmp_path):
    (tmp_path / "mine.txt").write_text(SMALLEST, encoding="utf-8")

    assert str(read_map(str(tmp_path / "mine.txt"))) == SMALLEST


@pytest.mark.parametrize(
    "text",
    [SMALLEST, "+---+\n|  *|\n+---+", "+-+\n|*|\n+d+\n|.|\n+-+"],
    ids=["1 x 2", "without corridor", "2 x 1"],
)
def test_the_smallest_maps_go_all_the_way_to_table_1(text):
    """One step to the goal: (V + 0) / 2 with V = -1 * 0.1 * 0.99 ... - 1."""
    tasks = navigation_tasks(parse_map(text))
    result = table1(tasks, tasks)

    value = -1 / (1 - 0.99 * 0.1) / 2
    for column in ("source", "target"):
        for row in ("nd", "prob", "grad", "optimal", "uniform_available"):
            assert result[column][row] == pytest.approx(value)
        # One of the 8 actions leads there: V = -1 + 0.99 (1 - 0.9 / 8) V.
        wasteful = -1 / (1 - 0.99 * (1 - 0.9 / 8)) / 2
        assert result[column]["rand"] == pytest.approx(wasteful)
    assert result["unseen"] == 0


def test_a_map_of_200_x_200_cells_is_read():
    big = tile_map(parse_map(SMALLEST), 200, 100)

    assert big.shape == (200, 200)
    assert big.n_rooms == len(big.goals) == 20_000
    assert parse_map(str(big)) == big


# Refusals

REFUSED = {
    "empty": ("", "the map is empty; draw at least two cells, one a goal"),
    "blank": ("\n  \n\n", "the map is empty; draw at least two cells, one a goal"),
    "one cell": (
        "+-+\n|*|\n+-+",
        "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or more; "
        "got 3 rows and 3 columns",
    ),
    "even rows": (
        SMALLEST + "\n+---+",
        "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or more; "
        "got 4 rows and 5 columns",
    ),
    "even columns": (
        "+--+\n|.d|\n+--+",
        "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or more; "
        "got 3 rows and 4 columns",
    ),
    "no cells": (
        "+---------------+",
        "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or more; "
        "got 1 rows and 17 columns",
    ),
    "line too short": (
        BUILDING.replace("|  *d |", "|  *d"),
        "row 2, column 6: this line has 5 characters, the first 7; "
        "make all lines equally long",
    ),
    "line too long": (
        BUILDING.replace("|. . .|", "|. . .|x"),
        "row 6, column 8: this line has 8 characters, the first 7; "
        "make all lines equally long",
    ),
    "blank line inside": (
        SMALLEST.replace("\n|", "\n\n|"),
        "row 2, column 1: this line has 0 characters, the first 5; "
        "make all lines equally long",
    ),
    "unknown cell": (
        edited(2, 2, "x"),
        "row 2, column 2: unknown character 'x'; "
        "here stands a cell: '.' of a corridor, ' ' of a room, '*' a goal",
    ),
    "unknown corner": (
        edited(3, 3, "d"),
        "row 3, column 3: unknown character 'd'; "
        "here stands a corner: '+', '-', '|' or ' '",
    ),
    "wall the wrong way": (
        edited(2, 3, "-"),
        "row 2, column 3: unknown character '-'; "
        "here stands an edge: '|' for a wall, 'd' for a door, ' ' for neither",
    ),
    "other wall the wrong way": (
        edited(3, 2, "|"),
        "row 3, column 2: unknown character '|'; "
        "here stands an edge: '-' for a wall, 'd' for a door, ' ' for neither",
    ),
    "character nul": (
        edited(2, 2, "\0"),
        "row 2, column 2: unknown character '\\x00'; "
        "here stands a cell: '.' of a corridor, ' ' of a room, '*' a goal",
    ),
    "not ascii": (
        edited(6, 4, "é"),
        "row 6, column 4: unknown character 'é'; "
        "here stands a cell: '.' of a corridor, ' ' of a room, '*' a goal",
    ),
    "hole above": (
        edited(1, 4, " "),
        "row 1, column 4: the border has a hole; put a wall there",
    ),
    "hole below": (
        edited(7, 2, " "),
        "row 7, column 2: the border has a hole; put a wall there",
    ),
    "hole on the left": (
        edited(4, 1, " "),
        "row 4, column 1: the border has a hole; put a wall there",
    ),
    "door in the border": (
        edited(2, 7, "d"),
        "row 2, column 7: the border has a hole; put a wall there",
    ),
    "door into the same room": (
        edited(2, 3, "d"),
        "row 2, column 3: the door joins a region to itself; "
        "make it a wall, or close the walls of the region",
    ),
    "door into the same corridor": (
        "+---+-+\n|.d.d*|\n|   +-+\n|. .d |\n+---+-+",
        "row 2, column 3: the door joins a region to itself; "
        "make it a wall, or close the walls of the region",
    ),
    "no goal": (
        edited(2, 4, " "),
        "the map has no goal; put '*' in a cell of a room",
    ),
    "goal in the corridor": (
        edited(6, 4, "*"),
        "row 6, column 4: a goal in the corridor; "
        "move it into a room, or make its cells a room with walls and a door",
    ),
    "room without wall to the corridor": (
        edited(5, 4, " "),
        "row 5, column 4: a room opens on the corridor; put a wall or a door there",
    ),
    "corridor cell in a room": (
        edited(4, 2, "."),
        "row 3, column 2: a room opens on the corridor; put a wall or a door there",
    ),
    "closed room": (
        edited(4, 5, "|", edited(2, 5, "|", edited(5, 2, "-"))),
        "row 2, column 2: this region cannot be reached from the rest of the "
        "building; put a door in one of its walls",
    ),
}


def message(call, *arguments, error=ValueError):
    """Return what the call says when it refuses."""
    with pytest.raises(error) as refusal:
        call(*arguments)
    return str(refusal.value)


@pytest.mark.parametrize(("text", "said"), REFUSED.values(), ids=REFUSED)
def test_a_bad_drawing_is_refused_with_place_and_remedy(text, said):
    assert message(parse_map, text) == said


def test_the_buildings_that_were_spoilt_are_legal():
    assert str(parse_map(BUILDING)) == BUILDING
    assert str(parse_map(SMALLEST)) == SMALLEST


@pytest.mark.parametrize("name", ["hole below", "unknown cell", "no goal"])
def test_blank_lines_before_the_picture_count_in_the_row(name):
    text, said = REFUSED[name]
    for row in (7, 2):
        said = said.replace(f"row {row}", f"row {row + 3}")

    assert message(parse_map, "\n \n\n" + text) == said


@given(text=map_texts(), data=st.data())
@settings(deadline=None, max_examples=60)
def test_any_change_of_one_character_gives_a_map_or_a_refusal(text, data):
    place = data.draw(st.integers(0, len(text) - 1))
    char = data.draw(st.sampled_from("+-|d *.x\n"))
    building = None
    with suppress(ValueError):
        building = parse_map(text[:place] + char + text[place + 1 :])

    assert building is None or parse_map(str(building)) == building


def test_something_else_than_text_is_refused():
    assert message(parse_map, None) == "text of a map must be a str, got NoneType"


def test_a_missing_file_is_told_from_the_names_that_exist(tmp_path):
    said = message(read_map, tmp_path / "none.txt", error=FileNotFoundError)

    assert f"no map file {str(tmp_path / 'none.txt')!r}" in said
    assert said.endswith("source, target, target_b, target_c, target_d")


def test_a_folder_is_no_map(tmp_path):
    assert "no map file" in message(read_map, tmp_path, error=FileNotFoundError)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "the map is empty; draw at least two cells, one a goal"),
        (bytes(range(1, 256)), "no text in UTF-8 or UTF-16 (byte 127)"),
        (SMALLEST.encode("utf-16-le")[:-1], "no text in UTF-8 or UTF-16 (byte 32)"),
        (edited(2, 2, "x").encode(), REFUSED["unknown cell"][1]),
    ],
    ids=["empty", "binary", "cut utf-16", "bad map"],
)
def test_a_bad_file_is_refused_by_its_name(tmp_path, content, said):
    path = tmp_path / "bad.txt"
    path.write_bytes(content)

    assert message(read_map, path) == f"{path}: {said}"


# What a map holds


@pytest.mark.parametrize(("name", "counts"), COUNTS.items(), ids=COUNTS)
def test_the_counts_are_those_of_the_paper(name, counts):
    building = read_map(name)

    assert (
        building.n_cells,
        building.n_rooms,
        len(building.goals),
        building.n_doors,
    ) == counts


def test_the_arrays_of_a_small_building_are_as_drawn():
    building = parse_map(BUILDING)

    assert building.shape == (3, 3)
    assert building.cells.tolist() == [*" * ", *"  .", *"..."]
    assert building.goals.tolist() == [1]
    assert building.neighbors.tolist() == [
        [-1, 1, 3, -1],
        [-1, 2, 4, 0],
        [-1, -1, 5, 1],
        [0, 4, 6, -1],
        [1, -1, -1, 3],
        [2, -1, 8, -1],
        [3, 7, -1, -1],
        [-1, 8, -1, 6],
        [5, -1, -1, 7],
    ]
    places = np.argwhere(building.doors).tolist()
    assert places == [[1, 1], [2, 2], [2, 3], [3, 2], [5, 0], [6, 0]]
    same_region = building.regions[:, None] == building.regions
    assert same_region[0].nonzero()[0].tolist() == [0, 1, 3, 4]
    assert same_region[2].nonzero()[0].tolist() == [2]
    assert same_region[5].nonzero()[0].tolist() == [5, 6, 7, 8]
    assert repr(building) == "Map(3 x 3 cells, 2 rooms, 1 goal)"


@pytest.mark.parametrize(
    "name", ["chars", "cells", "goals", "edges", "doors", "neighbors", "regions"]
)
def test_arrays_are_read_only(source, name):
    array = getattr(source, name)

    with pytest.raises(ValueError, match="read-only"):
        array[0] = array[1]


def test_a_map_is_frozen(source):
    with pytest.raises(FrozenInstanceError):
        source.text = SMALLEST


def test_maps_are_equal_when_their_texts_are():
    assert parse_map(BUILDING) == parse_map(BUILDING)
    assert len({parse_map(BUILDING), parse_map(BUILDING), parse_map(SMALLEST)}) == 2
    assert parse_map(BUILDING) != BUILDING


def test_a_map_comes_back_from_another_process_equal(source):
    assert pickle.loads(pickle.dumps(source)) == source


# Edits


def test_every_inner_wall_of_a_building_can_be_opened_and_closed_or_is_refused(source):
    n_opened = n_refused = 0
    for cell, direction in np.argwhere(np.isin(source.edges, ["-", "|"])):
        place = divmod(int(cell), source.shape[1])
        try:
            opened = source.set_edge(place, "NESW"[direction], "open")
        except ValueError:
            n_refused += 1
            continue
        n_opened += 1
        assert opened.neighbors[cell, direction] >= 0
        assert opened.set_edge(place, "NESW"[direction], "wall") == source

    # Four pairs of rooms share a wall of 3 edges without a door; 2 sides each.
    assert n_opened == 4 * 3 * 2
    assert n_refused > 0


@pytest.mark.parametrize(
    ("cell", "direction", "row"),
    [((0, 0), "E", 2), ((0, 0), "S", 3), ((1, 1), "N", 3), ((1, 1), "W", 4)],
)
def test_a_new_wall_stands_where_it_was_asked_for(cell, direction, row):
    building = parse_map(BUILDING)
    changed = building.set_edge(cell, direction, "wall")

    before, after = BUILDING.split("\n"), str(changed).split("\n")
    column = 2 * cell[1] + 1 + {"E": 1, "W": -1}.get(direction, 0)
    assert after[row - 1][column] == ("|" if direction in "EW" else "-")
    assert before[row - 1][column] == " "
    assert changed.set_edge(cell, direction, "open") == building
    assert str(building) == BUILDING


def test_a_door_can_be_added_between_two_regions():
    building = parse_map(BUILDING)
    changed = building.add_door((1, 1), "S")

    assert str(changed) == edited(5, 4, "d")
    assert (building.n_doors, changed.n_doors) == (3, 4)
    assert str(building) == BUILDING


def test_a_door_is_refused_where_it_joins_a_region_to_itself():
    said = message(parse_map(BUILDING).add_door, (0, 0), "E")

    assert said == REFUSED["door into the same room"][1]


def test_a_door_can_be_made_a_wall_and_opened():
    building = parse_map(BUILDING)

    assert str(building.set_edge((0, 1), "E", "wall")) == edited(2, 5, "|")
    merged = building.set_edge((0, 1), "E", "open")
    assert str(merged) == edited(2, 5, " ", edited(1, 5, "-"))
    assert (building.n_rooms, merged.n_rooms) == (2, 1)


@pytest.mark.parametrize("direction", "NESW")
def test_an_edge_is_the_same_from_both_sides(direction):
    blank = "|     |"
    building = parse_map(
        "\n".join(["+-----+", blank, blank, "|  *  |", blank, blank, "+-----+"])
    )
    opposite = dict(zip("NESW", "SWNE", strict=True))[direction]
    row, column = {"N": (0, 1), "E": (1, 2), "S": (2, 1), "W": (1, 0)}[direction]

    changed = building.set_edge((1, 1), direction, "wall")
    assert changed != building
    assert changed == building.set_edge((row, column), opposite, "wall")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (((-1, 0), "E", "wall"), "cell must lie within 3 x 3, got (-1, 0)"),
        (((3, 0), "E", "wall"), "cell must lie within 3 x 3, got (3, 0)"),
        ((4, "E", "wall"), "cell must lie within 3 x 3, got 4"),
        ((("a", "b"), "E", "wall"), "cell must lie within 3 x 3, got ('a', 'b')"),
        (
            ((0, 0), "east", "wall"),
            "direction must be one of ('N', 'E', 'S', 'W'), got 'east'",
        ),
        (
            ((0, 0), "E", "window"),
            "kind must be one of ('wall', 'door', 'open'), got 'window'",
        ),
        (
            ((0, 1), "N", "open"),
            "row 1, column 4: the border has a hole; put a wall there",
        ),
        (
            ((2, 1), "N", "open"),
            "row 5, column 4: a room opens on the corridor; put a wall or a door there",
        ),
    ],
)
def test_an_edit_that_cannot_be_is_refused(arguments, said):
    assert message(parse_map(BUILDING).set_edge, *arguments) == said


def test_removing_a_wall_of_a_room_is_said_to_open_the_room(source):
    """The goal in the room is not to blame."""
    assert message(source.set_edge, (3, 2), "E", "open") == (
        "row 8, column 7: a room opens on the corridor; put a wall or a door there"
    )


# Tiling


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 3), (2, 1), (3, 2)])
def test_tiles_are_copies_joined_by_one_door_each(source, rows, columns):
    n = rows * columns
    tiled = tile_map(source, rows, columns)

    assert tiled.shape == (9 * rows, 15 * columns)
    assert (tiled.n_rooms, len(tiled.goals)) == (11 * n, 11 * n)
    assert tiled.n_doors == 11 * n + rows * (columns - 1) + columns * (rows - 1)
    tiles = tiled.cells.reshape(rows, 9, columns, 15).swapaxes(1, 2).reshape(n, -1)
    assert (tiles == source.cells).all()
    assert all(goal < after for goal, after in pairwise(tiled.goals))


def test_one_tile_is_the_map_itself(source):
    assert tile_map(source, 1, 1) == source


@given(map_texts(3, 3), st.integers(1, 3), st.integers(1, 3))
@settings(deadline=None, max_examples=30)
def test_any_map_can_be_tiled(text, rows, columns):
    building = parse_map(text)
    tiled = tile_map(building, rows, columns)

    height, width = building.shape
    assert tiled.shape == (height * rows, width * columns)
    assert len(tiled.goals) == rows * columns * len(building.goals)


@pytest.mark.parametrize(("rows", "columns"), [(0, 1), (1, -1)])
def test_no_tile_at_all_is_refused(source, rows, columns):
    said = f"rows and columns must be at least 1, got {rows}, {columns}"

    assert message(tile_map, source, rows, columns) == said


def test_a_map_put_into_the_folder_is_known_by_its_name(tmp_path, monkeypatch):
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "target_paper.txt").write_text(SMALLEST, encoding="utf-8")
    monkeypatch.setattr("abstransfer.maps.DATA", tmp_path)

    assert str(read_map("target_paper")) == str(parse_map(SMALLEST))
