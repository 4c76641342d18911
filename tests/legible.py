"""What axe finds on a page: by all its rules, or by that of contrast alone."""

import json
from importlib.resources import files

AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
# Text of one look (letters, and all that lies behind them) has one contrast.  Of each
# look two are asked, the longest and the last: axe does not judge a single letter, nor
# what the head of the sidebar covers.
OF_EACH_LOOK = r"""(where) => {
    const looks = new Map();
    const seen = { opacityProperty: true, visibilityProperty: true };
    const said = (node) => node.nodeType === Node.TEXT_NODE ? node.data.trim() : "";
    const length = (e) => Math.max(...[...e.childNodes].map((n) => said(n).length));
    for (const e of document.querySelectorAll(`${where}, ${where} *`)) {
        const speaks = length(e) > 0 || e.matches("input, select, textarea");
        if (!speaks || !e.checkVisibility(seen)) continue;
        const { color, fontSize, fontWeight } = getComputedStyle(e);
        const look = [color, fontSize, fontWeight];
        for (let at = e; at; at = at.parentElement) {
            const { backgroundColor, backgroundImage, opacity } = getComputedStyle(at);
            look.push(backgroundColor, backgroundImage, opacity);
            if (backgroundColor.startsWith("rgb(")) break;
        }
        const key = look.filter((x) => !["1", "none", "rgba(0, 0, 0, 0)"].includes(x));
        looks.set(`${key}`, [...looks.get(`${key}`) ?? [], e]);
    }
    const longest = (a, b) => length(b) > length(a) ? b : a;
    return [...looks.values()].flatMap((of) => [of.reduce(longest), of.at(-1)]);
}"""


def faults(page, where="html"):
    """Return what is wrong in the part of a page that a selector names."""
    all_but_contrast = {"rules": {"color-contrast": {"enabled": False}}}
    found, n_passed = _run(page, json.dumps(where), all_but_contrast)
    assert n_passed > 9, "there is something to look at"
    return found + pale(page, where)


def pale(page, where="html"):
    """Return what has too little contrast there."""
    texts = f"({OF_EACH_LOOK})({json.dumps(where)})"
    return _run(page, texts, {"runOnly": ["color-contrast"]})[0]


def _run(page, where, options):
    if page.evaluate("typeof axe") == "undefined":
        page.evaluate(AXE)
    # No preload: axe would ask for the style sheets anew, which files refuse.
    options = json.dumps({**options, "resultTypes": ["violations"], "preload": False})
    result = page.evaluate(f"axe.run({where}, {options})")
    found = [
        (violation["id"], node["html"], node["failureSummary"])
        for violation in result["violations"]
        for node in violation["nodes"]
    ]
    return found, len(result["passes"])
