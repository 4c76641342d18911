// The deduced abstract policy: climbing the value of an abstract policy, one
// iteration at a time, so that a page can draw while it climbs.
// See Python's `absprob_pi`.

(function absprobPi(at) {
  "use strict";

  // Value of an abstract policy (Z, A) from the start distribution (S,), its
  // gradient (Z, A) and the discounted visits (Z,); uniform start by default.
  function abstractGradient(tasks, policy, start) {
    const { nStates, nTasks, nActions, nAbstract, rho, terminal, gamma } = tasks;
    const gradient = new Float64Array(nAbstract * nActions);
    const visits = new Float64Array(nAbstract);
    const d = start ? start.slice() : new Float64Array(nStates).fill(1 / nStates);
    const v = tasks.reward.slice();
    const q = new Float64Array(nActions);
    let value = 0;
    for (let task = 0; task < nTasks; task++) {
      const matrix = at.factorTask(tasks, task, policy, rho);
      const ofTask = (array) => at.ofTask(tasks, array, task);
      matrix.solve(ofTask(v));
      const weights = ofTask(d).slice();
      ofTask(v).forEach((x, cell) => (value += weights[cell] * x));
      matrix.solve(ofTask(d), true);
    }
    for (let s = 0; s < nStates; s++) {
      if (terminal[s]) continue;
      at.stateActionValues(tasks, v, s, q);
      visits[rho[s]] += d[s];
      for (let a = 0; a < nActions; a++) {
        gradient[nActions * rho[s] + a] += gamma * d[s] * q[a];
      }
    }
    return { value, gradient, visits };
  }

  // Move every abstract state by `step` of the way to its best action, made soft.
  function climbStep(policy, { gradient, visits }, possible, softness, step) {
    const nActions = possible.length / visits.length;
    visits.forEach((visit, z) => {
      if (!(visit > 0)) return;
      const first = z * nActions;
      let total = 1 - softness;
      let most = -Infinity;
      for (let i = first; i < first + nActions; i++) {
        if (!possible[i]) continue;
        total += softness / nActions;
        most = Math.max(most, gradient[i]);
      }
      // The first of the best: rounding must not decide where two are as good.
      const least = most - at.TIE * Math.abs(most);
      let best = first;
      while (!possible[best] || gradient[best] < least) best++;
      for (let i = first; i < first + nActions; i++) {
        const soft = possible[i] ? softness / nActions : 0;
        const target = (soft + (i === best ? 1 - softness : 0)) / total;
        policy[i] += step * (target - policy[i]);
      }
    });
  }

  // Yield { iteration, value, policy, gradient, visits } for the first policy and
  // after each iteration.  `policy` is one array, changed from yield to yield.
  function* absprobPi(tasks, options = {}) {
    const { initial, start, iterations = 300, softness = 0.05 } = options;
    const policy = initial ? initial.slice() : at.uniformPolicy(tasks.possible, tasks.nActions);
    for (let iteration = 0; ; iteration++) {
      const found = abstractGradient(tasks, policy, start);
      yield { iteration, policy, ...found };
      if (iteration === iterations) return;
      climbStep(policy, found, tasks.possible, softness, 1 / (2 + iteration));
    }
  }

  // Go on with an iterator for some milliseconds; return { last, done }.  `last` is
  // what it yielded last, undefined where nothing was left.
  function runFor(iterator, milliseconds) {
    const end = performance.now() + milliseconds;
    let last;
    do {
      const { value, done } = iterator.next();
      if (done) return { last, done };
      last = value;
    } while (performance.now() < end);
    return { last, done: false };
  }

  Object.assign(at, { abstractGradient, absprobPi, runFor });
})(globalThis.abstransfer ??= {});
