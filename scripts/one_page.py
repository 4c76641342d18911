"""
All pages of the built book as one page for print: what ``pdf.py`` prints.

Names and links are changed so that they stay apart and lead to their places.
"""

from __future__ import annotations

from importlib import metadata
from pathlib import Path
from urllib.parse import urlsplit

import yaml
from bs4 import BeautifulSoup
from bs4.element import Tag

ROOT = Path(__file__).parents[1]
STYLE = Path(__file__).with_name("pdf.css")
GONE = "script, a.headerlink, .prev-next-area, details.hide > summary"


def parts(toc: dict) -> list[tuple[str, list[str]]]:
    """Return the names of the pages, by the title of their part."""
    rest = [
        (part["caption"], [chapter["file"] for chapter in part["chapters"]])
        for part in toc["parts"]
    ]
    return [("", [toc["root"]]), *rest]


def one_page(html: Path, pages: list[tuple[str, list[str]]]) -> str:
    """Return the pages of a built book as one, in this order."""
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    soups = {
        name: BeautifulSoup((html / f"{name}.html").read_text("utf-8"), "html.parser")
        for _, names in pages
        for name in names
    }
    chapters, contents = [], []
    for title, names in pages:
        items = []
        for name in names:
            article = chapter(soups[name], name, html, set(soups))
            if title:
                article.h1.insert_before(kicker := Tag(name="p"))
                kicker["class"], kicker.string = "part", title
            words = article.h1.decode_contents()
            items.append(f'<li><a href="#{name}">{words}</a><span></span></li>')
            chapters.append(f'<section class="chapter" id="{name}">{article}</section>')
        contents.append(
            (f"<h3>{title}</h3>" if title else "") + f"<ol>{''.join(items)}</ol>"
        )
    version = metadata.version("abstransfer")
    return f"""<!doctype html>
<html lang="en" data-theme="light" data-mode="light"><head><meta charset="utf-8">
<title>{config["title"]}</title>
{"".join(head(soups.values(), html))}<style>{STYLE.read_text("utf-8")}</style></head>
<body><main class="bd-content">
<header><p class="title">{config["title"]}</p>
<p>A book you can run: how a robot takes what it learned in one building into the next,
taught on one paper and reproduced number by number.</p><p>{config["author"]}</p>
<p>Version {version}, {config["copyright"]}. Text, figures and maps: CC BY 4.0.
Code: MIT License.</p><nav><h2>Contents</h2>{"".join(contents)}</nav></header>
{"".join(chapters)}</main></body></html>"""


def head(soups, html: Path) -> list[str]:
    """Return the style sheets of the pages, and the scripts of the formulas."""
    found = {}
    for soup in soups:
        for tag in soup.select("head link[rel=stylesheet]"):
            path = file(html, tag["href"])
            found[path] = f'<link rel="stylesheet" href="{path}">\n'
        for tag in soup.select("head script"):
            if "mathjax/" in tag.get("src", ""):
                path = file(html, tag["src"])
                found[path] = f'<script defer src="{path}"></script>\n'
            elif "settings.js" in tag.get("src", ""):
                path = file(html, tag["src"])
                found[path] = f'<script src="{path}"></script>\n'
    return list(found.values())


def chapter(soup, name: str, html: Path, names: set[str]):
    """Return the text of a page, its names and links changed for the one page."""
    article = soup.find("article")
    for tag in article.select(GONE):
        tag.decompose()
    for tag in article.select("details"):
        tag["open"] = ""
    for tag in article.select("details.hide"):
        tag.name = "div"  # else the browser makes a title of its own
    for tag in article.select("[id]"):
        tag["id"] = f"{name}--{tag['id']}"
    for tag in article.select("[src]"):
        tag["src"] = file(html, tag["src"])
    for tag in article.select("a[href]"):
        target = link(tag["href"], name, names)
        if target is None:
            tag.unwrap()
        else:
            tag["href"] = target
    return article


def link(href: str, name: str, names: set[str]) -> str | None:
    """
    Return where a link of a page leads in the one page, None if nowhere.

    >>> link("03_learning.html#q", "08_advice", {"03_learning"})
    '#03_learning--q'
    >>> link("03_learning.html#microscope.t=9", "08_advice", {"03_learning"})
    '#03_learning'
    >>> link("https://example.org", "08_advice", set())
    'https://example.org'
    """
    to = urlsplit(href)
    if to.scheme:
        return href
    page = to.path.removesuffix(".html") if to.path else name
    if page not in names:
        return None
    is_moment = "=" in to.fragment  # of a scene: on paper it has no place
    return f"#{page}--{to.fragment}" if to.fragment and not is_moment else f"#{page}"


def file(html: Path, path: str) -> str:
    """Return the address of a file of the built book."""
    to = urlsplit(path)
    return path if to.scheme else (html / to.path).resolve().as_uri()
