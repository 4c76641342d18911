// Q-learning under the microscope, page 3: every step forward and back, with Eq. 1
// filled in.  A run is a list of steps; this page takes them, or Python sends them.

import { RULE } from "../engine/learning.js";
import { parseMap } from "../engine/maps.js";
import { A, LABELS } from "../engine/navigation.js";
import { mean } from "../engine/solvers.js";
import { BET, given, HOW, LUCKS, STARTS, take, visited } from "./runs.js";
import { mapTexts, spec } from "../python.js";
import { barChart, formula } from "../ui/bars.js";
import { list, make, number, place } from "../ui/dom.js";
import { layered } from "../ui/layers.js";
import { defineScene } from "../ui/scene.js";
import { nameOf } from "../ui/sights.js";
import { timeline } from "../ui/timeline.js";

defineScene("microscope", {
  title: "Q-learning under the microscope",
  build(scene) {
    let [map, run, q, done] = [null, null, null, 0];
    let counts = null; // cells visited by each start, by luck

    const view = layered({
      label: "The building, with the largest value of each cell",
      describe: (cell) => describe(cell),
      onAct: ({ cell }) => chooseGoal(cell),
      keys: [["Enter, Space", "on a goal: make it the task"]],
    });
    const bars = barChart({
      label: "The eight action values of the cell",
      format: (x) => number(x, 3),
    });
    const here = make("p", {});
    const equation = formula("Eq. 1 with the numbers of this step");
    const words = make("p", {});
    const been = make("p", {});
    const buildings = scene.choice("map", {
      label: "Building",
      options: { [scene.spec.state.map]: "two rooms", [mapTexts.source]: "the source" },
    });
    scene.add(
      scene.row(buildings, scene.slider("luck", { label: "Luck (seed)" })),
      scene.row(
        scene.choice("start", {
          label: "Reward and first values",
          options: Object.fromEntries(Object.entries(STARTS).map(([k, { text }]) => [k, text])),
        }),
      ),
      make(
        "div",
        { class: "ab-columns" },
        make(
          "div",
          { class: "ab-body" },
          view.node,
          timeline(scene, "t", {
            label: "Step",
            moments: { label: "Next change", find: (t) => nextChange(t) },
          }),
          been,
        ),
        make("div", {}, here, bars.node),
      ),
      equation.node,
      words,
      scene.bet("bet", spec.bets.bet),
    );

    function nextChange(t) {
      const found = run.steps.findIndex(({ before, after }, i) => i >= t && before !== after);
      return found < 0 ? null : found + 1;
    }
    function chooseGoal(cell) {
      const task = map.goals.indexOf(cell);
      if (task >= 0) scene.set({ task });
      else scene.say("No goal here. A star marks the goals.");
    }
    const best = (s) => Math.max(...q.subarray(A * s, A * s + A));
    function describe(cell) {
      const what = run.tasks.terminal[cell]
        ? "the goal"
        : `largest value ${number(best(cell), 3)}${
          map.goals.includes(cell) ? ", a goal of another task" : ""
        }`;
      return `${place(map, cell)}: ${what}`;
    }

    function begin(state) {
      map = parseMap(state.map);
      scene.limit("task", [0, map.goals.length - 1]);
      run = state.trace.length ? given(map, state) : take(map, state, scene.spec.limits.t[1]);
      scene.limit("t", [0, run.steps.length]);
      q = new Float64Array(A * map.nCells).fill(run.q0);
      run.tasks.terminal.forEach((isGoal, s) => isGoal && q.fill(0, A * s, A * s + A));
      done = 0;
      counts = null;
      view.map(map, { aim: run.tasks.goal[0] });
    }
    // Walk the values to just after step t, forward or back.
    function walk(t) {
      for (; done < t; done++) q[A * run.steps[done].s + run.steps[done].a] = run.steps[done].after;
      while (done > t) {
        const { s, a, before } = run.steps[--done];
        q[A * s + a] = before;
      }
    }

    function countAll(state) {
      counts = Object.fromEntries(
        Object.keys(STARTS).map((start) => [
          start,
          [state.luck, ...Array.from({ length: LUCKS }, (_, i) => i + 1)].map(
            (luck) => visited(take(map, { ...state, start, luck }, BET), BET).size,
          ),
        ]),
      );
    }
    function closing(state) {
      if (!state.bet || state.trace.length) return "";
      if (!counts) countAll(state);
      const keys = Object.keys(STARTS);
      const means = keys.map((key) => mean(counts[key].slice(1)));
      const winners = keys.filter((_, i) => means[i] === Math.max(...means));
      const truth = winners.includes(state.bet) ? state.bet : winners[0];
      const each = keys.map((key, i) => `${number(means[i], 1)} (${STARTS[key].text})`);
      return (
        `${
          scene.betResult("bet", truth)
        } In ${BET} steps, on average over ${LUCKS} seeds, the robot ` +
        `stands on ${list(each)} of ${map.nCells} cells; with this luck, on ` +
        `${list(keys.map((key) => `${counts[key][0]}`))}.`
      ).trim();
    }

    function show(state) {
      const step = run.steps[state.t - 1];
      const s = step ? step.s : run.first;
      const values = Float64Array.from(
        { length: map.nCells },
        (_, cell) => run.tasks.terminal[cell] ? NaN : best(cell),
      );
      const low = run.q0 < 0 || STARTS[state.start].reward === "cost"
        ? Math.min(-1, ...values.filter(Number.isFinite))
        : 0;
      const high = STARTS[state.start].reward === "goal"
        ? Math.max(0.2, ...values.filter(Number.isFinite))
        : 0;
      view.values(values, { low, high });
      const short = (v) => number(v, map.width < 10 ? 2 : 1).replace("0.", ".");
      view.texts(Array.from(values, (v) => (Number.isFinite(v) && v !== run.q0 ? short(v) : null)));
      view.lit(step ? [s] : []);
      view.robots([{ cell: step ? step.next : s, arm: "none", name: "the robot" }]);
      const visits = visited(run, state.t);
      view.dots(Array.from({ length: map.nCells }, (_, cell) => visits.get(cell) ?? 0));
      been.textContent =
        `Specks: where the robot was, the larger the more often. So far ${visits.size} of ${map.nCells} cells.`;
      view.rename();
      const available = run.tasks.nWays.subarray(A * s, A * s + A);
      bars.set(
        LABELS.map((_, a) => ({
          name: nameOf(a) + (available[a] ? "" : " ·"),
          value: q[A * s + a],
          lit: step?.a === a,
        })),
      );
      here.textContent = step
        ? `Action values where the robot was (${
          place(map, s)
        }), after the step. A dot: the action finds nothing to go to.`
        : `Action values where the robot stands (${
          place(map, s)
        }). A dot: the action finds nothing to go to.`;
      tell(step);
    }

    function tell(step) {
      equation.node.hidden = !step;
      if (!step) {
        words.textContent = `No step yet: every value is ${
          number(run.q0, 0)
        }, but the goal's, which is 0.`;
        return;
      }
      const bestNext = step.next === step.s ? Math.max(...valuesBefore(step)) : best(step.next);
      const terms = [
        { symbol: "Q(s, a)", value: number(step.after, 4), word: "new value", lit: true },
        step.isGiven ? "← your rule of" : "←",
        !step.isGiven && { symbol: "1 − α", value: number(1 - RULE.alpha, 1), word: "share kept" },
        { symbol: "Q(s, a)", value: number(step.before, 4), word: "old value" },
        !step.isGiven && "+",
        { symbol: "α", value: number(RULE.alpha, 1), word: "learning rate" },
        !step.isGiven && "(",
        { symbol: "r", value: number(step.reward, 0), word: "reward" },
        !step.isGiven && "+",
        { symbol: "γ", value: number(RULE.gamma, 1), word: "discount" },
        {
          symbol: "max Q(s′, b)",
          value: number(bestNext, 4),
          word: step.ended === "goal" ? "best value: the goal" : "best value there",
        },
        !step.isGiven && ")",
      ];
      equation.set(terms.filter(Boolean));
      const finds = run.tasks.nWays[A * step.s + step.a]
        ? ""
        : ", which finds nothing to go to here";
      const moved = step.next === step.s ? "stayed" : `went to ${place(map, step.next)}`;
      const change = step.after - step.before;
      const learned = change === 0
        ? "nothing changed"
        : `the value ${change > 0 ? "rose" : "fell"} from ${number(step.before, 4)} to ${
          number(step.after, 4)
        }`;
      const end = step.ended === "goal"
        ? " The goal: an episode ends, the next begins elsewhere."
        : "";
      words.textContent =
        `Step ${step.t}: the robot chose “${nameOf(step.a)}” (${
          HOW[step.how]
        }${finds}), ${moved}, ` +
        `and ${learned}.${end}`;
    }
    function valuesBefore({ s, a, before }) {
      const row = q.slice(A * s, A * s + A);
      row[a] = before;
      return row;
    }

    return function draw(state, changed) {
      if (["map", "start", "task", "luck", "trace"].some((name) => changed.has(name))) begin(state);
      walk(state.t);
      show(state);
      if (changed.has("t")) scene.say(words.textContent);
      scene.twin(() => twin(state));
      scene.close(closing(state));
    };

    function twin(state) {
      return {
        caption: `The first ${state.t} of ${run.steps.length} steps, the last first; ` +
          `${visited(run, state.t).size} of ${map.nCells} cells visited, ` +
          `${
            run.steps.slice(0, state.t).filter(({ ended }) => ended === "goal").length
          } goals reached.`,
        head: [
          "step",
          "cell",
          "action",
          "chosen as",
          "next cell",
          "reward",
          "old value",
          "new value",
        ],
        rows: run.steps.slice(0, state.t).reverse().slice(0, 40).map((each) => [
          each.t,
          place(map, each.s),
          nameOf(each.a),
          HOW[each.how],
          place(map, each.next),
          number(each.reward, 0),
          number(each.before, 6),
          number(each.after, 6),
        ]),
      };
    }
  },
});
