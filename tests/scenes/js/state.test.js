// The state of a scene: whatever it is given, each value is one that its field allows.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./python.js";
import { parseMap } from "../../../abstransfer/scenes/engine/maps.js";
import { makeState } from "../../../abstransfer/scenes/ui/state.js";

const scenes = Object.entries(globalThis.python.fields);
const of = (fields, get) =>
  Object.fromEntries(Object.entries(fields).map(([name, field]) => [name, get(field)]));
const specOf = (fields) => ({
  title: "",
  build: () => () => {},
  fields,
  state: of(fields, ({ start }) => start),
  limits: of(fields, ({ bounds }) => bounds),
  local: [],
});

const ODD = [
  ...[undefined, null, NaN, Infinity, -Infinity, 1.5, -1, 1e9, -1e9, 0.1, 1e-300, 2 ** 53],
  ...["", " ", "1.5", "1e9", "-3", "0x10", "Infinity", "NaN", "true", "false", "null", "x"],
  ...["[1]", "[[0.5, 0.5]]", "{}", '{"a": 1}', "[", '"nd"', "skip", "__proto__", "constructor"],
  ...[[], [1], ["nd"], [["nd"]], {}, { a: 1 }, { length: 3 }, true, false, 10n, Symbol.iterator],
  ...["no map", "+---+\n|  *|\n+---+", "+---+\n|   |\n+---+", "+---+\n|\t *|\n+---+", "@source"],
  ...["+---+\n|  *|\n+--", "*".repeat(1e6), `[${"[0,0],".repeat(1e5)}[0,0]]`],
];

// Whether a value is one that a field may have.
const ALLOWED = {
  flag: (value) => typeof value === "boolean",
  whole: (value, [least, most]) => Number.isInteger(value) && value >= least && value <= most,
  number: (value, [least, most]) => Number.isFinite(value) && value >= least && value <= most,
  choice: (value, bounds) => bounds.includes(value),
  text: (value) => typeof value === "string" && value.length <= 40_000,
  map: (value) => Boolean(parseMap(value)),
  list: (value, bounds) => Array.isArray(value) && value.every((each) => bounds.includes(each)),
  json: (value, _, start) =>
    value !== null && typeof value === "object" && Array.isArray(value) === Array.isArray(start),
};
const isAllowed = ({ kind, bounds, start }, value) => ALLOWED[kind](value, bounds, start);

for (const [scene, fields] of scenes) {
  test(`${scene} starts in a state that its fields allow`, () => {
    for (const [name, field] of Object.entries(fields)) {
      assert.ok(isAllowed(field, field.start), name);
      assert.deepEqual(makeState(specOf(fields), { [name]: field.start }).problems, {});
    }
  });

  test(`${scene} has no value that a field does not allow`, () => {
    for (const name of Object.keys(fields)) {
      for (const odd of ODD) {
        const state = makeState(specOf(fields));
        const changed = state.set({ [name]: odd });
        const value = state.values[name];

        assert.ok(isAllowed(fields[name], value), `${name}: ${String(odd)} gave ${value}`);
        assert.ok(changed.every((each) => each === name));
        if (name in state.problems) assert.equal(value, fields[name].start, "it stays as it was");
      }
    }
  });
}

test("a whole number stays whole, a number within its bounds, a list among its values", () => {
  const { race, project, hill } = globalThis.python.fields;
  const after = (fields, changes) => makeState(specOf(fields), changes).values;

  assert.equal(after(race, { t: "1.5" }).t, 2);
  assert.equal(after(race, { t: -0.2 }).t, 0);
  assert.equal(after(race, { luck: 1e9 }).luck, 50);
  assert.equal(after(hill, { p: 0.125 }).p, 0.125);
  assert.deepEqual(after(project, { guides: '["rand", "x", "nd", "nd"]' }).guides, ["nd", "rand"]);
});

test("a map that is refused is told of, until another is taken", () => {
  const { race } = globalThis.python.fields;
  const state = makeState(specOf(race), { map: "+---+\n|   |\n+---+" });

  assert.match(state.problems.map, /^the map has no goal; /);
  assert.equal(state.values.map, race.map.start);
  assert.deepEqual(state.set({ map: "x".repeat(50_000) }), []);
  assert.match(state.problems.map, /more than 40000 characters/);
  assert.deepEqual(state.set({ map: "+---+\n|  *|\n+---+" }), ["map"]);
  assert.deepEqual(state.problems, {});
});

test("nothing is set that is no field, not even by names that all objects have", () => {
  const { race } = globalThis.python.fields;
  const state = makeState(specOf(race), JSON.parse('{"__proto__": {"t": 3}, "nothing": 1}'));

  assert.deepEqual(Object.keys(state.values).sort(), Object.keys(race).sort());
  assert.equal(state.values.t, race.t.start);
  assert.equal({}.t, undefined);
});

test("new bounds clamp what is there", () => {
  const { ripple } = globalThis.python.fields;
  const state = makeState(specOf(ripple), { cell: 500 });

  assert.deepEqual(state.limit("cell", [0, 134]), ["cell"]);
  assert.equal(state.values.cell, 134);
  state.set({ cell: 1000 });
  assert.equal(state.values.cell, 134);
});
