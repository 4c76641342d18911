// The deduced abstract policy: climbing the value of an abstract policy, one
// iteration at a time, so that a page can draw while it climbs.
// See Python's `absprob_pi`.

import { uniformPolicy } from "./policies.js";
import { factorTask, ofTask, stateActionValues, TIE } from "./solvers.js";

/** @import { Climbed, Problem } from "../types.d.ts" */

export const ITERATIONS = 300; // until Grad stands

/**
 * Value of an abstract policy (Z, A) from the start distribution (S,), its
 * gradient (Z, A) and the discounted visits (Z,); uniform start by default.
 *
 * @param {Problem} tasks
 * @param {Float64Array} policy
 * @param {Float64Array} [start]
 */
export function abstractGradient(tasks, policy, start) {
  const { nStates, nTasks, nActions, nAbstract, rho, terminal, gamma } = tasks;
  const gradient = new Float64Array(nAbstract * nActions);
  const visits = new Float64Array(nAbstract);
  const d = start ? start.slice() : new Float64Array(nStates).fill(1 / nStates);
  const v = tasks.reward.slice();
  const q = new Float64Array(nActions);
  let value = 0;
  for (let task = 0; task < nTasks; task++) {
    const matrix = factorTask(tasks, task, policy, rho);
    const mine = (array) => ofTask(tasks, array, task);
    matrix.solve(mine(v));
    const weights = mine(d).slice();
    mine(v).forEach((x, cell) => (value += weights[cell] * x));
    matrix.solve(mine(d), true);
  }
  for (let s = 0; s < nStates; s++) {
    if (terminal[s]) continue;
    stateActionValues(tasks, v, s, q);
    visits[rho[s]] += d[s];
    for (let a = 0; a < nActions; a++) {
      gradient[nActions * rho[s] + a] += gamma * d[s] * q[a];
    }
  }
  return { value, gradient, visits };
}

/**
 * Move every abstract state by `step` of the way to its best action, made soft.
 *
 * @param {Float64Array} policy
 * @param {{ gradient: Float64Array, visits: Float64Array }} found
 * @param {Uint8Array} possible
 * @param {number} softness
 * @param {number} step
 */
function climbStep(policy, { gradient, visits }, possible, softness, step) {
  const nActions = possible.length / visits.length;
  visits.forEach((visit, z) => {
    if (!(visit > 0)) return;
    const first = z * nActions;
    let total = 1 - softness;
    let most = -Infinity;
    for (let i = first; i < first + nActions; i++) {
      if (!possible[i]) continue;
      total += softness / nActions;
      most = Math.max(most, gradient[i]);
    }
    // The first of the best: rounding must not decide where two are as good.
    const least = most - TIE * Math.abs(most);
    let best = first;
    while (!possible[best] || gradient[best] < least) best++;
    for (let i = first; i < first + nActions; i++) {
      const soft = possible[i] ? softness / nActions : 0;
      const target = (soft + (i === best ? 1 - softness : 0)) / total;
      policy[i] += step * (target - policy[i]);
    }
  });
}

/**
 * Yield { iteration, value, policy, gradient, visits } for the first policy and
 * after each iteration.  `policy` is one array, changed from yield to yield.
 *
 * @param {Problem} tasks
 * @param {{ initial?: Float64Array, start?: Float64Array, iterations?: number, softness?: number }} options
 * @returns {Generator<Climbed, void>}
 */
export function* absprobPi(tasks, options = {}) {
  const { initial, start, iterations = ITERATIONS, softness = 0.05 } = options;
  const policy = initial ? initial.slice() : uniformPolicy(tasks.possible, tasks.nActions);
  for (let iteration = 0;; iteration++) {
    const found = abstractGradient(tasks, policy, start);
    yield { iteration, policy, ...found };
    if (iteration === iterations) return;
    climbStep(policy, found, tasks.possible, softness, 1 / (2 + iteration));
  }
}

/**
 * Go on with an iterator for some milliseconds; return { last, done }.  `last` is
 * what it yielded last, undefined where nothing was left.
 *
 * @template T
 * @param {Iterator<T>} iterator
 * @param {number} milliseconds
 * @returns {{ last?: T, done: boolean }}
 */
export function runFor(iterator, milliseconds) {
  const end = performance.now() + milliseconds;
  let last;
  do {
    const { value, done } = iterator.next();
    if (done) return { last, done };
    last = value;
  } while (performance.now() < end);
  return { last, done: false };
}

/**
 * Grad, climbed to the end at once.
 *
 * @param {Problem} tasks
 * @param {object} [options] of absprobPi
 * @returns {Float64Array}
 */
export function deducedPolicy(tasks, options) {
  let policy;
  for (const step of absprobPi(tasks, options)) policy = step.policy;
  return policy;
}
