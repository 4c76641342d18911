// What can be whispered, tables (Z, A) by name: the numbers of Python's
// `reproduction/whispers`.

import { parseMap } from "../engine/maps.js";
import { navigationTasks } from "../engine/navigation.js";
import { inducedPolicies, uniformPolicy } from "../engine/policies.js";
import { actionValues, optimalValues } from "../engine/solvers.js";
import { RULE } from "../engine/learning.js";

/** @import { Tasks } from "../types.d.ts" */

/**
 * Six decimals, halves to the even one, so that no machine breaks ties.
 *
 * @param {number} x
 */
function rounded(x) {
  const floor = Math.floor(x * 1e6);
  const rest = x * 1e6 - floor;
  return (rest > 0.5 || (rest === 0.5 && floor % 2) ? floor + 1 : floor) / 1e6;
}

/**
 * The mean of Q* over the states of a view; what is not known has the mean of its
 * view, or of all.
 *
 * @param {Tasks} game
 */
function valuesByView(game) {
  const { nStates, nActions, nAbstract, nWays, rho, terminal, possible } = game;
  const q = actionValues(game, optimalValues(game));
  const total = new Float64Array(nAbstract * nActions);
  const n = new Float64Array(total.length);
  for (let i = 0; i < nStates * nActions; i++) {
    const s = Math.floor(i / nActions);
    if (!nWays[i] || terminal[s]) continue;
    const place = nActions * rho[s] + (i % nActions);
    total[place] += q[i];
    n[place]++;
  }
  const mean = total.map((sum, i) => possible[i] && n[i] ? sum / n[i] : NaN);
  const average = (numbers) => {
    const known = numbers.filter((x) => !Number.isNaN(x));
    return known.length ? known.reduce((a, b) => a + b, 0) / known.length : NaN;
  };
  const all = average(mean);
  return mean.map((x, i) => {
    if (!possible[i]) return 0;
    if (!Number.isNaN(x)) return x;
    const row = i - (i % nActions);
    const own = average(mean.subarray(row, row + nActions));
    return Number.isNaN(own) ? all : own;
  });
}

/**
 * All tables of a source, a map's text.
 *
 * @param {string} source
 * @returns {Record<string, Float64Array>}
 */
export function taught(source) {
  const map = parseMap(source);
  const solved = navigationTasks(map);
  const { nd, prob } = inducedPolicies(solved);
  const eager = uniformPolicy(solved.possible);
  const made = {
    values: valuesByView(navigationTasks(map, { reward: "goal", gamma: RULE.gamma })),
    half: prob.map((p, i) => 0.5 * p + 0.5 * eager[i]),
    prob,
    nd,
    exists: Float64Array.from(solved.possible),
  };
  return Object.fromEntries(Object.entries(made).map(([name, t]) => [name, t.map(rounded)]));
}

/**
 * First notes (S, A): the row of its view in each state, times a size.
 *
 * @param {Tasks} tasks
 * @param {Float64Array} table
 * @param {number} power the size is 10 to the minus this
 */
export function firstNotes({ nStates, nActions, rho, terminal }, table, power) {
  const size = Number(`1e-${power}`); // read, not computed: the nearest number
  const notes = new Float64Array(nStates * nActions);
  for (let s = 0; s < nStates; s++) {
    for (let a = 0; a < nActions && !terminal[s]; a++) {
      notes[nActions * s + a] = size * table[nActions * rho[s] + a];
    }
  }
  return notes;
}
