// For a lecturer: an address hides controls ("#tau.hide=luck,guide") and enlarges a scene
// for the wall ("#tau.wall=1"); a button enlarges it, too.

import { button } from "./controls.js";
import { list } from "./dom.js";

/** @import { Scene } from "../types.d.ts" */

/** Names in an address that are no part of a scene's state. */
export const ASKED = ["hide", "wall"];

/**
 * Why an address cannot be followed: names that a scene does not have.
 *
 * @param {string[]} names in the address
 * @param {string[]} hidden names of controls to hide
 * @param {string[]} fields that an address may set
 * @param {string[]} controls
 */
export function refused(names, hidden, fields, controls) {
  const quoted = (all) => list(all.map((name) => `“${name}”`));
  const odd = names.filter((name) => ![...fields, ...ASKED].includes(name));
  const none = hidden.filter((name) => !controls.includes(name));
  return [
    odd.length &&
    `The address names ${quoted(odd)}, which this scene does not know: it has ${list(fields)}.`,
    none.length &&
    `It cannot hide ${quoted(none)}: its controls are ${list(controls)}.`,
  ].filter(Boolean).join(" ");
}

/**
 * Give a scene its button; `follow(asked)` does what an address asks for, and returns
 * what it refuses.
 *
 * @param {Scene} scene
 * @param {HTMLElement} element
 */
export function lecture(scene, element) {
  const { fields, local } = scene.spec;
  const wall = button("Enlarge", () => enlarge(!isOn()));
  const isOn = () => element.classList.contains("ab-enlarged");

  function enlarge(is) {
    element.classList.toggle("ab-enlarged", is);
    wall.set(is ? "Back to the page" : "Enlarge");
    // The keyboard stays on the wall.
    for (let node = element; node.parentElement; node = node.parentElement) {
      for (const other of node.parentElement.children) {
        if (other !== node) other.toggleAttribute("inert", is);
      }
    }
  }
  function leaveWall({ key }) {
    if (key === "Escape" && isOn()) enlarge(false);
  }
  /** @param {Record<string, string>} asked by name, also of the state */
  function follow(asked) {
    const hidden = (asked.hide ?? "").split(",").filter(Boolean);
    for (const [name, nodes] of Object.entries(scene.parts)) {
      for (const node of nodes) node.classList.toggle("ab-away", hidden.includes(name));
    }
    if (isOn() !== (asked.wall === "1")) enlarge(!isOn());
    const known = Object.keys(fields).filter((name) => !local.includes(name));
    return refused(Object.keys(asked), hidden, known, Object.keys(scene.parts));
  }
  element.addEventListener("keydown", leaveWall);
  scene.onLeave(() => {
    element.removeEventListener("keydown", leaveWall);
    if (isOn()) enlarge(false);
  });
  return { node: wall.node, follow };
}
