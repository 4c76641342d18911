// Controls, all native: slider, choice, toggle, button.  Each is { node, set }.
// `bind` gives a scene the same, tied to the values of its state.

import { make, newId } from "./dom.js";
import { bindBets } from "./texts.js";

/** @import { ButtonOptions, Scene } from "../types.d.ts" */

const MEANT = 8; // pixels that a finger moves along a slider that it means to move

/** @param {{ label: string, min?: number, max?: number, step?: number, format?: (x: number) => string, onInput: (x: number) => void }} options */
export function slider({ label, min = 0, max = 1, step = 1, format = String, onInput }) {
  const id = newId();
  // Silent: the slider says its value, and the scene what comes of it.
  const output = make("output", { for: id, "aria-live": "off", "aria-hidden": "true" });
  let finger = null; // where a touch began, and the value then, until it means the slider
  const input = make("input", {
    id,
    type: "range",
    min,
    max,
    step,
    oninput: () => finger ? tell() : take(),
    onchange: () => finger || take(),
    onpointerdown: ({ pointerType, clientX }) => {
      if (pointerType === "touch") finger = { clientX, value: input.value };
    },
    onpointermove: ({ clientX }) => {
      if (!finger || Math.abs(clientX - finger.clientX) < MEANT) return;
      finger = null;
      take();
    },
    onpointerup: () => {
      finger = null;
      take();
    },
    // The finger scrolls the page: it meant the page.
    onpointercancel: () => {
      if (!finger) return;
      const { value } = finger;
      setTimeout(() => (finger = null, input.value = value, tell())); // it changes once more
    },
  });
  let taken = null;
  function take() {
    tell();
    if (input.value === taken) return;
    taken = input.value;
    onInput(input.valueAsNumber);
  }
  function tell() {
    const text = format(input.valueAsNumber);
    if (output.textContent === text) return;
    output.textContent = text;
    input.setAttribute("aria-valuetext", text);
  }
  function set(value, bounds) {
    if (bounds) [input.min, input.max] = bounds;
    if (finger) return; // it has the last word
    input.value = value;
    taken = input.value;
    tell();
  }
  const title = make("label", { for: id }, label);
  return { node: make("div", { class: "ab-slider" }, title, input, output), input, set };
}

/**
 * Radio buttons side by side; `options` is { value: text }.
 *
 * @param {{ label: string, options: Record<string, string>, onInput: (value: string) => void }} options
 */
export function choice({ label, options, onInput }) {
  const name = newId();
  const inputs = Object.entries(options).map(([value, text]) => {
    const input = make("input", {
      type: "radio",
      name,
      value,
      onchange: () => onInput(value),
    });
    return [input, make("label", {}, input, make("span", {}, text))];
  });
  const node = make(
    "fieldset",
    { class: "ab-choice" },
    make("legend", {}, label),
    make("div", { class: "ab-segments" }, inputs.map(([, node]) => node)),
  );
  const set = (value) => inputs.forEach(([input]) => (input.checked = input.value === value));
  return { node, set };
}

/** @param {{ label: string, onInput: (is: boolean) => void }} options */
export function toggle({ label, onInput }) {
  const input = make("input", { type: "checkbox", onchange: () => onInput(input.checked) });
  const node = make("label", { class: "ab-toggle" }, input, make("span", {}, label));
  return { node, set: (value) => (input.checked = value) };
}

/**
 * @param {any} text or nodes
 * @param {(event: MouseEvent) => void} act
 * @param {ButtonOptions} options
 */
export function button(text, act, { primary = false, label, title } = {}) {
  const node = make("button", {
    type: "button",
    class: primary ? "ab-button ab-primary" : "ab-button",
    "aria-label": label,
    title: title ?? label,
    onclick: (event) => is(true) || act(event),
  }, text);
  const is = (disabled) => node.getAttribute("aria-disabled") === `${disabled}`;
  return {
    node,
    set: (next) => (node.textContent = next),
    rename: (name) => node.setAttribute("aria-label", node.title = name),
    // Not by `disabled`: a button that has the focus would lose it.
    enable: (can) => is(!can) || node.setAttribute("aria-disabled", `${!can}`),
  };
}

// Note a node that steers a value of a scene: an address may hide it.
export const noted = (scene, name, node) => ((scene.parts[name] ??= []).push(node), node);

/** @param {Scene} scene */
export function bind(scene) {
  const tied = (make_) => (name, options) => {
    const part = make_({ ...options, onInput: (value) => scene.set({ [name]: value }) });
    scene.control(name, part.set);
    return noted(scene, name, part.node);
  };
  scene.slider = (name, options) => {
    const [min, max] = scene.limits[name];
    return tied(slider)(name, { min, max, ...options });
  };
  scene.choice = tied(choice);
  scene.toggle = tied(toggle);
  scene.button = (text, act, options) => button(text, act, options).node;
  bindBets(scene);
}
