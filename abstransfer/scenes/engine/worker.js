// The script of a worker: it takes one job at a time, and answers with its windows.
//
// Long windows are learned in slices; a message without content after each of them
// says that the worker is alive.

import { Run } from "./learning.js";

const scope = /** @type {any} of a worker, not of a window */ (self);

const SLICE = 250_000; // steps between two signs of life

scope.onmessage = ({ data: { world, guide, rule, seed, key, notes, steps, window } }) => {
  const run = new Run(world, guide, rule, seed, key, notes);
  for (let i = 0; i < steps / window; i++) {
    let goals = 0;
    for (let left = window; left > 0; left -= SLICE) {
      goals += run.learn(Math.min(SLICE, left));
      scope.postMessage({});
    }
    scope.postMessage({ i, goals });
  }
  scope.postMessage({ q: run.q }, [run.q.buffer]);
};
