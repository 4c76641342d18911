// Workers: the same runs as in the page, with progress, a stop, and a way out where
// workers are forbidden, fail, or fall silent.

import assert from "node:assert/strict";
import { afterEach, test } from "node:test";

import { at, readMap } from "./engine.js";

const { Blob: RealBlob, Worker: RealWorker } = globalThis;
const { createObjectURL } = URL;
const { setInterval } = globalThis;

// A clock that the test turns: how often the page looks after its workers.
const looks = [];
const byHand = (look) => looks.push(look);
function wait() {
  for (let n = 0; n < 10; n++) for (const look of looks) look();
}

// A browser's Worker; this runtime knows module workers only.
class PageWorker extends RealWorker {
  constructor(url) {
    super(url, { type: "module" });
  }
}

const tasks = at.navigationTasks(readMap("source"), { reward: "goal" });
const world = at.makeWorld(tasks);
const guide = at.makeGuide(at.inducedPolicies(tasks).nd, tasks.rho);
const job = (seed, steps = 40_000) => ({
  world,
  guide,
  seed,
  steps,
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
    onWindow(j, i, goals) {
      assert.equal(i, told[j].goals.length, "in order, and once");
      told[j].goals.push(goals);
    },
    onDone: (j, q) => (told[j].q = q),
    ...options,
  });
  assert.equal(await finished, true);
  return told;
}

afterEach(() => {
  delete globalThis.Worker;
  globalThis.Blob = RealBlob;
  URL.createObjectURL = createObjectURL;
  globalThis.setInterval = setInterval;
  looks.length = 0;
});

test("runs in workers are those of the page", async () => {
  globalThis.Worker = PageWorker;

  assert.ok(expected.every(({ goals }) => goals[0] > 0));
  for (const nWorkers of [1, 2, 5]) {
    assert.deepEqual(await collect({ nWorkers }), expected);
  }
});

test("a long window, learned in slices, is the same", async () => {
  globalThis.Worker = PageWorker;
  const window = 600_000;
  const run = new at.Run(world, guide, {}, 4);
  const long = { ...job(4, window), key: [], rule: {}, window };
  const told = [];
  await at.learnAll([long], { onWindow: (_, i, goals) => told.push([i, goals]) }).finished;

  assert.deepEqual(told, [[0, run.learn(window)]]);
});

test("without workers the page learns", async () => {
  delete globalThis.Worker;

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

test("where a worker has no address the page learns", async () => {
  globalThis.Worker = PageWorker;
  URL.createObjectURL = () => {
    throw new Error("forbidden");
  };
  assert.deepEqual(await collect({ nWorkers: 2 }), expected);

  globalThis.Blob = undefined;
  assert.deepEqual(await collect({ nWorkers: 2 }), expected);
});

// ---- workers that are lost

// One that loses its page: `when(data)` says at which of its messages, `how` what the
// page hears then.
function losing(when, how) {
  return class extends PageWorker {
    set onmessage(hear) {
      super.onmessage = (event) => {
        if (this.isLost) return;
        this.isLost = when(event.data);
        if (!this.isLost) hear(event);
        else how(this);
      };
    }
  };
}
const places = {
  "before its first window": ({ i }) => i === 0,
  "after half its windows": ({ i }) => i === 2,
  "while it sends its values": ({ q }) => q,
};
const ends = {
  "fails": (worker) => worker.onerror({}),
  "sends what cannot be read": (worker) => worker.onmessageerror({}),
  "ends without a word"(worker) {
    worker.terminate();
    wait();
  },
};

for (const [place, when] of Object.entries(places)) {
  for (const [what, how] of Object.entries(ends)) {
    test(`a worker that ${what} ${place} changes no number`, async () => {
      let nLost = 0;
      globalThis.Worker = losing(when, (worker) => (nLost++, how(worker)));
      globalThis.setInterval = byHand;

      assert.deepEqual(await collect({ nWorkers: 2 }), expected);
      assert.ok(nLost > 0);
    });
  }
}

test("where a worker takes no job, or never answers, the page learns", async () => {
  const refuse = () => {
    throw new Error("cannot be cloned");
  };
  globalThis.setInterval = byHand;
  for (const postMessage of [refuse, () => setTimeout(wait)]) {
    globalThis.Worker = class extends PageWorker {};
    globalThis.Worker.prototype.postMessage = postMessage;

    assert.deepEqual(await collect({ nWorkers: 2 }), expected);
  }
});

test("a worker that closes itself changes no number", async () => {
  globalThis.Blob = class extends RealBlob {
    constructor([source], options) {
      const closing = `const post = self.postMessage.bind(self);
        self.postMessage = (data, ...rest) =>
          data.i === 2 ? self.close() : post(data, ...rest);`;
      super([closing, source], options);
    }
  };
  globalThis.Worker = PageWorker;

  assert.deepEqual(await collect({ nWorkers: 2, look: 20 }), expected);
});

// ---- a stop

// One whose messages are still on their way when it is ended.
class LateWorker extends PageWorker {
  terminate() {
    setTimeout(() => super.terminate(), 50);
  }
}

const stopped = [["workers", PageWorker], ["late workers", LateWorker], ["the page"]];
for (const [where, Worker] of stopped) {
  test(`a stop ends the learning in ${where}; nothing more is told`, async () => {
    if (Worker) globalThis.Worker = Worker;
    else delete globalThis.Worker;
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
