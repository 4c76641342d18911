// Sparse elimination on the graph of a building.
//
// The tasks of a map are independent, and their matrices I - gamma P have the same
// places: a cell and its neighbors.  Which new places elimination fills is found
// once per map.  Cells with the fewest neighbors left go first, so rooms dissolve
// before the corridor they open on, and little is filled.  No pivoting is needed:
// the diagonal dominates as gamma < 1.

/** @import { Plan } from "../types.d.ts" */

/**
 * Order of elimination, and the neighbors of each cell left at its turn.
 *
 * @param {Int32Array} neighbors
 */
function eliminationOrder(neighbors) {
  const nCells = neighbors.length / 4;
  const left = Array.from(
    { length: nCells },
    (_, cell) => new Set(neighbors.subarray(4 * cell, 4 * cell + 4).filter((other) => other >= 0)),
  );
  const order = [];
  const isGone = new Uint8Array(nCells);
  while (order.length < nCells) {
    let next = -1;
    for (let cell = 0; cell < nCells; cell++) {
      if (isGone[cell]) continue;
      if (next < 0 || left[cell].size < left[next].size) next = cell;
    }
    isGone[next] = 1;
    order.push(next);
    for (const cell of left[next]) {
      left[cell].delete(next);
      for (const other of left[next]) if (other !== cell) left[cell].add(other);
    }
  }
  return { order, later: order.map((cell) => [...left[cell]]) };
}

// One matrix of a map, factored in place.  Its entries lie in `values`: the
// diagonal, the rows above it, the columns below it, each in order of elimination.
class Elimination {
  /** @param {Int32Array} neighbors (C, 4) */
  constructor(neighbors) {
    const { order, later } = eliminationOrder(neighbors);
    const n = order.length;
    const turn = new Int32Array(n);
    order.forEach((cell, k) => (turn[cell] = k));
    const first = new Int32Array(n + 1);
    later.forEach((cells, k) => (first[k + 1] = first[k] + cells.length));
    const slots = later.map((cells, k) => new Map(cells.map((cell, i) => [cell, first[k] + i])));
    const nFilled = first[n];
    const placeOf = (row, column) => {
      if (row === column) return turn[row];
      return turn[row] < turn[column]
        ? n + slots[turn[row]].get(column)
        : n + nFilled + slots[turn[column]].get(row);
    };
    this.order = Int32Array.from(order);
    this.first = first;
    this.nFilled = nFilled;
    this.later = Int32Array.from(later.flat());
    this.values = new Float64Array(n + 2 * nFilled);
    this.diagonal = turn; // place in `values` of (cell, cell)
    this.place = neighbors.map((other, i) =>
      // of (cell, neighbor)
      other < 0 ? -1 : placeOf(i >> 2, other)
    );
    const nUpdates = later.reduce((sum, cells) => sum + cells.length ** 2, 0);
    this.updated = new Int32Array(nUpdates);
    let i = 0;
    for (const cells of later) {
      for (const row of cells) {
        for (const column of cells) this.updated[i++] = placeOf(row, column);
      }
    }
  }

  factor() {
    const { values, first, updated, nFilled } = this;
    const n = first.length - 1;
    let i = 0;
    for (let k = 0; k < n; k++) {
      const inverse = 1 / values[k];
      values[k] = inverse;
      const [start, end] = [n + first[k], n + first[k + 1]];
      for (let row = start + nFilled; row < end + nFilled; row++) {
        const share = (values[row] *= inverse);
        for (let column = start; column < end; column++) {
          values[updated[i++]] -= share * values[column];
        }
      }
    }
  }

  // Replace x (C,) by the solution of M x = b, or of M^T x = b.
  solve(x, isTransposed = false) {
    const { values, first, order, later, nFilled } = this;
    const n = order.length;
    const [down, up] = isTransposed ? [n, n + nFilled] : [n + nFilled, n];
    for (let k = 0; k < n; k++) {
      const cell = order[k];
      if (isTransposed) x[cell] *= values[k];
      for (let i = first[k]; i < first[k + 1]; i++) {
        x[later[i]] -= values[down + i] * x[cell];
      }
    }
    for (let k = n - 1; k >= 0; k--) {
      let sum = x[order[k]];
      for (let i = first[k]; i < first[k + 1]; i++) {
        sum -= values[up + i] * x[later[i]];
      }
      x[order[k]] = isTransposed ? sum : sum * values[k];
    }
    return x;
  }
}

/** @type {WeakMap<Plan, Elimination>} */
const known = new WeakMap();

/**
 * The elimination of a map, made once.
 *
 * @param {Plan} map
 * @returns {Elimination}
 */
export function eliminationOf(map) {
  if (!known.has(map)) known.set(map, new Elimination(map.neighbors));
  return known.get(map);
}
