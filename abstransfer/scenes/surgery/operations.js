// What the reader may do to notes: as `operations.py` does it, luck included.

import { seedState } from "../engine/random.js";

/** @import { World } from "../types.d.ts" */

const A = 8;

/**
 * Which states have a note above 0, as 0 or 1.
 *
 * @param {Float64Array} notes
 */
export function noted(notes) {
  return Uint8Array.from({ length: notes.length / A }, (_, s) => {
    for (let i = A * s; i < A * s + A; i++) if (notes[i] > 0) return 1;
    return 0;
  });
}

/**
 * The notes of a robot after an operation; `other` are another's.
 *
 * @param {string} kind
 * @param {Float64Array} mine
 * @param {Float64Array} other
 * @param {World} world
 * @param {number} luck
 */
export function operate(kind, mine, other, world, luck) {
  const notes = mine.slice();
  const [has, helps] = [noted(mine), noted(other)];
  const words = kind === "deal" || kind === "thin" ? seedState(luck, [], mine.length) : null;
  for (let s = 0; s < world.nStates; s++) {
    const row = A * s;
    if (kind === "erase" && !helps[s]) notes.fill(0, row, row + A);
    if (kind === "graft" && !has[s]) notes.set(other.subarray(row, row + A), row);
    if (kind === "thin" && !(words[row] >>> 31)) notes.fill(0, row, row + A);
    if (kind === "deal" && has[s]) {
      const there = [0, 1, 2, 3, 4, 5, 6, 7].filter((a) => world.ways[row + a]);
      const drawn = there.toSorted((a, b) => words[row + a] - words[row + b]);
      there.forEach((a, k) => (notes[row + a] = mine[row + drawn[k]]));
    }
  }
  return notes;
}
