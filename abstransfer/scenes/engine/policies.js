// Policies as flat arrays of rows of A probabilities, and the two induced abstract
// policies of the paper.  See Python's `policies`.

import { LABELS } from "./navigation.js";
import { optimalActions, optimalValues } from "./solvers.js";

/** @import { Tasks } from "../types.d.ts" */

// Functions take the number of actions last; by default, the relational ones.
const nActions = () => LABELS.length;
const sumOf = (values) => values.reduce((sum, x) => sum + x, 0);

/**
 * Return a copy whose rows sum to 1; a row of 0 becomes uniform over its mask, and
 * over everything where the mask is empty.
 *
 * @param {ArrayLike<number>} weights
 * @param {Uint8Array | Float64Array} mask
 * @param {number} n
 * @returns {Float64Array}
 */
function normalized(weights, mask, n = nActions()) {
  const policy = Float64Array.from(weights);
  for (let i = 0; i < policy.length; i += n) {
    const row = policy.subarray(i, i + n);
    if (!sumOf(row)) row.set(mask.subarray(i, i + n));
    if (!sumOf(row)) row.fill(1);
    const total = sumOf(row);
    row.forEach((weight, a) => (row[a] = weight / total));
  }
  return policy;
}

/**
 * The policy that draws uniformly where the mask is 1.
 *
 * @param {Uint8Array} mask
 * @param {number} [n]
 */
export const uniformPolicy = (mask, n) => normalized(mask, mask, n);

/**
 * The policy that draws from all actions: the paper's pi_rand.
 *
 * @param {number} nRows
 */
export const randomPolicy = (nRows, n = nActions()) => uniformPolicy(new Uint8Array(nRows * n), n);

/**
 * An optimal policy (S, A), given which actions are optimal; rows of terminal
 * states are 0.  Equally good actions "share" the vote, or the "first" takes it.
 *
 * @param {Uint8Array} optimal (S, A)
 * @param {string} ties
 * @returns {Float64Array}
 */
export function breakTies(optimal, ties = "share", n = nActions()) {
  const policy = Float64Array.from(optimal);
  for (let i = 0; i < policy.length; i += n) {
    const row = policy.subarray(i, i + n);
    const first = row.indexOf(1);
    if (first < 0) continue;
    if (ties === "first") row.fill(0).fill(1, first, first + 1);
    const total = sumOf(row);
    row.forEach((vote, a) => (row[a] = vote / total));
  }
  return policy;
}

/**
 * Votes (Z, A): the sum of policy rows (S, A) by abstract state.
 *
 * @param {Float64Array} policy
 * @param {Int32Array} rho
 * @param {number} nAbstract
 * @returns {Float64Array}
 */
export function countVotes(policy, rho, nAbstract) {
  const n = policy.length / rho.length;
  const votes = new Float64Array(nAbstract * n);
  policy.forEach((p, i) => {
    const a = i % n;
    votes[n * rho[(i - a) / n] + a] += p;
  });
  return votes;
}

// pi_AbsProb (Z, A): how often each action is optimal in an abstract state.
export const induceProbabilistic = normalized;

/**
 * pi_AbsND (Z, A): uniform over the actions that are optimal at least once.
 *
 * @param {Float64Array} votes
 * @param {Uint8Array} fallback
 * @param {number} [n]
 */
export const induceNondeterministic = (votes, fallback, n) =>
  normalized(votes.map((vote) => (vote > 0 ? 1 : 0)), fallback, n);

/**
 * The policy proportional to p^beta where p > 0: ND at 0, p itself at 1, the most
 * frequent actions only at infinity.
 *
 * @param {Float64Array} policy
 * @param {number} beta at least 0
 * @returns {Float64Array}
 */
export function betaPolicy(policy, beta) {
  if (!(beta >= 0)) throw new Error(`beta must be at least 0, got ${beta}`);
  const weights = Float64Array.from(policy);
  for (let i = 0; i < policy.length; i += nActions()) {
    const row = weights.subarray(i, i + nActions());
    const most = Math.max(...row);
    row.forEach((p, a) => {
      // Sums of votes that differ by rounding tie.  (1 ** Infinity is NaN.)
      if (p / most > 1 - 1e-9) row[a] = 1;
      else if (p > 0) row[a] = power(p / most, beta);
    });
  }
  return normalized(weights, weights);
}

// x ** beta for quarters of 1: of products and roots, which all machines round alike.
function power(x, beta) {
  if (!Number.isInteger(4 * beta)) return x ** beta;
  let [result, square] = [1, Math.sqrt(Math.sqrt(x))];
  for (let n = 4 * beta; n; n = Math.floor(n / 2)) {
    if (n % 2) result *= square;
    square *= square;
  }
  return result;
}

/**
 * ND and Prob of solved tasks, with the votes (Z, A) they were induced from.
 *
 * @param {Tasks} tasks
 * @param {{ ties?: string, v?: Float64Array }} options
 */
export function inducedPolicies(tasks, { ties = "share", v } = {}) {
  const optimal = optimalActions(tasks, v ?? optimalValues(tasks));
  const n = tasks.nActions;
  const shares = breakTies(optimal, ties, n);
  const votes = countVotes(shares, tasks.rho, tasks.nAbstract);
  return {
    votes,
    nd: induceNondeterministic(votes, tasks.possible, n),
    prob: induceProbabilistic(votes, tasks.possible, n),
  };
}
