// Your turn, page 12: a building and features of one's own, a race in it, and a result
// card to hand in.

import { ITERATIONS } from "../engine/absprob_pi.js";
import { abstractStates, FEATURES } from "../engine/navigation.js";
import { makeEditor } from "../parts/editor.js";
import { runRows } from "../parts/rows.js";
import { textButtons } from "../parts/tools.js";
import { barChart } from "../ui/bars.js";
import { button, toggle } from "../ui/controls.js";
import { armStyle, count, list, make, number, plural } from "../ui/dom.js";
import { defineScene } from "../ui/scene.js";
import { sight } from "../ui/sights.js";
import { keep, kept, onReplaced, pageHere } from "../ui/kept.js";
import { sum } from "../parts/runs.js";
import * as rules from "./race.js";
import { compare, lineOf, predicting, tied } from "./sealed.js";
import { buildingOf, seedOf, written } from "./whose.js";

const FROM = {
  source: "the paper's source",
  target: "the paper's target",
  own: "this building itself",
};
const WAYS = { hard: "hard: obey to the letter", soft: "soft: ever less often" };
const BETS = { nd: "ND's", prob: "Prob's", grad: "Grad's", all: "all of them", none: "none" };
const ADVICE = ["nd", "prob", "grad"];
const lived = (n) => plural(n, "run");
const armOf = (name) => (name === "eager" ? "uniform_available" : name);
const nameOf = (name) => armStyle(armOf(name)).name;

defineScene("project", {
  title: "Your turn: a race in your own building",
  build(scene) {
    const { state } = scene;
    let [found, isWanted] = [null, false];
    let begun = {}; // by robot and run: the goals of its tenths; they stay after a stop

    const me = makeEditor(scene, { buildings: { "The school": scene.spec.state.text } });
    // Ticks of a list in the state; what an address holds is put in order.
    const listed = (name, all) => {
      const now = state[name];
      return Array.isArray(now) ? all.filter((each) => now.includes(each)) : all;
    };
    function ticks(name, label, all, words) {
      const boxes = all.map((each) =>
        toggle({
          label: words(each),
          onInput: (is) =>
            scene.set({
              [name]: all.filter((
                other,
              ) => (other === each ? is : listed(name, all).includes(other))),
            }),
        })
      );
      scene.control(
        name,
        () => boxes.forEach(({ set }, i) => set(listed(name, all).includes(all[i]))),
      );
      const boxed = make("div", { class: "ab-segments" }, boxes.map(({ node }) => node));
      return make("fieldset", { class: "ab-choice" }, make("legend", {}, label), boxed);
    }
    const features = () => listed("features", FEATURES);
    const guides = () => listed("guides", rules.GUIDES);

    // ---- whose race it is, what is predicted, and which race of this reader

    const student = () => written(state.student);
    const seed = () => (student() ? seedOf(student()) : rules.SEED);
    const field = { type: "text", maxlength: 60, placeholder: "Ann Lee" };
    const whose = tied(scene, "student", make("input", field));
    const mine = button("My building", () => scene.set({ text: buildingOf(student()) }));
    const seeded = make("span", {});
    const showSeed = (text) => seeded.textContent === text || (seeded.textContent = text);
    const forecast = predicting(
      scene,
      Object.fromEntries(rules.GUIDES.map((name) => [name, nameOf(name)])),
    );
    const isClosed = () =>
      isWanted || Object.keys(begun).length > 0 || Object.keys(state.goals).length > 0;
    // A reset forgets the race, not that there was one.
    const id = `${scene.id}.races`;
    const recall = () => scene.set({ races: Number(kept(pageHere(), id)) });
    scene.onLeave(onReplaced(recall));

    const bars = barChart({
      label: "How well the advice drives here",
      format: (x) => number(x, 1),
      low: -100,
      high: 0,
    });
    const dots = runRows("Goals of each run, beside the same run without advice");
    const [status, told] = [1, 2].map(() => make("p", {}));
    const key = make(
      "p",
      { class: "ab-ylabel" },
      "Dots: runs. Box: their quarters. Diamond: their mean, with a 95 % interval if there are five runs.",
    );
    const start = button("", () => race(), { primary: true });
    const stop = button("Stop", () => (scene.stop(), (isWanted = false), scene.redraw()));
    const area = make("textarea", {
      rows: 14,
      readonly: true,
      spellcheck: "false",
      "aria-label": "The result card as text",
    });
    const card = make(
      "details",
      { open: true },
      make("summary", {}, "Result card: hand it in"),
      area,
      scene.row(...textButtons(scene, area, "result-card.md")),
    );
    scene.add(
      scene.bet("bet", {
        question: "Bet first: whose advice helps a robot in the school, compared with none?",
        options: BETS,
      }),
      scene.row(make("label", {}, "Your name ", whose), mine.node, seeded),
      make(
        "div",
        { class: "ab-columns" },
        make("div", { class: "ab-body" }, me.tools.bar, me.view.node, me.legal, me.tools.files),
        make(
          "div",
          { class: "ab-body" },
          make(
            "p",
            {},
            "How well the advice drives here, before any learning: mean value of a cell.",
          ),
          bars.node,
          told,
        ),
      ),
      make(
        "details",
        {},
        make("summary", {}, "What the robots see"),
        ticks("features", "The eleven features; tick what counts", FEATURES, sight),
      ),
      scene.row(
        scene.choice("advice", { label: "The advice is made in", options: FROM }),
        scene.choice("strategy", { label: "Advice", options: WAYS }),
      ),
      scene.row(
        ticks(
          "guides",
          "Robots, beside the one without advice; eager does whatever can be done",
          rules.GUIDES,
          (name) => nameOf(name),
        ),
        scene.slider("lives", { label: "Runs of each" }),
      ),
      forecast.node,
      scene.row(start.node, stop.node),
      status,
      make("div", {}, key, dots.node),
      card,
    );

    // ---- before the race: the advice, in slices

    const isReady = () => found?.iteration === ITERATIONS && found.drives.grad !== undefined;
    function prepare() {
      found = null;
      const job = !me.problem && !me.isLarge() && rules.preparing(me.map, features(), state.advice);
      me.work(job, (last, isOver) => {
        found = last ?? found;
        if (isOver && isWanted) learn();
      });
    }

    // ---- the race

    const robots = () => ["none", ...guides()];
    const livesOf = (name) => (state.goals[name] ?? []).slice(0, state.lives);
    const isKnown = (name, life) => Number.isFinite(state.goals[name]?.[life]);
    const missing = () =>
      Array.from(
        { length: state.lives },
        (_, life) => robots().filter((name) => !isKnown(name, life)).map((name) => [name, life]),
      ).flat();
    const isDone = () => !missing().length;
    // What of the race is done, from 0 to 1.
    function share() {
      const left = missing().map((run) => 1 - (begun[run]?.length ?? 0) / 10);
      return 1 - sum(left) / (state.lives * robots().length);
    }
    const mayRace = () => state.bet && !me.problem && !scene.isLearning && !isWanted;
    function race() {
      if (!mayRace()) return;
      if (isDone()) return scene.say("All these runs are done.");
      isWanted = me.ask();
      if (isReady()) learn();
      else if (!me.isWorking()) prepare();
      scene.redraw();
    }
    function learn() {
      const lives = missing();
      isWanted = false;
      if (!isClosed()) {
        keep(pageHere(), id, `${state.races + 1}`);
        recall();
      }
      for (const run of lives) begun[run] ??= [];
      scene.learn(
        rules.jobsOf(
          me.map,
          { features: features(), strategy: state.strategy, seed: seed() },
          found.guides,
          lives,
        ),
        {
          onWindow: (job, i, goals) => (begun[lives[job]][i] = goals),
          onDone(job) {
            const [name, life] = lives[job];
            const mine = [...(state.goals[name] ?? [])];
            for (let i = mine.length; i < life; i++) mine[i] = null;
            mine[life] = sum(begun[lives[job]]);
            scene.set({ goals: { ...state.goals, [name]: mine } });
          },
        },
      );
    }

    // ---- what it shows

    const more = (name) =>
      livesOf(name).flatMap((
        n,
        i,
      ) => (isKnown(name, i) && isKnown("none", i) ? [n - state.goals.none[i]] : []));
    const raced = () => Object.fromEntries(robots().map((name) => [name, livesOf(name)]));
    function verdict() {
      if (!isDone() || !guides().length || !state.bet) return "";
      const none = livesOf("none");
      const { lives } = state;
      const found = guides().map((name) => rules.judge(name, livesOf(name), none));
      const words = found.map(({ name, gain, isHurt, n }) => {
        const share = Number.isFinite(gain) ? ` (${isHurt ? "" : "+"}${number(100 * gain)} %)` : "";
        return `${nameOf(name)} ${isHurt ? "hurt" : "helped"} in ${n}${share}`;
      });
      const taught = found.filter(({ name }) => ADVICE.includes(name));
      const better = taught.filter(({ gain }) => gain > 0).map(({ name }) => name);
      const truth = { 0: "none", 1: better[0], 3: "all" }[better.length] ??
        list(better.map((name) => BETS[name]));
      const isSchool = ["text", "features", "advice", "strategy"].every((key) =>
        `${state[key]}` === `${scene.spec.state[key]}`
      );
      const mean = none.reduce((a, b) => a + b, 0) / lives;
      return (
        `${
          scene.betResult(
            "bet",
            truth,
            isSchool && taught.length === 3
              ? ""
              : "the school, with the paper's advice of all three",
          )
        } A run without advice reaches ` +
        `${count(mean)} goals. Of ${lived(lives)} with the same luck, ${list(words)}.` +
        `${
          found.some(({ n }) => n < lives) && lives < 20
            ? " Where runs disagree, more runs tell more."
            : ""
        }${state.predicted && ` Your prediction: ${compare(state, raced())}.`}`
      ).trim();
    }
    function saying() {
      const { steps, tau } = rules.scale(me.map);
      const length = `A run is ${count(steps)} steps, with advice in the first ${count(tau)}.`;
      if (me.problem) return "No race: the building is not legal yet.";
      if (!state.bet) return `${length} Bet first, then race.`;
      if (isWanted) {
        return `${length} The advice is being made: Grad, ${
          found?.iteration ?? 0
        } of ${ITERATIONS}.`;
      }
      const part = `${number(100 * share(), 0)} % of ${lived(state.lives * robots().length)}`;
      if (scene.isLearning) return `${length} Racing: ${part}.`;
      if (isDone()) return `${length} All these runs are done: ask for more, or for others.`;
      return share() > 0 ? `${length} Done: ${part}. It can go on.` : length;
    }
    const rows = () => {
      const goals = isDone() ? raced() : {};
      return rules.cardRows(guides(), found?.drives ?? {}, goals, state.lives);
    };

    function show() {
      const { drives = {} } = found ?? {};
      bars.set(
        [...rules.GUIDES, "optimal"].map((name) => ({
          name: nameOf(name),
          arm: armOf(name),
          value: drives[name] ?? null,
        })),
      );
      told.textContent = isReady()
        ? `${
          count(abstractStates(found.tasks).length)
        } abstract states: the robots see ${features().length} of 11 features.`
        : me.isLarge()
        ? "A building of this size is solved when the race begins."
        : me.problem
        ? ""
        : `Grad climbs: ${found?.iteration ?? 0} of ${ITERATIONS}.`;
      status.textContent = saying();
      mine.enable(student());
      showSeed(student() ? `Seed ${seed()}` : "");
      const [, sealed] = lineOf(state, student()).split("sealed ");
      forecast.close(
        isClosed(),
        isClosed() && state.races ? `Sealed before race ${state.races}: ${sealed}.` : "",
      );
      const asked = `${lived(state.lives)} of ${plural(robots().length, "robot")}`;
      const isHalf = share() > 0 && !isDone() && !scene.isLearning;
      start.set(isHalf ? `Go on with the race: ${asked}` : `Race: ${asked}`);
      start.enable(mayRace() && !isDone());
      stop.node.hidden = !scene.isLearning && !isWanted;
      const racing = guides().filter((name) => more(name).length);
      key.parentNode.hidden = !racing.length;
      dots.set(
        rules.picture(
          racing.map((name) => ({ name: nameOf(name), arm: armOf(name), runs: more(name) })),
        ),
      );
      dots.describe(verdict() || "Goals of each run, beside the same run without advice");
      card.hidden = !(isDone() && isReady());
      if (!card.hidden) {
        const { advice, strategy, lives } = state;
        area.value = rules.cardText({
          student: student(),
          seed: seed(),
          prediction: lineOf(state, student()),
          found: compare(state, raced()),
          map: me.map,
          tasks: found.tasks,
          features: features(),
          advice,
          strategy,
          lives,
          rows: rows(),
        });
      }
      me.show();
    }

    return function draw(_, changed) {
      const isNew = ["text", "features", "advice"].some((name) => changed.has(name));
      if (changed.has("text")) me.read();
      if (isNew || changed.has("strategy") || changed.has("student")) {
        scene.stop();
        isWanted = false;
        const isStart = changed.size === Object.keys(state).length;
        if (isStart) recall();
        begun = {};
        if (!isStart) scene.set({ goals: {} }); // they were of another race
      }
      if (isNew) prepare();
      show();
      scene.twin(() => ({
        caption: `${status.textContent} ${told.textContent}`,
        head: rules.headOf(state.lives),
        rows: rows(),
      }));
      scene.close(verdict());
    };
  },
});
