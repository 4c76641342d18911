// The plan of a building as SVG: walls, doors and goals, as Python's figures draw them.

import { DOOR, OPEN } from "../engine/maps.js";
import { drawn, marker } from "./dom.js";

/** @import { Building } from "../types.d.ts" */

export const CELL = 20; // units of the drawing

/**
 * @param {{ width: number }} map
 * @param {number} cell
 * @returns {[number, number]}
 */
export const middle = ({ width }, cell) => [
  CELL * ((cell % width) + 0.5),
  CELL * (Math.floor(cell / width) + 0.5),
];

/**
 * Walls as lines, doors as hollow bars in a gap of the wall, as Python draws them.
 *
 * @param {Building} map
 * @param {Record<string, any>} above attributes
 */
export function edges(map, above) {
  const chars = map.text.split("\n");
  let [walls, doors] = ["", ""];
  chars.forEach((line, row) => {
    for (let column = (row + 1) % 2; column < line.length; column += 2) {
      const char = line[column];
      if (char === OPEN) continue;
      const isFlat = row % 2 === 0;
      const [x, y] = isFlat
        ? [(CELL * (column - 1)) / 2, (CELL * row) / 2]
        : [(CELL * column) / 2, (CELL * (row - 1)) / 2];
      walls += `M${x} ${y}${isFlat ? "h" : "v"}${CELL}`;
      if (char !== DOOR) continue;
      const gap = 0.18 * CELL;
      doors += isFlat ? `M${x + gap} ${y}h${CELL - 2 * gap}` : `M${x} ${y + gap}v${CELL - 2 * gap}`;
    }
  });
  return drawn(
    "g",
    above,
    drawn("path", { d: walls, class: "ab-wall" }),
    drawn("path", { d: doors, class: "ab-door" }),
    drawn("path", { d: doors, class: "ab-doorway" }),
  );
}

/**
 * @param {Building} map
 * @param {number} cell
 * @param {boolean} isFull
 */
export function star(map, cell, isFull) {
  const mark = marker("optimal", ...middle(map, cell), isFull ? 7 : 5.5);
  mark.setAttribute("class", isFull ? "ab-goal" : "ab-goal ab-othergoal");
  mark.removeAttribute("style");
  return mark;
}
