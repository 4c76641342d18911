"""What a reader bet and chose is kept or forgotten; it reads without scripts too."""

from support import drawn
from test_bets import BETS


def test_a_bet_and_a_choice_are_kept_and_forgotten(visit):
    name, tab = "00_race", visit()
    page = drawn(tab.open(name))
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


def test_one_button_forgets_all_pages_asks_first_and_can_be_undone(visit):
    tab = visit()
    page = tab.page
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
