// A building that is drawn by hand: what a stroke makes of its text, and how its cells
// are called.

import { CORRIDOR, DOOR, GOAL, OPEN, redraw, ROOM, STEP } from "../engine/maps.js";
import { place } from "../ui/dom.js";

export const SIDES = ["north", "east", "south", "west"];

// A building of one room with a goal in its middle.
export function blank(height, width) {
  const [wall, floor] = ["+-", "| "].map(([corner, middle]) =>
    corner + middle.repeat(2 * width - 1) + corner
  );
  const lines = [wall, ...Array(2 * height - 1).fill(floor), wall];
  const row = 2 * Math.floor(height / 2) + 1;
  const column = 2 * Math.floor(width / 2) + 1;
  return redraw(lines.join("\n"), [[row, column, GOAL]]);
}

/** @returns {[number, number]} row and column of the text */
const placeOf = ({ width }, cell) => [2 * Math.floor(cell / width) + 1, 2 * (cell % width) + 1];

// The edges of a cell to N, E, S, W: { row, column, char, other } in the text;
// `other` is the cell behind it, -1 outside.
export function edgesOf(map, cell) {
  const chars = map.text.split("\n");
  const [row, column] = placeOf(map, cell);
  return STEP.map(([dr, dc]) => {
    const [r, c] = [row + dr, column + dc];
    const isBorder = !r || !c || r === 2 * map.height || c === 2 * map.width;
    const other = isBorder ? -1 : cell + dr * map.width + dc;
    return { row: r, column: c, char: chars[r][c], other };
  });
}

// The text with an edge made what it is not: `kind` "wall" or "door", or open.
// "" where the edge is the outer wall.
export function toggleEdge(map, cell, direction, kind) {
  const { row, column, char, other } = edgesOf(map, cell)[direction];
  if (other < 0) return "";
  const wall = row % 2 ? "|" : "-";
  const next = kind === "door" ? (char === DOOR ? wall : DOOR) : char === wall ? OPEN : wall;
  return redraw(map.text, [[row, column, next]]);
}

// The text with a cell made room or corridor.  It joins its like, and walls rise
// where a room would open on the corridor.
export function paintCell(map, cell, kind) {
  const isRoom = kind === "room";
  if (map.inRoom[cell] === Number(isRoom)) return map.text;
  /** @type {[number, number, string][]} */
  const changes = [[...placeOf(map, cell), isRoom ? ROOM : CORRIDOR]];
  for (const { row, column, char, other } of edgesOf(map, cell)) {
    if (other < 0 || char === DOOR) continue;
    const isAlike = map.inRoom[other] === Number(isRoom);
    changes.push([row, column, isAlike ? OPEN : row % 2 ? "|" : "-"]);
  }
  return redraw(map.text, changes);
}

export function toggleGoal(map, cell) {
  const char = map.cells[cell] === GOAL ? ROOM : GOAL;
  return redraw(map.text, [[...placeOf(map, cell), char]]);
}

// The name of a cell, read aloud.
export function describeCell(map, cell, robot) {
  const kind = map.cells[cell] === GOAL ? "goal" : map.inRoom[cell] ? "room" : "corridor";
  const sides = edgesOf(map, cell).flatMap(({ char }, d) =>
    char === OPEN ? [] : [`${char === DOOR ? "door" : "wall"} ${SIDES[d]}`]
  );
  return [`${place(map, cell)}: ${kind}${robot === cell ? ", the robot" : ""}`, ...sides].join(
    ", ",
  );
}
