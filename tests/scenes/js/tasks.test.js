// Tasks, values and policies: whole numbers equal Python's, values to 1e-9, policies
// to 1e-12.

import assert from "node:assert/strict";
import { test } from "node:test";

import { at, difference, numbers, readGolden, readMap } from "./engine.js";

const golden = readGolden("tasks");

function tasksOf({ map, options }) {
  const { almost_near: almostNear = 8, ...others } = options;
  const building = map.includes("+") ? at.parseMap(map) : readMap(map);
  return at.navigationTasks(building, { ...others, almostNear });
}

const title = ({ map, options }, i) =>
  `${map.includes("+") ? `small map ${i}` : map} ${JSON.stringify(options)}`;

function assertClose(array, sample, tolerance, name) {
  const worst = difference(array, sample);
  assert.ok(worst <= tolerance, `${name}: ${worst}`);
}

// Rows of an abstract policy for the abstract states that occur.
function shown(tasks, array, width = tasks.nActions) {
  return at.abstractStates(tasks).flatMap((z) => [
    ...array.subarray(z * width, (z + 1) * width),
  ]);
}

golden.cases.forEach((facts, i) => {
  test(`tasks of ${title(facts, i)}`, () => {
    const tasks = tasksOf(facts);
    const available = tasks.nWays.map((n) => Math.min(n, 1));
    const found = { ...tasks, available };

    assert.equal(tasks.nStates, facts.states);
    assert.deepEqual([...tasks.goal], facts.goal);
    const names = ["labels", "rho", "available", "terminal", "reward", "possible"];
    for (const name of names) {
      assert.deepEqual(numbers(found[name], facts[name]), facts[name], name);
    }
    const z = at.abstractStates(tasks);
    assert.deepEqual(z, facts.abstract_states);
    assert.equal(at.describe(z.at(-1), tasks.features), facts.described);
  });

  if (!facts.values) return;

  test(`values and policies of ${title(facts, i)}`, () => {
    const tasks = tasksOf(facts);
    const v = at.optimalValues(tasks);
    const optimal = at.optimalActions(tasks, v);
    const { nd, prob, votes } = at.inducedPolicies(tasks, { v });
    const steps = [];
    let grad;
    for (const step of at.absprobPi(tasks, { iterations: facts.iterations })) {
      steps.push(step.value);
      grad = step.policy;
    }
    const policies = {
      nd,
      prob,
      grad,
      first: at.inducedPolicies(tasks, { ties: "first" }).prob,
      "beta_0.5": at.betaPolicy(prob, 0.5),
      beta_3: at.betaPolicy(prob, 3),
      beta_inf: at.betaPolicy(prob, Infinity),
    };
    const available = at.uniformPolicy(tasks.nWays.map((n) => Math.min(n, 1)));
    const sweeps = at.valueIteration(tasks);
    const [, , , , , swept] = Array.from({ length: 6 }, () => sweeps.next().value);
    const values = { optimal: v, swept };
    values.available = at.evaluatePolicy(tasks, available);
    const guides = { ...policies, rand: at.randomPolicy(tasks.nAbstract) };
    for (const [name, policy] of Object.entries(guides)) {
      values[name] = at.evaluatePolicy(tasks, policy, tasks.rho);
    }
    const uniform = at.uniformPolicy(tasks.possible);
    const { value, gradient, visits } = at.abstractGradient(tasks, uniform);

    assert.deepEqual(numbers(optimal, facts.optimal_actions), facts.optimal_actions);
    assertClose(shown(tasks, votes), facts.votes, 1e-9, "votes");
    assertClose(prob, facts.everywhere, 1e-12, "prob, rows without votes too");
    for (const [name, sample] of Object.entries(facts.policies)) {
      assertClose(shown(tasks, policies[name]), sample, 1e-12, name);
    }
    for (const [name, sample] of Object.entries(facts.values)) {
      assertClose(values[name], sample, 1e-9, `values of ${name}`);
      assert.ok(Math.abs(at.mean(values[name]) - sample.mean) < 1e-9, name);
    }
    assertClose(steps, facts.history, 1e-9, "history");
    assert.ok(Math.abs(value - facts.value) < 1e-9);
    assertClose(shown(tasks, gradient), facts.gradient, 1e-9, "gradient");
    assertClose(shown(tasks, visits, 1), facts.visits, 1e-9, "visits");
  });
});

test("the beta family is Python's, at the ends and with ties too", () => {
  for (const { beta, from, to } of golden.betas) {
    const exponent = beta === "inf" ? Infinity : Number(beta);
    const found = at.betaPolicy(Float64Array.from(from), exponent);
    found.forEach((p, a) => assert.ok(Math.abs(p - to[0][a]) < 1e-12, beta));
  }
  assert.throws(() => at.betaPolicy(new Float64Array(8), -1), /at least 0, got -1/);
});

test("equally good actions are not told apart by rounding", () => {
  // The mirror image is the same problem, with its sums in another order.
  const backwards = (line) => [...line].reverse().join("");
  const mirrored = (text) => text.replaceAll(/.+/g, backwards);
  for (const { text } of readGolden("maps").small) {
    const [one, other] = [text, mirrored(text)].map((drawn) => {
      const tasks = at.navigationTasks(at.parseMap(drawn));
      return [at.deducedPolicy(tasks), at.inducedPolicies(tasks).prob];
    });
    one.forEach((policy, i) =>
      policy.forEach((p, j) => assert.ok(Math.abs(p - other[i][j]) < 1e-12, text))
    );
  }
});

test("Table 1 is Python's", () => {
  const [source, target] = ["source", "target"].map((name) => at.navigationTasks(readMap(name)));
  const { nd, prob } = at.inducedPolicies(source);
  const grad = at.deducedPolicy(source);
  const rand = at.randomPolicy(source.nAbstract);

  for (const [place, tasks] of [["source", source], ["target", target]]) {
    const facts = golden.table1[place];
    const found = { optimal: at.mean(at.optimalValues(tasks)) };
    for (const [name, policy] of Object.entries({ rand, nd, prob, grad })) {
      found[name] = at.mean(at.evaluatePolicy(tasks, policy, tasks.rho));
    }
    assert.deepEqual(Object.keys(found).sort(), [...at.ROWS].sort());
    for (const [name, value] of Object.entries(found)) {
      assert.ok(Math.abs(facts[name] - value) < 1e-9, `${place} ${name}`);
    }
    assert.equal(facts.abstract_states, at.abstractStates(tasks).length);
  }
});

test("Grad can be climbed a few milliseconds at a time", () => {
  const tasks = at.navigationTasks(readMap("source"));
  const climb = at.absprobPi(tasks, { iterations: 30 });
  const first = at.runFor(climb, 0);
  let state = first;
  let rounds = 1;
  while (!state.done) {
    state = at.runFor(climb, 1);
    rounds++;
  }

  assert.deepEqual([first.last.iteration, first.done], [0, false]);
  assert.ok(rounds > 1);
  assert.deepEqual(first.last.policy, at.deducedPolicy(tasks, { iterations: 30 }));
});
