// Whispered advice, page 11: first notes at any size, no phase of advice, and a race
// against ND's advice and against none.

import * as runs from "../parts/runs.js";
import { ARMS } from "../engine/paper.js";
import { spec } from "../python.js";
import { barChart } from "../ui/bars.js";
import { button } from "../ui/controls.js";
import { count, make, newId } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";
import { defineScene } from "../ui/scene.js";
import { firstNotes, taught } from "./tables.js";

const WHAT = {
  values: "values by view",
  half: "half Prob, half eager",
  prob: "Prob's chances",
  nd: "ND's chances",
  exists: "what exists",
};
const BETS = { // up to this gain over ND's advice
  fewer: [-0.02, "fewer goals than ND's advice"],
  same: [0.02, "about as many, within 2 %"],
  more: [Infinity, "more goals than ND's advice"],
};
const QUIET = 9; // the bet is about values at this power
const IN_BENCH = { values: "whisper", exists: "hint" };
const sizeText = (power) => (power ? `1e−${power}` : "1");

defineScene("whisper", {
  title: "Whispered advice",
  build(scene) {
    const { state } = scene;
    let place = state.map + state.source; // where curves come from
    let tables = null; // of this place
    let growing = {}; // goals by window of runs that are not done
    let running = []; // their keys

    /** @type {(what: string, power?: number) => string} */
    const keyOf = (what, power) => `${what} ${power ?? "-"} ${state.luck} ${state.steps}`;
    const known = (what, power) => state.curves[keyOf(what, power)];
    const nameOf = (what, power) => `${WHAT[what]} × ${sizeText(power)}`;

    const bars = barChart({ label: "Goals of a whole run", format: count });
    const chart = runs.chart(scene, 240);
    const bySize = lineChart({
      label: "Goals of a whole run, by the size of what is whispered",
      height: 180,
      x: { label: "size", format: sizeText, min: 0, max: Math.max(...spec.powers) },
      y: { label: "thousand goals of a whole run", format: (y) => count(y / 1000), min: 0 },
    });
    const words = make("p", { id: newId() }); // also why the buttons wait
    const go = button("Whisper, and let it learn", () => learn([state.power]), { primary: true });
    const sweep = button("Seven sizes, 1 to 1e−40", () => learn(spec.powers));
    const stop = button("Stop", () => (scene.stop(), (running = []), scene.redraw()));
    for (const { node } of [go, sweep]) node.setAttribute("aria-describedby", words.id);
    scene.add(
      scene.bet("bet", {
        question: "Bet first: a robot is never advised. It starts with the small building's " +
          "values as notes, a thousand millionth of their size. It reaches",
        options: Object.fromEntries(Object.entries(BETS).map(([key, [, text]]) => [key, text])),
      }),
      scene.row(
        scene.choice("what", { label: "Whispered", options: WHAT }),
        scene.slider("power", { label: "Size", format: sizeText, step: 1 }),
      ),
      scene.row(go.node, sweep.node, stop.node),
      words,
      make("div", { class: "ab-columns" }, bars.node, make("div", {}, chart.node, bySize.node)),
      scene.slider("luck", { label: "Luck (run of the experiment)" }),
    );

    // ---- what is learned

    const problem = () => runs.problem(state.map, state.source);
    function rival(what) {
      const name = what === "none" ? "none" : "nd-hard";
      const { guide, strategy, tau } = ARMS.find((arm) => arm.name === name);
      return problem().parts({ guide, strategy, tau }, state.luck, state.steps);
    }
    function whispered(what, power) {
      tables ??= taught(state.source);
      const notes = firstNotes(problem().tasks, tables[what], power);
      return { ...rival("none"), guide: null, rule: {}, notes };
    }
    function learn(powers) {
      if (!state.bet || scene.isLearning) return;
      /** @type {any[][]} */
      const all = [["none"], ["advice"], ...powers.map((power) => [state.what, power])];
      const wanted = all.filter(([what, power]) => !known(what, power));
      running = wanted.map(([what, power]) => keyOf(what, power));
      growing = {};
      const keys = running;
      if (!keys.length) return;
      const jobs = wanted.map(([what, power]) =>
        power === undefined ? rival(what) : whispered(what, power)
      );
      scene.learn(jobs, {
        onWindow: (job, i, goals) => ((growing[keys[job]] ??= [])[i] = goals),
        onDone: (job) =>
          scene.set({ curves: { ...state.curves, [keys[job]]: growing[keys[job]] } }),
      });
      scene.redraw();
    }

    // ---- what it shows

    const total = (...pair) => runs.sum(known(...pair));
    // Powers at which this was whispered, with this luck.
    const tried = (what) =>
      Array.from({ length: Math.max(...spec.powers) + 1 }, (_, power) => power)
        .filter((power) => known(what, power));
    function rows() {
      /** @type {{ name: string, pair: any[], arm?: string, mark?: string }[]} */
      const found = [
        { name: runs.NAMES.none, pair: ["none"], arm: "none", mark: "none" },
        { name: "ND's advice, hard", pair: ["advice"], arm: "nd-hard", mark: "nd-hard" },
      ];
      for (const what of Object.keys(WHAT)) {
        for (const power of tried(what)) {
          const isHere = what === state.what && power === state.power;
          const mark = power >= 6 ? IN_BENCH[what] : undefined;
          const arm = isHere ? "prob-hard" : undefined;
          found.push({ name: nameOf(what, power), pair: [what, power], arm, mark });
        }
      }
      return found;
    }
    function closing() {
      const all = ["none", "advice"].every((what) => known(what)) && known("values", QUIET);
      if (!state.bet || !all) return "";
      const [none, advice, quiet] = [total("none"), total("advice"), total("values", QUIET)];
      const truth = Object.keys(BETS).find((key) => quiet / advice - 1 <= BETS[key][0]);
      const loud = known("values", 0)
        ? `; as loud as they are, to ${count(total("values", 0))}`
        : "";
      return (
        `${scene.betResult("bet", truth)} In this run values × ${sizeText(QUIET)} lead to ` +
        `${count(quiet)} goals, ND's advice to ${count(advice)}, no advice to ${count(none)}` +
        `${loud}.`
      ).trim();
    }
    function told() {
      const name = nameOf(state.what, state.power);
      if (scene.isLearning) {
        const n = Math.min(
          ...running.map((key) => (state.curves[key] ?? growing[key] ?? []).length),
        );
        return `Learning: window ${n} of ${runs.WINDOWS} …`;
      }
      if (known(state.what, state.power)) {
        return `${name}: ${
          count(total(state.what, state.power))
        } goals. Choose another size, or another whisper.`;
      }
      return state.bet ? `${name}: not learned yet.` : "Place your bet first, then whisper.";
    }

    return function draw() {
      if (place !== state.map + state.source) {
        place = state.map + state.source;
        tables = null;
        scene.set({ curves: {}, stored: {} });
      }
      const found = rows();
      const isIdle = state.bet && !scene.isLearning;
      go.enable(isIdle && !known(state.what, state.power));
      sweep.enable(isIdle && !spec.powers.every((power) => known(state.what, power)));
      stop.node.hidden = !scene.isLearning;
      const before = words.textContent;
      words.textContent = told();
      if (words.textContent !== before && !words.textContent.endsWith("…")) {
        scene.say(words.textContent);
      }
      const marks = state.stored;
      const shown = found.map(({ name, pair, arm, mark }) => ({
        name,
        arm,
        value: known(...pair) ? total(...pair) : null,
        mark: marks[mark],
      }));
      if (marks.ceiling) {
        shown.push({ name: "knows all: stored", arm: undefined, value: null, mark: marks.ceiling });
      }
      bars.set(shown);
      const curves = found.filter(({ pair, arm }) => arm && known(...pair));
      const short = { none: "none", advice: "advised" };
      chart.set(
        curves.map(({ pair, arm }) => ({
          name: short[pair[0]] ?? "whispered",
          arm,
          goals: known(...pair),
        })),
      );
      const powers = tried(state.what);
      const points = powers.map((power) => [power, total(state.what, power)]);
      bySize.node.hidden = powers.length < 2;
      bySize.set({
        curves: [{ name: WHAT[state.what], arm: "prob-hard", points }],
        marks: [],
        cursor: state.power,
      });
      scene.twin(() => ({
        caption: `Goals of a whole run of ${count(state.steps)} steps; stored means of five runs`,
        head: ["robot", "goals", "stored"],
        rows: shown.map(({ name, value, mark }) => [
          name,
          value === null ? "–" : count(value),
          mark ? count(mark) : "–",
        ]),
      }));
      scene.close(closing());
    };
  },
});
