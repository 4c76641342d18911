// What a building view shows over its cells: tints, texts, arrows, patterns, robots,
// trails.  Only what differs from the last time is painted.

import { STEP } from "../engine/maps.js";
import { building } from "./building.js";
import { drawn, marker } from "./dom.js";
import { frames, perCell } from "./lit.js";
import { CELL, middle } from "./plan.js";

/** @import { BuildingOptions } from "./building.js" */

const KINDS = [
  "",
  "M0 3H6",
  "M3 0V6",
  "M0 6L6 0",
  "M0 0L6 6",
  "M3 1V5M1 3H5",
  "M0 3H6M3 0V6",
  "M1 1L5 5M5 1L1 5",
  "M0 2H6M0 4H6",
  "M2 0V6M4 0V6",
];
const HUES = 10;

/**
 * A view of a building, with layers.
 *
 * @param {BuildingOptions} options
 */
export const layered = (options) => addLayers(building(options));

/** @param {any} view */
export function addLayers(view) {
  const centre = (cell) => {
    const [x, y] = middle(view.plan, cell);
    return { x, y };
  };

  // Tint by number: the stronger, the higher; NaN leaves a cell as it is.
  view.values = (numbers, /** @type {{ low?: number, high?: number }} */ { low, high } = {}) => {
    const known = numbers ? [...numbers].filter(Number.isFinite) : [];
    const bottom = low ?? Math.min(...known);
    const range = (high ?? Math.max(...known)) - bottom || 1;
    view.cells.forEach((tile, cell) => {
      const x = numbers?.[cell];
      const has = Number.isFinite(x);
      const part = has ? Math.round(100 * Math.min(Math.max((x - bottom) / range, 0), 1)) : -1;
      if (tile.abPart === part) return;
      tile.abPart = part;
      tile.classList.toggle("ab-valued", has);
      tile.style.setProperty("--ab-part", `${part}%`);
    });
  };

  view.texts = perCell(
    view,
    "texts",
    "signs",
    "text",
    (cell) => ({ ...centre(cell), dy: "0.35em", class: "ab-text" }),
    (node, text) => {
      node.textContent = text;
      node.classList.toggle("ab-small", `${text}`.length > 3);
    },
  );

  // Four weights a cell (N, E, S, W), 0..1: length and thickness of an arrow.
  const arrows = perCell(
    view,
    "arrows",
    "signs",
    "path",
    (cell) => {
      const { x, y } = centre(cell);
      return { transform: `translate(${x} ${y})`, class: "ab-arrow" };
    },
    (node, path) => node.setAttribute("d", path),
  );
  const arrowPath = (weights) =>
    weights
      .map((w, d) => {
        if (!(w > 0.02)) return "";
        const [dr, dc] = STEP[d];
        const tip = CELL * (0.15 + 0.3 * w);
        const barb = CELL * (0.05 + 0.06 * w);
        const [x, y] = [dc * tip, dr * tip];
        const back = [x - dc * barb, y - dr * barb];
        const wing = (side) =>
          `L${(back[0] + side * dr * barb).toFixed(2)} ${(back[1] + side * dc * barb).toFixed(2)}`;
        return `M0 0L${x.toFixed(2)} ${y.toFixed(2)}${wing(1)}M${x.toFixed(2)} ${y.toFixed(2)}${
          wing(-1)
        }`;
      })
      .join("");
  view.arrows = (weights) => {
    const paths = weights &&
      view.cells.map((_, cell) =>
        arrowPath([0, 1, 2, 3].map((d) => weights[4 * cell + d])) || null
      );
    arrows(paths);
  };

  // A hue and a pattern per number: equal numbers look alike.
  const patterns = perCell(
    view,
    "patterns",
    "below",
    "path",
    (cell) => {
      const { x, y } = centre(cell);
      return { transform: `translate(${x - CELL / 2} ${y - CELL / 2})`, class: "ab-pattern" };
    },
    (node, kind) => node.setAttribute("d", tiled(KINDS[kind])),
  );
  view.classes = (numbers) => {
    view.cells.forEach((tile, cell) => {
      const k = numbers ? numbers[cell] : -1;
      if (tile.abClass === k) return;
      tile.abClass = k;
      tile.classList.toggle("ab-classed", k >= 0);
      tile.style.setProperty("--ab-hue", `${((k % HUES) * 360) / HUES}`);
    });
    patterns(
      numbers &&
        view.cells.map((_, cell) =>
          numbers[cell] < 0 ? null : Math.floor(numbers[cell] / HUES) % KINDS.length
        ),
    );
  };

  // A dot for each number above 0, the larger, the more.
  const dots = perCell(
    view,
    "dots",
    "below",
    "circle",
    (cell) => {
      const { x, y } = centre(cell);
      return { cx: x + 0.32 * CELL, cy: y + 0.32 * CELL, class: "ab-dot" };
    },
    (node, n) => node.setAttribute("r", Math.min(0.8 + Math.log2(n) / 3, 3)),
  );
  view.dots = (numbers) => dots(numbers && numbers.map((n) => n || null));

  const chosen = frames(view, "chosen", "ab-chosen");
  view.choose = (cell) => chosen(view.cells.map((_, other) => (other === cell ? 1 : null)));

  // Robots: the mark of their arm on a disc; several in a cell stand side by side.
  view.robots = (robots) => {
    const { nodes } = (view.layers.robots ??= { nodes: [] });
    const crowd = {};
    robots.forEach(({ cell, arm = "none", name }, i) => {
      if (nodes[i]?.dataset.arm !== arm) {
        const body = drawn(
          "g",
          { class: "ab-robot", "data-arm": arm },
          drawn("circle", { r: 7 }),
          marker(arm, 0, 0, 4),
          name && drawn("title", { class: "nohighlight" }, name), // the search marks none
        );
        if (nodes[i]) nodes[i].replaceWith(body);
        else view.actors.append(body);
        nodes[i] = body;
      }
      const here = (crowd[cell] = (crowd[cell] ?? -1) + 1);
      const { x, y } = centre(cell);
      const isAlone = robots.filter((other) => other.cell === cell).length === 1;
      const [dx, dy] = isAlone ? [0, 0] : [here % 2 ? 4.5 : -4.5, here % 4 > 1 ? 4.5 : -4.5];
      nodes[i].style.transform = `translate(${x + dx}px, ${y + dy}px) scale(${isAlone ? 1 : 0.6})`;
    });
    nodes.splice(robots.length).forEach((node) => node.remove());
  };

  view.trail = (cells) => {
    const layer = (view.layers.trail ??= { path: null });
    layer.path ??= view.below.appendChild(drawn("path", { class: "ab-trail" }));
    const points = (cells ?? []).map((cell) => middle(view.plan, cell).join(" "));
    layer.path.setAttribute("d", points.length > 1 ? `M${points.join("L")}` : "");
  };
  return view;
}

// A pattern drawn out over one cell: no ids, so that no two views can clash.
const tiled = (unit) => {
  if (!unit) return "";
  const numbers = (dx, dy) =>
    unit.replace(/([MLHV])(\d+)(?: (\d+))?/g, (_, letter, a, b) => {
      if (letter === "H") return `H${+a + dx}`;
      if (letter === "V") return `V${+a + dy}`;
      return `${letter}${+a + dx} ${+(b ?? 0) + dy}`;
    });
  return [1, 7, 13].flatMap((y) => [1, 7, 13].map((x) => numbers(x, y))).join("");
};
