// Policies as flat arrays of rows of A probabilities, and the two induced abstract
// policies of the paper.  See Python's `policies`.

(function policies(at) {
  "use strict";

  // Functions take the number of actions last; by default, the relational ones.
  const nActions = () => at.LABELS.length;
  const sumOf = (values) => values.reduce((sum, x) => sum + x, 0);

  // Return a copy whose rows sum to 1; a row of 0 becomes uniform over its mask, and
  // over everything where the mask is empty.
  function normalized(weights, mask, n = nActions()) {
    const policy = Float64Array.from(weights);
    for (let i = 0; i < policy.length; i += n) {
      const row = policy.subarray(i, i + n);
      if (!sumOf(row)) row.set(mask.subarray(i, i + n));
      if (!sumOf(row)) row.fill(1);
      const total = sumOf(row);
      row.forEach((weight, a) => (row[a] = weight / total));
    }
    return policy;
  }

  // The policy that draws uniformly where the mask is 1.
  const uniformPolicy = (mask, n) => normalized(mask, mask, n);

  // The policy that draws from all actions: the paper's pi_rand.
  const randomPolicy = (nRows, n = nActions()) => uniformPolicy(new Uint8Array(nRows * n), n);

  // An optimal policy (S, A), given which actions are optimal; rows of terminal
  // states are 0.  Equally good actions "share" the vote, or the "first" takes it.
  function breakTies(optimal, ties = "share", n = nActions()) {
    const policy = Float64Array.from(optimal);
    for (let i = 0; i < policy.length; i += n) {
      const row = policy.subarray(i, i + n);
      const first = row.indexOf(1);
      if (first < 0) continue;
      if (ties === "first") row.fill(0).fill(1, first, first + 1);
      const total = sumOf(row);
      row.forEach((vote, a) => (row[a] = vote / total));
    }
    return policy;
  }

  // Votes (Z, A): the sum of policy rows (S, A) by abstract state.
  function countVotes(policy, rho, nAbstract) {
    const n = policy.length / rho.length;
    const votes = new Float64Array(nAbstract * n);
    policy.forEach((p, i) => {
      const a = i % n;
      votes[n * rho[(i - a) / n] + a] += p;
    });
    return votes;
  }

  // pi_AbsProb (Z, A): how often each action is optimal in an abstract state.
  const induceProbabilistic = normalized;

  // pi_AbsND (Z, A): uniform over the actions that are optimal at least once.
  const induceNondeterministic = (votes, fallback, n) =>
    normalized(votes.map((vote) => (vote > 0 ? 1 : 0)), fallback, n);

  // The policy proportional to p^beta where p > 0: ND at 0, p itself at 1, the most
  // frequent actions only at infinity.
  function betaPolicy(policy, beta) {
    if (!(beta >= 0)) throw new Error(`beta must be at least 0, got ${beta}`);
    const weights = Float64Array.from(policy);
    for (let i = 0; i < policy.length; i += nActions()) {
      const row = weights.subarray(i, i + nActions());
      const most = Math.max(...row);
      row.forEach((p, a) => {
        // Sums of votes that differ by rounding tie.  (1 ** Infinity is NaN.)
        if (p / most > 1 - 1e-9) row[a] = 1;
        else if (p > 0) row[a] = (p / most) ** beta;
      });
    }
    return normalized(weights, weights);
  }

  // Share of the states that are no goal whose abstract state has no vote.
  function unseenShare(target, source) {
    const voted = new Set(at.abstractStates(source));
    const states = target.rho.filter((_, s) => !target.terminal[s]);
    return at.mean(states.map((z) => (voted.has(z) ? 0 : 1)));
  }

  Object.assign(at, {
    uniformPolicy, randomPolicy, breakTies, countVotes, induceProbabilistic,
    induceNondeterministic, betaPolicy, unseenShare,
  });
})(globalThis.abstransfer ??= {});
