// What the paper compares, and found: the nine arms and the grid of tau, as in Python's
// `arms`; the rows of Table 1 and its numbers.

const M = 1e6; // steps
export const ARMS = /** @type {[string, string | null, string, number][]} */ ([
  ["none", null, "hard", 0],
  ["rand-hard", "rand", "hard", 9 * M],
  ["rand-soft", "rand", "soft", 19 * M],
  ["nd-hard", "nd", "hard", 3.5 * M],
  ["nd-soft", "nd", "soft", 11 * M],
  ["prob-hard", "prob", "hard", 3.5 * M],
  ["prob-soft", "prob", "soft", 6 * M],
  ["grad-hard", "grad", "hard", 3.5 * M],
  ["grad-soft", "grad", "soft", 6 * M],
]).map(([name, guide, strategy, tau]) => ({ name, guide, strategy, tau }));
export const TAUS = [0.5, 1, 2, 3.5, 6, 9, 11, 14, 19, 25].map((tau) => tau * M);
export const PAPER_STEPS = 30 * M;

export const ROWS = ["rand", "nd", "prob", "grad", "optimal"];
export const PAPER = {
  source: {
    cells: 135,
    rooms: 11,
    goals: 11,
    rand: -88.97,
    nd: -44.61,
    prob: -36.91,
    grad: -30.65,
    optimal: -14.86,
  },
  target: {
    cells: 540,
    rooms: 35,
    goals: 35,
    rand: -97.07,
    nd: -80.41,
    prob: -70.03,
    grad: -70.34,
    optimal: -29.13,
  },
};
