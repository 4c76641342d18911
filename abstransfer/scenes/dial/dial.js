// One dial, two curves, page 10: the policies proportional to p^beta, from ND (0) over
// Prob (1) to winner-takes-all.  How well each drives is exact; how well it teaches is
// learned in workers, when the reader asks.

import { makeGuide, makeWorld } from "../engine/learning.js";
import { parseMap } from "../engine/maps.js";
import { navigationTasks } from "../engine/navigation.js";
import { betaPolicy, inducedPolicies } from "../engine/policies.js";
import { evaluatePolicy, mean } from "../engine/solvers.js";
import { paper, spec } from "../python.js";
import { button } from "../ui/controls.js";
import { count, make, millions, number, plural } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";
import { defineScene } from "../ui/scene.js";
import * as runs from "../parts/runs.js";
import { slices } from "../parts/slices.js";

const { seed: SEED } = paper; // run `luck` has the seed of that run of the stored experiments
const { step: STEP } = spec;
const [, LAST] = spec.fields.beta.bounds;
const BETAS = Array.from({ length: LAST / STEP + 1 }, (_, i) => i * STEP);
const REWARDS = { goal: "1 at the goal, Q starts at 0", cost: "−1 a step, Q starts at 0" };
const BETS = {
  nd: "at ND, β = 0",
  drive: "where it drives best",
  prob: "at Prob, β = 1",
  more: "beyond Prob",
};
const SIDES = { hard: "hard", soft: "soft" };

defineScene("dial", {
  title: "One dial, two curves",
  build(scene) {
    let source, target, prob, drives, worlds; // drives: [in source, in target] by beta
    let [begun, running] = [[], []]; // runs { beta, of, goals }: not done, and those in workers
    let place = "";
    const work = slices(scene); // all values of driving

    const policyOf = (beta) => betaPolicy(prob, beta);
    const drive = (
      beta,
    ) => (drives[beta] ??= [source, target].map((tasks) =>
      mean(evaluatePolicy(tasks, policyOf(beta), tasks.rho))
    ));
    const betaText = (beta) =>
      `${number(beta, 2)}${
        { 0: " (ND)", 1: " (Prob)", [LAST]: " (winner takes all)" }[beta] ?? ""
      }`;

    const x = { label: "β (ND at 0, Prob at 1)", format: (b) => number(b, 0), min: 0, max: LAST };
    const y = {
      label: "How well it TEACHES: thousands of goals while learning with its advice",
      min: 0,
    };
    const driving = lineChart({
      label: "How well the policy drives",
      height: 200,
      x,
      y: {
        label: "How well it DRIVES: mean value of a cell",
        format: (v) => number(v, 0),
        min: -90,
        max: -20,
      },
    });
    const teaching = lineChart({ label: "How well the policy teaches", height: 220, x, y });
    const now = make("p", {});
    const one = button("", () => teach([scene.state.beta]), { primary: true });
    const many = button("", () => teach(places()));
    const stop = button("Stop", () => (scene.stop(), scene.redraw()));
    scene.add(
      scene.bet("bet", {
        question: "Bet first: where on the dial is the best teacher?",
        options: BETS,
      }),
      scene.row(scene.slider("beta", { label: "The dial: β", format: betaText, step: STEP })),
      driving.node,
      teaching.node,
      now,
      scene.row(one.node, many.node, stop.node),
      scene.row(
        scene.choice("strategy", { label: "Advice", options: SIDES }),
        scene.choice("reward", { label: "The learner's reward", options: REWARDS }),
      ),
      scene.row(
        scene.slider("tau", { label: "Advice until step τ", format: millions, step: 5e5 }),
        scene.slider("luck", { label: "Luck: run" }),
      ),
    );

    function begin(state) {
      scene.stop();
      [drives, worlds, begun] = [{}, {}, []];
      [source, target] = [state.source, state.map].map((text) => navigationTasks(parseMap(text)));
      ({ prob } = inducedPolicies(source));
      const of = state.source + state.map;
      if (place && place !== of) scene.set({ points: [] }); // they were of other buildings
      place = of;
      work.start(driveAll());
    }
    function* driveAll() {
      for (const beta of BETAS) yield drive(beta);
    }
    const bestDriver = (side) =>
      work.isWorking() ? null : BETAS.reduce((a, b) => (drives[b][side] > drives[a][side] ? b : a));
    const places = () => [...new Set([0, bestDriver(1) ?? 0.5, 1, 2, LAST])];

    // ---- teaching: a point is [beta, goals, strategy, reward, tau, luck, steps]

    const setting = (
      { strategy, reward, tau, luck, steps },
    ) => [strategy, reward, tau, luck, steps];
    const sameAs = (wanted) => ([, , ...rest]) => rest.join() === wanted.join();
    const tried = (strategy = scene.state.strategy) =>
      scene.state.points
        .filter(sameAs(setting({ ...scene.state, strategy })))
        .sort(([a], [b]) => a - b);
    const isTried = (beta) => tried().some(([b]) => b === beta);
    function worldOf(reward) {
      return (worlds[reward] ??= makeWorld(navigationTasks(target.map, { reward })));
    }
    // Like the race: what is known stays until it is learned again.
    const stopped = () => begun.filter(({ of }) => of === `${setting(scene.state)}`);
    const sofar = (list) =>
      list.map(({ beta, goals }) =>
        `β = ${number(beta, 2)}, ${
          millions(goals.length * runs.windowOf(scene.state.steps))
        } steps, ${count(runs.sum(goals))} goals`
      ).join("; ");
    function teach(betas) {
      const { strategy, reward, tau, luck, steps } = scene.state;
      const of = setting(scene.state);
      const window = runs.windowOf(steps);
      const fresh = (beta) => ({ beta, of: `${of}`, goals: [] });
      const mine = betas.filter((beta) => !isTried(beta)).map((beta) =>
        stopped().find((run) => run.beta === beta) ?? fresh(beta)
      );
      if (!mine.length) return scene.say("These are known already.");
      running = mine;
      begun = [...new Set([...begun, ...mine])];
      const jobs = mine.map(({ beta }) => ({
        world: worldOf(reward),
        guide: makeGuide(policyOf(beta), target.rho),
        rule: { strategy, tau: runs.scaled(tau, steps) },
        seed: SEED,
        key: [0, luck - 1],
        steps: runs.WINDOWS * window,
        window,
      }));
      scene.learn(jobs, {
        onWindow: (job, i, goals) => (mine[job].goals[i] = goals),
        onDone(job) {
          const { beta } = mine[job];
          const goals = runs.sum(mine[job].goals);
          begun = begun.filter((run) => run !== mine[job]);
          scene.set({ points: [...scene.state.points, [beta, goals, ...of]] });
          scene.say(`β = ${number(beta, 2)}: ${count(goals)} goals.`);
        },
      });
      scene.redraw(); // what can stop it is seen at once
    }

    const best = (list) => list.reduce((a, b) => (b[1] > a[1] ? b : a));
    // Which bet a place on the dial belongs to.
    const betOf = (beta) =>
      beta === 0
        ? "nd"
        : beta > 1
        ? "more"
        : Math.abs(beta - bestDriver(1)) <= 1 - beta
        ? "drive"
        : "prob";

    function closing(state) {
      if (work.isWorking()) return "";
      const [inSource, inTarget] = [bestDriver(0), bestDriver(1)];
      const driver =
        `The policy drives best at β = ${number(inTarget, 2)} in the target (${
          number(drives[inTarget][1], 1)
        }) and ` +
        `at ${number(inSource, 2)} in the source (${number(drives[inSource][0], 1)}).`;
      const list = tried();
      if (!state.bet || !list.length) return driver;
      const [beta, goals] = best(list);
      const other = list.find(([b]) => b === inTarget);
      const all = places().every(isTried);
      const result = all ? scene.betResult("bet", betOf(beta)) : "";
      const gap = other && beta !== inTarget
        ? `, ${
          number((100 * (goals - other[1])) / Math.max(other[1], 1), 0)
        } % more than the best driver`
        : "";
      return (
        `${result} ${driver} Of ${plural(list.length, "place")} tried, it teaches best at β = ${
          number(beta, 2)
        }: ` +
        `${count(goals)} goals${gap} (${state.strategy}, τ = ${millions(state.tau)}, ${
          REWARDS[state.reward]
        }).`
      ).trim();
    }

    function show(state) {
      const known = BETAS.filter((beta) => drives[beta]);
      const peak = bestDriver(1);
      const mark = (beta) => [{ x: beta, label: `peak ${number(beta, 2)}` }];
      driving.set({
        curves: ["source", "target"].map((name, side) => ({
          name,
          arm: side ? "dial-hard" : "dial-soft",
          points: known.map((beta) => [beta, drives[beta][side]]),
        })),
        marks: peak === null ? [] : mark(peak),
        cursor: state.beta,
      });
      const curves = Object.keys(SIDES).map((side) => ({
        name: side,
        arm: `dial-${side}`,
        points: state.bet ? tried(side).map(([beta, goals]) => [beta, goals / 1000]) : [],
      }));
      const list = state.bet ? tried() : [];
      y.max = 1.25 *
        Math.max(...curves.flatMap(({ points }) => points.map(([, goals]) => goals)), 4);
      teaching.set({ curves, cursor: state.beta, marks: list.length ? mark(best(list)[0]) : [] });
    }

    function tell(state) {
      const [inSource, inTarget] = drive(state.beta);
      const point = tried().find(([beta]) => beta === state.beta);
      const left = stopped().filter(({ goals }) => goals.length);
      const taught = !state.bet
        ? "Bet first, then let it teach."
        : scene.isLearning
        ? `Learning: ${sofar(running)}.`
        : point
        ? `Taught by it, a robot reaches ${count(point[1])} goals.`
        : "How well it teaches: not tried yet.";
      now.textContent =
        `At β = ${betaText(state.beta)}, driving is worth ${
          number(inTarget, 2)
        } a cell in the target, ` +
        `${number(inSource, 2)} in the source. ${taught}` +
        (left.length && !scene.isLearning ? ` Stopped: ${sofar(left)}.` : "");
      one.set(`Let β = ${number(state.beta, 2)} teach: ${millions(state.steps)} steps`);
      many.set(
        `Let five teach: β = ${places().map((beta) => number(beta, beta % 1 ? 2 : 0)).join(", ")}`,
      );
      one.enable(state.bet);
      many.enable(state.bet && !work.isWorking());
      stop.node.hidden = !scene.isLearning;
    }

    function twin() {
      return {
        caption: `Value of driving; goals in ${
          millions(scene.state.steps)
        } steps of learning, ${scene.state.strategy}, τ = ${millions(scene.state.tau)}.`,
        head: ["β", "drives in the source", "in the target", "teaches: goals"],
        rows: BETAS.filter((beta) => drives[beta]).map((beta) => [
          number(beta, 2),
          ...drives[beta].map((v) => number(v, 10)),
          tried().find(([b]) => b === beta)?.[1].toLocaleString("en-US") ?? "–",
        ]),
      };
    }

    return function draw(state, changed) {
      if (changed.has("map") || changed.has("source")) begin(state);
      show(state);
      tell(state);
      if (changed.has("beta")) scene.say(now.textContent);
      scene.twin(twin);
      scene.close(closing(state));
    };
  },
});
