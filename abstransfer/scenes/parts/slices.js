// Work in slices, so that the page stays free.  What is found is shown a few times a
// second, and at the end: a picture may cost more than the slice before it.

import { runFor } from "../engine/absprob_pi.js";

const SLICE = 15; // milliseconds of work between two turns of the page
const PAUSE = 100; // milliseconds between two pictures

/**
 * Return { start, isWorking } for a scene; when the reader leaves, the work ends.
 *
 * `start(job, onFound)` works off an iterator, in place of the last one; none just ends
 * that.  `onFound(last, isOver)` hears before each picture what the job yielded last.
 */
export function slices(scene) {
  let timer = null;
  const end = () => (timer = clearTimeout(timer) ?? null);
  function start(job, onFound = (_last, _isOver) => {}) {
    end();
    if (!job) return;
    let [found, shown] = [undefined, -Infinity];
    const work = () => {
      const { last, done } = runFor(job, SLICE);
      found = last ?? found;
      timer = done ? null : setTimeout(work);
      if (!done && performance.now() < shown + PAUSE) return;
      onFound(found, done);
      scene.redraw();
      shown = performance.now();
    };
    timer = setTimeout(work);
  }
  scene.onLeave(end);
  return { start, isWorking: () => timer !== null };
}
