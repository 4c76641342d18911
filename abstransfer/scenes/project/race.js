// A project: its advice, how it drives, how long a run is, and the text to
// hand in.  See Python's `project/racing.py` and `project/card.py`.

import { absprobPi, ITERATIONS } from "../engine/absprob_pi.js";
import { makeGuide, makeWorld } from "../engine/learning.js";
import { parseMap } from "../engine/maps.js";
import { abstractStates, FEATURES, navigationTasks } from "../engine/navigation.js";
import { PAPER_STEPS } from "../engine/paper.js";
import { inducedPolicies, randomPolicy, uniformPolicy } from "../engine/policies.js";
import { evaluatePolicy, mean, optimalValues } from "../engine/solvers.js";
import { meanInterval, quantile } from "../parts/student.js";
import { mapTexts, paper, spec } from "../python.js";
import { count } from "../ui/dom.js";

export const { seed: SEED } = paper;
export const GUIDES = spec.fields.guides.bounds;
const half = (x) => Math.floor(x + 0.5);

// Steps of a run and of advice, in the paper's proportions, rounded.
export function scale({ goals, nCells }) {
  const long = (PAPER_STEPS / spec.entries) * goals.length * nCells * 8;
  const unit = long >= 1e5 ? 1e4 : 100;
  const steps = unit * half(long / unit);
  return { steps, tau: unit * half((spec.tauShare * steps) / unit) };
}

const made = {}; // advice of before, by building and features

// Yield { tasks, drives, guides, iteration }: how the advice of a building ("source",
// "target", "own") drives in a map, and the advice, as they are found.
export function* preparing(map, features, advice) {
  const tasks = navigationTasks(map, { features });
  const found = { tasks, drives: {}, guides: {}, iteration: 0 };
  const drive = (name, policy) => {
    found.guides[name] = policy;
    found.drives[name] = mean(evaluatePolicy(tasks, policy, tasks.rho));
  };
  drive("rand", randomPolicy(tasks.nAbstract));
  drive("eager", uniformPolicy(tasks.possible));
  found.drives.optimal = mean(optimalValues(tasks));
  yield found;
  const key = advice + features;
  if (!made[key]) {
    const from = advice === "own"
      ? tasks
      : navigationTasks(parseMap(mapTexts[advice]), { features });
    const { nd, prob } = inducedPolicies(from);
    drive("nd", nd);
    drive("prob", prob);
    let grad;
    for (const { iteration, policy } of absprobPi(from)) {
      grad = policy;
      found.iteration = iteration;
      yield found;
    }
    if (advice !== "own") made[key] = { nd, prob, grad };
    drive("grad", grad);
  } else for (const [name, policy] of Object.entries(made[key])) drive(name, policy);
  found.iteration = ITERATIONS;
  yield found;
}

// Jobs of runs [robot, run] for `learnAll`.
export function jobsOf(map, { features, strategy, seed }, guides, runs) {
  const tasks = navigationTasks(map, { features, reward: "goal" });
  const world = makeWorld(tasks);
  const { steps, tau } = scale(map);
  const own = {};
  return runs.map(([robot, run]) => ({
    world,
    steps,
    window: steps / 10,
    seed,
    key: [0, run],
    rule: { strategy, tau },
    guide: robot === "none" ? null : (own[robot] ??= makeGuide(guides[robot], tasks.rho)),
  }));
}

export const total = (goals) => goals.reduce((sum, n) => sum + n, 0);
// As "+1.5 %"; nothing over nothing.
export function gainText(mine, none) {
  const share = half((1000 * mine) / none - 1000) / 10;
  return none ? `${share < 0 ? "" : "+"}${share.toFixed(1)} %` : "";
}
// By how much robots reached more than the one without advice: 0.1 is 10 %.
const gainOf = (goals, none) => total(goals) / total(none) - 1;

// What a race says of a robot: its gain, and in how many runs it was so.
export function judge(name, goals, none) {
  const gain = gainOf(goals, none);
  const isHurt = gain < 0;
  return {
    name,
    gain,
    isHurt,
    n: goals.filter((g, i) => (isHurt ? g < none[i] : g > none[i])).length,
  };
}

// Goals more than the same run without advice, [{ name, arm, runs }], as `runRows` draws
// them: a dot per run, their box, the mean with its interval.
export function picture(robots) {
  const signed = (n) => `${n > 0 ? "+" : ""}${count(n)}`;
  const items = robots.map((robot) => {
    const sorted = [...robot.runs].sort((a, b) => a - b);
    const interval = meanInterval(robot.runs);
    const [mean, low, high] = interval.map(signed);
    const box = [0, 0.25, 0.5, 0.75, 1].map((share) => quantile(sorted, share));
    return {
      ...robot,
      box,
      interval,
      text: interval[1] <= interval[2] ? `${mean} [${low}, ${high}]` : mean,
    };
  });
  const all = [0, 1, ...robots.flatMap(({ runs }) => runs)];
  const [low, high] = [Math.min(...all), Math.max(...all)];
  const margin = (high - low) / 12;
  const axis = "goals more than without advice, same luck";
  return { items, from: low - margin, to: high + margin, zero: 0, axis, format: signed };
}

// The rows of the card: robot, drives, goals of a life, over none, each life.
export function cardRows(chosen, drives, goals, lives) {
  return ["none", ...chosen, "optimal"].map((name) => {
    const mine = goals[name] ?? [];
    return [
      name,
      name === "none" ? "" : (drives[name]?.toFixed(2) ?? ""),
      mine.length ? `${half(total(mine) / mine.length)}` : "",
      mine.length && name !== "none" ? gainText(total(mine), total(goals.none)) : "",
      ...Array.from({ length: lives }, (_, i) => mine[i] ?? ""),
    ];
  });
}
const HEAD = ["robot", "drives", "goals of a life", "over none"];
export const headOf = (
  lives,
) => [...HEAD, ...Array.from({ length: lives }, (_, i) => `life ${i + 1}`)];

// `student` and `found` may be "", and are not told then; see `sealed.js`.
export function cardText(
  { student, map, tasks, features, advice, strategy, lives, seed, prediction, found, rows },
) {
  const { steps, tau } = scale(map);
  const seen = features.length === FEATURES.length ? "all" : features.join(", ") || "none";
  const size = `${map.nCells} cells, ${map.nRooms} rooms, ${map.goals.length} goals`;
  const settings = {
    ...(student && { Student: student }),
    Building: `${size}, ${abstractStates(tasks).length} abstract states`,
    "Advice from": advice,
    Features: seen,
    Strategy: strategy,
    Steps: steps,
    Tau: tau,
    Lives: lives,
    Seed: seed,
    Prediction: prediction,
    ...(found && { Found: found }),
  };
  const head = headOf(lives);
  return [
    "# Result card",
    "",
    ...Object.entries(settings).map(([name, value]) => `- ${name}: ${value}`),
    "",
    ...[head, head.map(() => "---"), ...rows].map((row) => `| ${row.join(" | ")} |`),
    "",
    "```text",
    map.text,
    "```",
    "",
  ].join("\n");
}
