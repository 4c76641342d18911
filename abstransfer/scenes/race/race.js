// The race, page 0: robots that differ in the advice they get learn in one building,
// with one task, one start and one luck; step by step first, then all 30 million steps.

import { Run } from "../engine/learning.js";
import { LABELS } from "../engine/navigation.js";
import { ARMS } from "../engine/paper.js";
import { NAMES, stateAt, sum, WINDOWS } from "../parts/runs.js";
import { spec } from "../python.js";
import { barChart } from "../ui/bars.js";
import { button } from "../ui/controls.js";
import { armStyle, count, drawn, list, make, newId, number, place as placeOf } from "../ui/dom.js";
import { layered } from "../ui/layers.js";
import { middle } from "../ui/plan.js";
import { defineScene } from "../ui/scene.js";
import { timeline } from "../ui/timeline.js";
import * as runs from "../parts/runs.js";

const { racers: RACERS } = spec;
const [, FIRST] = spec.fields.t.bounds; // steps that can be looked at
const TRAIL = 40; // steps
const PROBLEM = ["map", "source", "luck", "steps", "policy", "tau"];

defineScene("race", {
  title: "The race",
  build(scene) {
    let world = null; // the problem
    let robots = []; // { arm, name, look, first, steps, ends, goals, path }
    let events = new Map(); // step -> sentence
    let parting = null; // { t, s }
    let another = ""; // said of a race whose curves went with its settings

    const view = layered({ label: "" });
    view.svg.style.maxHeight = "75vh"; // all in sight: nothing to scroll
    const words = make("p", {});
    const reached = barChart({ label: "Goals reached so far", format: count });
    const ticks = make("datalist", { id: newId() });
    const line = timeline(scene, "t", {
      speeds: [4, 20, 100],
      moments: { label: "Next event", find: nextEvent },
    });
    line.querySelector("input").setAttribute("list", ticks.id);
    // The second click of two would stop what the first began.
    const go = button("", ({ detail }) => detail > 1 || scene.set({ full: !scene.state.full }), {
      primary: true,
    });
    const clear = button("Clear", () => {
      forget();
      scene.set({ full: false, goals: {} });
    });
    const progress = make("p", {});
    const chart = runs.chart(scene, 300);
    const totals = barChart({ label: "Goals reached in all", format: count });
    const full = make(
      "div",
      { class: "ab-scene" },
      scene.row(go.node, clear.node, progress),
      chart.node,
      totals.node,
    );
    const racers = RACERS.map((name) => name.replace("-hard", ""));
    if (hasOwn(scene.state)) racers.push("yours");
    const all = () => `${scene.state.steps / 1e6} million steps`;
    scene.add(
      words,
      view.node,
      line,
      ticks,
      reached.node,
      scene.slider("luck", { label: "Luck (run of the experiment)" }),
      scene.bet("bet", {
        question: `Bet first: which robot reaches most goals in ${all()}?`,
        options: Object.fromEntries(
          racers.map((key) => [key, key === "none" ? `${NAMES.none}, without advice` : NAMES[key]]),
        ),
      }),
      full,
    );

    function hasOwn({ policy }) {
      return Object.keys(policy).length > 0;
    }
    function nextEvent(t) {
      return [...events.keys()].find((step) => step > t) ?? null;
    }
    const cellOf = (s) => s % world.map.nCells;
    const place = (s) => placeOf(world.map, cellOf(s));
    // Where a robot is seen: on the goal in the step that reaches it.
    const seen = (robot, t) => robot.ends.includes(t) ? robot.steps[t - 1].next : stateAt(robot, t);
    const arrived = ({ ends }, t) => ends.filter((end) => end <= t);

    function begin(state) {
      const { luck, steps: n, tau } = state;
      world = runs.problem(state.map, state.source);
      const arms = RACERS.map((name) => ARMS.find((arm) => arm.name === name));
      if (hasOwn(state)) {
        world.own(state.policy);
        arms.push({ name: "uniform_available", guide: "yours", strategy: "hard", tau });
      }
      view.map(world.map, { goals: [] });
      view.below.replaceChildren();
      robots = arms.map((arm) => {
        const { guide, rule, seed, key, world: w } = world.parts(arm, luck, n);
        const run = new Run(w, guide, rule, seed, key);
        const first = run.s;
        const steps = Array.from({ length: FIRST }, () => run.step());
        const ends = steps.filter(({ ended }) => ended === "goal").map(({ t }) => t);
        const style = `stroke:${armStyle(arm.name).color}`;
        const path = view.below.appendChild(drawn("path", { class: "ab-trail", style }));
        const name = NAMES[arm.guide ?? "none"];
        return { arm, name, look: arm.name, first, steps, ends, goals: [], path };
      });
      ({ events, parting } = runs.firstEvents(robots, FIRST));
      ticks.replaceChildren(...[...events.keys()].map((t) => make("option", { value: t })));
    }

    function tell(t) {
      if (!t) return `All robots start in ${place(robots[0].first)}, with one goal and one luck.`;
      const next = nextEvent(t);
      return events.get(t) ??
        `Step ${count(t)}.${next ? ` The next event is in step ${count(next)}.` : ""}`;
    }

    function show({ t }) {
      const { map, tasks } = world;
      const aims = robots.map(({ first, steps }) =>
        tasks.goal[Math.floor((t ? steps[t - 1].s : first) / map.nCells)]
      );
      view.map(map, { goals: [...new Set(aims)] });
      view.lit(t >= parting?.t ? [cellOf(parting.s)] : []);
      view.robots(
        robots.map((robot) => ({
          cell: cellOf(seen(robot, t)),
          arm: robot.look,
          name: robot.name,
        })),
      );
      for (const robot of robots) {
        const from = Math.max(0, t - TRAIL, ...arrived(robot, t - 1));
        const cells = [stateAt(robot, from), ...robot.steps.slice(from, t).map(({ next }) => next)];
        robot.path.setAttribute(
          "d",
          `M${cells.map((s) => middle(map, cellOf(s)).join(" ")).join("L")}`,
        );
      }
      reached.set(robots.map((robot, i) => ({
        name: robot.name,
        arm: robot.look,
        value: arrived(robot, t).length,
        note: `${place(seen(robot, t))}; its goal: ${place(aims[i])}`,
      })));
      words.textContent = tell(t);
      view.svg.setAttribute("aria-label", `The building. ${words.textContent}`);
    }

    // ---- all steps

    const done = () => robots.length && Math.min(...robots.map(({ goals }) => goals.length)); // windows
    function forget() {
      scene.stop();
      for (const robot of robots) robot.goals = [];
      scene.redraw();
    }
    // Goes on where it was stopped: what is known stays until it is learned again.
    function learn({ luck, steps }) {
      scene.learn(robots.map(({ arm }) => world.parts(arm, luck, steps)), {
        nWorkers: robots.length, // side by side, on however few cores
        onWindow: (job, i, goals) => (robots[job].goals[i] = goals),
        onDone() {
          const found = robots.map(({ arm, goals }) => [arm.guide ?? "none", goals]);
          if (done() === WINDOWS) scene.set({ goals: Object.fromEntries(found) });
        },
      });
    }
    function showFull({ bet, full: isOn, steps }) {
      const n = done();
      const isDone = n === WINDOWS;
      full.hidden = !bet && !isOn && !n;
      go.node.hidden = isDone;
      clear.node.hidden = !n || scene.isLearning;
      go.set(isOn ? "Stop" : n ? "Go on" : `All ${all()}`);
      progress.textContent = isDone
        ? ""
        : n || isOn
        ? `${isOn ? "" : "Stopped after "}${count(n * runs.windowOf(steps))} of ${all()}`
        : another;
      // A fair race shows all up to the same step; where motion is unwelcome, its end.
      const curves = robots.map(({ name, look, goals }) => ({
        name,
        arm: look,
        goals: goals.slice(0, n),
      }));
      chart.node.hidden = !(isDone || (n && !scene.calm));
      chart.set(curves);
      totals.set(n ? curves.map(({ goals, ...row }) => ({ ...row, value: sum(goals) })) : []);
    }
    function closing({ luck }) {
      if (done() < WINDOWS) return "";
      const order = robots.map(({ name, arm, goals }) => ({
        name,
        key: arm.guide ?? "none",
        total: sum(goals),
      }))
        .sort((a, b) => b.total - a.total);
      const ratio = order[0].total / sum(robots[0].goals);
      const first = [...robots].sort((a, b) =>
        (a.ends[0] ?? Infinity) - (b.ends[0] ?? Infinity)
      )[0];
      return (
        `${scene.betResult("bet", order[0].key)} ` +
        (first.ends.length
          ? `First at a goal: ${first.name}, in step ${count(first.ends[0])}. `
          : "") +
        `Most goals in ${all()}, with the luck of run ${luck}: ${order[0].name}` +
        `${
          Number.isFinite(ratio) ? `, ${number(ratio, 2)} times as many as without advice` : ""
        }. ` +
        `They reached: ${list(order.map(({ name, total }) => `${name} ${count(total)}`))}.` +
        (["map", "source"].every((key) => scene.state[key] === scene.spec.state[key])
          ? " Before you take that for the worth of another building: in 30 million steps a robot " +
            "that is told only what can be done here comes as far as ND's."
          : "")
      ).trim();
    }

    return function draw(state, changed) {
      if (PROBLEM.some((name) => changed.has(name))) {
        scene.stop();
        another = done() ? "Another race now: its steps are not learned yet." : "";
        begin(state);
        if (!changed.has("full")) scene.set({ full: false, goals: {} });
      }
      if (!state.full) scene.stop();
      else if (done() < WINDOWS && !scene.isLearning) learn(state);
      show(state);
      showFull(state);
      if (changed.has("t")) scene.say(words.textContent);
      scene.twin(() => (done() < WINDOWS
        ? twin(state)
        : runs.table("Goals of each robot, window by window", robots, state.steps))
      );
      scene.close(closing(state));
    };

    function twin({ t }) {
      return {
        caption: `After step ${count(t)} of ${count(FIRST)}`,
        head: ["robot", "where", "action", "goals", "reached in steps"],
        rows: robots.map((robot) => [
          robot.name,
          place(seen(robot, t)),
          t ? LABELS[robot.steps[t - 1].a].replaceAll("_", " ") : "–",
          arrived(robot, t).length,
          arrived(robot, t).join(", ") || "–",
        ]),
      };
    }
  },
});
