// What page 4 counts: states by what they look like, over all tasks of a building.
// Forgetting a feature merges abstract states, so the sums are merged, not made again.

import { A, navigationTasks } from "../engine/navigation.js";
import { spec } from "../python.js";
import { optimalActions, optimalValues } from "../engine/solvers.js";

export const [, ALL] = spec.fields.features.bounds; // a bit for each feature
const Z = ALL + 1;

// No task counted yet: states (Z,) that are no goal, by abstract state, and `suits`
// (Z, A), in how many an action is optimal (if asked for).
export const nothing = (isSolved) => ({
  states: new Int32Array(Z),
  suits: isSolved && new Int32Array(A * Z),
});

// Add a task of a building.
export function tally({ states, suits }, map, task) {
  const tasks = navigationTasks(map, { keep: [task] });
  const optimal = suits && optimalActions(tasks, optimalValues(tasks));
  for (let s = 0; s < tasks.nStates; s++) {
    if (tasks.terminal[s]) continue;
    const z = tasks.rho[s];
    states[z]++;
    if (suits) { for (let a = 0; a < A; a++) suits[A * z + a] += optimal[A * s + a]; }
  }
}

// The sums over abstract states (of `width` numbers each) that `mask` cannot tell apart.
function merge(numbers, mask, width = 1) {
  const sums = new Int32Array(numbers.length);
  for (let i = 0; i < numbers.length; i++) {
    sums[width * (Math.floor(i / width) & mask) + (i % width)] += numbers[i];
  }
  return sums;
}

const sum = (numbers) => numbers.reduce((total, n) => total + n, 0);
const occurring = (states) => states.filter((n) => n > 0).length;

// Abstract states in both buildings, and shares in percent: states of the large one
// that look new, states of the small one with a conflict, where one action is right.
export function counts(home, away, mask) {
  const [small, large] = [home, away].map(({ states }) => merge(states, mask));
  const suits = home.suits && merge(home.suits, mask, A);
  let [torn, right] = suits ? [0, 0] : [NaN, NaN]; // not counted yet
  if (suits) {
    small.forEach((n, z) => {
      const most = Math.max(...suits.subarray(A * z, A * z + A));
      right += most;
      if (most < n) torn += n;
    });
  }
  const unseen = sum(large.filter((_, z) => !small[z]));
  const share = (n, of) => (100 * n) / sum(of);
  return {
    source: occurring(small),
    target: occurring(large),
    unseen: share(unseen, large),
    torn: share(torn, small),
    right: share(right, small),
  };
}

// Whether each state of a task (of a building that was counted, solved) does badly under
// the one action that suits most of those that look like it.
export function wrong(tasks, { suits }, mask) {
  const sums = merge(suits, mask, A);
  const optimal = optimalActions(tasks, optimalValues(tasks));
  return Array.from(tasks.rho, (z, s) => {
    const row = sums.subarray(A * (z & mask), A * (z & mask) + A);
    return !tasks.terminal[s] && !optimal[A * s + row.indexOf(Math.max(...row))];
  });
}

// A number for each abstract state, the commonest of the small building first: the
// same in both buildings, wherever the goal is.
export function looks(home, away, mask) {
  const [small, large] = [home, away].map(({ states }) => merge(states, mask));
  const order = [...small.keys()].filter((z) => small[z] || large[z]);
  order.sort((a, b) => small[b] - small[a] || large[b] - large[a] || a - b);
  const look = new Int32Array(Z);
  order.forEach((z, i) => (look[z] = i));
  return { look, small, large };
}
