"""The built pages reply: to bets, to their quiz, to links to a moment of the scene."""

import pytest
from support import drawn
from test_bets import BETS, PAGES, plain
from test_moments import links

NAMES = [path.stem for path in PAGES]
GLIDES = "01_building"
STATE = """scene => [scene.querySelector('.ab-body').innerHTML,
    ...[...scene.querySelectorAll('input')].map((e) => e.value + e.checked)].join()"""
UNFOLDED = """() => {
    for (const details of document.querySelectorAll("details:not([class])"))
        details.open = true;
}"""
CALM = """() => new Promise((done) => {
    const pictures = (n) => n ? requestAnimationFrame(() => pictures(n - 1)) : done();
    pictures(4);
})"""


@pytest.fixture
def opened(visit):
    """Open a page of the book, and wait until nothing on it moves."""

    def open_page(name, query="", **looks):
        tab = visit(**looks)
        return drawn(tab.open(name, query)), tab

    return open_page


@pytest.fixture(scope="module")
def shown(tab, request):
    """Open a page once for all that is asked of it: its name, its tab."""
    tab.problems.clear()
    drawn(tab.open(request.param))
    return request.param, tab


each_page = pytest.mark.parametrize("shown", NAMES, indirect=True)


@each_page
def test_a_bet_is_placed_by_keyboard_folds_and_is_replied_to(shown):
    name, tab = shown
    page = tab.page
    for bet in BETS[name]:
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
    page.evaluate(CALM)
    assert tab.problems == []


@pytest.mark.parametrize(
    "shown", [n for n in NAMES if any(b.asks for b in BETS[n])], indirect=True
)
def test_a_scene_and_its_page_say_a_bet_in_the_same_words(shown):
    name, tab = shown
    page = tab.page
    for bet in (b for b in BETS[name] if b.asks):
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


def test_a_bet_and_a_choice_are_kept_and_forgotten(opened):
    name = "03_learning"
    page, tab = opened(name)
    bet, *_ = BETS[name]
    page.locator(f"#{bet.name} .bet-option").first.click()
    page.locator("#quiz summary").nth(1).click()
    page.reload()
    drawn(page)

    assert page.locator(f"#{bet.name}.bet-folded").count() == 1
    assert page.locator("#quiz details[open]").count() == 1
    page.evaluate(
        "sessionStorage.clear(), dispatchEvent(new Event('abstransfer:kept'))"
    )
    assert page.locator(".bet-folded").count() == 0
    assert page.locator("#quiz details[open]").count() == 0
    assert tab.problems == []


@pytest.fixture
def gliding(shown):
    """On one page the browser glides to the scene and back, on others it jumps."""
    name, tab = shown
    if name == GLIDES:
        tab.page.emulate_media(reduced_motion="no-preference")
    yield
    tab.page.emulate_media(reduced_motion="reduce")


@each_page
@pytest.mark.usefixtures("gliding")
def test_each_link_changes_the_scene_and_back_returns(shown):
    name, tab = shown
    page = tab.page
    page.evaluate("window.isSame = true")
    assert links(PAGES[NAMES.index(name)])
    page.evaluate(UNFOLDED)
    for link in page.locator("article a[href^='#'][href*='=']").all():
        href = link.get_attribute("href")
        scene = page.locator(f'[data-ab-id="{href[1:].partition(".")[0]}"]')
        page.evaluate(CALM)
        before = scene.evaluate(STATE)
        link.click()
        back = page.get_by_role("button", name="Back to the text")
        back.wait_for()
        page.evaluate(CALM)
        assert scene.evaluate(STATE) != before, href
        assert scene.locator(".ab-now", has_text="stays as it was").count() == 0
        assert scene.bounding_box()["y"] < 900, "it is in sight"
        back.click()
        page.wait_for_function("hash => location.hash === hash", arg="")
        page.evaluate(CALM)
        assert link.evaluate("e => e === document.activeElement")
        assert back.count() == 0
    assert page.evaluate("isSame"), "the page was not loaded anew"
    assert tab.problems == []


def test_a_page_without_scripts_reads_as_it_stands(html, chromium):
    context = chromium.new_context(java_script_enabled=False)
    try:
        page = context.new_page()
        page.goto((html / "03_learning.html").as_uri())
        for bet in BETS["03_learning"]:
            box = page.locator(f"#{bet.name}")
            assert box.locator("li").count() == len(bet.options)
            reply = page.locator(f"#{bet.name.replace('bet-', 'reply-')}")
            assert bet.answer in reply.inner_text()
        page.locator("summary", has_text="What you should have seen").click()
        assert page.locator("details[open] li").count() >= 3
    finally:
        context.close()


def test_one_button_forgets_all_pages_asks_first_and_can_be_undone(opened):
    page, tab = opened("00_race")
    for name in ("00_race", "03_learning"):
        tab.open(name)
        page.locator(f"#{BETS[name][0].name} .bet-option").first.click()

    def placed():
        found = []
        for name in ("00_race", "03_learning"):
            tab.open(name)
            found.append(page.locator(".bet-folded").count())
        tab.open("lecturers_guide")
        return found

    def press(name):
        box = page.locator(".reset-book")
        box.get_by_role("button", name=name).click()
        return box.get_by_role("status").inner_text()

    tab.open("lecturers_guide")
    asked = "This tab keeps bets, answers or notes of 2 pages. Forget all of it?"
    assert press("Reset the whole book") == asked
    assert press("No, keep it") == "Nothing was forgotten."
    assert press("Reset the whole book") == asked, "it was kept"
    press("Yes, forget it")
    assert press("Undo the reset").endswith("are back.")
    assert placed() == [1, 1]
    press("Reset the whole book")
    press("Yes, forget it")
    assert placed() == [0, 0]
    assert press("Reset the whole book") == "Nothing is kept in this tab."
    assert tab.problems == []
