// The view of a building: SVG, one tab stop, arrow keys inside; cells can be lit.  What
// else is shown over cells is in `layers`.

import { STEP } from "../engine/maps.js";
import { drawn, make, place } from "./dom.js";
import { frameOf } from "./frame.js";
import { addLit } from "./lit.js";
import { CELL, edges, middle, star } from "./plan.js";

/** @import { Building } from "../types.d.ts" */

/**
 * @typedef {object} BuildingOptions
 * @property {string} label
 * @property {(cell: number) => string} [describe]
 * @property {(act: { cell: number, edge: number | null, event: any }) => void} [onAct]
 * @property {(cell: number | null) => void} [onPoint]
 * @property {(key: string, cell: number, event: KeyboardEvent) => boolean} [onKey]
 * @property {string[][]} [keys]
 * @property {number} [minCell]
 */

const NEAR = 0.25; // of a cell's side: the pointer means the wall
const REST = 400; // milliseconds
const ARROWS = { ArrowUp: 0, ArrowRight: 1, ArrowDown: 2, ArrowLeft: 3 };
const KEYS = [
  ["arrow keys", "go from cell to cell"],
  ["Home, End", "go to the first or last cell of the row"],
  ["?", "shows or hides this list"],
];

/** @param {BuildingOptions} options */
export function building(options) {
  const { label, describe, onAct, onPoint, onKey, keys = [], minCell } = options;
  const canWalk = Boolean(describe || onAct || onKey);
  const svg = drawn("svg", {
    class: "ab-building",
    role: canWalk ? "grid" : "img",
    "aria-label": label,
  });
  const isSaid = !onAct || keys.some(([key]) => key.startsWith("Enter"));
  const list = [...(isSaid ? [] : [["Enter, Space", "act on the cell"]]), ...keys, ...KEYS];
  const help = make(
    "dl",
    { class: "ab-keys", hidden: true },
    list.map(([key, text]) => make("div", {}, make("dt", {}, key), make("dd", {}, text))),
  );
  const frame = frameOf(svg, { label: label || "The building", hasStops: canWalk });
  const hint = make("p", { class: "ab-hint" }, canWalk && "Press ? for the keys.");
  const node = make("div", { class: "ab-view" }, frame, hint, help);
  const view = { node, svg, cell: 0, cells: [], plan: null, show, select, focus, rename };
  view.map = show;
  let naming = null;

  // Draw a map.  { goals }: the cells to mark, all goals of the map by default;
  // { aim }: the one that counts, the others are hollow.
  function show(map, { goals = map.goals, aim = null } = {}) {
    const isNew = view.plan?.text !== map.text;
    const marked = `${[...goals]} ${aim}`;
    if (!isNew && view.marked === marked) return;
    const hadFocus = svg.contains(document.activeElement);
    view.plan = map;
    view.marked = marked;
    svg.setAttribute("viewBox", `-2 -2 ${CELL * map.width + 4} ${CELL * map.height + 4}`);
    frame.style.setProperty("--ab-columns", map.width);
    frame.style.setProperty("--ab-rows", map.height);
    frame.style.setProperty("--ab-min", `${minCell ?? (onAct ? 24 : 8)}px`);
    view.cell = Math.min(view.cell, map.nCells - 1);
    if (isNew) {
      view.cells = Array.from({ length: map.nCells }, (_, cell) => tile(map, cell));
      view.names = [];
      const rows = Array.from(
        { length: map.height },
        (_, row) =>
          drawn(
            "g",
            canWalk ? { role: "row" } : {},
            view.cells.slice(row * map.width, (row + 1) * map.width),
          ),
      );
      const above = { class: "ab-above", "aria-hidden": "true" };
      view.below = drawn("g", above); // patterns, under walls
      view.signs = drawn("g", above); // arrows, texts, over them
      view.goals = drawn("g", above);
      view.actors = drawn("g", above);
      view.ring = drawn("rect", { class: "ab-ring", width: CELL - 2, height: CELL - 2 });
      const over = drawn("g", above, view.ring);
      svg.replaceChildren(
        ...rows,
        view.below,
        edges(map, above),
        view.goals,
        view.signs,
        view.actors,
        over,
      );
      view.layers = {};
    }
    view.goals.replaceChildren(
      ...[...goals].map((cell) => star(map, cell, aim === null || cell === aim)),
    );
    select(view.cell);
    rename();
    showRing();
    if (hadFocus) view.cells[view.cell].focus();
  }

  function tile(map, cell) {
    const [x, y] = middle(map, cell);
    return drawn("rect", {
      x: x - CELL / 2,
      y: y - CELL / 2,
      width: CELL,
      height: CELL,
      class: map.inRoom[cell] ? "ab-tile ab-room" : "ab-tile",
      role: canWalk && "gridcell",
      "data-cell": cell,
    });
  }

  const nameOf = (cell) => (describe ? describe(cell) : `${place(view.plan, cell)}`);

  // Make a cell the one that the keys start from.
  function select(cell) {
    if (!canWalk) return;
    view.cells[view.cell]?.removeAttribute("tabindex");
    view.cell = cell;
    view.cells[cell].setAttribute("tabindex", 0);
    tell(cell);
  }
  // Say anew what is in the cells, after the state changed: in the selected one at once,
  // in all others, for who explores by touch, when nothing moves any more.
  function rename() {
    if (!canWalk) return;
    tell(view.cell);
    clearTimeout(naming);
    naming = setTimeout(nameRow, REST, 0);
  }
  function nameRow(row) {
    const { width, height } = view.plan;
    if (!svg.isConnected) return;
    for (let cell = row * width; cell < (row + 1) * width; cell++) tell(cell);
    if (row + 1 < height) naming = setTimeout(nameRow, 0, row + 1);
  }
  function tell(cell) {
    const name = nameOf(cell);
    if (view.names[cell] === name) return;
    view.names[cell] = name;
    view.cells[cell].setAttribute("aria-label", name);
  }
  function focus(cell) {
    select(cell);
    view.cells[cell].focus({ preventScroll: false });
  }

  const cellOf = (event) => {
    const found = event.target.closest?.("[data-cell]");
    return found ? Number(found.dataset.cell) : null;
  };
  // The wall that a pointer is near, or null.
  function edgeOf(event, cell) {
    const box = view.cells[cell].getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width;
    const y = (event.clientY - box.top) / box.height;
    const gaps = [y, 1 - x, 1 - y, x];
    const least = Math.min(...gaps);
    return least < NEAR ? gaps.indexOf(least) : null;
  }

  function press(event) {
    const cell = cellOf(event);
    if (cell === null || event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === "?") help.hidden = !help.hidden;
    else if (onKey?.(event.key, cell, event)) rename();
    else if ((event.key === "Enter" || event.key === " ") && onAct) {
      onAct({ cell, edge: null, event });
    } else {
      const { width, height } = view.plan;
      const [row, column] = [Math.floor(cell / width), cell % width];
      if (event.key in ARROWS) {
        const [dr, dc] = STEP[ARROWS[event.key]];
        const [r, c] = [row + dr, column + dc];
        if (r >= 0 && r < height && c >= 0 && c < width) focus(r * width + c);
      } else if (event.key === "Home") focus(row * width);
      else if (event.key === "End") focus(row * width + width - 1);
      else return;
    }
    event.preventDefault();
  }

  // A frame over everything: the outline of a tile would lie under its neighbours.
  function showRing() {
    const cell = view.plan && svg.querySelector(".ab-tile:focus-visible")?.dataset.cell;
    view.ring?.toggleAttribute("hidden", !cell);
    if (!cell) return;
    const [x, y] = middle(view.plan, Number(cell));
    view.ring.setAttribute("x", x - CELL / 2 + 1);
    view.ring.setAttribute("y", y - CELL / 2 + 1);
  }

  if (canWalk) {
    svg.addEventListener("keydown", press);
    // On the frame: an SVG that listens for the focus would be a tab stop of its own.
    for (const kind of ["focusin", "focusout"]) {
      frame.addEventListener(kind, () => queueMicrotask(showRing));
    }
    svg.addEventListener("click", (event) => {
      const cell = cellOf(event);
      if (cell === null) return;
      select(cell);
      onAct?.({ cell, edge: edgeOf(event, cell), event });
    });
  }
  if (onPoint) {
    const point = (event) => onPoint(cellOf(event));
    for (const kind of ["pointerover", "focusin"]) frame.addEventListener(kind, point);
    for (const kind of ["pointerleave", "focusout"]) {
      frame.addEventListener(kind, () => onPoint(null));
    }
  }
  return addLit(view);
}
