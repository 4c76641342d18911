"""Figures: legible, described from their data, and the same bytes every time."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from support import ROOT

from abstransfer import plotting
from abstransfer.driving import PAPER, ROWS
from abstransfer.maps import parse_map, read_map
from abstransfer.navigation import navigation_tasks
from abstransfer.plotting.buildings import BLACK_ON, N_SHADES, _shades
from abstransfer.plotting.style import MARKS, number, spread
from abstransfer.plotting.tasks import abstract_ranks, walking_distance

ALT = "A line that rises from zero to one, to see how it is drawn."
TWO_ROOMS = parse_map("+-+-----+\n|*d. . .|\n+-+---+d+\n|* *  d.|\n+-----+-+")


@pytest.fixture(scope="module")
def tasks():
    return navigation_tasks(read_map("source"))


@pytest.fixture
def ax():
    return Figure(figsize=(5, 4.2)).subplots()


def ladder(*values, column="source"):
    return {column: dict(zip(ROWS, values, strict=True))}


def runs(means, n_windows=None):
    """Three runs of each arm, one of them its mean."""
    shape = (3,) if n_windows is None else (3, n_windows)
    spread_ = np.array([0.99, 1.0, 1.01]).reshape(3, *[1] * (len(shape) - 1))
    return {arm: np.broadcast_to(mean * spread_, shape) for arm, mean in means.items()}


NINE = {
    "none": 267_000,
    **{f"rand-{s}": x for s, x in (("hard", 433_000), ("soft", 314_000))},
    **{f"nd-{s}": x for s, x in (("hard", 561_000), ("soft", 567_000))},
    **{f"prob-{s}": x for s, x in (("hard", 447_000), ("soft", 465_000))},
    **{f"grad-{s}": x for s, x in (("hard", 423_000), ("soft", 469_000))},
}
TAUS = np.array([1e6, 3.5e6, 6e6])
BY_TAU = {arm: (TAUS, np.full((3, 2), x)) for arm, x in NINE.items() if arm != "none"}


def every_figure(tasks):
    """One picture by every plotting function of the package."""
    map_, states = tasks.maps[0], tasks.task == 3
    uniform = tasks.available / tasks.available.sum(axis=1, keepdims=True)
    v = -walking_distance(map_, int(tasks.goal[3]))
    return {
        "map": plotting.figure(plotting.plot_map, map_),
        "values": plotting.figure(plotting.plot_values, map_, v),
        "numbers": plotting.figure(plotting.plot_values, map_, v, numbers=True),
        "policy": plotting.figure(plotting.plot_policy, tasks, uniform, 3),
        "states": plotting.figure(plotting.plot_features, tasks, 3),
        "feature": plotting.figure(
            plotting.plot_features, tasks, 3, feature="near_goal"
        ),
        "z": plotting.figure(
            plotting.plot_features, tasks, 3, z=int(tasks.rho[states][0])
        ),
        "ladder": plotting.figure(plotting.plot_ladder, PAPER),
        "curves": plotting.figure(plotting.plot_curves, runs(NINE, 60)),
        "boxes": plotting.figure(plotting.plot_boxes, runs(NINE)),
        "tau": plotting.figure(plotting.plot_tau, BY_TAU, paper={"nd-hard": 3.5e6}),
    }


@pytest.fixture(scope="module")
def pictures(tasks):
    return every_figure(tasks)


KINDS = (
    ["map", "values", "numbers", "policy", "states", "feature", "z"]
    + ["ladder", "curves", "boxes", "tau"]
)  # fmt: skip


# --- the palette -------------------------------------------------------------


def luminance(color):
    parts = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    parts = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts]
    return float(np.dot(parts, [0.2126, 0.7152, 0.0722]))


def contrast(a, b):
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


def test_black_on_white_has_the_contrast_of_the_guidelines():
    """WCAG 2.2: 21 to 1; the examples there bound the formula below."""
    assert contrast("#000000", "#FFFFFF") == pytest.approx(21)
    assert contrast("#777777", "#FFFFFF") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("arm", plotting.PALETTE["arms"])
def test_the_name_of_an_arm_reads_well_in_its_colour_in_both_themes(arm):
    look, ground = plotting.PALETTE["arms"][arm], plotting.PALETTE["building"]["ground"]

    assert contrast(look["light"], ground["light"]) >= 4.5
    assert contrast(look["dark"], ground["dark"]) >= 4.5


def test_arms_and_strategies_differ_in_more_than_colour():
    marks = [look["marker"] for look in plotting.PALETTE["arms"].values()]
    hard, soft = plotting.arm_style("nd-hard"), plotting.arm_style("nd-soft")

    assert len(set(marks)) == len(marks)
    assert set(marks) <= set(MARKS)
    assert (hard.color, hard.marker) == (soft.color, soft.marker)
    assert hard.dash != soft.dash
    assert hard.face != soft.face


@pytest.mark.parametrize("arm", ["nd soft", "nd-soft", "nd_soft"])
def test_builder_and_strategy_may_be_joined_in_three_ways(arm):
    assert plotting.arm_style(arm).name == "ND soft"


def test_an_unknown_arm_is_refused_by_name():
    with pytest.raises(ValueError, match="arm must be one of .*'nd-warm'"):
        plotting.arm_style("nd-warm")


def test_a_number_in_a_cell_reads_well_on_every_shade():
    shades = [_shades(0, 1).cmap(i) for i in range(N_SHADES)]
    colors = ["#" + "".join(f"{round(255 * x):02X}" for x in s[:3]) for s in shades]
    inks = ["#FFFFFF"] * BLACK_ON + ["#000000"] * (N_SHADES - BLACK_ON)

    assert min(contrast(a, b) for a, b in zip(colors, inks, strict=True)) >= 4.5


# --- pictures ----------------------------------------------------------------


def test_only_the_room_of_pictures_names_matplotlib():
    package = ROOT / "abstransfer"
    importing = {
        path.parent.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if re.search(r"^\s*(import|from) matplotlib", path.read_text("utf-8"), re.M)
    }

    assert importing == {"plotting"}


@pytest.mark.parametrize("kind", KINDS)
def test_a_picture_is_an_svg_with_its_alt_text(pictures, kind):
    picture = pictures[kind]
    data, metadata = picture._repr_mimebundle_()
    root = ElementTree.fromstring(data["image/svg+xml"])

    assert sorted(data) == ["image/svg+xml", "text/plain"]
    assert data["text/plain"] == picture.alt == repr(picture)
    assert metadata == {"image/svg+xml": {"alt": picture.alt}}
    assert (root.get("role"), root.get("aria-label")) == ("img", picture.alt)
    assert root[0].text == picture.alt


@pytest.mark.parametrize("kind", KINDS)
def test_an_alt_text_has_40_to_300_characters(pictures, kind):
    assert 40 <= len(pictures[kind].alt) <= 300


@pytest.mark.parametrize("kind", KINDS)
def test_letters_are_not_small(pictures, kind):
    texts = pictures[kind].drawn.findobj(Text)
    sizes = [text.get_fontsize() for text in texts if text.get_text().strip()]

    assert min(sizes, default=9) >= 9


@pytest.mark.parametrize("kind", KINDS)
def test_a_picture_is_small_and_loads_nothing(pictures, kind):
    svg = pictures[kind].svg
    links = re.findall(r'(?:href|src)="([^"]*)"|url\(([^)]*)\)', svg)

    assert len(svg) < 70_000
    assert all((a or b).startswith("#") for a, b in links)
    assert {(a or b)[1:] for a, b in links} == set(re.findall(r' id="([^"]*)"', svg))


def test_the_same_data_give_the_same_bytes(tasks, pictures):
    again = every_figure(tasks)

    assert again == pictures
    assert {kind: picture.svg for kind, picture in again.items()} == {
        kind: picture.svg for kind, picture in pictures.items()
    }


def test_coordinates_are_rounded_and_words_are_not():
    def draw(ax):
        ax.plot([0, 1 / 3], [0, 1 / 7])
        ax.set_axis_off()
        ax.text(0, 0, "0.12345")

    svg = plotting.figure(draw, alt=ALT).svg

    assert ">0.12345<" in svg
    assert re.findall(r"<[^>]*\d\.\d{3}[^>]*>", svg) == []


def test_rounding_errors_of_the_machine_do_not_show():
    y = np.array([0.1, 0.7, 0.3])
    exact = plotting.figure(lambda ax: ax.plot(y), alt=ALT)

    assert plotting.figure(lambda ax: ax.plot(y * (1 + 4e-16)), alt=ALT) == exact
    assert plotting.figure(lambda ax: ax.plot(y * 2), alt=ALT) != exact


def test_a_description_with_signs_of_markup_is_kept():
    alt = 'The "better" policy is <b>worse</b> & slower than the other one.'
    root = ElementTree.fromstring(plotting.figure(lambda ax: None, alt=alt).svg)

    assert root.get("aria-label") == root[0].text == alt


def test_a_figure_without_a_description_is_refused():
    with pytest.raises(ValueError, match="alt must be given"):
        plotting.figure(lambda ax: ax.plot([0, 1]))


@pytest.mark.parametrize("alt", ["A figure.", "x" * 301])
def test_a_description_too_short_or_too_long_is_refused(alt):
    with pytest.raises(ValueError, match="alt must have 40 to 300 characters"):
        plotting.figure(lambda ax: ax.plot([0, 1]), alt=alt)


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf"])
def test_a_picture_is_saved_with_the_same_bytes_every_time(tmp_path, suffix):
    picture = plotting.figure(plotting.plot_map, TWO_ROOMS)
    saved = [picture.save(tmp_path / f"{i}.{suffix}").read_bytes() for i in range(2)]

    assert saved[0] == saved[1]
    assert len(saved[0]) > 1000


def test_several_panels_share_one_picture():
    seen = []
    plotting.figure(lambda ax: seen.append(ax.shape), alt=ALT, panels=(1, 2))

    assert seen == [(1, 2)]


def test_without_axes_a_plot_makes_its_own():
    plt = pytest.importorskip("matplotlib.pyplot")
    ax = plotting.plot_map(TWO_ROOMS)
    plt.close(ax.figure)

    assert len(ax.lines) == 4


# --- buildings and tasks -----------------------------------------------------


def test_every_wall_door_and_goal_is_drawn_where_it_is(ax):
    """The building of the test: 2 x 4 cells, two rooms, three doors."""
    walls, doors, _, goals = plotting.plot_map(TWO_ROOMS, ax).lines
    doors = doors.get_xydata().reshape(-1, 3, 2)[:, :2].mean(axis=1)

    assert sorted(map(tuple, doors)) == [(1.0, 0.5), (3.0, 1.5), (3.5, 1.0)]
    assert sorted(map(tuple, goals.get_xydata())) == [
        (0.5, 0.5),
        (0.5, 1.5),
        (1.5, 1.5),
    ]
    assert np.nansum(np.abs(np.diff(walls.get_xydata()[:2], axis=0))) > 0


def test_the_alt_text_of_a_map_counts_what_is_there():
    assert plotting.describe_map(TWO_ROOMS, goal=5) == (
        "Building of 2 by 4 cells, goal in row 2, column 2: 2 rooms, 3 goals, "
        "3 doors, a corridor of 4 cells."
    )
    assert "no corridor" in plotting.describe_map(parse_map("+---+\n|  *|\n+---+"))


def test_a_cell_without_goal_is_refused(ax):
    with pytest.raises(ValueError, match="goal must be a goal cell of the map, got 1"):
        plotting.plot_map(TWO_ROOMS, ax, goal=1)


@pytest.mark.parametrize(
    ("v", "finding"),
    [
        (-np.arange(8.0), "values rise from −7.0 in row 2, column 4 to 0.0 in row 1"),
        (np.arange(8.0), "values rise from 0.0 in row 1, column 1 to 7.0 in row 2"),
        (np.full(8, -1.0), "all values are −1.000"),
        (np.r_[np.nan, np.arange(7)], "1 cell without a value"),
    ],
)
def test_the_alt_text_of_values_says_where_they_are_high(v, finding):
    alt = plotting.describe_values(TWO_ROOMS, v, goal=0)

    assert finding in alt
    assert 40 <= len(alt) <= 300


@pytest.mark.parametrize("v", [np.zeros(7), np.full(8, np.nan)])
def test_values_that_are_no_values_of_the_cells_are_refused(v, ax):
    with pytest.raises(ValueError, match=r"v must hold numbers in shape \(8,\)"):
        plotting.plot_values(TWO_ROOMS, v, ax)


def test_an_arrow_is_as_long_as_its_direction_is_probable(ax):
    """One cell and a goal to its east, seen behind a door; moves succeed 9 in 10."""
    tasks = navigation_tasks(parse_map("+---+\n|.d*|\n+---+"))
    policy = np.zeros((2, 8))
    policy[:, tasks.actions.index("see_room_head_to_goal")] = 0.5
    policy[:, tasks.actions.index("see_room_opposite_to_goal")] = 0.5
    (start, tip, *_) = plotting.plot_policy(tasks, policy, ax=ax).lines[-1].get_xydata()

    np.testing.assert_allclose(start, [0.5, 0.5])
    np.testing.assert_allclose(tip, [0.5 + 0.52 * 0.45, 0.5])
    assert "nearer to the goal with 0.45" in plotting.describe_policy(tasks, policy)


def test_the_alt_text_of_a_policy_says_how_much_of_it_helps(tasks):
    head = np.array([name.endswith("head_to_goal") for name in tasks.actions])
    toward = tasks.available * head
    away = tasks.available * ~head
    uniform = [x / np.maximum(x.sum(axis=1, keepdims=True), 1) for x in (toward, away)]
    good, bad = (plotting.describe_policy(tasks, policy, 2) for policy in uniform)
    nearer = [float(re.search(r"goal with (0\.\d\d)", alt)[1]) for alt in (good, bad)]

    assert nearer[0] > 2 * nearer[1]
    assert "it never does" in bad


def test_walking_distance_goes_through_doors():
    """From the cell above the goal's neighbour, the way leads around."""
    distance = walking_distance(TWO_ROOMS, goal=4)

    assert distance.tolist() == [7, 6, 5, 4, 0, 1, 2, 3]


def test_cells_that_look_alike_have_the_same_number(tasks):
    states = np.flatnonzero(tasks.task == 5)
    rank, goal = abstract_ranks(tasks, 5), tasks.goal[5]
    sizes = np.bincount(np.delete(rank, goal))

    assert rank[goal] == -1
    assert (np.diff(sizes) <= 0).all()
    assert len(set(zip(rank, tasks.rho[states], strict=True))) == len(sizes) + 1
    assert f"look like {len(sizes)} abstract states" in plotting.describe_features(
        tasks, 5
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"feature": "see_all"}, "feature must be one of"),
        ({"feature": "in_room", "z": 1}, "feature or z, not both"),
        ({"z": 5000}, "z must lie in 0..2047"),
        ({"task": 11}, r"task must lie in 0\.\.10, got 11"),
    ],
)
def test_a_feature_or_task_that_is_not_there_is_refused(tasks, options, message):
    with pytest.raises(ValueError, match=message):
        plotting.figure(plotting.plot_features, tasks, **options)


def test_a_policy_of_another_shape_is_refused(tasks, ax):
    with pytest.raises(ValueError, match=r"policy must have shape \(1485, 8\)"):
        plotting.plot_policy(tasks, np.ones((2048, 8)), ax=ax)


# --- the ladder --------------------------------------------------------------


def boxes_of_text(ax):
    """Return the boxes of all words of a drawn axes, and the box of the figure."""
    FigureCanvasAgg(ax.figure).draw()
    texts = [text for text in ax.findobj(Text) if text.get_text().strip()]
    # An annotation's own extent would hold its line as well.
    return [Text.get_window_extent(text) for text in texts], ax.figure.bbox


TIGHT = (-70.0, -70.1, -70.2, -70.3, -70.0)
LADDERS = [PAPER, ladder(*TIGHT), ladder(*TIGHT) | ladder(*TIGHT, column="target")]


@pytest.mark.parametrize("result", LADDERS)
def test_labels_of_the_ladder_do_not_overlap_and_lie_inside(result, ax):
    boxes, figure = boxes_of_text(plotting.plot_ladder(result, ax))
    overlaps = [
        (a, b)
        for i, a in enumerate(boxes)
        for b in boxes[:i]
        if a.overlaps(b) and min(a.y1, b.y1) - max(a.y0, b.y0) > 3
    ]

    assert overlaps == []
    assert all(figure.x0 <= box.x0 and box.x1 <= figure.x1 for box in boxes)


def test_ours_are_filled_marks_and_the_papers_hollow_ones(ax):
    plotting.plot_ladder(ladder(-90, -50, -40, -30, -10), ax)
    marked = [line for line in ax.lines if line.get_marker() not in ("None", None)]
    hollow = [line for line in marked if line.get_markerfacecolor() == "none"]

    assert len(marked) == 10
    assert [line.get_ydata()[0] for line in hollow] == list(PAPER["source"].values())


def test_a_mark_steps_aside_where_it_would_hide_another(ax):
    plotting.plot_ladder(ladder(-90, -50, -40.1, -40, -10), ax, paper=None)
    marks = {line.get_marker(): line.get_xdata()[0] for line in ax.lines[1::2]}
    nd, prob, grad = (marks[plotting.arm_style(row).marker] for row in ROWS[1:4])

    assert nd == prob == 0
    assert abs(grad) >= 0.08


@pytest.mark.parametrize(
    ("result", "paper", "finding"),
    [
        (PAPER, PAPER, "Target: optimal −29.1, Prob −70.0, Grad −70.3, ND −80.4"),
        (PAPER, PAPER, "The order is the paper's."),
        (ladder(-9, -5, -4, -3, -1), PAPER, "The order is the paper's."),
        (ladder(-9, -5, -3, -4, -1), PAPER, "Prob −3.0, Grad −4.0, ND −5.0"),
        (ladder(-9, -5, -3, -4, -1), PAPER, "The order is not the paper's."),
        (ladder(-5, -9, -3, -4, -1), None, "ND −9.0."),
    ],
)
def test_the_alt_text_of_the_ladder_states_the_order(result, paper, finding):
    alt = plotting.describe_ladder(result, paper=paper)

    assert finding in alt
    assert 40 <= len(alt) <= 300


def test_a_row_that_the_paper_has_not_is_left_out_of_the_comparison():
    columns = {
        name: column | {"uniform_available": -50} for name, column in PAPER.items()
    }
    alt = plotting.describe_ladder(columns, rows=(*ROWS, "uniform_available"))

    assert "eager −50.0" in alt
    assert alt.endswith("The order is the paper's.")


@pytest.mark.parametrize(
    ("result", "message"),
    [
        ({"unseen": 0.1}, "result must hold source or target"),
        ({"source": {"rand": -1.0}}, "must hold a number for 'nd'"),
        (ladder(-9, -5, -4, np.nan, -1), "must hold a number for 'grad'"),
    ],
)
def test_a_ladder_without_its_numbers_is_refused(result, message):
    with pytest.raises(ValueError, match=message):
        plotting.figure(plotting.plot_ladder, result)


@given(st.lists(st.floats(-100, 100), max_size=9), st.floats(0.1, 10))
def test_labels_are_spread_by_the_gap_in_their_order(y, gap):
    places = spread(y, gap)
    order = np.argsort(y, kind="stable")

    assert (np.diff(places[order]) >= gap - 1e-9).all()
    if len(y) > 1 and np.diff(np.sort(y)).min() >= gap:
        np.testing.assert_allclose(places, y, atol=1e-9)


@pytest.mark.parametrize(("x", "text"), [(-0.04, "0.0"), (-81.03, "−81.0"), (2, "2.0")])
def test_a_number_has_a_true_minus_sign_and_no_negative_zero(x, text):
    assert number(x) == text


# --- learning runs -----------------------------------------------------------


def test_labels_of_nine_curves_do_not_overlap(ax):
    boxes, figure = boxes_of_text(plotting.plot_curves(runs(NINE, 60), ax))
    names = sorted(boxes[:9], key=lambda box: box.y0)

    assert all(a.y1 <= b.y0 + 3 for a, b in zip(names, names[1:], strict=False))
    assert all(box.x1 <= figure.x1 for box in boxes)


def test_a_curve_is_the_mean_of_its_runs_in_millions_of_steps(ax):
    goals = {"nd-soft": np.array([[0.0, 10.0], [20.0, 30.0]])}
    (line,) = plotting.plot_curves(goals, ax, window=2_000_000).lines

    np.testing.assert_array_equal(line.get_xydata(), [[1, 10], [3, 20]])


def test_a_band_of_another_length_is_refused(ax):
    bands = {"none": (np.zeros(3), np.ones(3))}

    with pytest.raises(ValueError, match=r"bands\['none'\] must be two arrays"):
        plotting.plot_curves(runs({"none": 5.0}, 2), ax, bands=bands)


def test_the_alt_text_of_curves_names_who_leads():
    slow = np.array([[1.0, 50.0]])
    fast = np.array([[20.0, 30.0]])
    alt = plotting.describe_curves({"none": slow, "nd-hard": fast})
    other = plotting.describe_curves({"none": fast, "nd-hard": slow})

    assert "Last of 2 windows: Q-learning 50, ND hard 30." in alt
    assert "First window: ND hard 20, Q-learning 1." in alt
    assert "Last of 2 windows: ND hard 50, Q-learning 30." in other


def test_the_alt_text_of_boxes_ranks_the_arms():
    alt = plotting.describe_boxes(runs(NINE))
    turned = plotting.describe_boxes(runs({"none": 600_000, "nd-soft": 300_000}))

    assert "best first: ND soft 567k, ND hard 561k, Grad soft 469k" in alt
    assert (
        "best first: Q-learning 600k, ND soft 300k. The best reaches 2 times" in turned
    )


def test_a_box_spans_the_quartiles(ax):
    plotting.plot_boxes({"prob-soft": np.arange(101.0)}, ax)
    (box,) = ax.patches

    assert (box.get_x(), box.get_x() + box.get_width()) == (25, 75)


def test_the_alt_text_of_tau_names_the_best_of_each_arm():
    goals = np.array([[5.0, 7.0], [9.0, 9.0], [4.0, 4.0]])
    data = {"rand-hard": (TAUS, goals), "nd-soft": (TAUS[::-1], goals)}
    alt = plotting.describe_tau(data, paper={"rand-hard": 3.5e6, "nd-soft": 11e6})

    assert "wanderer hard 3.5 (9), ND soft 3.5 (9)" in alt
    assert alt.endswith("The paper's tau is the best for 1 of 2.")


def test_taus_are_drawn_in_ascending_order(ax):
    goals = np.array([[1.0], [2.0], [3.0]])
    plotting.plot_tau({"nd-soft": (TAUS[::-1], goals)}, ax)

    np.testing.assert_array_equal(ax.lines[0].get_xdata(), TAUS / 1e6)
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), [3, 2, 1])


@pytest.mark.parametrize(
    ("plot", "data", "message"),
    [
        (plotting.plot_curves, {}, "at least one arm"),
        (plotting.plot_curves, {"none": np.ones(3)}, r"of shape \(N, B\), got \(3,\)"),
        (plotting.plot_curves, {"all": np.ones((1, 2))}, "arm must be one of"),
        (plotting.plot_boxes, {"none": np.array([1, np.nan])}, "must be finite"),
        (plotting.plot_tau, {}, "at least one arm"),
        (
            plotting.plot_tau,
            {"none": (TAUS, np.ones((2, 5)))},
            r"taus \(n,\) and goals",
        ),
    ],
)
def test_runs_that_are_none_are_refused(plot, data, message):
    with pytest.raises(ValueError, match=message):
        plotting.figure(plot, data)


def test_curves_of_different_lengths_are_refused(ax):
    data = runs({"none": 1.0}, 2) | runs({"nd-soft": 1.0}, 3)

    with pytest.raises(ValueError, match="same number of windows"):
        plotting.plot_curves(data, ax)


@given(st.dictionaries(st.sampled_from(list(NINE)), st.floats(0, 1e8), min_size=1))
def test_alt_texts_of_any_runs_keep_their_length(means):
    alts = [
        plotting.describe_boxes(runs(means)),
        plotting.describe_curves(runs(means, 4)),
        plotting.describe_tau(
            {arm: (TAUS, np.full((3, 2), x)) for arm, x in means.items()}
        ),
    ]

    assert all(40 <= len(alt) <= 300 for alt in alts)
