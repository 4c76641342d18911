"""The built book as files: whole, described, and free of the network."""

import re
import runpy
from functools import cache
from urllib.parse import unquote, urlsplit

import pytest
from bs4 import BeautifulSoup
from fontTools.ttLib import TTFont
from support import ROOT, toc_pages

from abstransfer.exercises import exercises_of, open_exercises_of
from abstransfer.exercises._model import first_of

TERMS = runpy.run_path(str(ROOT / "book" / "_ext" / "terms.py"))
PAGES = toc_pages()
LOADS = {  # what a browser fetches by itself, and from which attribute
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "video": "src",
    "audio": "src",
    "embed": "src",
    "object": "data",
    "image": "href",
    "link": "href",
}


@cache
def soup(path):
    return BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser")


@cache
def anchors(path):
    return {tag["id"] for tag in soup(path).find_all(id=True)}


@pytest.mark.parametrize("name", PAGES)
def test_a_page_of_the_table_of_contents_is_there_and_says_something(html, name):
    article = soup(html / f"{name}.html").find("article")

    assert len(article.get_text(" ", strip=True).split()) >= 50


@pytest.mark.parametrize("name", PAGES)
def test_a_page_has_one_first_heading(html, name):
    # The theme adds one to each page that only a printer shows.
    article = soup(html / f"{name}.html").find("article")

    assert len(article.find_all("h1")) == 1


@pytest.mark.parametrize("name", PAGES)
def test_tables_and_examples_are_drawn_as_such(html, name):
    article = soup(html / f"{name}.html").article
    code = {id(s) for tag in article.find_all(["pre", "code"]) for s in tag.strings}
    text = "".join(said for said in article.strings if id(said) not in code)

    assert not re.findall(r"(?:\|\s*:?---|>>> ).*", text), "Markdown or Python as text"


def test_no_value_in_the_reference_is_longer_than_a_few_lines(html):
    for path in html.glob("api*.html"):
        for value in soup(path).select("dt.sig em.property"):
            assert len(value.get_text()) < 500, value.find_parent("dt")["id"]


@pytest.mark.parametrize("name", PAGES)
def test_every_picture_is_described(html, name):
    for picture in soup(html / f"{name}.html").find("article").find_all("img"):
        alt = picture.get("alt", "")
        assert 40 <= len(alt) <= 300, f"{picture['src']}: {alt!r}"
        assert not alt.startswith("_images/")


@pytest.mark.parametrize("name", [name for name in PAGES if name[:2].isdigit()])
def test_each_exercise_has_a_box_and_its_hints_one_inside_the_other(html, name):
    text, page = soup(html / f"{name}.html"), int(name[:2])
    for key, exercise in (exercises_of(page) | open_exercises_of(page)).items():
        place = text.find(id=first_of(key))
        boxes = [box for box in place.select(".ab-answer") if f'"{key}"' in str(box)]
        hint, words = boxes[0].find_next_sibling("details"), []
        while hint:
            words.append(" ".join(hint.find("p").get_text().split()))
            hint = hint.find("details")

        assert len(boxes) == 1
        # Stars are of stress or of products, and stay in code.
        marks = str.maketrans("", "", "`*")
        told = [word.translate(marks) for word in words]
        assert told == [hint.translate(marks) for hint in exercise.hints]


def test_no_page_loads_anything_from_elsewhere(html):
    remote = [
        (path.name, tag.name, tag[LOADS[tag.name]])
        for path in html.glob("**/*.html")
        for tag in soup(path).find_all(list(LOADS))
        if urlsplit(tag.get(LOADS[tag.name], "")).netloc
    ]

    assert remote == []


def test_no_style_loads_anything_from_elsewhere(html):
    sheets = {path: path.read_text(encoding="utf-8") for path in html.glob("**/*.css")}
    for path in html.glob("**/*.html"):
        inline = [tag.get_text() for tag in soup(path).find_all("style")]
        sheets[path] = "\n".join(inline)
    remote = r"(?:url\(\s*['\"]?|@import\s+['\"])(?:https?:)?//[^'\")]*"

    assert len(sheets) > len(PAGES)
    assert {p.name: re.findall(remote, text) for p, text in sheets.items()} == {
        p.name: [] for p in sheets
    }


def test_no_script_in_a_page_names_another_host(html):
    for path in html.glob("**/*.html"):
        for script in soup(path).find_all("script", src=False):
            assert not re.search(r"['\"](?:https?:)?//", script.get_text()), path.name


def test_all_scripts_of_a_page_are_files(html):
    """A server may forbid others; data are none, and the slides are one file."""
    inside = [
        (path.name, str(tag)[:200])
        for path in html.glob("**/*.html")
        if path.name != "slides.html"
        for tag in soup(path).find_all(True)
        if (tag.name == "script" and not tag.get("src") and "json" not in str(tag))
        or any(name.startswith("on") for name in tag.attrs)
    ]

    assert inside == []


def test_a_page_waits_for_few_scripts_and_styles(html):
    for name in PAGES:
        head = soup(html / f"{name}.html").head
        scripts = [
            tag["src"]
            for tag in head.find_all("script", src=True)
            if not {"defer", "async"} & set(tag.attrs) and not tag.get("type")
        ]
        styles = [tag["href"] for tag in head.find_all("link", rel="stylesheet")]
        weight = [
            sum((html / urlsplit(address).path).stat().st_size for address in found)
            for found in (scripts, styles)
        ]

        assert 0 < weight[0] < 2_000, scripts
        assert len(styles) == 1  # each is a way to the server and back
        assert 0 < weight[1] < 180_000, styles


def test_a_page_has_an_icon_and_a_description_and_no_script_of_icons(html):
    for name in PAGES:
        head = soup(html / f"{name}.html").head

        assert (html / head.find("link", rel="icon")["href"]).is_file()
        assert len(head.find("meta", attrs={"name": "description"})["content"]) > 40
        assert "fontawesome.js" not in str(head)  # 1.5 MB; a font has them too


def test_fonts_of_icons_hold_the_icons_of_the_pages_and_no_others(html):
    fonts = html.glob("_static/vendor/fontawesome/webfonts/*")
    held = set().union(*(TTFont(path).getBestCmap() or {} for path in fonts))
    paths = html.glob("_static/styles/page-*.css")
    styles = "".join(path.read_text("utf-8") for path in paths)
    named = {int(code, 16) for code in re.findall(r"\\(f[0-9a-f]{3})\b", styles)}
    named |= {ord(letter) for letter in styles if "\uf000" <= letter <= "\uf8ff"}

    assert 10 < len(held) < 100
    assert held == named
    assert "woff2" not in styles


def test_a_picture_has_its_room_before_it_comes(html):
    found = [
        tag
        for name in PAGES
        for tag in soup(html / f"{name}.html").find("article").find_all("img")
    ]

    assert len(found) > 20
    for tag in found:
        size = re.search(
            r'viewBox="0 0 ([\d.]+) ([\d.]+)"', (html / tag["src"]).read_text("utf-8")
        )
        width, height = (float(points) * 4 / 3 for points in size.groups())
        assert int(tag["width"]) == pytest.approx(width, abs=1)
        assert int(tag["height"]) == pytest.approx(height, abs=1)


def is_place(page, name):
    """Return whether a page has such an anchor, or a scene of which it is a moment."""
    moment = re.fullmatch(r"(\w+)\.\w+=.+", name)
    if moment:
        return bool(soup(page).find(attrs={"data-scene": moment[1]}))
    return name in anchors(page)


def test_every_link_inside_the_book_leads_somewhere(html):
    broken = []
    for path in html.glob("**/*.html"):
        for link in soup(path).find_all("a", href=True):
            url = urlsplit(link["href"])
            if url.scheme or url.netloc:
                continue
            goal = (path.parent / unquote(url.path)).resolve() if url.path else path
            place = unquote(url.fragment) if goal.suffix == ".html" else ""
            if not goal.is_file() or place and not is_place(goal, place):
                broken.append((path.name, link["href"]))

    assert broken == []


def test_every_page_in_the_folder_is_in_the_table_of_contents():
    written = [p for p in (ROOT / "book").glob("*") if p.suffix in (".md", ".ipynb")]

    assert sorted(page.stem for page in written) == sorted(PAGES)


def test_every_public_module_is_in_the_reference_once():
    reference = [
        path.read_text(encoding="utf-8")
        for path in sorted((ROOT / "book").glob("api*.md"))
    ]
    listed = re.findall(r"automodule:: abstransfer\.([\w.]+)", "".join(reference))
    package = ROOT / "abstransfer"
    public = {
        ".".join(path.relative_to(package).with_suffix("").parts)
        for path in package.glob("**/[a-z]*.py")
    }
    # These are shown by their rooms.
    apart = (
        "builders.",
        "learning.learner",
        "scenes.",
        "exercises.",
        "plotting.",
        "classroom.handed_in",
        "classroom.worker",
        "cli.",
    )
    public = {name for name in public if not name.startswith((*apart, "cli."))}

    assert len(listed) == len(set(listed))
    assert not public - set(listed), "each needs a section in its room's page"


@pytest.mark.parametrize("name", PAGES)
def test_what_a_drawn_picture_says_stands_below_it_too(html, name):
    for picture in soup(html / f"{name}.html").select("article .cell_output img"):
        caption = picture.find_next(class_="ab-caption")

        assert caption.get_text() == picture["alt"]
        assert caption["aria-hidden"] == "true", "a screen reader is told it once"


EVERYDAY = TERMS["EVERYDAY"]


SKIPPED = {
    *("h1", "h2", "h3", "h4", "code", "pre", "script", "style", "figure"),
    "summary",  # and an option of a bet: each is pressed as a whole
}
BESIDE = ["ab-caption", "ab-answer", "ab-hint"]  # not in the order of reading


def glossary(html):
    """Return the words of the glossary that mean one thing only."""
    words = [
        t.get_text() for t in soup(html / "notation.html").select("dl.glossary dt")
    ]
    words = [re.sub(r"\W+$", "", word) for word in words]

    assert len(words) > 50
    return [w for w in words if w.lower() not in EVERYDAY and "," not in w]


def first_use(article, word):
    """Return the node of running text that uses a word first, or None."""
    found = TERMS["pattern"](word)
    for text in article.find_all(string=found):
        inside = {tag.name for tag in text.parents}
        if inside & SKIPPED or text.find_parent(class_=BESIDE):
            continue
        options = text.find_parent("ul")
        if options is None or not options.parent.get("id", "").startswith("bet-"):
            return text
    return None


@pytest.mark.parametrize("name", [n for n in PAGES if re.match(r"\d|intro", n)])
def test_the_first_use_of_a_word_of_the_glossary_leads_there_or_says_it(html, name):
    article = soup(html / f"{name}.html").find("article")
    for word in glossary(html):
        text = first_use(article, word)
        if text is None:
            continue
        around = text.find_parent(["a", "strong", "em", "b"])
        tag = around.name if around else "nothing"
        assert tag != "nothing", f"{word}: {text.strip()[:80]}"


def test_each_word_of_every_day_is_set_off_where_a_page_explains_it(html):
    """Words with a sense of their own here: no link by itself, but a place."""
    set_off = set()
    for path in html.glob("[0-9]*.html"):
        for tag in soup(path).find("article").select("strong, em, b, a.term, a > span"):
            set_off.add(tag.get_text().lower().strip(" .:,"))
    plain = {word for word in EVERYDAY if not {word, word + "s"} & set_off}

    assert not plain, sorted(plain)
