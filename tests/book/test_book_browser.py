"""The built book in a browser, opened from files, with the network cut."""

import pytest
from legible import faults, pale
from support import Visit, drawn, toc_pages
from test_bets import BETS, plain
from test_moments import links
from test_pages import BOOK, LESSONS, questions, text_of

# What the theme itself does wrong: (rule, part of the element).
KNOWN = (
    ("region", "sidebar-primary-item"),
    ("aria-allowed-role", "doc-biblioentry"),
    ("aria-deprecated-role", "doc-biblioentry"),
    ("aria-required-children", "citation-list"),
)
WIDE = {"width": 1440, "height": 900}
WIDTHS = [*range(320, 1921, 64), 360, 400, 600, 768, 820, 1240, 1366]  # pixels
SINGLE = 768  # from this width on a building is whole
PICTURES = """async (n) => {
    while (n--) await new Promise(requestAnimationFrame);
}"""
LOOK = """() => ({
    page: document.documentElement.scrollWidth,
    frames: [...document.querySelectorAll(".ab-frame")].map((frame) => ({
        hidden: frame.scrollWidth - frame.clientWidth,
        isShown: (frame.dataset.cut ?? "").includes("right"),
        name: frame.getAttribute("aria-label") ?? "",
    })),
})"""
# Displayed formulas that need more room than their column, and how much.  It is the
# element of MathJax that scrolls, not ours around it.
WIDER = """() => [...document.querySelectorAll("article div.math > mjx-container")]
    .map((box) => [box.parentNode.id, box.scrollWidth, box.clientWidth])
    .filter(([, needed, given]) => needed > given + 1)"""
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
NAMES = [path.stem for path in LESSONS]
GLIDES = "01_building"
# What a scene shows.
STATE = """scene => [scene.querySelector('.ab-body').innerHTML,
    ...[...scene.querySelectorAll('input')].map((e) => e.value + e.checked)].join()"""
UNFOLDED = """() => {
    for (const details of document.querySelectorAll("details:not([class])"))
        details.open = true;
}"""
# Only what axe looks at needs to be painted.
PAINT = "opacity => (document.body.style.opacity = opacity)"
each_lesson = pytest.mark.parametrize("page", NAMES, indirect=True)


@pytest.fixture(scope="module", params=toc_pages())
def page(tab, request):
    """A page of the book, opened once for all that is asked of it."""
    tab.problems.clear()
    tab.page.emulate_media(color_scheme="light")
    tab.open(request.param)
    tab.page.evaluate(PAINT, 0)
    return drawn(tab.page)


def name_of(page):
    return page.url.rpartition("/")[2].partition(".")[0]


@pytest.fixture(scope="module")
def looks():
    """Looks of text that axe judged, on whichever page, in the light or the dark."""
    return set()


def test_a_page_draws_its_formulas(page):
    n_formulas = page.locator(".math").count()

    assert page.locator("mjx-container").count() == n_formulas
    assert page.locator("mjx-merror, [data-mjx-error]").count() == 0


def test_a_page_is_accessible(page, looks):
    page.evaluate(PAINT, 1)
    assert unknown(faults(page, known=looks)) == []
    page.evaluate(PAINT, 0)


@pytest.fixture
def at_width(page):
    """What a page looks like in a window of a width; a low one is laid out sooner."""

    def look(width):
        page.set_viewport_size({"width": width, "height": 100})
        page.evaluate(PICTURES, 2)
        return page.evaluate(LOOK)

    yield look
    page.set_viewport_size(WIDE)


def test_a_page_and_its_formulas_fit_a_phone(page, at_width):
    """A formula could scroll, but what is cut looks complete: lines are broken."""
    for width in (400, 320):
        assert at_width(width)["page"] == width
        assert page.evaluate(WIDER) == []


@pytest.mark.parametrize("page", ["genindex"], indirect=True)
def test_the_index_fits_a_phone(at_width):
    assert [at_width(width)["page"] for width in (320, 400)] == [320, 400]


@pytest.mark.parametrize(
    "page",
    ["00_race", "01_building", "02_solving", "03_learning", "04_abstraction"]
    + ["05_inducing", "07_driving_test", "12_your_turn"],
    indirect=True,
)
def test_no_building_is_cut_without_a_sign(at_width):
    wrong = []
    for width in WIDTHS:
        found = at_width(width)
        wrong += [f"the page at {width}"] if found["page"] > width else []
        for frame in found["frames"]:
            is_cut = frame["hidden"] > 0
            if is_cut != frame["isShown"] or (is_cut and not frame["name"]):
                wrong.append(f"no sign at {width}: {frame}")
            if is_cut and width >= SINGLE:
                wrong.append(f"cut at {width}: {frame}")

    assert wrong == []


@pytest.mark.parametrize(
    "page",
    ["03_learning", "07_driving_test", "08_advice", "10_worst_driver", "11_neighbours"],
    indirect=True,
)
def test_letters_may_stand_wider_apart(page, at_width):
    style = page.add_style_tag(content=SPACED)
    wrong = []
    for width in (1280, 320):
        found = at_width(width)
        wrong += [(width, found["page"])] if found["page"] > width else []
        wrong += [(width, *text) for text in page.evaluate(CUT)]
    style.evaluate("style => style.remove()")

    assert wrong == []


@pytest.mark.parametrize("page", ["01_building"], indirect=True)
def test_a_cell_of_an_editor_is_large_enough_for_a_finger(page, at_width):
    at_width(360)
    cell = page.locator("[data-scene=studio] .ab-tile").first
    box = cell.evaluate("e => e.getBoundingClientRect().toJSON()")

    assert round(min(box["width"], box["height"]), 1) >= 24


def test_who_chooses_in_a_quiz_by_keyboard_gets_the_reply_of_that_choice(page):
    source = BOOK / f"{name_of(page)}.ipynb"
    asked = questions(text_of(source)) if source in LESSONS else []
    question_of = [n for n, choices in enumerate(asked) for _ in choices]
    choices = page.locator("section#quiz details")
    assert choices.count() == len(question_of)
    for i, question in enumerate(question_of):
        choices.nth(i).locator("summary").focus()
        page.keyboard.press("Enter")
        is_open = choices.evaluate_all("choices => choices.map(c => c.open)")
        chosen = [j for j, n in enumerate(question_of) if n == question and is_open[j]]
        assert chosen == [i], "the others of the question are closed"

    assert page.locator("section#quiz .quiz-right").count() == len(asked)


def test_a_page_and_its_pictures_are_legible_in_the_dark(page, looks):
    page.emulate_media(color_scheme="dark")
    page.wait_for_function("document.documentElement.dataset.theme == 'dark'")
    drawn(page)
    page.evaluate(PAINT, 1)

    assert unknown(pale(page, known=looks)) == []
    page.evaluate(PAINT, 0)
    pictures = page.locator("article img").evaluate_all(
        "images => images.map(i => getComputedStyle(i))"
        ".map(style => style.backgroundColor + ' ' + style.filter)"
    )
    assert set(pictures) <= {"rgb(255, 255, 255) none"}, "they stand on a light card"


@each_lesson
def test_a_bet_is_placed_by_keyboard_folds_and_is_replied_to(page, tab):
    for bet in BETS[name_of(page)]:
        box, reply = (
            page.locator(f"#{kind}{bet.name.removeprefix('bet-')}")
            for kind in ("bet-", "reply-")
        )
        options = box.get_by_role("group").get_by_role("button")
        wrong = next(o for o in bet.options if plain(o) != plain(bet.answer))
        assert options.count() == len(bet.options) + bool(bet.asks)
        for option, end in ((wrong, "”."), (bet.answer, "”: right.")):
            index = [plain(o) for o in bet.options].index(plain(option))
            options.nth(index).focus()
            page.keyboard.press("Enter")
            assert not options.first.is_visible(), "it folds"
            change = box.get_by_role("button", name="Your bet:")
            assert change.evaluate("e => e === document.activeElement")
            assert reply.locator(".bet-said").inner_text().endswith(end)
            page.keyboard.press("Enter")
            assert options.first.is_visible()
    page.evaluate(PICTURES, 4)
    assert tab.problems == []


@pytest.mark.parametrize(
    "page", [n for n in NAMES if any(b.asks for b in BETS[n])], indirect=True
)
def test_a_scene_and_its_page_say_a_bet_in_the_same_words(page, tab):
    for bet in (b for b in BETS[name_of(page)] if b.asks):
        box = page.locator(f"#{bet.name}")
        for index in range(len(bet.options)):
            if not box.locator(".bet-option").first.is_visible():
                box.get_by_role("button", name="Your bet:").click()
            button = box.locator(".bet-option").nth(index)
            text = button.evaluate("b => b.textContent").replace("’", "'")
            button.click()
            line = page.locator(f'.ab-bet:has(a[href="#{bet.name}"])')
            line.get_by_text(f"You bet on “{text}”.").wait_for()
    assert tab.problems == []


@pytest.fixture
def gliding(page):
    """On one page the browser glides to the scene and back, on others it jumps."""
    if name_of(page) == GLIDES:
        page.emulate_media(reduced_motion="no-preference")
    yield
    page.emulate_media(reduced_motion="reduce")


@each_lesson
@pytest.mark.usefixtures("gliding")
def test_each_link_changes_the_scene_and_back_returns(page, tab):
    page.evaluate("window.isSame = true")
    assert links(LESSONS[NAMES.index(name_of(page))])
    page.evaluate(UNFOLDED)
    page.evaluate(PICTURES, 4)
    # Not by its role: for this, all elements of the page would be asked for theirs.
    back = page.locator("button.moment-back", has_text="Back to the text")
    for link in page.locator("article a[href^='#'][href*='=']").all():
        href = link.get_attribute("href")
        scene = page.locator(f'[data-ab-id="{href[1:].partition(".")[0]}"]')
        before = scene.evaluate(STATE)
        link.click()
        back.wait_for()
        page.evaluate(PICTURES, 4)
        assert scene.evaluate(STATE) != before, href
        assert scene.locator(".ab-now", has_text="stays as it was").count() == 0
        assert scene.bounding_box()["y"] < 900, "it is in sight"
        back.click()
        page.wait_for_function("hash => location.hash === hash", arg="")
        page.evaluate(PICTURES, 4)
        assert link.evaluate("e => e === document.activeElement")
        assert back.count() == 0
    assert page.evaluate("isSame"), "the page was not loaded anew"
    assert tab.problems == []


def test_a_page_asks_nothing_of_the_network_and_no_script_fails(page, tab):
    assert tab.page is page
    assert tab.problems == []


@pytest.mark.parametrize("page", ["notation"], indirect=True)
def test_letters_of_formulas_come_from_the_books_own_font(page):
    loaded = page.evaluate(
        "[...document.fonts].filter(f => f.status == 'loaded').map(f => f.family)"
    )

    assert any(family.startswith("MJXTEX") for family in loaded)


def test_formulas_come_where_a_browser_does_not_say_when_it_drew(html, chromium):
    context = chromium.new_context()
    context.add_init_script(
        "Object.defineProperty(PerformanceObserver, 'supportedEntryTypes',"
        " { value: ['mark'] });"
        "PerformanceObserver.prototype.observe = () => {};"
    )
    try:
        visit = Visit(context)
        visit.folder = html
        assert drawn(visit.open("notation")).locator("mjx-container").count() > 9
    finally:
        context.close()


def test_one_pale_word_is_found(visit):
    # On a dark page the grey of the word would not be pale.
    page, looks = drawn(visit(color_scheme="light").open("how_to_cite")), set()
    page.locator("article p").first.evaluate("p => p.innerHTML += ' <i>pale</i>'")
    assert unknown(pale(page, known=looks)) == []
    page.locator("article p i").first.evaluate("word => word.style.color = '#999'")

    ((rule, html, _),) = unknown(pale(page, known=looks))
    assert rule == "color-contrast"
    assert html == '<i style="color: rgb(153, 153, 153);">pale</i>'


def unknown(found):
    """Return what axe found, but for what is known of the theme."""
    return [f for f in found if not any(r == f[0] and s in f[1] for r, s in KNOWN)]


def test_the_search_finds_a_page(visit):
    tab = visit()
    page = tab.open("search", query="?q=discount")
    page.wait_for_selector("#search-results li:has-text('Notation')")

    assert tab.problems == []


def test_a_dark_page_is_printed_light(visit):
    page = drawn(visit(color_scheme="dark").open("00_race"))
    page.wait_for_function("document.documentElement.dataset.theme == 'dark'")
    page.evaluate(
        "addEventListener('beforeprint', () => "
        "window.printed = getComputedStyle(document.body).backgroundColor)"
    )
    page.pdf(print_background=True)

    assert page.evaluate("printed") == "rgb(255, 255, 255)"
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"


@pytest.mark.parametrize("name", ["00_race", "01_building", "03_learning"])
def test_a_word_that_was_searched_for_is_marked_to_the_end_of_a_page(visit, name):
    tab = visit()
    page = drawn(tab.open(name, query="?highlight=robot"))
    # Words are marked a little after the page was loaded.
    page.locator("section#quiz .highlighted").first.wait_for(state="attached")

    assert tab.problems == []
