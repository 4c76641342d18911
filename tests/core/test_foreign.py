"""Maps from elsewhere: the same map, or a refusal that names what it looks like."""

import pytest
from golden.foreign_texts import HARMLESS, LARGER_CELLS, NAMED, NEARLY, OURS
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import map_texts

from abstransfer import parse_map, read_map
from abstransfer.foreign import FORMATS, PLAIN, SAME, named
from abstransfer.maps import KNOWN


def answer(text):
    """Return the text of the map, or what the refusal says."""
    try:
        return str(parse_map(text))
    except ValueError as error:
        return str(error)


@pytest.mark.parametrize("text", HARMLESS.values(), ids=HARMLESS)
def test_a_harmless_difference_makes_no_difference(text):
    assert answer(text) == OURS


@pytest.mark.parametrize(("text", "meant"), LARGER_CELLS.values(), ids=LARGER_CELLS)
def test_a_maze_with_larger_cells_is_the_building_it_means(text, meant):
    if meant is None:
        assert "cannot be reached" in answer(text)
    else:
        assert answer(text) == str(parse_map(meant))


@pytest.mark.parametrize(
    ("name", "text"), [(name, text) for name, texts in NAMED.items() for text in texts]
)
def test_another_format_is_refused_by_its_name(name, text):
    said = answer(text)

    assert said.startswith(f"this looks like {name}: ")
    assert said.endswith("; page 1 of the book shows how a building is drawn")


def test_every_format_that_is_named_is_tested():
    assert list(NAMED) == [name for name, *_ in FORMATS]


@pytest.mark.parametrize(("text", "said"), NEARLY.values(), ids=NEARLY)
def test_what_is_nearly_ours_is_refused_with_its_place(text, said):
    assert answer(text) == said


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"]
)
def test_a_file_is_read_in_the_encodings_of_editors(tmp_path, encoding):
    path = tmp_path / "mine.txt"
    path.write_bytes(OURS.encode(encoding))

    assert str(read_map(path)) == OURS


def test_what_stands_for_a_character_is_none_of_ours():
    ours = set("".join("".join(pair) for pair in KNOWN))

    assert not ours & set("".join(SAME.values()))
    assert set(SAME) <= ours
    assert len(PLAIN) == len("".join(SAME.values()))


# Any of our maps


@st.composite
def journeys(draw, text):
    """Draw what a text of ours may look like when it comes back: no other map."""
    lines = text.split("\n")
    if draw(st.booleans()):
        other = {plain: draw(st.sampled_from(chars)) for plain, chars in SAME.items()}
        kept = draw(st.sets(st.sampled_from("-|+ ")))
        table = str.maketrans({char: other[char] for char in kept})
        lines = [line.translate(table) for line in lines]
    indent = draw(st.sampled_from(["", " ", "   ", "\t", "\t\t"]))
    ends = draw(st.lists(st.sampled_from(["", " ", "   ", "\t"]), min_size=1))
    lines = [
        indent + line + ends[i % len(ends)].replace("\t", "" if "\t" in indent else " ")
        for i, line in enumerate(lines)
    ]
    around = st.lists(st.sampled_from(["", "  ", "# a school", "#", "   # 2 x 3"]))
    lines = [*draw(around), *lines, *draw(around)]
    if draw(st.booleans()):
        lines = [draw(st.sampled_from(["```", "```text", "~~~"])), *lines, "```"]
    end = draw(st.sampled_from(["\n", "\r\n", "\r"]))
    mark = draw(st.sampled_from(["", "\ufeff"]))
    return mark + end.join(lines) + draw(st.sampled_from(["", end, end + "\x1a"]))


@given(st.data())
@settings(deadline=None, max_examples=150)
def test_any_map_comes_back_from_a_journey_as_it_was(data):
    text = data.draw(st.one_of(map_texts(), map_texts().map(parse_map).map(str)))

    assert parse_map(data.draw(journeys(text))) == parse_map(text)


@given(text=map_texts(), size=st.sampled_from([2, 3, 4, 8]))
@settings(deadline=None, max_examples=100)
def test_tabs_for_blanks_give_the_same_map_or_are_refused_by_name(text, size):
    said = answer("\n".join(with_tabs(line, size) for line in text.split("\n")))

    assert said == str(parse_map(text)) or ": a tab, of which nobody" in said


def with_tabs(line, size):
    """Return a line whose blanks before tab stops are tabs."""
    parts = [line[i : i + size] for i in range(0, len(line), size)]
    short = [part.rstrip(" ") for part in parts[:-1]]
    return "".join(
        part if len(part) == size else part + "\t" for part in short
    ) + "".join(parts[-1:])


@given(text=map_texts(), size=st.sampled_from([2, 3, 4, 5, 7]), high=st.integers(1, 3))
@settings(deadline=None, max_examples=150)
def test_any_map_drawn_with_larger_cells_is_the_same_map(text, size, high):
    """Where it may be ours too, it is refused, or is what it was as ours."""
    drawn = enlarged(text, size, high)
    said = answer(drawn)

    assert said == str(parse_map(text)) or (
        size % 2 and high % 2 and (": here no walls meet" in said or said == drawn)
    )


def enlarged(text, wide, high):
    """Return a text of ours with cells of so many characters, '+' at all corners."""
    lines = []
    for i, line in enumerate(text.split("\n")):
        middle, fill = [], []
        for j, char in enumerate(line):
            if j % 2 == 0:
                middle.append("+" if i % 2 == 0 else char)
                fill.append("|" if char == "d" else char)
            else:
                wall = "-" if i % 2 == 0 and char in "-d" else " "
                left = wide // 2
                middle.append(wall * left + char + wall * (wide - 1 - left))
                fill.append(" " * wide)
        first = (high - 1) // 2
        inner = ["".join(fill)] * first, ["".join(fill)] * (high - 1 - first)
        whole = ["".join(middle)]
        lines += whole if i % 2 == 0 else [*inner[0], *whole, *inner[1]]
    return "\n".join(lines)


@given(text=map_texts(), data=st.data())
@settings(deadline=None, max_examples=150)
def test_a_slip_of_the_pen_is_not_called_another_format(text, data):
    place = data.draw(st.integers(0, len(text) - 1))
    char = data.draw(st.characters())

    assert named(text) == ""
    assert named(text[:place] + char + text[place + 1 :]) == ""


@given(st.text(alphabet="+-|d *.oGSX#%\n:01@\t", max_size=60))
@settings(deadline=None, max_examples=300)
def test_any_text_is_read_or_refused(text):
    answer(text)
