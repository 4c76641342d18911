// What the first runs of arms say of a claim, as Python's `claims` does.

import { gainInterval } from "../parts/student.js";

export const SAME = "same"; // the claim that compares each arm with itself
export const [HOLDS, FAILS, UNDECIDED, IN_PART] = [
  "holds",
  "does not hold",
  "undecided",
  "fails in part",
];

/**
 * @param {number[]} effect with its interval
 * @param {number} threshold
 * @param {boolean} above
 */
function judge([, low, high], threshold, above) {
  if (low > threshold) return above ? HOLDS : FAILS;
  if (high < threshold) return above ? FAILS : HOLDS;
  return UNDECIDED;
}
export function combine(findings) {
  const main = findings.filter((f) => f.main).map((f) => f.verdict);
  if (findings.some((f) => f.verdict === FAILS)) return main.includes(HOLDS) ? IN_PART : FAILS;
  return findings.every((f) => f.verdict === HOLDS) ? HOLDS : UNDECIDED;
}

// The data of Python: arms, totals (arms, N), lives (orders, N), claims.
export function findingsOf({ arms, totals, lives, claims }, key, order, n) {
  const half = key === SAME ? Math.floor(lives[order].length / 2) : 0;
  const taken = (arm, from) =>
    lives[order].slice(from, from + n).map((i) => totals[arms.indexOf(arm)][i]);
  return claims[key].compared.map(([text, a, b, threshold, above, main, fixed]) => {
    const effect = fixed !== null
      ? [fixed, fixed, fixed]
      : gainInterval(taken(a, 0), taken(b, half));
    return { text, a, b, main, fixed, effect, verdict: judge(effect, threshold, above) };
  });
}
// Verdicts by track: of the claim, or of each comparison of an arm with itself.
export const verdictsOf = (
  findings,
  key,
) => (key === SAME ? findings.map((f) => f.verdict) : [combine(findings)]);
