// The three abstract policies of a source, and Table 1 of the paper.

(function table1(at) {
  "use strict";

  const ROWS = ["rand", "nd", "prob", "grad", "optimal"];
  const PAPER = {
    source: {
      cells: 135, rooms: 11, goals: 11,
      rand: -88.97, nd: -44.61, prob: -36.91, grad: -30.65, optimal: -14.86,
    },
    target: {
      cells: 540, rooms: 35, goals: 35,
      rand: -97.07, nd: -80.41, prob: -70.03, grad: -70.34, optimal: -29.13,
    },
  };

  // ND and Prob of solved tasks, with the votes (Z, A) they were induced from.
  function inducedPolicies(tasks, { ties = "share", v } = {}) {
    const optimal = at.optimalActions(tasks, v ?? at.optimalValues(tasks));
    const n = tasks.nActions;
    const shares = at.breakTies(optimal, ties, n);
    const votes = at.countVotes(shares, tasks.rho, tasks.nAbstract);
    return {
      votes,
      nd: at.induceNondeterministic(votes, tasks.possible, n),
      prob: at.induceProbabilistic(votes, tasks.possible, n),
    };
  }

  // Grad, climbed to the end at once.
  function deducedPolicy(tasks, options) {
    let policy;
    for (const step of at.absprobPi(tasks, options)) policy = step.policy;
    return policy;
  }

  // One column of Table 1, with the counts of its map, for abstract policies by name.
  function column(tasks, policies, v = at.optimalValues(tasks)) {
    const random = at.randomPolicy(tasks.nAbstract, tasks.nActions);
    const result = {
      cells: tasks.nCells,
      rooms: tasks.map.nRooms,
      goals: tasks.nTasks,
      abstract_states: at.abstractStates(tasks).length,
      rand: at.mean(at.evaluatePolicy(tasks, random, tasks.rho)),
    };
    for (const [name, policy] of Object.entries(policies)) {
      result[name] = at.mean(at.evaluatePolicy(tasks, policy, tasks.rho));
    }
    const available = at.uniformPolicy(tasks.nWays.map((n) => Math.min(n, 1)), tasks.nActions);
    result.uniform_available = at.mean(at.evaluatePolicy(tasks, available));
    result.optimal = at.mean(v);
    return result;
  }

  // Policies of the source, executed in source and target.
  function table1(source, target) {
    const { nd, prob } = inducedPolicies(source);
    const policies = { nd, prob, grad: deducedPolicy(source) };
    return {
      source: column(source, policies),
      target: column(target, policies),
      unseen: at.unseenShare(target, source),
    };
  }

  Object.assign(at, { ROWS, PAPER, inducedPolicies, deducedPolicy, column, table1 });
})(globalThis.abstransfer ??= {});
