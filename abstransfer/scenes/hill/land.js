// The decision problem of page 6, with two knobs; its values as a land with contours;
// the climbs on it.

import { absprobPi } from "../engine/absprob_pi.js";
import { evaluatePolicy } from "../engine/solvers.js";
import { spec } from "../python.js";

export const N = 40; // squares along a side of the land
export const [, LAST] = spec.fields.t.bounds; // iterations of a climb
const { early: EARLY } = spec; // after which it is on one side for good
export const LEVELS = [-20, -10, -7, -5, -4.5, -4, -3.5, -3, -2.5, -2.2];
export const { weights: STARTS, words: WORDS } = spec; // of where the robot starts

// The five states as tasks of the engine: two "directions" lead where the actions do.
// In the tunnel both actions are one.
const neighbors = Int32Array.of(
  1,
  2,
  -1,
  -1,
  4,
  0,
  -1,
  -1,
  0,
  3,
  -1,
  -1,
  4,
  2,
  -1,
  -1,
  1,
  3,
  -1,
  -1,
);
const hall = {
  map: { neighbors },
  neighbors,
  nCells: 5,
  nStates: 5,
  nTasks: 1,
  nActions: 2,
  nAbstract: 3,
  labels: Int8Array.of(0, 1, -1, -1, 0, 1, -1, -1, 0, 1, -1, -1, 0, -1, -1, -1, -1, -1, -1, -1),
  nWays: Uint8Array.of(1, 1, 1, 1, 1, 1, 1, 0, 0, 0),
  rho: Int32Array.of(0, 1, 1, 2, 2),
  goal: Int32Array.of(4),
  terminal: Uint8Array.of(0, 0, 0, 0, 1),
  reward: Float64Array.of(-1, -1, -1, -1, 0),
  gamma: 0.99,
  success: 1,
  possible: Uint8Array.of(1, 1, 1, 1, 1, 0),
};
const advice = (p, q) => Float64Array.of(p, 1 - p, q, 1 - q, 1, 0);
const dot = (weights, v) => weights.reduce((sum, weight, s) => sum + weight * v[s], 0);
export const value = (p, q, start) =>
  dot(STARTS[start], evaluatePolicy(hall, advice(p, q), hall.rho));

// Heights ((N + 1)^2,), row by row from q = 0; the values are found once for all starts.
let known = null;
export function heights(start) {
  known ??= Array.from(
    { length: (N + 1) ** 2 },
    (_, i) =>
      evaluatePolicy(hall, advice((i % (N + 1)) / N, Math.floor(i / (N + 1)) / N), hall.rho),
  );
  return known.map((v) => dot(STARTS[start], v));
}

// Each iteration of AbsProb-PI: { p, q, value, up: the slope of either knob }.
export function climb(p, q, start, iterations = LAST) {
  const way = [];
  const options = { initial: advice(p, q), start: Float64Array.from(STARTS[start]), iterations };
  for (const { policy, value, gradient } of absprobPi(hall, options)) {
    const up = [gradient[0] - gradient[1], gradient[2] - gradient[3]];
    way.push({ p: policy[0], q: policy[2], value, up });
  }
  return way;
}

// Starts in the middle of 10 x 10 squares, and whether left and up is the end; a yield each.
export function* sides(start, found) {
  for (let i = 0; i < 100; i++) {
    const [p, q] = [((i % 10) + 0.5) / 10, (Math.floor(i / 10) + 0.5) / 10];
    found.push({ p, q, isLeft: climb(p, q, start, EARLY)[EARLY].p > 0.5 });
    yield;
  }
}

// Where the land is at least as high as a level, and the rim, as paths over the squares.
export function region(land, level) {
  let [fill, rim] = ["", ""];
  const rise = (x, y) => land[y * (N + 1) + x] - level;
  for (let y = 0; y < N; y++) {
    let run = 0; // whole squares in a row are one piece
    for (let x = 0; x <= N; x++) {
      const corners = x < N ? [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] : [];
      const rises = corners.map((corner) => rise(...corner));
      const isWhole = x < N && rises.every((h) => h >= 0);
      if (run && !isWhole) fill += `M${x - run} ${y}h${run}v1h${-run}z`;
      run = isWhole ? run + 1 : 0;
      if (isWhole || !rises.some((h) => h >= 0)) continue;
      const [points, cuts] = [[], []];
      corners.forEach(([a, b], i) => {
        const j = (i + 1) % 4;
        if (rises[i] >= 0) points.push(`${a} ${b}`);
        if (rises[i] >= 0 === rises[j] >= 0) return;
        const part = rises[i] / (rises[i] - rises[j]);
        const cut = [0, 1].map((k) => ([a, b][k] + part * (corners[j][k] - [a, b][k])).toFixed(2))
          .join(" ");
        points.push(cut);
        cuts.push(cut);
      });
      fill += `M${points.join("L")}z`;
      for (let i = 0; i + 1 < cuts.length; i += 2) rim += `M${cuts[i]}L${cuts[i + 1]}`;
    }
  }
  return { fill, rim };
}

// Where to write the levels: on ways from the saddle to a top and to a pit.
export function labels(start) {
  const found = [];
  for (const [a, b] of [[1, 1], [0, 0], [1, 0]]) {
    let before = value(0.5, 0.5, start);
    let last = -1;
    for (let i = 1; i < N; i++) {
      const onWay = (part) => [0.5 + part * (a - 0.5), 0.5 + part * (b - 0.5)];
      const now = value(...onWay(i / N), start);
      const level = LEVELS.find((each) => (before < each) !== (now < each));
      const part = (i - 1 + (level - before) / (now - before)) / N;
      before = now;
      if (level === undefined || part - last < 0.1) continue;
      last = part;
      const [p, q] = onWay(part);
      found.push({ p, q, level });
    }
  }
  return found;
}
