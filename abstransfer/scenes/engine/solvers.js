// Exact values and optimal actions, as in Python's `solvers`:
// V(s) = R(s) + gamma sum_a pi(s, a) Q(s, a), and V = R in terminal states.
//
// A policy is a flat array of rows of A probabilities.  `rows` says which row a
// state uses: leave it out for a policy (S, A), pass rho for an abstract policy.

import { eliminationOf } from "./elimination.js";

/** @import { Problem } from "../types.d.ts" */

export const TIE = 1e-9; // actions whose values differ by less are equally good

/**
 * Factor I - gamma P of one task under a policy.
 *
 * @param {Problem} tasks
 * @param {number} task
 * @param {Float64Array} policy
 * @param {ArrayLike<number>} [rows]
 */
export function factorTask(tasks, task, policy, rows) {
  const { nCells, nActions, gamma, success, labels, nWays, goal } = tasks;
  const matrix = eliminationOf(tasks.map);
  const { values, place, diagonal } = matrix;
  values.fill(0);
  for (let cell = 0; cell < nCells; cell++) {
    if (cell === goal[task]) {
      values[diagonal[cell]] = 1;
      continue;
    }
    const s = task * nCells + cell;
    const row = nActions * (rows ? rows[s] : s);
    let stay = 1;
    for (let d = 0; d < 4; d++) {
      const a = labels[4 * s + d];
      if (a < 0) continue;
      const p = (policy[row + a] * success) / nWays[nActions * s + a];
      stay -= p;
      values[place[4 * cell + d]] = -gamma * p;
    }
    values[diagonal[cell]] = 1 - gamma * stay;
  }
  matrix.factor();
  return matrix;
}

/**
 * The part of an array over states that belongs to a task, not copied.
 *
 * @param {Problem} tasks
 * @param {Float64Array} array
 * @param {number} task
 */
export const ofTask = (tasks, array, task) =>
  array.subarray(task * tasks.nCells, (task + 1) * tasks.nCells);

/**
 * Value of every state under a policy, (S,).
 *
 * @param {Problem} tasks
 * @param {Float64Array} policy
 * @param {ArrayLike<number>} [rows]
 * @returns {Float64Array}
 */
export function evaluatePolicy(tasks, policy, rows) {
  const v = tasks.reward.slice();
  for (let task = 0; task < tasks.nTasks; task++) {
    factorTask(tasks, task, policy, rows).solve(ofTask(tasks, v, task));
  }
  return v;
}

/**
 * Write Q(s, .) into q (A,), given values v (S,).
 *
 * @param {Problem} tasks
 * @param {Float64Array} v
 * @param {number} s
 * @param {Float64Array} q
 * @returns {Float64Array}
 */
export function stateActionValues(tasks, v, s, q) {
  const { neighbors, nCells, nActions, labels, nWays, success } = tasks;
  const cell = s % nCells;
  q.fill(0);
  for (let d = 0; d < 4; d++) {
    const a = labels[4 * s + d];
    if (a >= 0) q[a] += v[s - cell + neighbors[4 * cell + d]];
  }
  for (let a = 0; a < nActions; a++) {
    const n = nWays[nActions * s + a];
    q[a] = n ? (success / n) * q[a] + (1 - success) * v[s] : v[s];
  }
  return q;
}

/**
 * Q (S, A), flat; 0 in terminal states.
 *
 * @param {Problem} tasks
 * @param {Float64Array} v
 * @returns {Float64Array}
 */
export function actionValues(tasks, v) {
  const { nStates, nActions, terminal } = tasks;
  const q = new Float64Array(nStates * nActions);
  for (let s = 0; s < nStates; s++) {
    if (terminal[s]) continue;
    stateActionValues(tasks, v, s, q.subarray(nActions * s, nActions * (s + 1)));
  }
  return q;
}

/**
 * The values before the first sweep of value iteration, and after each, without end.
 *
 * @param {Problem} tasks
 * @returns {Generator<Float64Array, never>}
 */
export function* valueIteration(tasks) {
  const { nStates, gamma, reward, terminal, nActions } = tasks;
  const q = new Float64Array(nActions);
  for (let v = reward.slice();;) {
    yield v;
    const next = reward.slice();
    for (let s = 0; s < nStates; s++) {
      if (terminal[s]) continue;
      stateActionValues(tasks, v, s, q);
      next[s] += gamma * q[argmax(q)];
    }
    v = next;
  }
}

/**
 * Optimal value of every state, exact, (S,): policy iteration, task by task, from
 * the policy that is greedy to the values of the random one.
 *
 * @param {Problem} tasks
 * @returns {Float64Array}
 */
export function optimalValues(tasks) {
  const { nStates, nActions, nTasks } = tasks;
  const uniform = new Float64Array(nActions).fill(1 / nActions);
  const best = new Uint8Array(nStates);
  const v = evaluatePolicy(tasks, uniform, best);
  const pure = Float64Array.from(
    { length: nActions ** 2 },
    (_, i) => i % (nActions + 1) === 0 ? 1 : 0,
  );
  for (let task = 0; task < nTasks; task++) {
    const part = ofTask(tasks, v, task);
    improve(tasks, task, v, best);
    do {
      part.set(ofTask(tasks, tasks.reward, task));
      factorTask(tasks, task, pure, best).solve(part);
    } while (improve(tasks, task, v, best));
  }
  return v;
}

/**
 * Choose better actions for the states of a task; return whether there were any.
 * Only by more than TIE: equally good ones would swap for ever on rounding.
 *
 * @param {Problem} tasks
 * @param {number} task
 * @param {Float64Array} v
 * @param {Uint8Array} best
 */
function improve(tasks, task, v, best) {
  const { nCells, nActions, terminal } = tasks;
  const q = new Float64Array(nActions);
  let isBetter = false;
  for (let s = task * nCells; s < (task + 1) * nCells; s++) {
    if (terminal[s]) continue;
    stateActionValues(tasks, v, s, q);
    const a = argmax(q);
    if (q[a] <= q[best[s]] + TIE) continue;
    best[s] = a;
    isBetter = true;
  }
  return isBetter;
}

/** @param {ArrayLike<number>} values */
export function argmax(values) {
  let best = 0;
  for (let i = 1; i < values.length; i++) if (values[i] > values[best]) best = i;
  return best;
}

/**
 * Which actions are optimal given the optimal values v, (S, A): all within TIE of
 * the best; none in a terminal state.
 *
 * @param {Problem} tasks
 * @param {Float64Array} v
 * @returns {Uint8Array}
 */
export function optimalActions(tasks, v) {
  const { nStates, nActions, terminal } = tasks;
  const q = actionValues(tasks, v);
  const optimal = new Uint8Array(nStates * nActions);
  for (let s = 0; s < nStates; s++) {
    if (terminal[s]) continue;
    const row = q.subarray(nActions * s, nActions * (s + 1));
    const least = row[argmax(row)] - TIE;
    row.forEach((value, a) => (optimal[nActions * s + a] = value >= least ? 1 : 0));
  }
  return optimal;
}

/**
 * @param {any} values an array of numbers
 * @returns {number}
 */
export const mean = (values) => values.reduce((sum, x) => sum + x, 0) / values.length;
