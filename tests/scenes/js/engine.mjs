// Loads the engine as a page does: classic scripts, in one global scope.

import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { runInThisContext } from "node:vm";

const here = new URL("./", import.meta.url);
const folder = new URL("../../../abstransfer/scenes/engine/", here);

for (const name of readdirSync(folder)) {
  if (!name.endsWith(".js")) continue;
  runInThisContext(readFileSync(new URL(name, folder), "utf8"), { filename: name });
}

export const at = globalThis.abstransfer;

export const readGolden = (name) =>
  JSON.parse(readFileSync(new URL(`../../golden/${name}.json`, here), "utf8"));

export const readMap = (name) =>
  at.parseMap(readFileSync(new URL(`../../../data/maps/${name}.txt`, here), "utf8"));

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
