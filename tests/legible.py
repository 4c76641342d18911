"""What axe finds on a page: by all its rules, or by that of contrast alone."""

from importlib.resources import files

AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
# Text of one look (letters, and all that lies behind them) has one contrast.  Of each
# look two are asked, the longest and the last: axe does not judge a single letter, nor
# what the head of the sidebar covers.
OF_EACH_LOOK = r"""(where) => {
    axe.configure({ rules: [{ id: "color-contrast", selector: "[data-look]" }] });
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
    for (const e of document.querySelectorAll("[data-look]")) delete e.dataset.look;
    for (const of of looks.values())
        for (const e of [of.reduce(longest), of.at(-1)]) e.dataset.look = "";
}"""


def faults(page, where="html", **options):
    """Return what is wrong in the part of a page that a selector names."""
    if page.evaluate("typeof axe") == "undefined":
        page.evaluate(AXE)
    page.evaluate(OF_EACH_LOOK, where)
    # No preload: axe would ask for the style sheets anew, which files refuse.
    options = {**options, "resultTypes": ["violations"], "preload": False}
    run = "([where, options]) => axe.run(where, options)"
    result = page.evaluate(run, [where, options])
    passed = {rule["id"] for rule in result["passes"]}
    assert "color-contrast" in passed, "there is something to look at"
    return [
        (
            violation["id"],
            node["html"].replace(' data-look=""', ""),
            node["failureSummary"],
        )
        for violation in result["violations"]
        for node in violation["nodes"]
    ]


def pale(page, where="html"):
    """Return what has too little contrast there."""
    return faults(page, where, runOnly=["color-contrast"])
