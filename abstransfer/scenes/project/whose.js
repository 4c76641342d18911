// Whose work it is: from a name follow a seed and a building.  See Python's
// `project/student.py`, and `reproduction/buildings.py` with NumPy's generator.

import { CORRIDOR, DOOR, GOAL, OPEN, ROOM, STEP, toText } from "../engine/maps.js";
import { seedState } from "../engine/random.js";
import { sha256 } from "./hash.js";

const [ROWS, COLUMNS, BLOCK] = [6, 10, 3]; // blocks of cells
const YEAR = 2015n;
const FACTOR = 0x2360ed051fc65da44385df649fccf645n; // of PCG64
const wrapped = (x) => BigInt.asUintN(128, x);

// What Python's str.split takes for blanks.
// deno-lint-ignore no-control-regex
const BLANKS = /(?:[^\S\uFEFF]|[\x1c-\x1f\x85])+/g;

/**
 * A name in one form; "" where it is none.
 *
 * @param {string} name
 */
export function written(name) {
  const text = name.normalize("NFC").replace(BLANKS, " ").replace(/^ | $/g, "");
  return /^\.*$/.test(text) ? "" : text;
}

/**
 * The seed of a name: capitals do not matter.
 *
 * @param {string} name
 */
export const seedOf = (name) =>
  parseInt(
    sha256([...written(name)].map((sign) => sign.toUpperCase().toLowerCase()).join("")).slice(0, 8),
    16,
  );

/**
 * numpy.random.default_rng([2015, seed]).integers, as a function of n: 0..n-1.
 *
 * @param {number} seed
 */
function generator(seed) {
  const words = [...seedState(YEAR + (BigInt(seed) << 32n), [], 8)].map(BigInt);
  const [s1, s0, i1, i0] = [0, 2, 4, 6].map((i) => words[i] + (words[i + 1] << 32n));
  const increment = wrapped((((i1 << 64n) + i0) << 1n) | 1n);
  let state = wrapped((increment + (s1 << 64n) + s0) * FACTOR + increment);
  const rest = [];
  function word() {
    if (!rest.length) {
      state = wrapped(state * FACTOR + increment);
      const [mixed, turn] = [BigInt.asUintN(64, (state >> 64n) ^ state), state >> 122n];
      const both = BigInt.asUintN(64, (mixed >> turn) | (mixed << ((64n - turn) & 63n)));
      rest.push(Number(both & 0xffffffffn), Number(both >> 32n));
    }
    return rest.shift();
  }
  return (n) => {
    if (n === 1) return 0;
    for (;;) { // Lemire's way: 53 bits hold the product of a word and a small n
      const product = word() * n;
      if (product % 2 ** 32 >= 2 ** 32 % n) return Math.floor(product / 2 ** 32);
    }
  };
}

/**
 * A student's own building, as text: the doors between its rooms make a tree.
 *
 * @param {string} name
 */
export function buildingOf(name) {
  const below = generator(seedOf(name));
  const isRoom = Array.from({ length: ROWS * COLUMNS }, (_, i) => ![1, 4].includes(row(i)));
  // Two columns of ten link the corridors: drawn as NumPy chooses, then shuffled in vain.
  const first = below(COLUMNS - 1);
  const second = below(COLUMNS);
  below(2);
  for (const column of [first, second === first ? COLUMNS - 1 : second]) {
    isRoom[2 * COLUMNS + column] = isRoom[3 * COLUMNS + column] = false;
  }
  const rooms = [...isRoom.keys()].filter((i) => isRoom[i]);
  isRoom[rooms[below(rooms.length)]] = false;
  return drawn(isRoom, tree(isRoom, below));
}

const row = (block) => Math.floor(block / COLUMNS);

// Doors between blocks [from, to]: one at a time, to a room that has none yet.
function tree(isRoom, below) {
  const isReached = isRoom.map((is) => !is);
  const doors = [];
  while (isReached.includes(false)) {
    const ways = isReached.flatMap((is, from) =>
      is
        ? STEP.flatMap(([down, right]) => {
          const to = from + down * COLUMNS + right;
          const isBeside = right === 0 || row(to) === row(from);
          return isBeside && isReached[to] === false ? [[from, to]] : [];
        })
        : []
    );
    const door = ways[below(ways.length)];
    doors.push(door);
    isReached[door[1]] = true;
  }
  return doors;
}

function drawn(isRoom, doors) {
  const size = 2 * BLOCK; // characters of a block
  const chars = Array.from(
    { length: size * ROWS + 1 },
    (_, y) =>
      Array.from({ length: size * COLUMNS + 1 }, (_, x) => {
        // What lies to both sides: a room by its number, the corridor, or the outside.
        const region = (y, x) => {
          const block = Math.floor(y / size) * COLUMNS + Math.floor(x / size);
          if (y < 0 || x < 0 || y >= size * ROWS || x >= size * COLUMNS) return -2;
          return isRoom[block] ? block : -1;
        };
        if (y % 2 && x % 2) {
          if (region(y, x) < 0) return CORRIDOR;
          return y % size === BLOCK && x % size === BLOCK ? GOAL : ROOM;
        }
        if (y % 2 === 0 && x % 2 === 0) return "+";
        if (y % 2 === 0) return region(y - 1, x) === region(y + 1, x) ? OPEN : "-";
        return region(y, x - 1) === region(y, x + 1) ? OPEN : "|";
      }),
  );
  for (const [from, to] of doors) {
    const middle = (a, b) => BLOCK * (a + b + 1); // half way between the centres
    chars[middle(row(from), row(to))][middle(from % COLUMNS, to % COLUMNS)] = DOOR;
  }
  return toText(chars);
}
