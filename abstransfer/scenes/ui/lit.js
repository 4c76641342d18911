// Cells of a building that are lit, and what all layers over its cells are made by.

import { drawn } from "./dom.js";
import { CELL, middle } from "./plan.js";

// A layer: a drawing per cell, made when first needed; `paint(node, value)` shows a value.
export function perCell(view, key, group, tag, attributes, paint) {
  return (values) => {
    const layer = (view.layers[key] ??= { nodes: [], last: [] });
    for (let cell = 0; cell < view.cells.length; cell++) {
      const value = values?.[cell] ?? null;
      if (layer.last[cell] === value || (value === null && !layer.nodes[cell])) continue;
      layer.last[cell] = value;
      layer.nodes[cell] ??= view[group].appendChild(drawn(tag, attributes(cell)));
      layer.nodes[cell].toggleAttribute("hidden", value === null);
      if (value !== null) paint(layer.nodes[cell], value, cell);
    }
  };
}

// A frame in each cell that has one.
export const frames = (view, key, kind) =>
  perCell(
    view,
    key,
    "signs",
    "rect",
    (cell) => {
      const [x, y] = middle(view.plan, cell).map((each) => each - CELL / 2 + 1.5);
      return { x, y, width: CELL - 3, height: CELL - 3, class: kind };
    },
    () => {},
  );

/** @param {any} view */
export function addLit(view) {
  const frame = frames(view, "frames", "ab-litframe");
  view.lit = (cells) => {
    const chosen = new Set(cells ?? []);
    view.cells.forEach((tile, cell) => tile.classList.toggle("ab-lit", chosen.has(cell)));
    frame(view.cells.map((_, cell) => (chosen.has(cell) ? 1 : null)));
  };
  return view;
}
