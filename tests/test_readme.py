"""What README says of the package holds."""

import re

import pytest
from rooms import ABOVE, CORE, rooms
from support import ROOT

ROW = re.compile(r"^\| `([\w*/.]+)` \| .* \| ([\d,]+) \|$", re.MULTILINE)
STATED = ROW.findall((ROOT / "README.md").read_text(encoding="utf-8"))


def test_the_rooms_stand_in_the_order_in_which_they_build_on_each_other():
    assert [name for name, _ in STATED] == [*CORE, *ABOVE]


@pytest.mark.parametrize(("name", "stated"), STATED)
def test_the_stated_size_of_a_room_is_within_a_tenth(name, stated):
    (room,) = rooms((name,))

    assert int(stated.replace(",", "")) == pytest.approx(room.lines, rel=0.1)


def test_the_method_stays_small():
    assert sum(room.lines for room in rooms(CORE)) < 1300
