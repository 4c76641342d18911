"""Slides for the wall: one a scene, from the guide and the pages; no network needed."""

import re

import pytest
import slides
from legible import faults
from support import ROOT

from abstransfer.scenes import KINDS

SLIDES = slides.slides(ROOT / "book")
SECTIONS = dict(re.findall(r'<section id="(\w+)"(.*?)</section>', SLIDES, re.DOTALL))
SHOWN = (
    "[...document.querySelectorAll('section')].filter(s => !s.hidden).map(s => s.id)"
)


def test_each_scene_has_one_slide():
    assert sorted(re.findall(r'<section id="(\w+)"', SLIDES)) == sorted(KINDS)


@pytest.mark.parametrize("name", KINDS)
def test_a_slide_has_its_question_a_picture_in_words_and_a_way_to_the_scene(name):
    text = SECTIONS[name]

    assert re.search(r'<svg role="img" [^>]*aria-label="[^"]{15,}"', text)
    assert re.search(r"Then ask:</b> [^<]+\?", text)
    page, moment = re.search(r'href="(\w+)\.html#([^"]+)"', text).groups()
    assert (ROOT / "book" / f"{page}.ipynb").is_file()
    assert f"&amp;{name}.wall=1" in moment
    words = re.sub(r"<svg.*?</svg>|<[^>]+>", " ", text, flags=re.DOTALL)
    assert not re.search(r"[$`\\*{}]|None", words), "a mark that is no HTML"


@pytest.mark.parametrize("name", sorted(set(KINDS) - {"sights"}))
def test_a_slide_has_the_bet_of_its_scene(name):
    question, options = re.search(
        r"<p><b>Bet.</b> (.+?)</p><ul>(.+?)</ul>", SECTIONS[name], re.DOTALL
    ).groups()

    assert question.endswith("?")
    assert options.count("<li>") >= 2


def test_slides_turn_by_keys_and_need_no_network(visit):
    tab = visit(width=1920)
    page = tab.open("slides")
    names = list(SECTIONS)
    assert page.evaluate(SHOWN) == names[:1]
    for key, wanted in [("ArrowRight", 1), ("PageDown", 2), ("ArrowLeft", 1)]:
        page.keyboard.press(key)
        assert page.evaluate(SHOWN) == [names[wanted]]
    page.keyboard.press("End")
    page.keyboard.press("ArrowRight")
    assert page.evaluate(SHOWN) == names[-1:]
    assert page.url.endswith(f"#{names[-1]}")
    page.get_by_role("button", name="Back").click()
    assert page.evaluate(SHOWN) == names[-2:-1]
    page.keyboard.press("Home")
    assert page.evaluate("document.activeElement.id") == names[0], "it is read aloud"
    assert tab.problems == []


@pytest.mark.parametrize(
    ("width", "color", "letters"),
    [(360, "light", 16), (1440, "dark", 24), (1920, "light", 32)],
)
def test_a_slide_has_large_letters_and_fits(visit, width, color, letters):
    page = visit(width=width, color_scheme=color).open("slides")
    for _ in KINDS:
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        page.keyboard.press("ArrowRight")
    size = page.evaluate("parseFloat(getComputedStyle(document.body).fontSize)")
    assert size >= letters
    assert faults(page) == []


def test_a_slide_leads_to_its_scene_in_large(visit):
    tab = visit()
    page = tab.open("slides", "#race")
    page.get_by_role("link", name="Show it live").click()
    page.wait_for_selector(".abstransfer-scene.ab-enlarged")
    assert "race.wall=1" in page.url
    assert tab.problems == []
