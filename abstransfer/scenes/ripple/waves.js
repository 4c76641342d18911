// The sweeps of value iteration for one task, kept, and what they end in.

import { LABELS, navigationTasks } from "../engine/navigation.js";
import {
  argmax,
  optimalActions,
  stateActionValues,
  TIE,
  valueIteration,
} from "../engine/solvers.js";

export const RIGHT = 0.01; // a value is known when it is right to within this
const STILL = 1e-12; // a sweep that changes less is the last: its values are exact

const gap = (v, w) => v.reduce((most, x, s) => Math.max(most, Math.abs(x - w[s])), 0);

// Steps from each cell to the goal: the sweep in which its news arrives.
export function distances({ nCells, neighbors }, goal) {
  const steps = new Int32Array(nCells).fill(-1);
  steps[goal] = 0;
  for (let edge = [goal], n = 1; edge.length; n++) {
    const next = [];
    for (const cell of edge) {
      for (const other of neighbors.subarray(4 * cell, 4 * cell + 4)) {
        if (other < 0 || steps[other] >= 0) continue;
        steps[other] = n;
        next.push(other);
      }
    }
    edge = next;
  }
  return steps;
}

// Yield between sweeps, so that a page stays awake; return all that is to be shown.
export function* ripple(map, task, success) {
  const tasks = navigationTasks(map, { keep: [task], success });
  const sweeps = [];
  for (const v of valueIteration(tasks)) {
    sweeps.push(v);
    if (sweeps.length > 1 && gap(v, sweeps.at(-2)) < STILL) break;
    yield;
  }
  const exact = sweeps.at(-1);
  const errors = sweeps.map((v) => gap(v, exact));
  const end = errors.findIndex((error) => error < RIGHT);
  const optimal = optimalActions(tasks, exact);
  const nBest = Int32Array.from(
    exact,
    (_, s) =>
      optimal.subarray(LABELS.length * s, LABELS.length * (s + 1)).reduce((n, x) => n + x, 0),
  );
  const steps = distances(map, tasks.goal[0]);
  return {
    tasks,
    sweeps: sweeps.slice(0, end + 1),
    errors: errors.slice(0, end + 1),
    end,
    optimal,
    nBest,
    nTies: nBest.filter((n) => n > 1).length,
    steps,
    far: Math.max(...steps),
  };
}

// What cell s will believe after the next sweep: the best action, its worth, the guess.
export function backup(tasks, v, s) {
  const { nActions, nWays, reward, gamma, terminal } = tasks;
  if (terminal[s]) return { action: null, worth: 0, guess: reward[s] };
  const q = stateActionValues(tasks, v, s, new Float64Array(nActions));
  const worth = q[argmax(q)];
  // Of equally good actions, one that leads somewhere.
  const best = [...q.keys()].filter((a) => q[a] >= worth - TIE);
  const action = best.find((a) => nWays[nActions * s + a]) ?? best[0];
  return { action, worth, guess: reward[s] + gamma * worth };
}

// Arrows along the best actions: four weights a cell.
export function arrowsOf({ tasks, optimal, nBest }) {
  const { labels, nActions, nWays } = tasks;
  return Float64Array.from(labels, (a, i) => {
    const s = i >> 2;
    if (a < 0 || !optimal[nActions * s + a]) return 0;
    return 1 / (nBest[s] * nWays[nActions * s + a]);
  });
}
