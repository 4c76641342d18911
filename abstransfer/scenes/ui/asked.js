// Bets that the page asks in a box of its own (book/_assets/bets.js): the scene hears of
// them, and does not ask again.

import { make } from "./dom.js";

/** @import { Scene } from "../types.d.ts" */

/**
 * What stands in a scene for a bet that the page asks: { node, set }, or null if the
 * page does not.  Options are told apart by their order; a test compares the words.
 *
 * @param {Scene} scene
 * @param {string} name
 * @param {{ question: string, options: Record<string, any> }} bet
 */
export function askedByPage(scene, name, { question, options }) {
  const kind = `${scene.id}-${name}`.replaceAll("_", "-"); // as a class is written
  const box = /** @type {HTMLElement} */ (document.querySelector(`.asks-${kind}[data-bet]`));
  if (!box) return null;
  const keys = Object.keys(options);
  const placed = () => keys[box.dataset.bet] ?? box.dataset.bet; // "skip" and "" as they are
  const link = make("a", { href: `#${box.id}` });
  const words = make("span", {});
  const node = make("p", { class: "ab-bet" }, words, link);
  const hear = () => scene.set({ [name]: placed() });
  box.addEventListener("abstransfer:bet", hear);
  scene.onLeave(() => box.removeEventListener("abstransfer:bet", hear));
  if (placed()) scene.set({ [name]: placed() });
  return {
    node,
    set(value) {
      words.textContent = value === "skip"
        ? "You did not bet. "
        : value
        ? `You bet on “${options[value]}”. `
        : `${question} `;
      link.textContent = value ? "Change" : "Bet above";
      if (value === placed()) return;
      const detail = keys.includes(value) ? `${keys.indexOf(value)}` : value;
      box.dispatchEvent(new CustomEvent("abstransfer:place", { detail }));
    },
  };
}
