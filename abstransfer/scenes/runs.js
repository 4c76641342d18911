// What the scenes of learning at full scale share: the problem, its guides, and runs
// of it.  Run `luck` has the seed of that run of the stored experiments, so that all
// numbers can be compared with theirs.  See Python's `_widget_runs`.

(function runs(at) {
  "use strict";

  const SEED = 2015;
  const WINDOWS = 60; // of a run
  const NAMES = {
    none: "no advice", rand: "random", nd: "ND", prob: "Prob", grad: "Grad", yours: "yours",
  };
  const sum = (goals) => goals.reduce((total, n) => total + n, 0);
  const windowOf = (steps) => Math.round(steps / WINDOWS);
  const scaled = (tau, steps) => Math.round((tau * steps) / at.PAPER_STEPS);
  let last = null;

  // Learning in a target with advice from a source; both are texts of maps.
  function problem(target, source) {
    const key = target + source;
    if (last?.key === key) return last;
    const map = at.parseMap(target);
    const tasks = at.navigationTasks(map, { reward: "goal" });
    const world = at.makeWorld(tasks);
    const guides = {};
    let solved, induced;
    function policy(name) {
      if (name === "rand") return at.randomPolicy(tasks.nAbstract);
      solved ??= at.navigationTasks(at.parseMap(source));
      if (name === "grad") return at.deducedPolicy(solved);
      return (induced ??= at.inducedPolicies(solved))[name];
    }
    // What a run is made of.
    const parts = ({ guide, strategy, tau }, luck, steps) => ({
      world,
      guide: guide && (guides[guide] ??= at.makeGuide(policy(guide), tasks.rho)),
      rule: { strategy, tau: scaled(tau, steps) },
      seed: SEED,
      key: [0, luck - 1], // the stream that reports
      window: windowOf(steps),
      steps: WINDOWS * windowOf(steps),
    });
    // An own policy, as Python sends it: rows that are not uniform, by abstract state.
    function own(rows) {
      const all = at.uniformPolicy(tasks.possible);
      for (const [z, row] of Object.entries(rows)) all.set(row, z * tasks.nActions);
      guides.yours = at.makeGuide(all, tasks.rho);
    }
    return (last = { key, map, tasks, own, parts });
  }

  // A chart of goals by window; `set` takes curves with `goals` and fills in points.
  function chart(scene, height, marks = () => []) {
    const { count, millions, lineChart } = at.ui;
    const size = () => windowOf(scene.state.steps);
    const x = { label: "steps", format: millions, min: 0 };
    const y = { label: `goals reached in ${count(size())} steps`, min: 0 };
    const part = lineChart({ label: "Goals reached while learning, window by window", x, y, height });
    function set(curves) {
      x.max = WINDOWS * size();
      const points = (goals) => goals.map((n, i) => [(i + 1) * size(), n]);
      part.set({ curves: curves.map((c) => ({ ...c, points: points(c.goals) })), marks: marks() });
    }
    return { node: part.node, set };
  }

  // Its twin.
  function table(caption, curves, steps) {
    const known = curves.filter(({ goals }) => goals.length);
    return {
      caption,
      head: ["goals up to step", ...known.map(({ name }) => name)],
      rows: Array.from({ length: WINDOWS }, (_, i) => [
        at.ui.count((i + 1) * windowOf(steps)),
        ...known.map(({ goals }) => (i in goals ? at.ui.count(goals[i]) : "–")),
      ]),
    };
  }

  // ---- the first steps of robots { name, first, steps, ends }

  const stateAt = ({ first, steps }, t) => (t ? steps[t - 1].here : first);

  // Steps in which robots part that were always together, or one reaches a goal, as
  // sentences by step; and the first parting { t, s }, null if they stay together.
  function firstEvents(robots, n) {
    const { count, list } = at.ui;
    const names = (group) => list(group.map(({ name }) => name));
    const events = new Map();
    let groups = [robots];
    let parting = null;
    for (let t = 1; t <= n; t++) {
      const news = [];
      const split = groups.flatMap((group) => {
        const parts = {};
        for (const robot of group) (parts[stateAt(robot, t)] ??= []).push(robot);
        return Object.values(parts);
      });
      if (split.length > groups.length) {
        news.push(`${parting ? "again" : "here, in the frame,"} they part: ${split.map(names).join(" – ")}`);
        parting ??= { t, s: stateAt(robots[0], t - 1) };
      }
      groups = split;
      const there = robots.filter(({ ends }) => ends.includes(t));
      const verb = there.length > 1 ? "are" : "is";
      if (there.length) news.push(`${names(there)} ${verb} at the goal; the next start is elsewhere`);
      if (news.length) events.set(t, `Step ${count(t)}: ${news.join("; ")}.`);
    }
    return { events, parting };
  }

  at.runs = {
    WINDOWS, NAMES, stateAt, firstEvents, sum, windowOf, scaled, problem, chart, table,
  };
})((globalThis.abstransfer ??= {}));
