// A line chart that may grow while a worker runs: curves with the colour, mark and
// dash of their arm, named at their end; vertical marks; a cursor.

import { armStyle, count, drawn, make, marker, sheet } from "./dom.js";

/** @import { Axis, Curve } from "../types.d.ts" */

const [LEFT, RIGHT, TOP, BOTTOM] = [58, 100, 12, 40]; // margins
const LINE = 15; // height of a label

/**
 * Round numbers between two bounds, about n of them.
 *
 * @param {number} low
 * @param {number} high
 * @param {number} n
 */
export function ticks(low, high, n) {
  const raw = (high - low) / n;
  const base = 10 ** Math.floor(Math.log10(raw));
  const step = base * ([1, 2, 5, 10].find((m) => m * base >= raw) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/**
 * Places at least `gap` apart, in the same order, moved as little as is simple.
 *
 * @param {number[]} places
 * @param {number} gap
 * @param {number} low
 * @param {number} high
 * @returns {number[]}
 */
export function spread(places, gap, low, high) {
  const order = [...places.keys()].sort((i, j) => places[i] - places[j]);
  const out = [...places];
  let last = -Infinity;
  for (const i of order) last = out[i] = Math.max(out[i], last + gap, low);
  let limit = high;
  for (const i of order.reverse()) {
    out[i] = Math.min(out[i], limit);
    limit = out[i] - gap;
  }
  return out;
}

/**
 * @param {number[]} values
 * @param {Axis} axis
 */
function range(values, { min, max }) {
  const low = min ?? Math.min(...values);
  const high = max ?? Math.max(...values);
  if (!(high > low)) return Number.isFinite(low) ? [low, low + 1] : [0, 1];
  return [low, high];
}

/**
 * Give an element these children, and keep those that are there already: a cursor that
 * moves leaves the curves alone.
 *
 * @param {Element} parent
 * @param {Element[]} children
 */
function replaceWhatDiffers(parent, children) {
  const old = [...parent.children];
  children.forEach((child, i) => {
    if (!old[i]) parent.append(child);
    else if (!old[i].isEqualNode(child)) old[i].replaceWith(child);
  });
  old.slice(children.length).forEach((child) => child.remove());
}

/** @param {{ label: string, x?: Axis, y?: Axis, height?: number }} options */
export function lineChart({ label, x = {}, y = {}, height = 260 }) {
  const { svg, node, repaint, resize, describe } = sheet(label, paint);
  /** @type {{ curves: Curve[], marks?: { x: number, label: string }[], cursor?: number }} */
  let data = { curves: [], marks: [] };

  /** @param {number} width */
  function paint(width) {
    const { curves, marks = [], cursor } = data;
    const right = curves.some(({ name }) => name) ? RIGHT : 14;
    const points = curves.flatMap((curve) => curve.points);
    const [x0, x1] = range(points.map((p) => p[0]).concat(marks.map((m) => m.x)), x);
    const yTicks0 = range(points.map((p) => p[1]), y);
    const yTicks = ticks(yTicks0[0], yTicks0[1], 4);
    const [y0, y1] = [y.min ?? Math.min(yTicks0[0], yTicks[0]), yTicks0[1]];
    const px = (v) => LEFT + ((v - x0) / (x1 - x0)) * (width - LEFT - right);
    const py = (v) => height - BOTTOM - ((v - y0) / (y1 - y0)) * (height - BOTTOM - TOP);
    /** @param {number[]} point */
    const at2 = ([a, b]) => `${px(a).toFixed(1)} ${py(b).toFixed(1)}`;
    const text = (content, left, top, attributes) =>
      drawn("text", { x: left, y: top, ...attributes }, content);

    const parts = [];
    for (const tick of yTicks) {
      parts.push(drawn("path", { d: `M${LEFT} ${py(tick)}H${width - right}`, class: "ab-rule" }));
      parts.push(text((y.format ?? count)(tick), LEFT - 6, py(tick) + 4, { "text-anchor": "end" }));
    }
    for (const tick of ticks(x0, x1, width < 500 ? 3 : 6)) {
      parts.push(
        text((x.format ?? count)(tick), px(tick), height - BOTTOM + 18, {
          "text-anchor": "middle",
        }),
      );
    }
    const axis = `M${LEFT} ${TOP}V${height - BOTTOM}H${width - right}`;
    parts.push(drawn("path", { d: axis, class: "ab-axis" }));
    parts.push(
      text(x.label, (LEFT + width - right) / 2, height - 4, {
        "text-anchor": "middle",
        class: "ab-faint",
      }),
    );
    for (const mark of marks) {
      const place = px(mark.x);
      parts.push(drawn("path", { d: `M${place} ${TOP}V${height - BOTTOM}`, class: "ab-mark" }));
      const isLate = place > width / 2;
      parts.push(
        text(mark.label, place + (isLate ? -4 : 4), TOP + 8, {
          "text-anchor": isLate ? "end" : "start",
        }),
      );
    }
    const named = curves.filter((curve) => curve.points.length);
    for (const { arm, points: line } of named) {
      const { color, dash } = armStyle(arm);
      parts.push(
        drawn("path", {
          d: `M${line.map(at2).join("L")}`,
          class: "ab-line",
          style: `stroke:${color}`,
          "stroke-dasharray": dash,
        }),
      );
      const every = Math.max(1, Math.ceil(line.length / 6));
      line.forEach(([a, b], i) => {
        if ((line.length - 1 - i) % every === 0) parts.push(marker(arm, px(a), py(b), 4));
      });
    }
    const ends = spread(
      named.map(({ points: line }) => py(line.at(-1)[1])),
      LINE,
      TOP,
      height - BOTTOM,
    );
    named.forEach(({ name, arm, points: line }, i) => {
      if (!name) return;
      const style = `fill:${armStyle(arm).color}`;
      parts.push(text(name, px(line.at(-1)[0]) + 8, ends[i] + 4, { style, class: "ab-name" }));
    });
    if (cursor !== undefined && cursor !== null) {
      parts.push(
        drawn("path", { d: `M${px(cursor)} ${TOP}V${height - BOTTOM}`, class: "ab-cursor" }),
      );
    }
    resize(width, height);
    replaceWhatDiffers(svg, parts);
  }
  const title = make("p", { class: "ab-ylabel" }, y.label);
  return {
    node: make("div", { class: "ab-figure" }, title, node),
    set: (next) => {
      data = { marks: [], ...next };
      repaint();
    },
    describe,
  };
}
