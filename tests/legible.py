"""What axe finds on a page: by all its rules, or by that of contrast alone."""

import re
from importlib.resources import files

AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
# Text of one look (letters, and all that lies behind them) has one contrast.  Of each
# look two are asked, the longest and the last: axe does not judge what the head of the
# sidebar covers; nor single letters, what is above the page until it has the focus, the
# words of a formula that are only heard, and those of a drawing, which has a picture
# behind them.  Looks that are known are not asked again.
OF_EACH_LOOK = r"""([where, known]) => {
    const rules = [{ id: "color-contrast", selector: "[data-look]" }];
    axe.configure({ rules, noHtml: true });
    const FIELDS =
        "select, textarea, input:not([type=range], [type=radio], [type=checkbox])";
    const UNJUDGED = "mjx-assistive-mml, svg";
    const looks = new Map();
    const seen = { opacityProperty: true, visibilityProperty: true };
    const said = (node) => node.nodeType === Node.TEXT_NODE ? node.data.trim() : "";
    const length = (e) => Math.max(...[...e.childNodes].map((n) => said(n).length));
    const layers = new Map();
    const behind = (e) => {
        if (!e) return [];
        if (!layers.has(e)) {
            const { backgroundColor, backgroundImage, opacity } = getComputedStyle(e);
            const further = backgroundColor.startsWith("rgb(") ? null : e.parentElement;
            layers.set(
                e, [backgroundColor, backgroundImage, opacity, ...behind(further)]);
        }
        return layers.get(e);
    };
    for (const e of document.querySelectorAll(`${where}, ${where} *`)) {
        const speaks = length(e) > 1 || e.matches(FIELDS);
        if (!speaks || !e.checkVisibility(seen) || e.closest(UNJUDGED)) continue;
        if (e.getBoundingClientRect().bottom + scrollY < 0) continue;
        const { color, fontSize, fontWeight } = getComputedStyle(e);
        const look = [color, fontSize, fontWeight, ...behind(e)];
        const key = look.filter((x) => !["1", "none", "rgba(0, 0, 0, 0)"].includes(x));
        looks.set(`${key}`, [...looks.get(`${key}`) ?? [], e]);
    }
    const longest = (a, b) => length(b) > length(a) ? b : a;
    for (const e of document.querySelectorAll("[data-look]")) delete e.dataset.look;
    const keys = [...looks.keys()];
    for (const [key, of] of looks) {
        if (known.includes(key)) continue;
        for (const e of [of.reduce(longest), of.at(-1)])
            e.dataset.look = keys.indexOf(key);
    }
    return keys;
}"""
# No preload: axe would ask for the style sheets anew, which files refuse.  Of what it
# judges it would write down the HTML; here only what is wrong is written.
RUN = """async ([where, options]) => {
    const asked = { elementRef: true, preload: false, selectors: false };
    const { violations, passes } = await axe.run(where, { ...options, ...asked });
    const html = ({ element }) => element.outerHTML.slice(0, 300);
    const of = (rule) => rule.nodes.map((e) => [rule.id, html(e), e.failureSummary]);
    const judged = [...violations, ...passes].filter((r) => r.id === "color-contrast")
        .flatMap((rule) => rule.nodes.map((e) => Number(e.element.dataset.look)));
    return [violations.flatMap(of), judged];
}"""
MARK = re.compile(' data-look="[0-9]*"')


def faults(page, where="html", known=None, **options):
    """
    Return what is wrong in the part of a page that a selector names.

    The contrast of looks that are known is not asked again; those that axe judged here
    are known from now on.
    """
    known = set() if known is None else known
    looks = _looks(page, where, known)
    found, judged = page.evaluate(RUN, [where, options])
    known.update(looks[i] for i in judged)
    assert known.intersection(looks), "there is something to look at"
    return [(rule, MARK.sub("", html), summary) for rule, html, summary in found]


def pale(page, where="html", known=None):
    """Return what has too little contrast there."""
    if known and known.issuperset(_looks(page, where, known)):
        return []  # an empty page has no looks, and is asked
    return faults(page, where, known, runOnly=["color-contrast"])


def _looks(page, where, known):
    """Mark what axe shall judge; return all looks, also those that are known."""
    if page.evaluate("typeof axe") == "undefined":
        page.evaluate(AXE)
    return page.evaluate(OF_EACH_LOOK, [where, list(known)])
