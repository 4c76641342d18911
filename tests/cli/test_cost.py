"""What Table 1 takes is said before the work, and refused where it cannot fit."""

import pytest
from buildings import tile_map

from abstransfer import read_map
from abstransfer.cli import cost, main


def test_a_small_table_says_nothing(capsys):
    cost.say_what_it_takes(read_map("source"), read_map("target"))

    assert capsys.readouterr().err == ""


def test_a_long_table_says_states_time_and_memory(capsys):
    target = tile_map(read_map("target"), 2, 3)
    cost.say_what_it_takes(read_map("source"), target)

    said = capsys.readouterr().err
    assert said.startswith(
        "abstransfer: 1,485 states in the source and 680,400 in the target "
    )
    assert "this may take about" in said
    assert said.count("\n") == 1


def test_a_source_that_cannot_be_held_is_refused(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(cost, "memory", lambda: 200_000_000)
    path = tmp_path / "large.txt"
    path.write_text(str(tile_map(read_map("source"), 2, 2)), encoding="utf-8")

    assert main(["table1", "--source", str(path)]) == 2
    assert "23,760 states of the source" in capsys.readouterr().err


def test_the_target_of_any_number_of_goals_fits_where_one_part_does(monkeypatch):
    monkeypatch.setattr(cost, "memory", lambda: 300_000_000)

    cost.say_what_it_takes(read_map("source"), tile_map(read_map("target"), 3, 3))


def test_where_the_memory_is_not_known_nothing_is_refused(monkeypatch):
    monkeypatch.setattr(cost, "memory", lambda: None)

    cost.say_what_it_takes(tile_map(read_map("source"), 3, 3), None)


def test_too_little_memory_ends_with_a_message_and_code_2(monkeypatch, capsys):
    def full(*arguments):
        raise MemoryError

    monkeypatch.setattr("abstransfer.cli.table1.read_map", full)

    assert main(["table1"]) == 2
    assert "not enough memory" in capsys.readouterr().err


@pytest.mark.parametrize(("seconds", "said"), [(42, "42 s"), (1000, "17 min")])
def test_a_time_is_said_as_a_person_says_it(seconds, said):
    assert cost._spoken(seconds) == said
