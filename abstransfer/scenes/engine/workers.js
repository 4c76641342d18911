// Learning runs in workers, so that the page stays free, with progress and a stop.
//
// Under file:// a worker can only be made from text that the page holds: the source of
// the function `worker`, see worker.js.  Where none can be made, and where one fails,
// falls silent or ends, the page itself learns, by the same function.  A run is the same wherever it is learned,
// so what a lost worker has told stands, and is not told again.

import { worker } from "../python.js";

/** @import { Job, LearnOptions, Learning } from "../types.d.ts" */

// A worker gives a sign of life every few milliseconds.  One that has given none for so
// many looks is lost; looks are counted, not time, since a machine may sleep.
const LOOK = 5000; // milliseconds
const LOOKS = 6;

/**
 * Run jobs { world, guide, rule, seed, key, notes, steps, window }, several at once.
 *
 *   onWindow(job, i, goals)   after window i of a job, both counted from 0: once each,
 *                             in order
 *   onDone(job, q)            after the last one
 *
 * Return { stop, finished }: `finished` promises true, or false after a stop.
 *
 * @param {Job[]} jobs
 * @param {LearnOptions} options
 * @returns {Learning}
 */
export function learnAll(jobs, { onWindow, onDone, nWorkers, look = LOOK } = {}) {
  const waiting = [...jobs.keys()];
  const cores = globalThis.navigator?.hardwareConcurrency ?? 2;
  const size = Math.min(jobs.length, nWorkers ?? cores);
  const url = makeUrl();
  const team = Array.from({ length: size }, () => makeWorker(url, look));
  let isStopped = false;

  async function serve(member) {
    while (waiting.length && !isStopped) {
      const job = waiting.shift();
      let nTold = 0;
      const tell = (i, goals) => {
        if (isStopped || i !== nTold) return;
        nTold++;
        onWindow?.(job, i, goals);
      };
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

// The address of the worker's source; null where there can be none.
function makeUrl() {
  try {
    if (typeof Worker === "undefined") return null;
    return URL.createObjectURL(new Blob([`(${worker})(self)`], { type: "text/javascript" }));
  } catch {
    return null;
  }
}

/**
 * A worker, if the page may have one.  To end it also ends the wait for its answer.
 *
 * @param {string | null} url
 * @param {number} look
 */
function makeWorker(url, look) {
  /** @type {any} */
  const member = { worker: null, give: () => {}, look };
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

// Promise the values that a job ends with; null if the worker is lost or ended.
function inWorker(member, job, tell) {
  const { worker } = member;
  let nSilent = 0;
  const watch = setInterval(() => ++nSilent > LOOKS && member.end(), member.look);
  return new Promise((give) => {
    member.give = give;
    worker.onmessage = ({ data }) => {
      nSilent = 0;
      if (data.q) give(data.q);
      else if ("i" in data) tell(data.i, data.goals);
    };
    worker.onmessageerror = worker.onerror = (event) => {
      event.preventDefault?.();
      member.end();
    };
    try {
      worker.postMessage(job);
    } catch {
      member.end();
    }
  }).finally(() => clearInterval(watch));
}

/**
 * @param {Job} job
 * @param {(i: number, goals: number) => void} tell
 * @param {() => boolean} isStopped
 */
async function inPage(job, tell, isStopped) {
  /** @type {any} */
  const scope = {};
  worker(scope);
  for (const { i, goals, q } of scope.work(job)) {
    if (q || isStopped()) return q;
    if (i !== undefined) tell(i, goals);
    await new Promise((resume) => setTimeout(resume)); // let the page draw
  }
}
