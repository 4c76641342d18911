"""The built pages in windows of all widths: nothing sticks out, no building is cut."""

import pytest
from support import drawn

WIDTHS = [*range(320, 1921, 64), 360, 400, 600, 768, 820, 1240, 1366]  # pixels
SINGLE = 768  # from this width on a building is whole
PICTURES = """() => new Promise(
    (f) => requestAnimationFrame(() => requestAnimationFrame(f)))"""
LOOK = """() => ({
    page: document.documentElement.scrollWidth,
    frames: [...document.querySelectorAll(".ab-frame")].map((frame) => ({
        hidden: frame.scrollWidth - frame.clientWidth,
        isShown: (frame.dataset.cut ?? "").includes("right"),
        name: frame.getAttribute("aria-label") ?? "",
    })),
})"""


@pytest.fixture(scope="module")
def page(tab, request):
    """A page of the book, opened once for all that is asked of it."""
    yield drawn(tab.open(request.param))
    tab.page.set_viewport_size({"width": 1440, "height": 900})


def at_width(page, width):
    """What a page looks like in a window of a width."""
    page.set_viewport_size({"width": width, "height": 900})
    page.evaluate(PICTURES)
    return page.evaluate(LOOK)


@pytest.mark.parametrize("page", ["genindex"], indirect=True)
def test_the_index_fits_a_phone(page):
    assert [at_width(page, width)["page"] for width in (320, 400)] == [320, 400]


@pytest.mark.parametrize(
    "page",
    ["00_race", "01_building", "02_solving", "03_learning", "04_abstraction"]
    + ["05_inducing", "07_driving_test", "12_your_turn"],
    indirect=True,
)
def test_no_building_is_cut_without_a_sign(page):
    wrong = []
    for width in WIDTHS:
        found = at_width(page, width)
        wrong += [f"the page at {width}"] if found["page"] > width else []
        for frame in found["frames"]:
            is_cut = frame["hidden"] > 0
            if is_cut != frame["isShown"] or (is_cut and not frame["name"]):
                wrong.append(f"no sign at {width}: {frame}")
            if is_cut and width >= SINGLE:
                wrong.append(f"cut at {width}: {frame}")

    assert wrong == []


# What a reader may ask for who reads with difficulty (WCAG 1.4.12).
SPACED = """
* { letter-spacing: 0.12em !important; word-spacing: 0.16em !important }
article p { line-height: 1.5 !important }
"""
# Texts of charts that stick out of their picture, with the pixels.
CUT = """() => [...document.querySelectorAll("svg.ab-chart text")].flatMap((text) => {
    const [inner, outer] = [text, text.ownerSVGElement]
        .map((each) => each.getBoundingClientRect());
    const out = Math.max(inner.right - outer.right, outer.left - inner.left);
    return outer.width && out > 1 ? [[text.textContent, Math.round(out)]] : [];
})"""


@pytest.mark.parametrize(
    "page",
    ["03_learning", "07_driving_test", "08_advice", "10_worst_driver", "11_neighbours"],
    indirect=True,
)
def test_letters_may_stand_wider_apart(page):
    style = page.add_style_tag(content=SPACED)
    wrong = []
    for width in (1280, 320):
        found = at_width(page, width)
        wrong += [(width, found["page"])] if found["page"] > width else []
        wrong += [(width, *text) for text in page.evaluate(CUT)]
    style.evaluate("style => style.remove()")

    assert wrong == []


@pytest.mark.parametrize("page", ["01_building"], indirect=True)
def test_a_cell_of_an_editor_is_large_enough_for_a_finger(page):
    at_width(page, 360)
    cell = page.locator("[data-scene=studio] .ab-tile").first
    box = cell.evaluate("e => e.getBoundingClientRect().toJSON()")

    assert round(min(box["width"], box["height"]), 1) >= 24
