// Values ripple out from the goal, page 2: sweep by sweep, until every cell knows its
// value; then the best actions, all of them.

import { runFor } from "../engine/absprob_pi.js";
import { parseMap } from "../engine/maps.js";
import { layered } from "../ui/layers.js";
import { nameOf } from "../ui/sights.js";
import { formula } from "../ui/bars.js";
import { count, make, number, place, plural } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";
import { defineScene } from "../ui/scene.js";
import { timeline } from "../ui/timeline.js";
import * as waves from "./waves.js";

const SLICE = 12; // milliseconds of sweeping between two pictures
const SWEEPS = { few: "about 25", some: "about 75", many: "several hundred" };
const short = (v) => number(v, v > -10 ? 1 : 0); // as it fits into a cell
const low = (n) => `${n}`.replace(/\d/g, (digit) => "₀₁₂₃₄₅₆₇₈₉"[digit]);
const TIES = { few: "in hardly any", some: "in a third", many: "in most" };

defineScene("ripple", {
  title: "Values ripple out from the goal",
  build(scene) {
    const { state } = scene;
    let [map, wave, totals, timer, end] = [null, null, [], null, null];
    let work; // what sweeps, a little at a time

    const view = layered({
      label: "The building, with what each cell believes to be worth",
      describe: (cell) => `${place(map, cell)}: ${believes(cell)}`,
      onAct({ cell }) {
        const task = map.goals.indexOf(cell);
        scene.set(task < 0 || task === state.task ? { cell } : { task });
      },
      keys: [[
        "Enter, Space",
        "on a goal: make it the task; else show how the cell finds its next value",
      ]],
    });
    const words = make("p", {});
    const own = make("p", {});
    const equation = formula("The backup of the chosen cell, with its numbers");
    const chart = lineChart({
      label: "The largest error of a cell, by sweep",
      height: 190,
      x: { label: "sweeps", min: 0 },
      // In powers of ten: the last hundredths take longest.
      y: {
        label: "largest error of a cell (each line a hundredth of the one above)",
        format: (y) => `${Number((10 ** y).toPrecision(1))}`,
        min: -2.5,
        max: 2,
      },
    });
    const arrows = scene.toggle("arrows", {
      label: "Best actions, as arrows; a frame where there is more than one",
    });
    scene.add(
      scene.bet("bet", {
        question:
          "Bet first: how many sweeps until every cell, in every task, knows its value to within a hundredth?",
        options: SWEEPS,
      }),
      scene.bet("ties", {
        question: "And in how many cells is there more than one best action?",
        options: TIES,
      }),
      scene.row(
        scene.slider("task", { label: "Task: goal number", format: (task) => `${task + 1}` }),
        scene.slider("success", {
          label: "A move succeeds with probability",
          step: 0.05,
          format: (p) => number(p, 2),
        }),
      ),
      view.node,
      arrows,
      timeline(scene, "k", { label: "Sweep", speeds: [2, 5, 15] }),
      words,
      own,
      equation.node,
      chart.node,
    );

    const shown = () => Math.min(Math.round(state.k), wave.end);
    const value = (cell) => wave.sweeps[shown()][cell];
    const hasNews = (cell) => wave.steps[cell] <= shown();
    function believes(cell) {
      if (!wave) return "not known yet";
      if (wave.tasks.terminal[cell]) return "the goal, value 0";
      const guess = hasNews(cell)
        ? `value ${number(value(cell), 2)}`
        : `no news yet, believes ${number(value(cell), 2)}`;
      const best = state.arrows ? `, ${plural(wave.nBest[cell], "best action")}` : "";
      return `${guess}${best}${map.goals.includes(cell) ? ", a goal of another task" : ""}`;
    }

    // ---- sweeping: the task that is shown, then all others

    function* sweepAll() {
      const { task, success } = state;
      const summary = ({ end, nTies, far }) => ({ end, nTies, far });
      wave = yield* waves.ripple(map, task, success);
      totals[task] = summary(wave);
      for (let other = 0; other < map.goals.length; other++) {
        totals[other] ??= summary(yield* waves.ripple(map, other, success));
      }
    }
    function begin(changed) {
      if (changed.has("map")) {
        map = parseMap(state.map);
        scene.limit("task", [0, map.goals.length - 1]);
        scene.limit("cell", [0, map.nCells - 1]);
      }
      if (changed.has("map") || changed.has("success")) totals = [];
      wave = null;
      work = sweepAll();
      clearTimeout(timer);
      go();
    }
    function go() {
      const wasKnown = wave;
      const { done } = runFor(work, SLICE);
      timer = done ? null : setTimeout(go);
      if (wave && !wasKnown) {
        const wasAtEnd = state.k === end;
        end = wave.end;
        scene.limit("k", [0, end]);
        if (wasAtEnd) scene.set({ k: end }); // who looked at the end does so still
      }
      if (done || wave !== wasKnown) scene.redraw();
    }
    scene.onLeave(() => clearTimeout(timer));

    // ---- pictures

    function show() {
      view.map(map, { aim: map.goals[state.task] });
      view.choose(state.cell);
      const isSmall = map.nCells <= 1000; // numbers could be read
      const v = wave?.sweeps[shown()];
      const least = wave && Math.min(...wave.sweeps[wave.end]);
      view.values(wave && v.map((x, cell) => (hasNews(cell) ? x : NaN)), { low: least, high: 0 });
      const text = (x, cell) => (wave.tasks.terminal[cell] ? null : hasNews(cell) ? short(x) : "·");
      view.texts(wave && isSmall && !state.arrows ? Array.from(v, text) : null);
      view.arrows(wave && state.arrows ? waves.arrowsOf(wave) : null);
      view.lit(
        wave && state.arrows ? [...wave.nBest.keys()].filter((cell) => wave.nBest[cell] > 1) : [],
      );
      view.rename();
    }
    function tell() {
      const k = shown();
      const { steps, errors, sweeps, tasks } = wave;
      const deaf = steps.findIndex((n) => n > k);
      const nDeaf = steps.filter((n) => n > k).length;
      const others = deaf < 0
        ? "all cells have heard of the goal"
        : `${count(map.nCells - nDeaf)} of ${
          count(map.nCells)
        } cells have heard of the goal; the others (·) all believe ${number(sweeps[k][deaf], 2)}`;
      words.textContent = `After ${plural(k, "sweep")}: ${others}. The worst guess is wrong by ${
        number(errors[k], 2)
      }.`;
      const { cell } = state;
      const { action, worth, guess } = waves.backup(tasks, sweeps[k], cell);
      equation.set([
        { symbol: `V${low(k + 1)}(s)`, value: number(guess, 4), word: "next guess", lit: true },
        "=",
        { symbol: "r(s)", value: number(tasks.reward[cell], 0), word: "my pay" },
        ...(action === null ? [] : [
          "+",
          { symbol: "γ", value: number(tasks.gamma, 2), word: "discount" },
          "·",
          {
            symbol: `max Σ T V${low(k)}`,
            value: number(worth, 4),
            word: "best of what my neighbours guess",
          },
        ]),
      ]);
      const { success, nWays, nActions } = tasks;
      const v = sweeps[k][cell];
      const outcome = nWays[nActions * cell + action]
        ? `It leads on with probability ${number(success, 2)}, to ${
          number((worth - (1 - success) * v) / success, 4)
        } on average; else the cell's own ${number(v, 4)} stays.`
        : "It finds nothing to go to here.";
      own.textContent = action === null
        ? `The chosen cell, ${place(map, cell)}, is the goal: nothing comes after it.`
        : `The chosen cell, ${place(map, cell)}, in sweep ${k + 1}: its best action is “${
          nameOf(action)
        }”. ${outcome}`;
    }
    function showChart() {
      const { errors, far } = wave;
      const points = errors.slice(0, shown() + 1).map((
        error,
        k,
      ) => [k, Math.log10(Math.max(error, 10 ** -2.5))]);
      chart.set({
        curves: [{ name: "", arm: "none", points }],
        cursor: shown(),
        marks: [{ x: far, label: "news is everywhere" }, { x: wave.end, label: "" }],
      });
    }
    function closing() {
      if (!state.bet || !state.ties || shown() < wave.end || timer) return "";
      const { far, nTies } = wave;
      const n = map.goals.length;
      const most = Math.max(...totals.map((total) => total.end));
      const farthest = Math.max(...totals.map((total) => total.far));
      const ties = totals.reduce((sum, total) => sum + total.nTies, 0);
      const cells = n * (map.nCells - 1);
      const truth = most < 43 ? "few" : most < 150 ? "some" : "many"; // half way, by factors
      const truthOfTies = ties < cells / 6 ? "few" : ties < cells / 2 ? "some" : "many";
      const isAsked = ["map", "success"].every((name) => state[name] === scene.spec.state[name]);
      const other = isAsked ? "" : "moves that succeed with probability 0.9, in the source";
      const results = [
        scene.betResult("bet", truth, other),
        scene.betResult("ties", truthOfTies, other),
      ];
      const all = n > 1
        ? ` In all ${n} tasks: at most ${farthest} steps, ${most} sweeps, ${count(ties)} of ${
          count(cells)
        } cells.`
        : "";
      return (
        `${results.join(" ")} News reaches the farthest cell of this task, ${
          plural(far, "step")
        } away, in sweep ${far}; every cell knows its ` +
        `value to within a hundredth after ${plural(wave.end, "sweep")}. ` +
        `More than one action is best in ${nTies} of ${count(map.nCells - 1)} cells.${all}`
      ).trim();
    }
    function twin() {
      return {
        caption: words.textContent,
        head: ["cell", "steps to the goal", "value now", "value in the end", "best actions"],
        rows: Array.from(wave.steps, (n, cell) => [
          place(map, cell),
          n,
          number(value(cell), 6),
          number(wave.sweeps[wave.end][cell], 6),
          wave.nBest[cell],
        ]),
      };
    }

    return function draw(_, changed) {
      if (["map", "task", "success"].some((name) => changed.has(name))) begin(changed);
      show();
      arrows.hidden = !state.ties;
      chart.node.hidden = !state.bet;
      if (!wave) {
        words.textContent = "Sweeping …";
        return;
      }
      tell();
      showChart();
      if (changed.has("k")) scene.say(words.textContent);
      else if (changed.has("cell")) scene.say(own.textContent);
      scene.twin(twin);
      scene.close(closing());
    };
  },
});
