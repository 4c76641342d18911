"""Reset gives the start back, whatever the reader did before."""

import pytest
from scene_tab import quick

from abstransfer.scenes import KINDS

# Use each control in turn, as a reader would, then press Reset; return what is not then
# as it was at the start: [control, what was, what is].
TRY = """async (patience) => {
    const scene = document.querySelector(".abstransfer-scene");
    const pictures = async (n) => {
        while (n--) await new Promise(requestAnimationFrame);
    };
    // Until something is written in the scene; false if nothing was for so long.
    const writes = (milliseconds) => new Promise((tell) => {
        const end = (is) => (observer.disconnect(), clearTimeout(timer), tell(is));
        const observer = new MutationObserver(() => end(true));
        const timer = setTimeout(end, milliseconds, false);
        const all = { attributes: true, characterData: true, childList: true };
        observer.observe(scene, { ...all, subtree: true });
    });
    const isSeen = (each) => each.getClientRects().length > 0;
    const nameOf = (each) => each.getAttribute("aria-label") ??
        each.labels?.[0]?.textContent ?? each.textContent;
    const controls = () => [...scene.querySelectorAll("button, input, select")]
        .filter(isSeen).filter((each) => each.closest(".ab-foot") === null);
    const reset = () => [...scene.querySelectorAll(".ab-foot button")]
        .find((each) => each.textContent === "Reset").click();
    const text = (node) => [...node.childNodes].map((each) =>
        each instanceof Text ? each.data
            : each.matches?.("svg, option") ? "" : text(each)).join("");
    const look = () => {
        // A reset can be undone.
        const isUndo = (each) => /^(Undo|Redo)$/.test(each.textContent);
        const all = controls().filter((each) => !isUndo(each));
        const states = all.map((each) => [
            nameOf(each), each.type, each.value, each.checked, each.min, each.max,
            each.getAttribute("aria-disabled")]);
        return JSON.stringify([text(scene.querySelector(".ab-body")), states], null, 1);
    };
    const rests = async () => {
        while (await writes(400) || /…|Learning|Grad climbs/.test(look()));
        return look();
    };
    const start = await rests();
    const wrong = [];
    for (let i = 0; i < controls().length; i++) {
        const control = controls()[i];
        const name = nameOf(control);
        if (/^(Copy|Save)/.test(name)) continue;
        if (control.type === "range") {
            const { min, max, value } = control;
            control.value = value === max ? min : max;
            control.dispatchEvent(new Event("input"));
        } else if (control.tagName === "SELECT") continue;
        else if (control.type === "number") control.value = control.min;
        else control.click();
        await pictures(3);
        reset();
        const end = Date.now() + patience;
        let now = look();
        while (now !== start && Date.now() < end) {
            await writes(100);
            now = look();
        }
        if (now === start) continue;
        const lines = start.split("\\n");
        wrong.push([name, now.split("\\n").filter((line, i) => line !== lines[i])]);
        break; // what follows would be wrong, too
    }
    return [controls().length, wrong];
}"""


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.timeout(900)
def test_reset_gives_the_start_back_after_every_control(open_scene, name):
    tab = open_scene(quick(name))
    n, wrong = tab.page.evaluate(TRY, 20_000)

    assert n >= 2
    assert wrong == []
    assert tab.problems == []
