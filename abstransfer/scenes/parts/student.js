// Intervals as `stats.py` has them: Student's, of a mean or of a gain.

import { spec } from "../python.js";

/**
 * Ascending numbers, and a share: as numpy.quantile.
 *
 * @param {number[]} sorted
 * @param {number} share
 */
export function quantile(sorted, share) {
  const place = share * (sorted.length - 1);
  const i = Math.floor(place);
  return sorted[i] + (place - i) * ((sorted[i + 1] ?? sorted[i]) - sorted[i]);
}

/** @param {number[]} x */
const mean = (x) => x.reduce((a, b) => a + b, 0) / x.length;

/**
 * [estimate, low, high] of the mean of runs; NaN for ends where they are too few.
 *
 * @param {number[]} runs
 */
export function meanInterval(runs) {
  const [middle, n] = [mean(runs), runs.length];
  const variance = runs.reduce((sum, x) => sum + (x - middle) ** 2, 0) / (n - 1);
  const half = (spec.student[n] ?? NaN) * Math.sqrt(variance / n);
  return [middle, middle - half, middle + half];
}

/**
 * [estimate, low, high] of mean(a) / mean(b) - 1; run i of a with run i of b.
 *
 * @param {number[]} a
 * @param {number[]} b
 */
export function gainInterval(a, b) {
  const [x, y] = [mean(a), mean(b)];
  const logs = a.map((run, i) => Math.log(x / y) + run / x - b[i] / y);
  return meanInterval(logs).map(Math.expm1);
}
