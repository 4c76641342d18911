// The engine as one object, and what its tests need to compare with the golden files.

import "./python.js";

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";

import * as absprobPi from "../../../abstransfer/scenes/engine/absprob_pi.js";
import * as learning from "../../../abstransfer/scenes/engine/learning.js";
import * as maps from "../../../abstransfer/scenes/engine/maps.js";
import * as navigation from "../../../abstransfer/scenes/engine/navigation.js";
import * as paper from "../../../abstransfer/scenes/engine/paper.js";
import * as policies from "../../../abstransfer/scenes/engine/policies.js";
import * as random from "../../../abstransfer/scenes/engine/random.js";
import * as solvers from "../../../abstransfer/scenes/engine/solvers.js";
import * as workers from "../../../abstransfer/scenes/engine/workers.js";

export const at = {
  ...absprobPi,
  ...learning,
  ...maps,
  ...navigation,
  ...paper,
  ...policies,
  ...random,
  ...solvers,
  ...workers,
};

const golden = new URL("../../golden/", import.meta.url);
const drawn = new URL("../../../data/maps/", import.meta.url);

export const readGolden = (name) =>
  JSON.parse(readFileSync(new URL(`${name}.json`, golden), "utf8"));

export const readMap = (name) => at.parseMap(readFileSync(new URL(`${name}.txt`, drawn), "utf8"));

// Whole numbers as the golden files keep them: a list, or the digest of a long one.
export function numbers(array, golden) {
  const list = Array.from(array);
  if (Array.isArray(golden)) return list;
  return digest(Int32Array.from(list));
}

// Digest of a typed array, every bit of it.
export const digest = ({ buffer }) =>
  createHash("sha256").update(new Uint8Array(buffer)).digest("hex").slice(0, 32);

// Largest difference between an array and the sample of it in a golden file.
export function difference(array, { step, values }) {
  const entries = values.map((value, i) => Math.abs(array[i * step] - value));
  return Math.ceil(array.length / step) === values.length ? Math.max(...entries) : NaN;
}
