// The tau slider, page 8: how long a guide should advise.  Curves at full scale for
// hard and soft, learned when the reader's hand rests, and remembered.

import { ARMS, PAPER_STEPS, TAUS } from "../engine/paper.js";
import { NAMES, sum } from "../parts/runs.js";
import { spec } from "../python.js";
import { barChart } from "../ui/bars.js";
import { button } from "../ui/controls.js";
import { count, make, millions } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";
import { defineScene } from "../ui/scene.js";
import * as runs from "../parts/runs.js";

const PAUSE = 150; // milliseconds of rest before a dragged tau is learned
const BETS = { // up to this tau
  short: [2e6, "2 million or fewer"],
  few: [5e6, "2 to 5 million"],
  many: [12e6, "5 to 12 million"],
  most: [30e6, "more than 12 million"],
};
const SIDES = ["hard", "soft"];
const GUIDES = spec.fields.guide.bounds;

defineScene("tau", {
  title: "How long to advise",
  build(scene) {
    const { state } = scene;
    let place = state.map + state.source; // where `curves` come from
    let growing = {}; // goals by window of runs that are not done
    let running = null; // their keys
    let planned = null; // those that wait for the reader's hand to rest, joined
    let timer = null;

    const words = make("p", {});
    const schedule = lineChart({
      label: "When the guide decides: until τ in every step (hard), or ever less often (soft)",
      height: 130,
      x: { label: "", format: () => "", min: 0, max: PAPER_STEPS },
      y: {
        label: "share of steps in which the guide decides",
        format: (y) => `${100 * y} %`,
        min: 0,
        max: 1,
      },
    });
    schedule.node.style.marginBottom = "-1.5rem"; // its axis has no words
    const mark = () => (state.tau ? [{ x: runs.scaled(state.tau, state.steps), label: "" }] : []);
    const chart = runs.chart(scene, 280, mark);
    const totals = barChart({ label: "Goals in all", format: count });
    const height = {
      label: "thousand goals of a whole run, by τ",
      format: (y) => count(y / 1000),
      min: 0,
    };
    const byTau = lineChart({
      label: "Goals of a whole run by τ, hard and soft",
      height: 220,
      y: height,
      x: { label: "advice until step τ", format: millions, min: 0, max: PAPER_STEPS },
    });
    const grid = button("", () => scene.set({ all: isAll() || !state.all }), { primary: true });
    const jumps = SIDES.map((side) => button("", () => scene.set({ tau: paper(side) })));
    const buttons = [grid, ...jumps].map(({ node }) => node);
    const found = make("div", { class: "ab-scene" }, scene.row(...buttons), byTau.node);
    scene.add(
      scene.row(
        scene.choice("guide", {
          label: "Guide",
          options: Object.fromEntries(GUIDES.map((key) => [key, NAMES[key]])),
        }),
        scene.slider("tau", { label: "Advice until step τ", format: millions, step: 5e5 }),
      ),
      words,
      schedule.node,
      chart.node,
      totals.node,
      scene.bet("bet", {
        question:
          "Bet first: with advice in every step until τ (hard), which τ leads to most goals?",
        options: Object.fromEntries(Object.entries(BETS).map(([key, [, text]]) => [key, text])),
      }),
      found,
      scene.slider("luck", { label: "Luck (run of the experiment)" }),
    );
    scene.onLeave(() => clearTimeout(timer));

    const look = (side) => (side ? `${state.guide}-${side}` : "none");
    const paper = (side) => ARMS.find(({ name }) => name === look(side)).tau;
    // The name of a run among `curves`; without advice there is one only.
    function keyOf(side, tau = state.tau) {
      const name = side && tau ? `${look(side)} ${tau}` : "none 0";
      return `${name} ${state.luck} ${state.steps}`;
    }
    function jobOf(key) {
      const [name, tau, luck, steps] = key.split(" ");
      const [guide, strategy = "hard"] = name === "none" ? [null] : name.split("-");
      return runs.problem(state.map, state.source).parts({ guide, strategy, tau }, luck, steps);
    }
    const isKnown = (key) => key in state.curves;
    const goalsOf = (key) => state.curves[key] ?? growing[key] ?? [];
    const total = (side, tau) => sum(goalsOf(keyOf(side, tau)));
    const isAll = () => gridKeys().every(isKnown);
    const gridKeys = () => TAUS.flatMap((tau) => SIDES.map((side) => keyOf(side, tau)));

    // Learn what is shown, and not known: not before the reader's hand rests.
    function follow() {
      const keys = [...SIDES, null].map((side) => keyOf(side)).concat(state.all ? gridKeys() : []);
      const want = [...new Set(keys)].filter((key) => !isKnown(key));
      if (want.join() === planned) return;
      const left = scene.isLearning ? running.filter((key) => !isKnown(key)) : [];
      clearTimeout(timer);
      planned = null;
      if ([...want].sort().join() === left.sort().join()) return;
      scene.stop();
      growing = {};
      planned = want.join();
      timer = setTimeout(learn, running ? PAUSE : 0, want);
    }
    function learn(keys) {
      planned = null;
      running = keys;
      if (keys.length) {
        scene.learn(keys.map(jobOf), {
          onWindow: (job, i, goals) => ((growing[keys[job]] ??= [])[i] = goals),
          onDone: (job) =>
            scene.set({ curves: { ...state.curves, [keys[job]]: growing[keys[job]] } }),
        });
      }
    }

    function show() {
      const { steps, tau } = state;
      const end = [PAPER_STEPS, 0];
      const shares = { hard: [[0, 1], [tau, 1], [tau, 0], end], soft: [[0, 1], [tau, 0], end] };
      schedule.set({
        curves: SIDES.map((side) => ({
          name: side,
          arm: look(side),
          points: tau ? shares[side] : [[0, 0], end],
        })),
      });
      const rows = [null, ...SIDES].map((side) => {
        const goals = goalsOf(keyOf(side));
        return {
          name: side ?? NAMES.none,
          arm: look(side),
          goals,
          value: goals.length ? sum(goals) : null,
        };
      });
      // Where motion is unwelcome, curves do not grow: they come when they are known.
      chart.set(rows.filter(({ goals }) => !scene.calm || goals.length === runs.WINDOWS));
      totals.set(rows.map(({ name, arm, value }) => ({ name, arm, value })));
      scene.twin(() =>
        runs.table(`${words.textContent} ${SIDES.map(listed).join(" ")}`, rows, steps)
      );
    }
    function told() {
      const { guide, tau, steps } = state;
      if (!tau) return "No step of advice: hard and soft are plain Q-learning.";
      const until = `${NAMES[guide]} advises until step ${millions(tau)}`;
      const waiting = SIDES.map((side) => keyOf(side)).filter((key) => !isKnown(key));
      if (!waiting.length) {
        return `${until}: ${count(total("hard"))} goals if it decides in every step (hard), ${
          count(total("soft"))
        } if ever less often (soft).`;
      }
      const n = Math.min(...waiting.map((key) => goalsOf(key).length));
      return `${until}: learning, ${millions(n * runs.windowOf(steps))} of ${
        millions(steps)
      } steps …`;
    }

    // ---- what the reader has found: [tau, goals], ascending
    const tried = (side) =>
      Object.keys(state.curves)
        .map((key) => Number(key.split(" ")[1]))
        .filter((tau, i, all) => tau && all.indexOf(tau) === i && isKnown(keyOf(side, tau)))
        .sort((a, b) => a - b)
        .map((tau) => [tau, total(side, tau)]);
    const best = (side) => tried(side).reduce((most, each) => (each[1] > most[1] ? each : most));
    const listed = (side) =>
      `Goals by τ, ${side}: ${
        tried(side).map(([tau, goals]) => `${millions(tau)} ${count(goals)}`).join(", ") ||
        "none yet"
      }.`;

    function showFound() {
      const known = gridKeys().filter(isKnown).length;
      found.hidden = !state.bet && !state.all;
      grid.set(
        isAll()
          ? "Ten τ are known"
          : state.all
          ? `Stop (${known} of 20 runs)`
          : "Learn with ten τ, from 0.5 M to 25 M",
      );
      const papers = SIDES.map(paper);
      jumps.forEach((jump, i) => jump.set(`The paper's τ, ${SIDES[i]}: ${millions(papers[i])}`));
      const curves = SIDES.map((side) => ({ name: side, arm: look(side), points: tried(side) }));
      height.max = 1.2 * Math.max(...curves.flatMap(({ points }) => points.map(([, y]) => y)), 1); // room for names
      const isNear = papers[1] - papers[0] < 3e9 / found.clientWidth;
      const labels = isNear ? ["", "paper: hard, soft"] : ["paper: hard", "paper: soft"];
      byTau.set({
        curves,
        marks: papers.map((x, i) => ({ x, label: labels[i] })),
        cursor: state.tau,
      });
    }
    function closing() {
      const n = tried("hard").length;
      if (!state.bet || n < 2 || tried("soft").length < 2) return "";
      const [[tau, goals], [softTau, softGoals]] = SIDES.map(best);
      const truth = Object.keys(BETS).find((key) => tau <= BETS[key][0]);
      return (
        `${isAll() ? scene.betResult("bet", truth) : ""} Of ${n} τ tried with ${
          NAMES[state.guide]
        }, hard is best at ` +
        `${millions(tau)} (${count(goals)} goals), soft at ${millions(softTau)} (${
          count(softGoals)
        })` +
        `${isKnown(keyOf(null)) ? `; without advice it is ${count(total(null))}` : ""}. ` +
        `The paper chose ${millions(paper("hard"))} and ${millions(paper("soft"))}.`
      ).trim();
    }

    return function draw() {
      if (place !== state.map + state.source) {
        place = state.map + state.source;
        scene.set({ curves: {} });
      }
      follow();
      const before = words.textContent;
      words.textContent = told();
      if (words.textContent !== before && !words.textContent.endsWith("…")) {
        scene.say(words.textContent);
      }
      show();
      showFound();
      scene.close(closing());
    };
  },
});
