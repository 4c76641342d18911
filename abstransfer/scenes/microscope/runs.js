// The runs that the microscope looks at: what differs is where they start, and luck.

import { makeWorld, Run } from "../engine/learning.js";
import { navigationTasks } from "../engine/navigation.js";
import { spec } from "../python.js";

export const { bet: BET, starts: STARTS } = spec;
export const LUCKS = 20; // runs that the closing sentence averages
export const HOW = { guided: "advised", explored: "a random action", greedy: "a largest value" };

// The steps of a run: what the engine says of each.
export function take(map, { start, task, luck }, n) {
  const { reward, q0 } = STARTS[start];
  const tasks = navigationTasks(map, { reward, keep: [task] });
  const run = new Run(makeWorld(tasks), null, { q0 }, luck);
  const first = run.s;
  return { tasks, first, q0, steps: Array.from({ length: n }, () => run.step()) };
}

// A run that Python took: rows of [state, action, how, next, reward, before, after, here].
export function given(map, { start, task, trace }) {
  const { reward, q0 } = STARTS[start];
  const tasks = navigationTasks(map, { reward, keep: [task] });
  const steps = trace.map(([s, a, how, next, r, before, after, here], i) => ({
    t: i + 1,
    s,
    a,
    how: ["guided", "explored", "greedy"][how],
    next,
    reward: r,
    before,
    after,
    here,
    ended: tasks.terminal[next] ? "goal" : here === next ? null : "cut",
    isGiven: true,
  }));
  return { tasks, first: trace[0][0], q0, steps };
}

// Cells that a run has stood on in n steps, and in how many of them.
export function visited({ first, steps }, n) {
  const visits = new Map(n ? [] : [[first, 1]]);
  for (const { s, next } of steps.slice(0, n)) {
    for (const cell of s === next ? [s] : [s, next]) {
      visits.set(cell, (visits.get(cell) ?? 0) + 1);
    }
  }
  return visits;
}
