// Bars with their names and numbers, and a formula with its numbers and words.

import { armStyle, make, number, sample } from "./dom.js";

/**
 * set([{ name, value, arm, lit, note, mark }]): bars grow from 0, or from `low`
 * where all is on one side of it; null as value leaves the bar out.
 *
 * @param {{ label: string, format?: (x: number) => string, low?: number, high?: number }} options
 */
export function barChart({ label, format = (x) => number(x), low, high }) {
  const node = make("ul", { class: "ab-bars", "aria-label": label });
  let last = "";
  function set(rows) {
    const key = JSON.stringify(rows);
    if (key === last) return;
    last = key;
    const all = rows.flatMap((row) => [row.value, row.mark]).filter(Number.isFinite);
    const bottom = low ?? Math.min(0, ...all);
    const span = (high ?? Math.max(0, ...all)) - bottom || 1;
    const part = (x) => (100 * Math.min(Math.max((x - bottom) / span, 0), 1)).toFixed(2);
    const origin = Number(part(Math.max(0, bottom)));
    const items = rows.map(({ name, value, arm, lit, note, mark }) => {
      const has = Number.isFinite(value);
      const end = has ? Number(part(value)) : origin;
      const [from, to] = [Math.min(origin, end), Math.max(origin, end)];
      const color = arm ? `;--ab-bar:${armStyle(arm).color}` : "";
      const track = make(
        "span",
        { class: "ab-track", "aria-hidden": "true" },
        has &&
          make("span", {
            class: "ab-bar",
            style: `left:${from}%;width:${(to - from).toFixed(2)}%${color}`,
          }),
        make("span", { class: "ab-zero", style: `left:${origin}%` }),
        Number.isFinite(mark) && make("span", { class: "ab-hollow", style: `left:${part(mark)}%` }),
      );
      return make(
        "li",
        { class: lit && "ab-now" },
        make("span", { class: "ab-barname" }, arm && sample(arm), name),
        track,
        make("span", { class: "ab-num" }, has ? format(value) : "–"),
        note && make("span", { class: "ab-note" }, note),
      );
    });
    node.replaceChildren(...items);
  }
  return { node, set };
}

/**
 * A formula: strings are signs between terms { symbol, value, word, lit }.
 *
 * @param {string} label
 */
export function formula(label) {
  const node = make("div", { class: "ab-equation", role: "group", "aria-label": label });
  function set(terms) {
    node.replaceChildren(
      ...terms.map((term) =>
        typeof term === "string" ? make("span", { class: "ab-sign" }, term) : make(
          "span",
          { class: term.lit ? "ab-term ab-now" : "ab-term" },
          make("var", {}, term.symbol),
          make("b", {}, term.value),
          make("small", {}, term.word),
        )
      ),
    );
  }
  return { node, set };
}
