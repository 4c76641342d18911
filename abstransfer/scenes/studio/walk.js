// What Map Studio does with a building, without a page: walk a robot by compass, and
// rebuild Table 1 piece by piece.

import { absprobPi } from "../engine/absprob_pi.js";
import { DIRECTIONS } from "../engine/maps.js";
import { abstractStates, LABELS, navigationTasks } from "../engine/navigation.js";
import { inducedPolicies, randomPolicy } from "../engine/policies.js";
import { nextWord, seedState } from "../engine/random.js";
import { evaluatePolicy, mean, optimalValues } from "../engine/solvers.js";

const LUCK = 1; // seed of the robot's slips
const WORD = 4294967296;

// Walk from a cell: a letter N, E, S, W steers, the number of a label is what a robot can
// say; chance takes one of the ways that have it.  Return { cell, steps, total, isOver },
// each step { cell, d, a, next, r, slips, nWays, isSteered }; `a` is the label of that
// edge, -1 a wall, and `nWays` how many have it.
export function follow(tasks, start, walk) {
  const luck = seedState(LUCK);
  const steps = [];
  let [cell, total, weight] = [start, 0, 1];
  for (const letter of walk) {
    const isSteered = DIRECTIONS.includes(letter);
    if (tasks.terminal[cell] || !(isSteered || letter in LABELS)) continue;
    const labels = [...tasks.labels.subarray(4 * cell, 4 * cell + 4)];
    const ways = [0, 1, 2, 3].filter((d) => labels[d] === Number(letter));
    const d = isSteered
      ? DIRECTIONS.indexOf(letter)
      : ways[Math.floor((nextWord(luck) / WORD) * ways.length)] ?? 0;
    const a = isSteered ? labels[d] : ways.length ? labels[d] : -1;
    const nWays = labels.filter((label) => label === a).length;
    const slips = nextWord(luck) / WORD >= tasks.success;
    const next = a < 0 || slips ? cell : tasks.neighbors[4 * cell + d];
    const r = tasks.reward[next];
    steps.push({ cell, d, a, next, r, slips: slips && a >= 0, nWays, isSteered });
    total += weight * tasks.reward[cell]; // a state pays on its own account, as in its value
    weight *= tasks.gamma;
    cell = next;
  }
  return { cell, steps, total, isOver: tasks.terminal[cell] === 1 };
}

// All that can happen next in a cell: { a, next, chance, r }; chances of one a sum to 1.
export function outcomes(tasks, cell) {
  const ways = LABELS.map(() => []);
  for (let d = 0; d < 4; d++) {
    const a = tasks.labels[4 * cell + d];
    if (a >= 0) ways[a].push(tasks.neighbors[4 * cell + d]);
  }
  return ways.flatMap((cells, a) => {
    if (!cells.length) return [];
    const moved = cells.map((next) => ({ a, next, chance: tasks.success / cells.length }));
    return [...moved, { a, next: cell, chance: 1 - tasks.success }].map((each) => ({
      ...each,
      r: tasks.reward[each.next],
    }));
  });
}

// Yield { tasks, states, row, policies, iteration } as it fills: number of abstract
// states, row of Table 1, policies by name, iteration of Grad.
export function* solving(map) {
  const tasks = navigationTasks(map);
  const found = { tasks, row: {}, policies: {}, iteration: 0 };
  // What was yielded stays as it was: it may be drawn while the next is on its way.
  const now = () => ({ ...found, row: { ...found.row }, policies: { ...found.policies } });
  const drive = (name, policy) => {
    found.policies[name] = policy;
    found.row[name] = mean(evaluatePolicy(tasks, policy, tasks.rho));
  };
  found.states = abstractStates(tasks).length;
  drive("rand", randomPolicy(tasks.nAbstract));
  yield now();
  const v = optimalValues(tasks);
  found.row.optimal = mean(v);
  yield now();
  const { nd, prob } = inducedPolicies(tasks, { v });
  drive("nd", nd);
  drive("prob", prob);
  for (const { iteration, policy, value } of absprobPi(tasks)) {
    found.policies.grad = policy;
    found.iteration = iteration;
    found.row.grad = value;
    yield now();
  }
}
