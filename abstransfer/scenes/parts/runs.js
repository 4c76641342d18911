// What the scenes of learning at full scale share: the problem, its guides, and runs
// of it.  Run `luck` has the seed of that run of the stored experiments, so that all
// numbers can be compared with theirs.  See Python's `parts/runs`.

import { makeGuide, makeWorld } from "../engine/learning.js";
import { parseMap } from "../engine/maps.js";
import { navigationTasks } from "../engine/navigation.js";
import { PAPER_STEPS } from "../engine/paper.js";
import { inducedPolicies, randomPolicy, uniformPolicy } from "../engine/policies.js";
import { deducedPolicy } from "../engine/absprob_pi.js";
import { armStyle, count, list, millions } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";
import { paper } from "../python.js";

const { seed: SEED } = paper;
export const { windows: WINDOWS } = paper; // of a run
const ROBOTS = ["none", "rand", "nd", "prob", "grad", "yours"];
export const NAMES = Object.fromEntries(ROBOTS.map((name) => [name, armStyle(name).name]));
export const sum = (goals) => goals.reduce((total, n) => total + n, 0);
export const windowOf = (steps) => Math.round(steps / WINDOWS);
export const scaled = (tau, steps) => Math.round((tau * steps) / PAPER_STEPS);
let last = null;

// Learning in a target with advice from a source; both are texts of maps.
export function problem(target, source) {
  const key = target + source;
  if (last?.key === key) return last;
  const map = parseMap(target);
  const tasks = navigationTasks(map, { reward: "goal" });
  const world = makeWorld(tasks);
  const guides = {};
  let solved, induced;
  function policy(name) {
    if (name === "rand") return randomPolicy(tasks.nAbstract);
    solved ??= navigationTasks(parseMap(source));
    if (name === "grad") return deducedPolicy(solved);
    return (induced ??= inducedPolicies(solved))[name];
  }
  // What a run is made of.
  const parts = ({ guide, strategy, tau }, luck, steps) => ({
    world,
    guide: guide && (guides[guide] ??= makeGuide(policy(guide), tasks.rho)),
    rule: { strategy, tau: scaled(tau, steps) },
    seed: SEED,
    key: [0, luck - 1], // the stream that reports
    window: windowOf(steps),
    steps: WINDOWS * windowOf(steps),
  });
  // An own policy, as Python sends it: rows that are not uniform, by abstract state.
  function own(rows) {
    const all = uniformPolicy(tasks.possible);
    for (const [z, row] of Object.entries(rows)) all.set(row, Number(z) * tasks.nActions);
    guides.yours = makeGuide(all, tasks.rho);
  }
  return (last = { key, map, tasks, own, parts });
}

// A chart of goals by window; `set` takes curves with `goals` and fills in points.
export function chart(scene, height, marks = () => []) {
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
export function table(caption, curves, steps) {
  const known = curves.filter(({ goals }) => goals.length);
  return {
    caption,
    head: ["goals up to step", ...known.map(({ name }) => name)],
    rows: Array.from({ length: WINDOWS }, (_, i) => [
      count((i + 1) * windowOf(steps)),
      ...known.map(({ goals }) => (i in goals ? count(goals[i]) : "–")),
    ]),
  };
}

// ---- the first steps of robots { name, first, steps, ends }

export const stateAt = ({ first, steps }, t) => (t ? steps[t - 1].here : first);

// Steps in which robots part that were always together, or one reaches a goal, as
// sentences by step; and the first parting { t, s }, null if they stay together.
export function firstEvents(robots, n) {
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
      news.push(
        `${parting ? "again" : "here, in the frame,"} they part: ${split.map(names).join(" – ")}`,
      );
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
