// The election of page 5, and what its advice is worth: a task between yields,
// so that a large building does not stop the hand.

import { A, navigationTasks } from "../engine/navigation.js";
import { betaPolicy, breakTies, countVotes, induceProbabilistic } from "../engine/policies.js";
import { evaluatePolicy, optimalActions, optimalValues } from "../engine/solvers.js";
import { number } from "../ui/dom.js";
import { spec } from "../python.js";

const Z = 2 ** 11;
export const { last: LAST, step: STEP } = spec;
export const WINNER = LAST + STEP; // where the slider ends: beta is infinite
export const BETAS = Array.from({ length: WINNER / STEP + 1 }, (_, i) => i * STEP);

// The votes (Z, A) of all tasks of a map, which `each` collects, with the optimal
// policy of each as `best`; `boxes`: abstract states with a vote, the fullest first.
export function* elect(map, each) {
  const votes = new Float64Array(A * Z);
  const states = new Int32Array(Z);
  for (let task = 0; task < map.goals.length; task++) {
    const tasks = navigationTasks(map, { keep: [task] });
    const best = breakTies(optimalActions(tasks, optimalValues(tasks)));
    countVotes(best, tasks.rho, Z).forEach((n, i) => (votes[i] += n));
    tasks.rho.forEach((z, s) => (states[z] += 1 - tasks.terminal[s]));
    each.push({ ...tasks, best });
    yield;
  }
  const boxes = [...states.keys()].filter((z) => states[z]);
  boxes.sort((a, b) => states[b] - states[a] || a - b);
  return { votes, states, boxes, prob: induceProbabilistic(votes, each[0].possible) };
}

// The mean value of a cell under advice, exact.
export function* drive(each, advice) {
  let sum = 0;
  for (const tasks of each) {
    sum += evaluatePolicy(tasks, advice, tasks.rho).reduce((a, b) => a + b);
    yield;
  }
  return sum / (each.length * each[0].nCells);
}

export const adviceOf = (prob, beta) => betaPolicy(prob, beta > LAST ? Infinity : beta);
export const betaText = (beta) =>
  beta > LAST
    ? "∞ (the winner takes all)"
    : `${number(beta, 2)}${{ 0: " (ND)", 1: " (Prob)" }[beta] ?? ""}`;
