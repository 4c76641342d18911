// What an address asks for beside a state: what is unknown is refused in a sentence.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./python.js";
import { refused } from "../../../abstransfer/scenes/ui/lecture.js";

const FIELDS = ["tau", "luck"];
const CONTROLS = ["tau", "luck", "bet"];

test("what a scene has is not refused", () => {
  assert.equal(refused([], [], FIELDS, CONTROLS), "");
  assert.equal(refused(["tau", "hide", "wall"], ["luck", "bet"], FIELDS, CONTROLS), "");
});

test("an unknown name is told, with the names there are", () => {
  assert.equal(
    refused(["tau", "epsilon"], [], FIELDS, CONTROLS),
    "The address names “epsilon”, which this scene does not know: it has tau and luck.",
  );
  assert.equal(
    refused(["hide"], ["q0", "luck"], FIELDS, CONTROLS),
    "It cannot hide “q0”: its controls are tau, luck and bet.",
  );
});

test("both are told", () => {
  const told = refused(["a", "b"], ["c"], FIELDS, CONTROLS);
  assert.match(told, /“a” and “b”.*“c”/);
});
