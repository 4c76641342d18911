// Buildings as text: read, check, print and redraw maps.
//
// The same rules and the same messages as the Python module `maps`, which
// describes the format.  A map is a frozen record of arrays over its C cells,
// numbered row by row; entry 4 * cell + direction belongs to an edge.

import { drawing } from "../python.js";
import { findPicture, named, refuse } from "./foreign.js";

/** @import { Building, Picture } from "../types.d.ts" */

export const [CORRIDOR, ROOM, GOAL, DOOR, OPEN] = [".", " ", "*", "d", " "];
const WALLS = "-|";
const { known: KNOWN, said: SAID } = drawing; // by row % 2 and column % 2
export const DIRECTIONS = ["N", "E", "S", "W"];
export const STEP = [[-1, 0], [0, 1], [1, 0], [0, -1]]; // row, column

/**
 * A character as Python's repr writes it.
 *
 * @param {string} char
 */
function quoted(char) {
  const known = { "'": `"'"`, "\\": "'\\\\'", "\t": "'\\t'" };
  if (char in known) return known[char];
  if (char === " " || !/[\p{C}\p{Z}]/u.test(char)) return `'${char}'`;
  const code = char.codePointAt(0).toString(16);
  const [mark, digits] = code.length <= 2 ? ["x", 2] : code.length <= 4 ? ["u", 4] : ["U", 8];
  return `'\\${mark}${code.padStart(digits, "0")}'`;
}

// ---- from text to characters and back

/** @param {Picture} picture */
function checkRectangle(picture) {
  const { lines } = picture;
  if (!lines.length) {
    throw new Error("the map is empty; draw at least two cells, one a goal");
  }
  const rows = lines.length;
  const columns = lines[0].length;
  lines.forEach((line, row) => {
    if (line.length === columns) return;
    const problem = `this line has ${line.length} characters, the first ${columns}`;
    const place = Math.min(line.length, columns);
    refuse(picture, row, place, problem, "make all lines equally long");
  });
  const isEven = rows % 2 === 0 || columns % 2 === 0;
  if (isEven || Math.min(rows, columns) < 3 || rows * columns < 15) {
    throw new Error(
      "H x W cells take 2H+1 rows and 2W+1 columns of text, two cells or " +
        `more; got ${rows} rows and ${columns} columns`,
    );
  }
}

/** @param {Picture} picture */
function checkCharacters(picture) {
  const { lines } = picture;
  for (const [top, left] of [[0, 0], [1, 1], [0, 1], [1, 0]]) {
    for (let row = top; row < lines.length; row += 2) {
      for (let column = left; column < lines[0].length; column += 2) {
        const char = lines[row][column];
        if (KNOWN[top][left].includes(char)) continue;
        const problem = `unknown character ${quoted(char)}`;
        refuse(picture, row, column, problem, `here stands ${SAID[top][left]}`);
      }
    }
  }
  lines.forEach((line, row) => {
    const isEnd = row === 0 || row === lines.length - 1;
    line.forEach((char, column) => {
      const isBorder = isEnd || column === 0 || column === line.length - 1;
      const isCorner = row % 2 === 0 && column % 2 === 0; // carries no information
      if (isBorder && !isCorner && (char === OPEN || char === DOOR)) {
        refuse(picture, row, column, "the border has a hole", "put a wall there");
      }
    });
  });
}

/**
 * Draw the corners that the edges make; return the picture as text.
 *
 * @param {string[][]} chars
 * @returns {string}
 */
export function toText(chars) {
  const [rows, columns] = [chars.length, chars[0].length];
  const isSolid = (row, column) =>
    (WALLS + DOOR).includes(chars[row]?.[column] ?? "outside the picture");
  const corner = (row, column) => {
    const isEnd = row === 0 || row === rows - 1;
    if (isEnd && (column === 0 || column === columns - 1)) return "+";
    const [n, e, s, w] = STEP.map(([dr, dc]) => isSolid(row + dr, column + dc));
    if (n && s && !w && !e) return "|";
    if (w && e && !n && !s) return "-";
    return n || s || w || e ? "+" : " ";
  };
  const draw = (line, row) =>
    line.map((char, column) => (row % 2 || column % 2 ? char : corner(row, column)));
  return chars.map((line, row) => draw(line, row).join("")).join("\n");
}

// ---- from characters to arrays

/**
 * Number of the connected component of each cell, for neighbors (C, 4).
 *
 * @param {Int32Array} neighbors
 */
function components(neighbors) {
  const part = new Int32Array(neighbors.length / 4).fill(-1);
  let count = 0;
  for (let first = 0; first < part.length; first++) {
    if (part[first] >= 0) continue;
    const stack = [first];
    part[first] = count;
    while (stack.length) {
      const cell = stack.pop();
      for (let edge = 4 * cell; edge < 4 * cell + 4; edge++) {
        const other = neighbors[edge];
        if (other < 0 || part[other] >= 0) continue;
        part[other] = count;
        stack.push(other);
      }
    }
    count++;
  }
  return part;
}

/**
 * @param {string} text
 * @returns {Building}
 */
function describeMap(text) {
  const chars = text.split("\n").map((line) => [...line]);
  const [height, width] = [(chars.length - 1) / 2, (chars[0].length - 1) / 2];
  const nCells = height * width;
  const cells = new Array(nCells);
  const neighbors = new Int32Array(4 * nCells).fill(-1);
  const doors = new Uint8Array(4 * nCells);
  for (let cell = 0; cell < nCells; cell++) {
    const row = 2 * Math.floor(cell / width) + 1;
    const column = 2 * (cell % width) + 1;
    cells[cell] = chars[row][column];
    STEP.forEach(([dr, dc], direction) => {
      const edge = chars[row + dr][column + dc];
      if (WALLS.includes(edge)) return;
      neighbors[4 * cell + direction] = cell + dr * width + dc;
      doors[4 * cell + direction] = edge === DOOR ? 1 : 0;
    });
  }
  const inRoom = Uint8Array.from(cells, (kind) => (kind === CORRIDOR ? 0 : 1));
  const goals = [...cells.keys()].filter((cell) => cells[cell] === GOAL);
  const regions = components(neighbors.map((other, i) => (doors[i] ? -1 : other)));
  const nRooms = new Set(regions.filter((_, cell) => inRoom[cell])).size;
  const nDoors = doors.reduce((sum, door) => sum + door, 0) / 2;
  return Object.freeze({
    text,
    height,
    width,
    nCells,
    cells,
    inRoom,
    goals,
    neighbors,
    doors,
    regions,
    nRooms,
    nDoors,
  });
}

/**
 * Refuse a drawing that is no building a robot can learn in.
 *
 * @param {Building} map
 * @param {Picture} picture
 */
function checkBuilding(map, picture) {
  const { width, nCells, cells, inRoom, goals, neighbors, doors, regions } = map;
  const refuseCell = (cell, dr, dc, problem, remedy) =>
    refuse(
      picture,
      2 * Math.floor(cell / width) + 1 + dr,
      2 * (cell % width) + 1 + dc,
      problem,
      remedy,
    );
  const refuseFirstCell = (isBad, problem, remedy) => {
    const cell = cells.findIndex((_, i) => isBad(i));
    if (cell >= 0) refuseCell(cell, 0, 0, problem, remedy);
  };
  const refuseFirstEdge = (isBad, problem, remedy) => {
    for (let i = 0; i < 4 * nCells; i++) {
      const cell = i >> 2;
      if (neighbors[i] < 0 || !isBad(cell, neighbors[i], doors[i])) continue;
      refuseCell(cell, ...STEP[i & 3], problem, remedy);
    }
  };

  const corridors = new Set(regions.filter((_, cell) => !inRoom[cell]));
  refuseFirstEdge(
    (cell, other, door) => !door && !inRoom[cell] && cells[other] === ROOM,
    "a room opens on the corridor",
    "put a wall or a door there",
  );
  refuseFirstCell(
    (cell) => cells[cell] === GOAL && corridors.has(regions[cell]),
    "a goal in the corridor",
    "move it into a room, or make its cells a room with walls and a door",
  );
  refuseFirstEdge(
    (cell, other, door) => door && regions[cell] === regions[other],
    "the door joins a region to itself",
    "make it a wall, or close the walls of the region",
  );
  if (!goals.length) {
    throw new Error("the map has no goal; put '*' in a cell of a room");
  }
  const part = components(neighbors);
  const sizes = new Int32Array(nCells);
  part.forEach((number) => sizes[number]++);
  const largest = sizes.indexOf(sizes.reduce((most, n) => Math.max(most, n)));
  refuseFirstCell(
    (cell) => part[cell] !== largest,
    "this region cannot be reached from the rest of the building",
    "put a door in one of its walls",
  );
}

/**
 * What a text draws, though it be no legal building (yet): a page can show it.
 *
 * @param {string} text
 * @returns {Building}
 */
export function drawMap(text) {
  return explained(text, ({ lines }) => describeMap(toText(lines)));
}

/**
 * Return the map that a text draws.  An error names row, column and remedy; where there
 * is one place to mark it has `row` and `column` of the text, counted from 0, and
 * `inside`, the same in the picture that was found there.
 *
 * @param {string} text
 * @returns {Building}
 */
export function parseMap(text) {
  return explained(text, (picture) => {
    const map = describeMap(toText(picture.lines));
    checkBuilding(map, picture);
    return map;
  });
}

/**
 * @param {string} text
 * @param {(picture: Picture) => Building} build
 */
function explained(text, build) {
  try {
    const picture = findPicture(text);
    checkRectangle(picture);
    checkCharacters(picture);
    return build(picture);
  } catch (error) {
    const name = named(text);
    throw name ? new Error(name) : error;
  }
}

/**
 * Return a drawing with characters [row, column, char] of the text replaced.  It need
 * not be legal (yet): while somebody draws, a page keeps the text and shows what
 * `parseMap` says of it.
 *
 * @param {string} text
 * @param {[number, number, string][]} changes
 * @returns {string}
 */
export function redraw(text, changes) {
  const chars = text.split("\n").map((line) => [...line]);
  for (const [row, column, char] of changes) chars[row][column] = char;
  return toText(chars);
}
