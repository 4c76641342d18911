// Maps: parsed, refused and printed as Python does.

import assert from "node:assert/strict";
import { test } from "node:test";

import { at, numbers, readGolden, readMap } from "./engine.js";

const golden = readGolden("maps");

function answer(call) {
  try {
    return { text: call().text };
  } catch (error) {
    if (error.constructor !== Error) throw error; // a bug, not a refusal
    return { message: error.message };
  }
}

function assertSame(map, facts) {
  assert.equal(map.text, facts.text);
  assert.deepEqual([map.height, map.width], facts.shape);
  assert.equal(map.cells.join(""), facts.cells);
  assert.deepEqual(map.goals, facts.goals);
  for (const name of ["neighbors", "doors", "regions"]) {
    assert.deepEqual(numbers(map[name], facts[name]), facts[name], name);
  }
  assert.deepEqual([map.nRooms, map.nDoors], [facts.rooms, facts.n_doors]);
}

for (const [name, facts] of Object.entries(golden.shipped)) {
  test(`the ${name} map is the same building`, () => assertSame(readMap(name), facts));
}

test("small maps are the same buildings", () => {
  for (const facts of golden.small) assertSame(at.parseMap(facts.text), facts);
});

test("a drawing gives the same map or the same message", () => {
  for (const { drawn, ...expected } of golden.parsed) {
    assert.deepEqual(answer(() => at.parseMap(drawn)), expected, drawn);
  }
});

test("a refusal marks the place that it names", () => {
  for (const { drawn, message } of golden.parsed) {
    const named = message?.match(/^row (\d+), column (\d+)/);
    if (!named) continue;
    const place = { row: named[1] - 1, column: named[2] - 1 };
    assert.throws(() => at.parseMap(drawn), place);
  }
});

test("a drawing that is not legal yet can be redrawn", () => {
  const text = at.redraw("+---+\n|.d*|\n+---+", [[1, 2, " "]]);

  assert.equal(text, "+---+\n|. *|\n+---+");
  assert.throws(() => at.parseMap(text), /a goal in the corridor/);
});
