// What a worker does: it takes one job at a time, and answers with its windows.
//
// Python makes a function of this script, `worker` of python.js.  A page hands its source
// to its workers; where it has none, it calls the function, and learns by `work` itself.

import { Run } from "./learning.js";

/** @import { Job } from "../types.d.ts" */

const scope = /** @type {any} of a worker, not of a window */ (self);

const SLICE = 250_000; // steps between two signs of life

/**
 * Yield { i, goals } after window i of a job, { q } at the end, and records without
 * content in between, as signs of life: long windows are learned in slices.
 *
 * @param {Job} job
 */
function* work({ world, guide, rule, seed, key, notes, steps, window }) {
  const run = new Run(world, guide, rule, seed, key, notes);
  for (let i = 0; i < steps / window; i++) {
    let goals = 0;
    for (let left = window; left > 0; left -= SLICE) {
      goals += run.learn(Math.min(SLICE, left));
      yield {};
    }
    yield { i, goals };
  }
  yield { q: run.q };
}

scope.work = work;
scope.onmessage = ({ data }) => {
  for (const told of work(data)) scope.postMessage(told, told.q ? [told.q.buffer] : []);
};
