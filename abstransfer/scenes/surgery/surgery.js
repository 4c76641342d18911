// Surgery on notes, page 10: two robots were advised, and go on alone; what hangs on
// their notes shows when these are changed, and nothing else.

import { barChart } from "../ui/bars.js";
import { button } from "../ui/controls.js";
import { count, make, millions, newId, number, plural } from "../ui/dom.js";
import { layered } from "../ui/layers.js";
import { lineChart } from "../ui/lines.js";
import { defineScene } from "../ui/scene.js";
import * as runs from "../parts/runs.js";
import { paper, spec } from "../python.js";
import { noted, operate } from "./operations.js";

const PATIENTS = { nd: "ND's robot", prob: "Prob's robot" };
const OTHER = { nd: "prob", prob: "nd" };
const NAME = { nd: "ND", prob: "Prob" };
const OPERATIONS = {
  none: "nothing",
  erase: "erase its notes where the other has none",
  graft: "give it the other's notes where it has none",
  deal: "deal the notes of each state to other actions",
  thin: "erase half of the states, by chance",
};
const SHORT = {
  none: () => "as left",
  erase: (patient) => `blank where ${NAME[OTHER[patient]]} is`,
  graft: (patient) => `+ ${NAME[OTHER[patient]]}'s notes`,
  deal: () => "notes dealt anew",
  thin: () => "half of the states",
};
const BETS = {
  most: [0.5, "most of it"],
  some: [0.15, "some of it"],
  none: [-Infinity, "next to nothing"],
};

defineScene("surgery", {
  title: "Surgery on notes",
  build(scene) {
    const { state } = scene;
    let notes = {}; // Q that a robot left, by "patient luck"
    let place = state.map + state.source; // where notes and curves come from
    let growing = {}; // goals by window of runs that are not done
    let running = []; // their keys

    const keyOf = (patient, operation) => `${patient} ${operation} ${state.luck} ${state.steps}`;
    const known = (patient, operation) => state.curves[keyOf(patient, operation)];
    const nameOf = (patient, operation) => `${NAME[patient]}, ${SHORT[operation](patient)}`;
    const window = () => runs.windowOf(state.steps);

    const bars = barChart({ label: "Goals after the advice", format: count });
    const x = { label: "steps after the advice", format: millions, min: 0 };
    const y = { label: "goals, window by window", min: 0 };
    const chart = lineChart({ label: "Goals after the advice, by step", x, y, height: 220 });
    const view = layered({ label: "Where the robot has notes" });
    const shown = make("div", { class: "ab-body" }, make("p", { class: "ab-ylabel" }), view.node);
    const words = make("p", { id: newId() }); // also why the button waits
    const go = button("Operate, and let it go on", operateNow, { primary: true });
    go.node.setAttribute("aria-describedby", words.id);
    const stop = button("Stop", () => (scene.stop(), (running = []), scene.redraw()));
    scene.add(
      scene.bet("bet", {
        question: "Bet first: ND's notes are erased in all states where Prob's robot has none. " +
          "How much of ND's lead over Prob is left?",
        options: Object.fromEntries(Object.entries(BETS).map(([key, [, text]]) => [key, text])),
      }),
      scene.row(
        scene.choice("patient", { label: "On the table", options: PATIENTS }),
        scene.choice("operation", { label: "The operation", options: OPERATIONS }),
      ),
      scene.row(go.node, stop.node),
      words,
      make("div", { class: "ab-columns" }, make("div", {}, bars.node, chart.node), shown),
      scene.slider("luck", { label: "Luck: run" }),
    );

    // ---- first both robots are advised, then the table is changed, then it goes on

    function parts(patient) {
      const arm = { guide: patient, strategy: "hard", tau: 0 };
      return runs.problem(state.map, state.source).parts(arm, state.luck, state.steps);
    }
    function advise(patient) {
      const job = parts(patient);
      const steps = spec.advice * window();
      const rule = { strategy: "hard", tau: steps };
      return { ...job, rule, key: [spec.advised, state.luck - 1], steps, window: steps };
    }
    function alone(patient, operation) {
      const job = parts(patient);
      const [mine, other] = [patient, OTHER[patient]].map((name) => notes[noteKey(name)]);
      return {
        ...job,
        guide: null,
        rule: {},
        key: [spec.alone, state.luck - 1],
        notes: operate(operation, mine, other, job.world, state.luck),
        steps: (paper.windows - spec.advice) * window(),
      };
    }
    const noteKey = (patient) => `${patient} ${state.luck} ${state.steps}`;
    function operateNow() {
      if (!state.bet || scene.isLearning) return;
      const wanted = Object.keys(NAME).filter((name) => !notes[noteKey(name)]);
      running = ["advice"];
      if (!wanted.length) return learn();
      scene.learn(wanted.map(advise), {
        onDone(job, q) {
          notes[noteKey(wanted[job])] = q;
          if (Object.keys(NAME).every((name) => notes[noteKey(name)])) learn();
        },
      });
      scene.redraw();
    }
    function learn() {
      const pairs = [["nd", "none"], ["prob", "none"], [state.patient, state.operation]];
      const keys = new Map(pairs.filter((pair) => !known(...pair)).map((p) => [keyOf(...p), p]));
      running = [...keys.keys()];
      growing = {};
      const jobs = [...keys.values()].map((pair) => alone(...pair));
      const way = jobs[0]?.world.start;
      const share = (job) => {
        const has = noted(job.notes);
        return Math.round((1e4 * way.reduce((n, s) => n + has[s], 0)) / way.length) / 1e4;
      };
      if (jobs.length) {
        scene.learn(jobs, {
          onWindow: (job, i, goals) => ((growing[running[job]] ??= [])[i] = goals),
          onDone(job) {
            const curve = [share(jobs[job]), ...growing[running[job]]];
            scene.set({ curves: { ...state.curves, [running[job]]: curve } });
          },
        });
      }
      scene.redraw();
    }

    // ---- what it shows

    const total = (curve) => runs.sum(curve.slice(1));
    function rows() {
      const all = Object.keys(NAME).flatMap((patient) =>
        Object.keys(OPERATIONS).map((operation) => ({ patient, operation }))
      );
      return all.flatMap(({ patient, operation }) => {
        const curve = known(patient, operation);
        if (!curve) return [];
        const isHere = patient === state.patient && operation === state.operation;
        const arm = operation === "none" ? patient : `${patient}-soft`;
        const name = nameOf(patient, operation);
        return [{ name, arm, curve, isHere, isLeft: operation === "none", share: curve[0] }];
      });
    }
    function paintNotes() {
      const both = Object.keys(NAME).map((name) => notes[noteKey(name)]);
      shown.hidden = !both.every(Boolean);
      if (shown.hidden) return;
      const { map, tasks } = runs.problem(state.map, state.source);
      const { world } = parts(state.patient);
      const [mine, other] = [state.patient, OTHER[state.patient]].map((n) => notes[noteKey(n)]);
      const has = noted(operate(state.operation, mine, other, world, state.luck));
      const shares = new Float64Array(map.nCells);
      const nTasks = tasks.nStates / map.nCells;
      has.forEach((is, s) => (shares[s % map.nCells] += is / nTasks));
      view.map(map);
      view.values(shares, { low: 0, high: 1 });
      const text = "Where the robot has notes when it goes on: the stronger a cell, the more " +
        `of ${plural(nTasks, "goal")} it has a note for`;
      shown.firstChild.textContent = text;
      view.svg.setAttribute("aria-label", text);
    }
    function leadLeft() {
      const curves = [known("nd", "none"), known("prob", "none"), known("nd", "erase")];
      if (!curves.every(Boolean)) return null;
      const [nd, prob, erased] = curves.map(total);
      return nd > prob ? (erased - prob) / (nd - prob) : null;
    }
    function closing() {
      const left = leadLeft();
      if (!state.bet || left === null) return "";
      const truth = Object.keys(BETS).find((key) => left >= BETS[key][0]);
      const percent = number(100 * left, 0);
      return (
        `${scene.betResult("bet", truth)} In this run ${percent} % of ND's lead is left when its ` +
        "notes are erased where Prob is blank. Now give these notes to Prob, and nothing else."
      ).trim();
    }

    return function draw(state) {
      if (place !== state.map + state.source) {
        place = state.map + state.source;
        notes = {};
        scene.set({ curves: {} });
      }
      const found = rows();
      const here = known(state.patient, state.operation);
      const [busy, key] = [scene.isLearning, keyOf(state.patient, state.operation)];
      go.enable(state.bet && !here && !busy);
      stop.node.hidden = !busy;
      const n = (growing[key] ?? []).length;
      const before = words.textContent;
      words.textContent = told(here, busy, n);
      if (words.textContent !== before && !words.textContent.endsWith("…")) {
        scene.say(words.textContent);
      }
      bars.set(
        found.map(({ name, arm, curve, share }) => ({
          name,
          arm,
          value: total(curve),
          note: `notes in ${number(100 * share, 0)} % of states`,
        })),
      );
      const points = (goals) => goals.map((g, i) => [(i + 1) * window(), g]);
      x.max = (paper.windows - spec.advice) * window();
      const curves = found.filter(({ isHere, isLeft }) => isHere || isLeft);
      if (n && !here && !scene.calm) {
        const curve = [0, ...growing[key]];
        curves.push({ ...found[0], curve, isLeft: false, arm: `${state.patient}-soft` });
      }
      chart.node.hidden = !curves.length;
      chart.set({
        curves: curves.map(({ name, arm, curve, isLeft }) => ({
          name: isLeft ? name.replace(", as left", "") : "operated",
          arm,
          points: points(curve.slice(1)),
        })),
      });
      paintNotes();
      scene.twin(() => ({
        caption: "After the advice: states with a note, and goals",
        head: ["robot", "states with a note", "goals"],
        rows: found.map(({ name, curve, share }) => [
          name,
          `${number(100 * share, 1)} %`,
          count(total(curve)),
        ]),
      }));
      scene.close(closing());
    };

    function told(here, busy, n) {
      const name = nameOf(state.patient, state.operation);
      if (here) {
        const at = `${number(100 * here[0], 0)} % of the states`;
        return `${name}: notes in ${at}, and ${count(total(here))} goals after the advice. ` +
          "This operation is done with this luck: choose another.";
      }
      if (busy && running[0] === "advice") return "Both robots are advised first …";
      if (busy) return `${name}: window ${n} of ${paper.windows - spec.advice} …`;
      return state.bet ? `${name}: not operated on yet.` : "Place your bet first, then operate.";
    }
  },
});
