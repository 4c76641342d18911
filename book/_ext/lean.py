"""
A Sphinx extension that makes the pages light, and lets them live under strict policies.

Before it draws anything a page waits for its scripts and its styles.  Here the scripts
come after the page, in their order; what the theme wrote into each page as a script
goes to one file, for a server may forbid scripts in pages; fifteen styles are one, and
lose the rules for what is in no page, which are three quarters of the theme's; fonts of
icons keep the few that pages show; pictures have their room before they come; and words
of code that look like the code around them stand alone, not each in an element.
"""

import gc
import hashlib
import posixpath
import re
from pathlib import Path

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

SETTINGS = "_static/settings.js"
OF_THEME = "data-content_root="  # what only pages of the theme have
# 1.5 MB of icons as a script: the style sheet has the same icons as a font.
ICONS = re.compile(r'<script src="[^"]*/fontawesome\.js[^"]*"></script>')
# Live code on a remote server, versions of a page, an index that folds: this book has
# none; and the search has the focus without.
UNUSED = ("thebe", "kernelName", "DOCUMENTATION_OPTIONS", "searchInput")
LOADED = re.compile(r"<script (?![^>]*\b(?:defer|async)\b)([^>]*\bsrc=)")
# A megabyte for formulas: `book.js` loads it when the page was drawn.
LATE = re.compile(r'<script defer(?:="defer")? (src="[^"]*/mathjax/)')
# Of scripts that come after the page anyway: they would come before its styles.
EARLY = re.compile(r'<link rel="preload" as="script"[^>]*>\n?')
STYLE = re.compile(
    r'[ ]*<link(?=[^>]*\brel="stylesheet")[^>]*\bhref="([^"?]+)[^>]*>\n?'
)
IMPORT = re.compile(r"@import\s*[\"']([^\"']+)[\"'];")
PICTURE = re.compile(r'<img (?!width)(?=[^>]*\bsrc="(_images/[^"]+\.svg)")')
SIZE = re.compile(r'<svg[^>]*\bwidth="([\d.]+)pt" height="([\d.]+)pt"')
FONTS = "_static/vendor/fontawesome/webfonts"
FACE = re.compile(
    r'url\((\.\./vendor/fontawesome/webfonts/[\w-]+)\.woff2\) format\("woff2"\),'
    r'url\([^)]*\) format\("truetype"\)'
)
ICON = re.compile(r"\\(f[0-9a-f]{3})\b|([\uf000-\uf8ff])")
ADDRESS = re.compile(r"url\(([\"']?)(?!data:|#|/)([^\"')]+)\1\)")
CODE = re.compile(r"<pre>.*?</pre>", re.DOTALL)
PART = re.compile(r'<span class="pre">([^<]*)</span>')  # of code in a line
PLAIN = re.compile(r'<span(?: class="(?:n|nn|p|w)")?>([^<]*)</span>')  # has no colour
INLINE = re.compile(r"<script(?![^>]*\bsrc=)([^>]*)>(.*?)</script>", re.DOTALL)
CLICKED = re.compile(r' onclick="(?:window\.)?(\w+)\(\)"')
WORD = re.compile(r"[\w-]+")
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
CLASS = re.compile(r"\.(-?[a-zA-Z_][\w-]*)")
# Where the page keeps the theme if it may keep nothing: in a frame, or in private.
KEPT = """try {
  localStorage.getItem("theme");
} catch {
  const kept = new Map();
  const getItem = (name) => kept.get(name) ?? null;
  const setItem = (name, value) => kept.set(name, `${value}`);
  const localStorage = { getItem, setItem, removeItem: (name) => kept.delete(name) };
  Object.defineProperty(window, "localStorage", { value: localStorage });
}
"""


def lighten(app, exception):
    """Rewrite the pages and the style sheets of the built book."""
    if exception is not None or app.builder.format != "html":
        return
    out, settings, pages = Path(app.outdir), [KEPT], {}
    for path in sorted(out.glob("*.html")):
        text = path.read_text(encoding="utf-8")
        if OF_THEME in text:
            text = with_plain_code(without_inline(EARLY.sub("", text), settings))
            pages[path] = PICTURE.sub(lambda found: with_room(out, found), text)
    text = "".join(f"{body}\n" for body in settings)
    Path(out, SETTINGS).write_text(text, encoding="utf-8", newline="\n")
    for file in Path(out, "_static", "scripts").glob("fontawesome.js*"):
        file.unlink()
    of_scripts = set()
    for path in Path(out, "_static").glob("**/*.js"):
        if "mathjax" not in path.parts:
            of_scripts.update(WORD.findall(path.read_text(encoding="utf-8")))
    alike = {}  # pages, by the styles that they load
    for path, text in pages.items():
        alike.setdefault(tuple(STYLE.findall(text)), []).append(path)
    for sheets, paths in alike.items():
        known = of_scripts.union(*(WORD.findall(pages[path]) for path in paths))
        name = write_style(out, sheets, known)
        for path in paths:
            text = with_one_style(pages[path], name)
            path.write_text(text, encoding="utf-8", newline="\n")
    keep_used_icons(out)


def with_plain_code(page: str) -> str:
    """
    Return a page without the spans in code that change no look.

    >>> with_plain_code('<pre><span class="n">x</span><span class="o">.</span></pre>')
    '<pre>x<span class="o">.</span></pre>'
    >>> with_plain_code('<code><span class="pre">a</span> <span>b</span></code>')
    '<code>a <span>b</span></code>'
    """
    page = PART.sub(r"\1", page)
    return CODE.sub(lambda found: PLAIN.sub(r"\1", found[0]), page)


def keep_used_icons(out: Path) -> None:
    """Write the fonts of icons anew, with those that a style of the pages names."""
    styles = {
        path: path.read_text(encoding="utf-8")
        for path in Path(out, "_static", "styles").glob("page-*.css")
    }
    icons = {
        int(code, 16) if code else ord(letter)
        for text in styles.values()
        for code, letter in ICON.findall(text)
    }
    for path in Path(out, FONTS).glob("*.ttf"):
        font, subsetter = TTFont(path), Subsetter(Options())
        subsetter.populate(unicodes=icons)
        subsetter.subset(font)
        font.flavor = "woff"
        font.save(path.with_suffix(".woff"))
        path.unlink()
        path.with_suffix(".woff2").unlink(missing_ok=True)
    for path, text in styles.items():
        text = FACE.sub(r'url(\1.woff) format("woff")', text)
        path.write_text(text, encoding="utf-8", newline="\n")


def with_room(out: Path, found: re.Match) -> str:
    """Return the begin of a picture that has its room before it comes."""
    size = SIZE.search(Path(out, found[1]).read_text(encoding="utf-8"))
    width, height = (round(float(points) * 4 / 3) for points in size.groups())
    return f'<img width="{width}" height="{height}" '


def write_style(out: Path, sheets: tuple[str, ...], known: set[str]) -> str:
    """Write one style sheet instead of several; return its address."""
    text = needed("".join(read_style(out, sheet) for sheet in sheets), known)
    name = hashlib.sha256(text.encode()).hexdigest()[:12]
    address = f"_static/styles/page-{name}.css"
    Path(out, address).write_text(text, encoding="utf-8", newline="\n")
    return address


def read_style(out: Path, sheet: str) -> str:
    """Return a style sheet and what it imports, for a place in ``_static/styles``."""
    folder = posixpath.dirname(sheet)
    text = Path(out, sheet).read_text("utf-8").removeprefix('@charset "UTF-8";')

    def moved(found):
        address = posixpath.relpath(posixpath.join(folder, found[2]), "_static/styles")
        return f"url({found[1]}{address}{found[1]})"

    def imported(found):
        return read_style(out, posixpath.normpath(posixpath.join(folder, found[1])))

    return IMPORT.sub(imported, ADDRESS.sub(moved, COMMENT.sub("", text))) + "\n"


def with_one_style(page: str, address: str) -> str:
    """
    Return a page that loads one style sheet in the place of its first.

    >>> page = '<link rel="stylesheet" href="a?v=1"><link href="b" rel="stylesheet">'
    >>> with_one_style(page, "c.css")
    '<link rel="stylesheet" href="c.css">'
    """
    one = iter([f'<link rel="stylesheet" href="{address}">'])
    return STYLE.sub(lambda _: next(one, ""), page)


def without_inline(page: str, settings: list[str]) -> str:
    """
    Return a page that loads all of its scripts from files, after it was read.

    What stood in the page is added to the settings, unless it is there.

    >>> settings = []
    >>> page = '<head><script>let a = 1;</script><script src="b.js"></script></head>'
    >>> print(without_inline(page, settings))
    <head><script src="_static/settings.js"></script>
    <script defer src="b.js"></script></head>
    >>> settings
    ['let a = 1;']
    """

    def take(found):
        attributes, body = found[1], found[2].strip()
        if "application/json" in attributes:
            return found[0]
        is_used = not any(name in attributes + body for name in UNUSED)
        if is_used and body not in settings:
            settings.append(body)
        return ""

    page = INLINE.sub(take, ICONS.sub("", page))
    page = CLICKED.sub(r' data-clicked="\1"', LOADED.sub(r"<script defer \1", page))
    page = LATE.sub(r'<script type="text/later" \1', page)
    first = f'<script src="{SETTINGS}"></script>\n'
    return re.sub(r"(?=<title>|<script )", lambda _: first, page, count=1)


def needed(style: str, known: set[str]) -> str:
    """
    Return the rules of a style sheet that can hold in some page.

    One is dropped if all its selectors ask for classes that are no word of any page or
    script; a class is known, too, if a script makes it from a word that ends in "-".

    >>> style = ".a .b, .c { x: 1 } @media print { .b { x: 2 } } p { x: 3 }"
    >>> print(needed(style, {"c"}))
    .a .b, .c { x: 1 } p { x: 3 }
    >>> needed(".made-up { x: 1 }", {"made-"})
    '.made-up { x: 1 }'
    """
    made = tuple(word for word in known if word.endswith("-") and len(word) > 3)

    def can_hold(selector):
        return all(c in known or c.startswith(made) for c in CLASS.findall(selector))

    kept = []
    for head, body in rules(COMMENT.sub("", style)):
        words = head.strip()
        if body is None or words.startswith(("@font-face", "@keyframes", "@page")):
            kept.append(head + (body or ""))
        elif words.startswith("@"):
            inner = needed(body[1:-1], known)
            kept += [head, "{", inner, "}"] if inner.strip() else []
        elif any(can_hold(selector) for selector in selectors(words)):
            kept.append(head + body)
    return "".join(kept).strip()


def rules(style: str):
    """Yield a style sheet's rules, each what it is for and its block; None if none."""
    begin = at = 0
    while found := re.compile(r"[{;]").search(style, at):
        # A semicolon, or a brace of an address, inside quotes or brackets.
        head = style[begin : found.start()]
        if head.count("(") > head.count(")") or head.count('"') % 2:
            at = found.end()
            continue
        if found[0] == ";":
            yield style[begin : found.end()], None
            begin = at = found.end()
            continue
        depth, end = 1, found.end()
        while depth and (brace := re.compile(r"\"[^\"]*\"|[{}]").search(style, end)):
            depth += {"{": 1, "}": -1}.get(brace[0], 0)
            end = brace.end()
        yield head, style[found.start() : end]
        begin = at = end
    if style[begin:].strip():
        yield style[begin:], None


def selectors(head: str):
    """Return the selectors of a rule, apart; commas in brackets do not part them."""
    depth, parts = 0, [""]
    for character in head:
        depth += (character in "([") - (character in ")]")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return parts


def setup(app):
    # Trees of pages are millions of objects, few of them garbage: to look for it as
    # often as Python does was half of the build's time.
    gc.set_threshold(200_000, 20, 100)
    app.connect("build-finished", lighten, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
