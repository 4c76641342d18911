// What is kept: by page and id, with a store and without, until it is forgotten.

import assert from "node:assert/strict";
import { test } from "node:test";

import {
  everything,
  forget,
  keep,
  kept,
  onReplaced,
  replace,
} from "../../../abstransfer/scenes/ui/kept.js";

const broken = () => {
  throw new Error("a browser may refuse");
};
const STORES = {
  "with a store": () => delete globalThis.sessionStorage,
  "without a store": () =>
    Object.defineProperty(globalThis, "sessionStorage", { get: broken, configurable: true }),
};

function makeStore() {
  const items = {};
  Object.defineProperties(items, {
    getItem: { value: (key) => items[key] ?? null },
    setItem: { value: (key, text) => (items[key] = text) },
  });
  return items;
}

for (const [name, prepare] of Object.entries(STORES)) {
  const start = () => {
    globalThis[Symbol.for("abstransfer: what is kept without a store")] = new Map();
    prepare();
    if (name === "with a store") {
      Object.defineProperty(globalThis, "sessionStorage", {
        value: makeStore(),
        configurable: true,
      });
    }
  };

  test(`${name}: each page keeps its own`, () => {
    start();
    keep("00_race", "race.bet", "nd");
    keep("01_building", "race.bet", "prob");
    keep("00_race", "ex-0-1", "a note\nof two lines");

    assert.equal(kept("00_race", "race.bet"), "nd");
    assert.equal(kept("00_race", "ex-0-1"), "a note\nof two lines");
    assert.equal(kept("02_solving", "race.bet"), "");
    assert.equal(kept("00_race", "constructor"), "");
    assert.deepEqual(everything(), {
      "00_race": { "race.bet": "nd", "ex-0-1": "a note\nof two lines" },
      "01_building": { "race.bet": "prob" },
    });
  });

  test(`${name}: what is empty is forgotten, and a page can be forgotten`, () => {
    start();
    keep("00_race", "a", "1");
    keep("00_race", "b", "2");
    keep("00_race", "a", "");
    assert.deepEqual(everything(), { "00_race": { b: "2" } });

    let heard = 0;
    const end = onReplaced(() => heard++);
    forget("00_race");
    replace({ "00_race": { c: "3" } });
    end();
    forget("05_inducing");

    assert.deepEqual(everything(), { "00_race": { c: "3" } });
    assert.equal(heard, 2);
  });
}

test("what somebody else put there does no harm", () => {
  STORES["with a store"]();
  for (const text of ["", "no json", "null", "[1]", '"x"', '{"a": 1, "b": {}, "c": "x"}']) {
    const value = makeStore();
    value.setItem("abstransfer:p", text);
    Object.defineProperty(globalThis, "sessionStorage", { value, configurable: true });
    assert.equal(kept("p", "a"), "");
    keep("p", "d", "y");
    assert.equal(kept("p", "d"), "y");
  }
});
