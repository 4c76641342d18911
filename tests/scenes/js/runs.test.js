// What the scenes of learning share: the jobs they give to workers.

import assert from "node:assert/strict";
import { test } from "node:test";

import { at, readMap } from "./engine.js";
import {
  firstEvents,
  problem,
  scaled,
  sum,
  table,
  windowOf,
  WINDOWS,
} from "../../../abstransfer/scenes/parts/runs.js";

const [target, source] = ["target", "source"].map((name) => readMap(name).text);
const nd = at.ARMS.find(({ name }) => name === "nd-hard");

function goals({ world, guide, rule, seed, key, window }) {
  const run = new at.Run(world, guide, rule, seed, key);
  return Array.from({ length: 5 }, () => run.learn(window));
}

test("a run at any length has sixty windows, and its share of advice", () => {
  for (const steps of [6e5, 1e6, 1234567, 30e6]) {
    const job = problem(target, source).parts(nd, 1, steps);

    assert.equal(job.steps, WINDOWS * job.window);
    assert.ok(Math.abs(job.steps - steps) <= WINDOWS / 2);
    assert.equal(job.rule.tau, scaled(nd.tau, steps));
  }
  assert.equal(windowOf(30e6), 500_000);
  assert.equal(scaled(3.5e6, 30e6), 3.5e6);
});

test("a problem is made once, and anew for another map", () => {
  const first = problem(target, source);

  assert.equal(problem(target, source), first);
  assert.notEqual(problem(source, source), first);
  assert.equal(problem(source, source).map.nCells, 135);
});

test("luck is the seed, advice changes the run", () => {
  const all = problem(target, source);
  const found = [[nd, 1], [nd, 1], [nd, 2], [at.ARMS[0], 1]].map(([arm, luck]) =>
    goals(all.parts(arm, luck, 1.2e6))
  );

  assert.deepEqual(found[0], found[1]);
  assert.notDeepEqual(found[0], found[2]);
  assert.notDeepEqual(found[0], found[3]);
  assert.ok(sum(found[0]) > sum(found[3]));
});

test("an own policy that is ND advises as ND does", () => {
  const all = problem(target, source);
  const rows = {};
  const policy = at.inducedPolicies(at.navigationTasks(readMap("source"))).nd;
  const uniform = at.uniformPolicy(all.tasks.possible);
  for (let z = 0; z < all.tasks.nAbstract; z++) {
    const row = [...policy.subarray(8 * z, 8 * z + 8)];
    if (row.some((p, a) => p !== uniform[8 * z + a])) rows[z] = row;
  }
  all.own(rows);
  const job = (guide) => all.parts({ ...nd, guide }, 3, 1.2e6);

  assert.ok(Object.keys(rows).length > 10);
  assert.deepEqual(job("yours").guide.bound, job("nd").guide.bound);
  assert.deepEqual(goals(job("yours")), goals(job("nd")));
  all.own({});
  assert.notDeepEqual(goals(job("yours")), goals(job("nd")));
});

test("a table has a line per window, and a dash for what is not known", () => {
  const curves = [
    { name: "ND", goals: Array.from({ length: 60 }, (_, i) => i) },
    { name: "Prob", goals: [7] },
    { name: "wanderer", goals: [] },
  ];
  const { head, rows } = table("", curves, 30e6);

  assert.deepEqual(head, ["goals up to step", "ND", "Prob"]);
  assert.deepEqual(rows[0], ["500,000", "0", "7"]);
  assert.deepEqual(rows.at(-1), ["30,000,000", "59", "–"]);
});

test("partings are told once, and the first one is where they were together", () => {
  const robot = (name, states, ends = []) => ({
    name,
    ends,
    first: 3,
    steps: states.map((here) => ({ here })),
  });
  const robots = [
    robot("A", [3, 4, 5, 9, 6, 7]),
    robot("B", [3, 4, 5, 5, 5, 7]),
    robot("C", [3, 4, 6, 9, 6, 7], [5]),
  ];
  const { events, parting } = firstEvents(robots, 6);

  assert.deepEqual(parting, { t: 3, s: 4 });
  assert.deepEqual([...events.keys()], [3, 4, 5]);
  assert.match(events.get(3), /they part: A and B – C\.$/);
  assert.match(events.get(4), /again they part: /);
  assert.match(events.get(5), /C is at the goal/);
  assert.deepEqual(firstEvents([robots[0], { ...robots[0], name: "D" }], 6).parting, null);
});
