// Workers: the same runs as in the page, with progress, a stop, and a way out where
// workers are forbidden.  Node's threads stand in for those of a browser.

import assert from "node:assert/strict";
import { resolveObjectURL } from "node:buffer";
import { afterEach, test } from "node:test";
import { Worker as Thread } from "node:worker_threads";

import { at, readMap } from "./engine.mjs";

const SHIM = `
  const { parentPort } = require("node:worker_threads");
  globalThis.self = globalThis;
  self.postMessage = (data, transfer) => parentPort.postMessage(data, transfer);
  parentPort.on("message", (data) => self.onmessage({ data }));
`;

// A browser's Worker, as far as the engine uses it.
class BlobWorker {
  constructor(url) {
    this.thread = resolveObjectURL(url)
      .text()
      .then((source) => {
        const thread = new Thread(SHIM + source, { eval: true });
        thread.on("message", (data) => this.onmessage({ data }));
        thread.on("error", (error) => this.onerror(error));
        return thread;
      });
  }

  postMessage(data) {
    this.thread.then((thread) => thread.postMessage(data));
  }

  terminate() {
    this.thread.then((thread) => thread.terminate());
  }
}

const tasks = at.navigationTasks(readMap("source"), { reward: "goal" });
const world = at.makeWorld(tasks);
const guide = at.makeGuide(at.inducedPolicies(tasks).nd, tasks.rho);
const job = (seed, steps = 40_000) => ({
  world, guide, seed, steps,
  key: [0, 1],
  window: 10_000,
  rule: { tau: 20_000 },
});
const jobs = [1, 2, 3].map((seed) => job(seed));

// What each job must tell: the goals of its windows, and its values.
const expected = jobs.map(({ seed, key, rule }) => {
  const run = new at.Run(world, guide, rule, seed, key);
  return { goals: [0, 1, 2, 3].map(() => run.learn(10_000)), q: run.q };
});

async function collect(options) {
  const told = jobs.map(() => ({ goals: [], q: null }));
  const { finished } = at.learnAll(jobs, {
    onWindow: (j, i, goals) => told[j].goals.push(goals),
    onDone: (j, q) => (told[j].q = q),
    ...options,
  });
  assert.equal(await finished, true);
  return told;
}

afterEach(() => delete globalThis.Worker);

test("runs in workers are those of the page", async () => {
  globalThis.Worker = BlobWorker;

  assert.ok(expected.every(({ goals }) => goals[0] > 0));
  for (const nWorkers of [1, 2, 5]) {
    assert.deepEqual(await collect({ nWorkers }), expected);
  }
});

test("without workers the page learns", async () => {
  assert.deepEqual(await collect(), expected);
});

test("where workers are forbidden the page learns", async () => {
  globalThis.Worker = class {
    constructor() {
      throw new Error("forbidden");
    }
  };
  assert.deepEqual(await collect({ nWorkers: 2 }), expected);
});

test("where a worker fails the page learns", async () => {
  globalThis.Worker = class extends BlobWorker {
    postMessage() {
      setTimeout(() => this.onerror({}));
    }
  };
  assert.deepEqual(await collect({ nWorkers: 2 }), expected);
});

// One whose messages are still on their way when it is ended.
class LateWorker extends BlobWorker {
  terminate() {
    setTimeout(() => super.terminate(), 50);
  }
}

const places = [["workers", BlobWorker], ["late workers", LateWorker], ["the page"]];
for (const [where, Worker] of places) {
  test(`a stop ends the learning in ${where}; nothing more is told`, async () => {
    if (Worker) globalThis.Worker = Worker;
    let nTold = 0;
    const long = [1, 2, 3].map((seed) => job(seed, 1e9));
    const learning = at.learnAll(long, {
      nWorkers: 2,
      onWindow: () => ++nTold === 3 && learning.stop(),
      onDone: () => assert.fail("not done"),
    });

    assert.equal(await learning.finished, false);
    await new Promise((resume) => setTimeout(resume, 100));
    assert.equal(nTold, 3);
  });
}
