// What is compared: the nine arms and the grid of tau, as in Python's `arms`.

(function arms(at) {
  "use strict";

  const M = 1e6; // steps
  const ARMS = [
    ["none", null, "hard", 0],
    ["rand-hard", "rand", "hard", 9 * M],
    ["rand-soft", "rand", "soft", 19 * M],
    ["nd-hard", "nd", "hard", 3.5 * M],
    ["nd-soft", "nd", "soft", 11 * M],
    ["prob-hard", "prob", "hard", 3.5 * M],
    ["prob-soft", "prob", "soft", 6 * M],
    ["grad-hard", "grad", "hard", 3.5 * M],
    ["grad-soft", "grad", "soft", 6 * M],
  ].map(([name, guide, strategy, tau]) => ({ name, guide, strategy, tau }));
  const TAUS = [0.5, 1, 2, 3.5, 6, 9, 11, 14, 19, 25].map((tau) => tau * M);
  const PAPER_STEPS = 30 * M;

  Object.assign(at, { ARMS, TAUS, PAPER_STEPS });
})(globalThis.abstransfer ??= {});
