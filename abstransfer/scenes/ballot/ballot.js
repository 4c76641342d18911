// The ballot box, page 5: states that look alike vote for what is best in them; a dial
// makes advice of the votes, from ND (0) over Prob (1) to the winner.

import { adviceOf, BETAS, betaText, drive, elect, STEP, WINNER } from "./votes.js";
import { wholeAdvice } from "./whole.js";
import { parseMap } from "../engine/maps.js";
import { A, LABELS, navigationTasks } from "../engine/navigation.js";
import { slices } from "../parts/slices.js";
import { barChart } from "../ui/bars.js";
import { button } from "../ui/controls.js";
import { list, make, number, place as placeOf, plural } from "../ui/dom.js";
import { layered } from "../ui/layers.js";
import { defineScene } from "../ui/scene.js";
import { sight as sightOf, sights } from "../ui/sights.js";

defineScene("ballot", {
  title: "The ballot box",
  build(scene) {
    const { state } = scene;
    let sides; // of both buildings: map, and its tasks as far as they are made
    let election = null; // null until all votes are counted
    let drives = {}; // by beta: what the advice is worth in both buildings
    let shown = null; // the task that is seen
    let isAsked = false; // what another beta is worth, which may take a while

    const words = make("p", {});
    const steps = [["A box with more votes", -1], ["A box with fewer votes", 1]].map(([text, by]) =>
      button(text, () => scene.set({ z: election.boxes[place() + by] }))
    );
    const view = layered({
      label: "The small building: lit states vote, arrows are votes",
      describe: (cell) => describe(cell),
      onAct: ({ cell }) => act(cell),
      keys: [["Enter, Space", "open the box of the cell; on a hollow star: make it the goal"]],
    });
    const cast = barChart({ label: "Votes in the box", format: (x) => number(x), low: 0 });
    const chances = barChart({
      label: "Probabilities in the advice",
      format: (x) => number(x, 3),
      low: 0,
      high: 1,
    });
    const whole = wholeAdvice(scene);
    const column = (...nodes) => make("div", { class: "ab-scene" }, nodes);
    const goals = () => sides?.[0].map.goals ?? [];
    scene.add(
      words,
      scene.row(...steps.map(({ node }) => node)),
      make(
        "div",
        { class: "ab-columns" },
        column(
          scene.slider("task", {
            label: "Goal",
            step: 1,
            format: (n) => `${n + 1} of ${goals().length}`,
          }),
          view.node,
        ),
        column(
          make("p", {}, "Votes in this box:"),
          cast.node,
          scene.slider("beta", { label: "The dial: β", format: betaText, step: STEP }),
          make("p", {}, "So the advice says, with what probability:"),
          chances.node,
        ),
      ),
      whole.bets,
      whole.node,
    );
    const { start, isWorking } = slices(scene);

    // ---- the election, and drives along the dial, in slices

    function begin() {
      sides = ["source", "map"].map((of) => ({ map: parseMap(state[of]), each: [] }));
      scene.limit("task", [0, goals().length - 1]);
      view.map(sides[0].map, { aim: goals()[state.task] });
      [election, drives, shown] = [null, {}, null];
      start(work());
    }
    function* work() {
      const [home, { map, each }] = sides;
      election = yield* elect(home.map, home.each);
      for (let task = 0; task < map.goals.length; task++) {
        each.push(navigationTasks(map, { keep: [task] }));
        yield;
      }
      yield* driveAll();
    }
    // Where the reader stands comes first, then the three kinds of advice.
    const isDone = () => election && next() === undefined;
    const next = () =>
      [state.beta, 0, 1, ...BETAS.slice(-1), ...BETAS].find((beta) => !drives[beta]);
    function* driveAll() {
      for (let beta; (beta = next()) !== undefined;) {
        const advice = adviceOf(election.prob, beta);
        const means = [];
        for (const { each } of sides) means.push(yield* drive(each, advice));
        drives[beta] = means;
      }
    }

    // ---- one box

    const place = () => election.boxes.indexOf(state.z);
    const row = (array, z) => array.subarray(A * z, A * z + A);
    const sight = (a) => sightOf(LABELS[a]);
    const actions = () => [...LABELS.keys()].filter((a) => row(shown.possible, state.z)[a]);
    const chance = (beta) => adviceOf(row(election.prob, state.z), beta);

    function describe(cell) {
      const where = placeOf(view.plan, cell);
      if (!shown) return where;
      if (shown.terminal[cell]) return `${where}: the goal, which has no vote`;
      const star = goals().includes(cell) ? "the goal of another task; " : "";
      return `${where}: ${star}votes for ${
        list(LABELS.filter((_, a) => row(shown.best, cell)[a]).map(sightOf))
      }`;
    }
    function act(cell) {
      const other = goals().indexOf(cell);
      if (!shown) return;
      if (shown.terminal[cell]) scene.say("This is the goal: it has no vote.");
      else scene.set(other >= 0 ? { task: other } : { z: shown.rho[cell] });
    }
    function showBox() {
      const { boxes, votes, states } = election;
      const { rho, terminal, labels, best, nWays } = shown;
      const isHere = (cell) => rho[cell] === state.z && !terminal[cell];
      const here = [...rho.keys()].filter(isHere);
      view.lit(here);
      view.arrows(
        Float64Array.from(
          labels,
          (a, i) => a >= 0 && isHere(i >> 2) ? best[A * (i >> 2) + a] / nWays[A * (i >> 2) + a] : 0,
        ),
      );
      view.rename();
      words.textContent = place() < 0
        ? `No state of the small building looks like this: ${sights(state.z)}.`
        : `Box ${place() + 1} of ${boxes.length}: ${sights(state.z)}. ${
          plural(states[state.z], "state")
        } of ` +
          `${plural(goals().length, "task")} vote here, ${here.length} of them in the task shown.`;
      steps[0].enable(place() > 0);
      steps[1].enable(place() >= 0 && place() < boxes.length - 1);
      const bars = (values) => actions().map((a) => ({ name: sight(a), value: values[a] }));
      cast.set(bars(row(votes, state.z)));
      chances.set(bars(chance(state.beta)));
    }

    function twin() {
      const places = [state.beta, 0, 1, WINNER];
      const rows = places.map(chance);
      return {
        caption: `${words.textContent} Probabilities, and mean values of the whole advice.`,
        head: ["action", "votes", `β = ${betaText(state.beta)}`, "ND", "Prob", "winner"],
        rows: [
          ...actions().map((
            a,
          ) => [
            sight(a),
            number(row(election.votes, state.z)[a], 4),
            ...rows.map((p) => number(p[a], 6)),
          ]),
          ...whole.rows(places, drives),
        ],
      };
    }

    return function draw(_, changed) {
      if (changed.has("map") || changed.has("source")) begin();
      if (!election) {
        words.textContent = `Counting the votes of ${plural(goals().length, "task")} …`;
        whole.node.hidden = true;
        return scene.close(false);
      }
      shown = sides[0].each[state.task];
      view.map(sides[0].map, { aim: shown.goal[0] });
      if (!isWorking() && !isDone()) start(driveAll());
      showBox();
      const sentence = whole.show(state, drives, isDone());
      isAsked ||= changed.has("beta");
      if (isAsked && sentence && drives[state.beta]) {
        isAsked = false;
        scene.say(sentence);
      } else if (changed.has("z") || changed.has("task")) scene.say(words.textContent);
      scene.twin(twin);
      scene.close(isDone() && whole.closing(drives));
    };
  },
});
