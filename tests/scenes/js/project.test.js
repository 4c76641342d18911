// Whose work it is: seeds and buildings of names, as Python makes them.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { test } from "node:test";

import "./python.js";

const { sha256 } = await import("../../../abstransfer/scenes/project/hash.js");
const { buildingOf, seedOf, written } = await import(
  "../../../abstransfer/scenes/project/whose.js"
);

test("a digest is SHA-256, for every length of a text's last block", () => {
  for (let n = 0; n < 200; n++) {
    const text = "aé".repeat(n).slice(n % 2);
    assert.equal(sha256(text), createHash("sha256").update(text).digest("hex"));
  }
});

test("names have Python's seeds and buildings", () => {
  const { students } = globalThis.python;
  assert.ok(students.length > 20);
  for (const { name, one, seed, building } of students) {
    assert.equal(written(name), one);
    assert.equal(seedOf(name), seed, name);
    assert.equal(buildingOf(name), building, name);
  }
});

test("every sign counts as it does in Python", () => {
  const { signs } = globalThis.python;
  const found = signs.map(([sign]) => sign.toUpperCase().toLowerCase());
  assert.deepEqual(found, signs.map(([, small]) => small));
});

test("what is no name is none", () => {
  for (const name of ["", " ", "...", " . "]) assert.equal(written(name), "");
});
