// Small things that all parts use: elements, numbers as text, and the look of arms.

import { palette } from "../python.js";
import { drawn, make, newId } from "./elements.js";

export { drawn, make, newId };

/**
 * An SVG picture that is painted anew when its width changes: { svg, node, box }.
 *
 * @param {string} label
 * @param {(width: number) => void} paint
 */
export function sheet(label, paint) {
  const svg = drawn("svg", { class: "ab-chart", role: "img", "aria-label": label });
  const node = make("div", { class: "ab-chartbox" }, svg);
  // In the next picture: to paint changes the height, which is observed as well.
  new ResizeObserver(() => requestAnimationFrame(repaint)).observe(node);
  function repaint() {
    if (node.clientWidth) paint(node.clientWidth);
  }
  const resize = (width, height) => {
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.style.height = `${height}px`;
  };
  const describe = (sentence) => svg.setAttribute("aria-label", sentence);
  return { svg, node, repaint, resize, describe };
}

// ---- text

/**
 * With a true minus sign, as Python's figures print it.
 *
 * @param {number} x
 * @param {number} digits
 */
export function number(x, digits = 1) {
  const text = x.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}
/** @param {number} n */
export const count = (n) => Math.round(n).toLocaleString("en-US").replace("-", "−");
/** @param {number} n */
export const millions = (n) => `${Math.round(n / 1e5) / 10} M`;
/**
 * @param {number} n
 * @param {string} noun
 */
export const plural = (n, noun) => `${count(n)} ${noun}${n === 1 ? "" : "s"}`;
/**
 * @param {readonly string[]} words
 * @returns {string}
 */
export const list = (words) =>
  words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words.at(-1)}`;
/**
 * @param {{ width: number }} map
 * @param {number} cell
 */
export const place = ({ width }, cell) =>
  `row ${Math.floor(cell / width) + 1}, column ${(cell % width) + 1}`;

// ---- the look of an arm: a builder, with or without a strategy ("nd", "nd-soft")

/** @param {string} [arm] */
export function armStyle(arm) {
  const [, builder, strategy] = /^(.*?)(?:[ _-](hard|soft))?$/.exec(arm ?? "none");
  const look = palette.arms[builder] ?? { name: arm, marker: "circle" };
  const line = palette.strategies[strategy ?? "hard"];
  return {
    name: look.name + (strategy ? ` ${strategy}` : ""),
    color: `var(--ab-arm-${builder in palette.arms ? builder : "none"})`,
    marker: look.marker,
    dash: line.dash.join(" "),
    isFilled: line.filled,
  };
}

const polygon = (n, inner = 1, turn = 0) =>
  Array.from({ length: n }, (_, i) => {
    const r = i % 2 ? inner : 1;
    const angle = Math.PI * ((2 * i) / n + turn - 0.5);
    return `${(r * Math.cos(angle)).toFixed(2)},${(r * Math.sin(angle)).toFixed(2)}`;
  }).join("L");
const SHAPES = {
  square: "M-.85-.85H.85V.85H-.85Z",
  triangle: `M${polygon(3)}Z`,
  diamond: `M${polygon(4)}Z`,
  star: `M${polygon(10, 0.45)}Z`,
  cross: "M-1-.6L-.6-1 0-.4.6-1 1-.6.4 0 1 .6.6 1 0 .4-.6 1-1 .6-.4 0Z",
  plus: "M-.3-1H.3V-.3H1V.3H.3V1H-.3V.3H-1V-.3H-.3Z",
  circle: "M-.9 0A.9.9 0 1 1 .9 0 .9.9 0 1 1-.9 0Z",
};

/**
 * The mark of an arm at (x, y), `size` from its middle to its rim.
 *
 * @param {string} arm
 * @param {number} x
 * @param {number} y
 * @param {number} size
 */
export function marker(arm, x, y, size) {
  const { marker: kind, color, isFilled } = armStyle(arm);
  return drawn("path", {
    d: SHAPES[kind],
    transform: `translate(${x} ${y}) scale(${size})`,
    style: `fill:${isFilled ? color : "var(--ab-ground)"};stroke:${color}`,
    class: "ab-marker",
  });
}

/**
 * An inline sample of an arm's line and mark, for legends and names.
 *
 * @param {string} arm
 */
export function sample(arm) {
  const { color, dash } = armStyle(arm);
  const line = { d: "M0 6H26", style: `stroke:${color}`, "stroke-dasharray": dash };
  return drawn(
    "svg",
    { class: "ab-sample", viewBox: "0 0 26 12", "aria-hidden": "true" },
    drawn("path", line),
    marker(arm, 13, 6, 4),
  );
}
