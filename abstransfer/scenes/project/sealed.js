// A prediction of a race: open until the race begins, sealed from then on, compared
// after it.  See Python's `project/prediction.py`.

import { make } from "../ui/dom.js";
import { gainText, total } from "./race.js";
import { sha256 } from "./hash.js";

const DIRECTIONS = { "+": "more goals", "-": "fewer goals", 0: "as many goals" };
const sideOf = ({ direction }) => (direction === "0" ? "above" : "below");

/**
 * The line of a card, and in it the seal.
 *
 * @param {{ predicted: string, direction: string, percent: number, races: number }} state
 * @param {string} student
 */
export function lineOf(state, student) {
  const { predicted, direction, percent, races } = state;
  const what = predicted
    ? `${predicted}, direction ${direction}, refuted ${sideOf(state)} ${percent} %`
    : "none";
  const said = `${what}, race ${races}`;
  return `${said}, sealed ${sha256(`${student}: ${said}`).slice(0, 8)}`;
}

/**
 * What goals of runs, by robot, say to it; "" if nothing was predicted.
 *
 * @param {{ predicted: string, direction: string, percent: number }} state
 * @param {Record<string, number[]>} goals
 */
export function compare({ predicted, direction, percent }, goals) {
  if (!predicted) return "";
  const [mine, none] = [predicted, "none"].map((name) => total(goals[name] ?? []));
  if (!goals[predicted] || !none) return "nothing to compare";
  const more = 100 * (mine - none);
  const size = { "+": more, "-": -more, 0: -Math.abs(more) }[direction];
  const least = percent * none * (direction === "0" ? -1 : 1);
  return `${gainText(mine, none)}, ${size >= least ? "as predicted" : "refuted"}`;
}

// Tie a field to a value of the state; who writes in it is not disturbed by a redraw.
export function tied(scene, name, node) {
  node.addEventListener("change", () => {
    scene.set({ [name]: node.value });
    node.value = scene.state[name]; // what is no value goes
  });
  scene.control(name, (value) => document.activeElement === node || (node.value = value));
  return node;
}

/**
 * The fields: { node, close(is, words) }; `names` are the robots, by their names in the
 * state.
 *
 * @param {any} scene
 * @param {Record<string, string>} names
 */
export function predicting(scene, names) {
  const select = (name, label, options) =>
    tied(
      scene,
      name,
      make(
        "select",
        { "aria-label": label },
        Object.entries(options).map(([value, text]) => make("option", { value }, text)),
      ),
    );
  const share = { type: "number", min: 0, max: 100, "aria-label": "Refuted, in percent" };
  const parts = [
    select("predicted", "Robot", { "": "no prediction", ...names }),
    select("direction", "Compared with none", DIRECTIONS),
    tied(scene, "percent", make("input", share)),
  ];
  const side = make("span", {});
  const words = make("p", {});
  const [who, direction, percent] = parts;
  const rest = make("span", {}, direction, side, percent, " %");
  function show() {
    const text = `, refuted ${sideOf(scene.state)} `;
    if (side.textContent !== text) side.textContent = text;
    if (rest.hidden === Boolean(scene.state.predicted)) rest.hidden = !rest.hidden;
  }
  scene.control("direction", show);
  scene.control("predicted", show);
  return {
    node: make(
      "fieldset",
      { class: "ab-choice" },
      make("legend", {}, "Predict before the race; it is sealed when the race begins"),
      scene.row(who, rest),
      words,
    ),
    close(is, said) {
      if (words.textContent === said && percent.disabled === is) return;
      for (const part of parts) part.disabled = is;
      words.textContent = said;
    },
  };
}
