// Learning runs in workers, so that the page stays free, with progress and a stop.
//
// Under file:// a worker can only be made from text that the page holds: the source of
// `random` and `learning`.  Where none can be made at all, the page itself learns, one
// window at a time.

(function workers(at) {
  "use strict";

  function workerSource() {
    const { random, learning } = at.sources;
    return `"use strict";
      (${random})(self.abstransfer = {});
      (${learning})(self.abstransfer);
      self.onmessage = ({ data: { world, guide, rule, seed, key, steps, window } }) => {
        const run = new abstransfer.Run(world, guide, rule, seed, key);
        for (let i = 0; i < steps / window; i++) {
          self.postMessage({ i, goals: run.learn(window) });
        }
        self.postMessage({ q: run.q }, [run.q.buffer]);
      };`;
  }

  // Run jobs { world, guide, rule, seed, key, steps, window }, several at once.
  //
  //   onWindow(job, i, goals)   after window i of a job, both counted from 0
  //   onDone(job, q)            after the last one
  //
  // Return { stop, finished }: `finished` promises true, or false after a stop.
  function learnAll(jobs, { onWindow, onDone, nWorkers } = {}) {
    const waiting = [...jobs.keys()];
    const cores = globalThis.navigator?.hardwareConcurrency ?? 2;
    const size = Math.min(jobs.length, nWorkers ?? cores);
    const url = makeUrl();
    const team = Array.from({ length: size }, () => makeWorker(url));
    let isStopped = false;

    async function serve(member) {
      while (waiting.length && !isStopped) {
        const job = waiting.shift();
        const tell = (i, goals) => isStopped || onWindow?.(job, i, goals);
        let q = member.worker && (await inWorker(member, jobs[job], tell));
        if (!q && !isStopped) q = await inPage(jobs[job], tell, () => isStopped);
        if (!isStopped) onDone?.(job, q);
      }
    }

    function close() {
      for (const member of team) member.end();
      if (url) URL.revokeObjectURL(url);
    }

    const finished = Promise.all(team.map(serve)).then(() => {
      close();
      return !isStopped;
    });
    const stop = () => {
      isStopped = true;
      close();
    };
    return { stop, finished };
  }

  function makeUrl() {
    if (typeof Worker === "undefined") return null;
    return URL.createObjectURL(new Blob([workerSource()], { type: "text/javascript" }));
  }

  // A worker, if the page may have one.  To end it also ends the wait for its answer.
  function makeWorker(url) {
    const member = { worker: null, give: () => {} };
    try {
      if (url) member.worker = new Worker(url);
    } catch {
      // Forbidden here: the page learns.
    }
    member.end = () => {
      member.worker?.terminate();
      member.worker = null;
      member.give(null);
    };
    return member;
  }

  // Promise the values that a job ends with; null if the worker fails or is ended.
  function inWorker(member, job, tell) {
    return new Promise((give) => {
      member.give = give;
      member.worker.onmessage = ({ data }) =>
        data.q ? give(data.q) : tell(data.i, data.goals);
      member.worker.onerror = (event) => {
        event.preventDefault?.();
        member.end();
      };
      member.worker.postMessage(job);
    });
  }

  async function inPage(job, tell, isStopped) {
    const run = new at.Run(job.world, job.guide, job.rule, job.seed, job.key);
    for (let i = 0; i < job.steps / job.window && !isStopped(); i++) {
      tell(i, run.learn(job.window));
      await new Promise((resume) => setTimeout(resume)); // let the page draw
    }
    return run.q;
  }

  Object.assign(at, { workerSource, learnAll });
})(globalThis.abstransfer ??= {});
