"""What README says of the package holds."""

import re

import pytest
from rooms import ABOVE, CORE, rooms
from support import ROOT

ROW = re.compile(r"^\| `([\w*/.]+)` \| .* \| ([\d,]+) \|$", re.MULTILINE)
GROUP = re.compile(r"^\| \{doc\}`([\w, ]+) <\w+>` \| .* \| ([\d,]+) \|$", re.MULTILINE)
GROUPS = GROUP.findall((ROOT / "book" / "api.md").read_text(encoding="utf-8"))
STATED = ROW.findall((ROOT / "README.md").read_text(encoding="utf-8"))


def test_the_rooms_stand_in_the_order_in_which_they_build_on_each_other():
    assert [name for name, _ in STATED] == [*CORE, *ABOVE]


@pytest.mark.parametrize(("name", "stated"), STATED)
def test_the_stated_size_of_a_room_is_within_a_tenth(name, stated):
    (room,) = rooms((name,))

    assert int(stated.replace(",", "")) == pytest.approx(room.lines, rel=0.1)


@pytest.mark.parametrize(("names", "stated"), GROUPS)
def test_the_reference_states_the_sizes_within_a_tenth(names, stated):
    known = {re.sub(r"\W|py$", "", name): name for name in (*CORE, *ABOVE)}
    lines = sum(room.lines for room in rooms([known[n] for n in names.split(", ")]))

    assert int(stated.replace(",", "")) == pytest.approx(lines, rel=0.1)


def test_the_reference_states_the_size_of_every_room():
    named = ", ".join(names for names, _ in GROUPS).split(", ")

    assert len(named) == len(CORE) + len(ABOVE) - 2, (
        "what makes building and learning fast is inside"
    )


def test_the_method_stays_small():
    assert sum(room.lines for room in rooms(CORE)) < 1300
