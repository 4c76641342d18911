// The learner: the same runs as Python's, to the bit.

import assert from "node:assert/strict";
import { test } from "node:test";

import { at, digest, readGolden, readMap } from "./engine.js";

const golden = readGolden("learning");

const source = at.navigationTasks(readMap("source"));
const guides = {
  ...at.inducedPolicies(source),
  grad: at.deducedPolicy(source),
  rand: at.randomPolicy(source.nAbstract),
};

function startRun({ map, tasks: options, guide, options: rule }) {
  const building = map.includes("+") ? at.parseMap(map) : readMap(map);
  const tasks = at.navigationTasks(building, options);
  const { max_episode: maxEpisode = 5000, ...others } = rule;
  const advice = guide && at.makeGuide(guides[guide], tasks.rho);
  const world = at.makeWorld(tasks);
  return new at.Run(world, advice, { ...others, maxEpisode }, golden.seed, golden.key);
}

// Take a case's 60,000 steps; return its goals and cuts by window, and digests of Q.
function learnAll(run) {
  const [goals, cuts, q] = [[], [], []];
  for (let i = 0; i < 6; i++) {
    const [goalsBefore, cutsBefore] = [run.goals, run.cuts];
    if (i === 0) {
      run.learn(1000);
      q.push(digest(run.q));
      run.learn(9000);
    } else run.learn(10_000);
    if (i === 1) q.push(digest(run.q));
    goals.push(run.goals - goalsBefore);
    cuts.push(run.cuts - cutsBefore);
  }
  return { goals, cuts, q: [...q, digest(run.q)] };
}

function traced(run, length) {
  const steps = Array.from({ length }, () => run.step());
  const column = (name) => steps.map((step) => step[name]);
  return {
    state: column("s"),
    action: column("a"),
    how: column("how").map((how) => ["guided", "explored", "greedy"].indexOf(how)),
    next_state: column("next"),
    reward: column("reward"),
    before: column("before"),
    after: column("after"),
  };
}

golden.cases.forEach((facts, i) => {
  const { map, tasks, guide, options } = facts;
  const name = map.includes("+") ? `small map ${i}` : map;
  const title = `${name} ${JSON.stringify({ guide, ...tasks, ...options })}`;

  test(`a run in ${title}`, () => {
    const run = startRun(facts);
    const { goals, cuts, q } = facts;

    assert.deepEqual(traced(run, facts.trace.state.length), facts.trace);
    run.goTo(0);
    assert.deepEqual(learnAll(run), { goals, cuts, q });
    assert.equal(run.q.reduce((x, y) => Math.max(x, y)), facts.largest);
  });
});

test("the golden runs reach goals, explore, follow guides, and are cut", () => {
  const sum = (name) => golden.cases.map((c) => c[name].reduce((a, b) => a + b, 0));
  const how = new Set(golden.cases.flatMap((c) => c.trace.how));

  assert.ok(sum("goals").filter((n) => n > 20).length > 15);
  assert.ok(sum("cuts").some((n) => n > 1000));
  assert.deepEqual(how, new Set([0, 1, 2]));
});

test("seeds and spawn keys give Python's streams", () => {
  for (const { seed, key, state } of golden.streams) {
    assert.deepEqual([...at.seedState(seed, key, 8)], state);
  }
});

test("words come one at a time or in blocks", () => {
  const [one, other] = [at.seedState(5), at.seedState(5)];
  const words = new Uint32Array(100);
  at.fillWords(one, words, 100);

  assert.deepEqual([...words], Array.from(words, () => at.nextWord(other)));
  assert.deepEqual(one, other);
  assert.deepEqual(at.nextWord(Uint32Array.of(1, 2, 3, 4)), 641);
});

test("chances become whole numbers as in Python", () => {
  const bounds = at.integerBounds([0.25, 0, 0.75, 0], 65536);

  assert.deepEqual(bounds, [16384, 16384, 65536, 65536]);
  assert.deepEqual(at.integerBounds([0.3, 0.7], 65536), [19661, 65536]); // of 19660.8
});

test("steps can be taken back, and any step gone to", () => {
  const facts = golden.cases.find((c) => c.options.max_episode === 20);
  const [run, straight] = [startRun(facts), startRun(facts)];
  const state = ({ q, top, ties, rng, s, t, left, goals, cuts }) =>
    structuredClone({ q, top, ties, rng, s, t, left, goals, cuts });
  straight.learn(300);
  run.learn(200);
  const records = Array.from({ length: 300 }, () => run.step());
  assert.ok(records.some((record) => record.ended === "goal"));
  assert.ok(records.some((record) => record.ended === "cut"));
  assert.ok(records.some((record) => record.next === record.s));

  run.goTo(300); // by undoing
  assert.deepEqual(state(run), state(straight));
  assert.deepEqual(run.step(), records[100]);
  run.goTo(120); // by starting again
  assert.equal(run.t, 120);
  run.goTo(300);
  assert.deepEqual(state(run), state(straight));
});

test("a record fills in Eq. 1", () => {
  const run = startRun(golden.cases.find((c) => c.guide === "nd"));
  let here = run.s;
  for (let i = 0; i < 3000; i++) {
    const record = run.step();
    const { s, a, reward, bestNext, target, before, after, next } = record;
    assert.equal(s, here);
    assert.equal(target, reward + 0.9 * bestNext);
    assert.equal(after, (1 - 0.1) * before + 0.1 * target);
    assert.equal(after, run.q[8 * s + a]);
    const best = Math.max(...run.q.subarray(8 * next, 8 * next + 8));
    if (next !== s) assert.equal(bestNext, best);
    here = record.here;
  }
});
