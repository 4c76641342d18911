"""Stills: what stands for a scene where no script runs."""

import os
import re
import subprocess
import sys
from functools import cache

import numpy as np
import pytest
from bs4 import BeautifulSoup

from abstransfer import scenes
from abstransfer.maps import parse_map
from abstransfer.plotting import PALETTE
from abstransfer.scenes.parts.building import draw_building
from abstransfer.scenes.parts.charts import Axis, Curve, Row, line_chart, row_chart
from abstransfer.scenes.parts.svg import (
    MARKS,
    group,
    look_of,
    mark,
    paint,
    path,
    picture,
    text,
)

SCENES = [
    getattr(scenes, name)
    for name in scenes.__all__
    if getattr(getattr(scenes, name), "scene", "")
]
CORRIDOR_AND_ROOM = parse_map("+---+-+\n|. .d*|\n+---+-+")
UNIT = Axis(0, 1, {0: "0", 1: "1"}, "share")


@cache
def still_of(kind):
    return kind().still()


def drawn(svg_text):
    return BeautifulSoup(svg_text, "html.parser").svg


def places(picture):
    """Return where texts and moved marks are, (n, 2)."""
    found = [(float(t["x"]), float(t["y"])) for t in picture.find_all("text")]
    for shape in picture.find_all(transform=True):
        found.append(tuple(map(float, re.findall(r"-?[\d.]+", shape["transform"]))))
    return np.array(found).reshape(-1, 2)


# Every scene


@pytest.mark.parametrize("kind", SCENES)
def test_nothing_of_a_still_lies_outside_of_its_picture(kind):
    for frame in still_of(kind).frames:
        picture = drawn(frame)
        left, top, width, height = map(float, picture["viewbox"].split())
        x, y = places(picture).T

        assert ((x >= left) & (x <= left + width)).all()
        assert ((y >= top) & (y <= top + height)).all()


@pytest.mark.parametrize("kind", SCENES)
def test_numbers_of_a_still_have_at_most_one_digit_after_the_point(kind):
    for frame in still_of(kind).frames:
        paths = re.findall(r' d="([^"]*)"', frame)
        numbers = re.findall(r"\d*\.\d+", " ".join(paths).replace("h.01", ""))

        assert [n for n in numbers if len(n.split(".")[1]) > 1] == []


@pytest.mark.parametrize("kind", SCENES)
def test_pictures_of_a_still_differ_and_have_words_of_their_own(kind):
    frames = still_of(kind).frames

    assert len(set(frames)) == len({drawn(f)["aria-label"] for f in frames}) == 3


@pytest.mark.parametrize("seed", ["1", "2"])
def test_stills_do_not_depend_on_the_order_of_hashes(seed):
    names = ["Paint", "Race", "Ripple", "Filling"]
    program = (
        "from abstransfer import scenes\n"
        f"for name in {names}: print(getattr(scenes, name)().html())"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONHASHSEED": seed, "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )

    assert done.stdout.split("\n")[:-1] == [
        getattr(scenes, name)().html() for name in names
    ]


def test_a_scene_of_a_readers_own_has_the_still_of_its_kind():
    class Mine(scenes.Paint):
        """A scene that is defined elsewhere."""

    assert Mine(z=0).still() == scenes.Paint(z=0).still()


# A building


def test_a_building_marks_goals_doors_and_the_robot():
    values = [0, 0.5, np.nan]
    words = "A corridor and a room."
    picture = draw_building(CORRIDOR_AND_ROOM, words, values=values, robots={0: ""})

    assert drawn(picture)["aria-label"] == words
    assert "a6 6 0" in picture  # the robot
    assert picture.count("translate(50 10)") == 1  # the goal
    assert "fill-opacity:0.5" in picture
    assert picture.count("M40 3.6L40 16.4") == 2  # one door: its rim and its inside


def test_robots_in_one_cell_share_a_sign_with_their_names():
    picture = draw_building(CORRIDOR_AND_ROOM, "Two robots.", robots={1: "QR"})
    (sign,) = drawn(picture).find_all("text")

    assert (sign.get_text(), sign["x"]) == ("QR", "30")


def test_a_number_is_not_hidden_by_the_star_of_a_goal_that_does_not_count():
    map_ = parse_map("+-+---+-+\n|*d. .d*|\n+-+---+-+")
    both = draw_building(map_, "Two goals.", goal=0)
    texts = draw_building(map_, "Two goals.", goal=0, texts=["", "-1", "-2", "-3"])

    assert both.count("translate") == 2
    assert texts.count("translate") == 1
    assert [t.get_text() for t in drawn(texts).find_all("text")] == ["-1", "-2", "-3"]


# Charts


def test_names_of_curves_are_apart_and_in_the_order_of_their_ends():
    curves = [Curve(f"curve {i}", [(0, 0), (1, 1 - i / 100)]) for i in range(5)]
    parts = line_chart(curves, UNIT, UNIT)
    words = drawn(picture(parts, "Five curves.", 300, 200))
    names = [t for t in words.find_all("text") if "curve" in t.get_text()]
    y = np.array([float(t["y"]) for t in names])

    assert [t.get_text() for t in names] == [curve.name for curve in curves]
    assert (np.diff(y) >= 12.9).all()


def test_a_curve_goes_through_its_points():
    (line,) = [
        part
        for part in line_chart([Curve("a", [(0, 0), (0.5, 1), (1, 1)])], UNIT, UNIT)
        if "L" in part
    ]

    assert 'd="M34 166L134 28L234 28"' in line


def test_points_without_a_name_are_hollow_marks():
    parts = line_chart(
        [Curve("ours", [(0, 0)], "nd", marks=1), Curve("", [(1, 1)], "nd", marks=1)],
        UNIT,
        UNIT,
    )
    ours, theirs = (part for part in parts if "translate" in part)

    assert "fill:var(--ab-arm-nd" in ours
    assert "fill:var(--ab-ground" in theirs


def test_a_box_spans_the_quartiles_and_a_bar_starts_at_zero():
    axis = Axis(0, 100, {0: "0", 100: "100"}, "goals")
    rows = [Row("a", "50", "nd", box=range(101)), Row("b", "50", "nd", bar=50)]
    x = [98 + 1.48 * share for share in (25, 50, 75)]
    picture = row_chart(rows, axis, "A box and a bar.")

    assert f'd="M{x[0]:g} 23H{x[2]:g}v10H{x[0]:g}z"' in picture
    assert f'd="M98 54H{x[1]:g}"' in picture


# The kit


@pytest.mark.parametrize("arm", PALETTE["arms"])
def test_every_arm_has_a_mark_and_colours_for_both_themes(arm):
    assert look_of(arm).mark in MARKS.values()
    assert f"var(--ab-arm-{arm}," in mark(arm, 0, 0)


def test_words_cannot_break_out_of_the_picture():
    words = 'a < b & "c"'
    shown = drawn(picture([text(0, 0, words)], words, 9, 9))

    assert shown["aria-label"] == shown.get_text() == words


def test_what_is_empty_draws_nothing():
    assert path("", "ink") == text(0, 0, "") == group([], "fill:red") == ""


@pytest.mark.parametrize("name", ["nowhere", "arm-nowhere"])
def test_an_unknown_colour_is_an_error(name):
    with pytest.raises(KeyError, match="nowhere"):
        paint(name)
