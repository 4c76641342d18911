// What Python says to a bundle, for tests that run without a page.

import { readFileSync } from "node:fs";

const read = (path) => readFileSync(new URL(`../../../${path}`, import.meta.url), "utf8");
const { arms, strategies } = JSON.parse(read("abstransfer/palette.json"));

globalThis.python = {
  palette: { arms, strategies },
  mapTexts: { source: read("data/maps/source.txt"), target: read("data/maps/target.txt") },
  workerSource: read("abstransfer/scenes/_bundles/worker.js"),
  isWidget: true,
};
