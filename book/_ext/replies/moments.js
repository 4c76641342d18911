// Links of the text to a moment of a scene, as "#race.t=77": the scene follows the
// address by itself; here it comes into view, and a button leads back to the text.

import { make } from "../../../abstransfer/scenes/ui/elements.js";

/** @type {any} */
let back = null; // the button

export function bindMoments() {
  document.addEventListener("click", (event) => {
    const link = /** @type {Element} */ (event.target).closest("article a[href^='#'][href*='=']");
    const scene = link && sceneOf(link);
    if (!scene || event.ctrlKey || event.metaKey || event.shiftKey) return;
    const isStep = link.getAttribute("href") !== location.hash;
    setTimeout(show, 0, link, scene, isStep); // behind the browser's own step
  });
  addEventListener("hashchange", () => {
    if (back?.value !== location.hash) back?.remove();
  });
}

function sceneOf(link) {
  const [, id] = /^#([\w-]+)\.\w+=/.exec(link.getAttribute("href")) ?? [];
  return document.querySelector(`[data-ab-id="${id}"]`);
}

function show(link, scene, isStep) {
  back?.remove();
  back = make("button", {
    type: "button",
    class: "moment-back",
    value: link.getAttribute("href"),
    onclick() {
      back.remove();
      if (isStep) history.back(); // the browser's own way: the scene goes back, too
      link.scrollIntoView({ block: "center" });
      link.focus({ preventScroll: true });
    },
  }, "Back to the text");
  scene.prepend(back);
  scene.scrollIntoView();
  back.focus({ preventScroll: true });
}
