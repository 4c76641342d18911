// Paint by abstract state, page 4: cells that look alike are painted alike, in two
// buildings.  Forget features, and count what is left.

import { parseMap } from "../engine/maps.js";
import { FEATURES, navigationTasks } from "../engine/navigation.js";
import { ALL, counts, looks, nothing, tally, wrong } from "./counts.js";
import { findings } from "./found.js";
import { button, toggle } from "../ui/controls.js";
import { make, place, plural } from "../ui/dom.js";
import { layered } from "../ui/layers.js";
import { defineScene } from "../ui/scene.js";
import { sight, sights } from "../ui/sights.js";

const CHOICES = { "All 11": ALL, "The 8 sights": 255, "No sights": ALL - 255, None: 0 };
const SIDES = [["task", "source", "small"], ["away", "map", "large"]];

defineScene("paint", {
  title: "Paint by abstract state",
  build(scene) {
    let counted = {}; // { home, away } as far as they are counted
    let [full, seen] = [null, null]; // counts with all features; looks with those kept
    let pointed = null; // the abstract state of the cell under the pointer
    let timer = null;

    const sides = SIDES.map(([task, map, size], i) => {
      /** @type {any} */ const side = { task, of: map, size, tasks: null };
      side.view = layered({
        label: `The ${size} building, painted`,
        describe: (cell) => describe(side, cell),
        onAct: ({ cell }) => act(side, cell),
        onPoint: (cell) => point(side, cell),
        keys: [[
          "Enter, Space",
          "keep what looks like the cell lit; on a hollow star: make it the goal",
        ]],
        minCell: i ? 8 : 16,
      });
      const slider = scene.slider(task, {
        label: `Goal of the ${size} building`,
        step: 1,
        format: (n) => `${n + 1} of ${side.map?.goals.length ?? ""}`,
      });
      side.node = make("div", { class: "ab-scene" }, slider, side.view.node);
      return side;
    });
    const [home, away] = sides;

    const questions = FEATURES.map((name, f) => {
      const box = toggle({
        label: sight(name),
        onInput: () => scene.set({ features: scene.state.features ^ (1 << f) }),
      });
      const answer = make("b", {});
      box.node.append(answer);
      return { ...box, answer };
    });
    const words = make("p", {});
    const presets = Object.entries(CHOICES).map(([text, features]) =>
      button(text, () => scene.set({ features })).node
    );
    const found = findings(scene);
    const torn = scene.toggle("torn", {
      label: "× where the best single action for what the robot sees is wrong",
    });
    scene.add(
      make("div", { class: "ab-columns ab-pair" }, sides.map(({ node }) => node)),
      torn,
      words,
      make(
        "fieldset",
        { class: "ab-choice" },
        make("legend", {}, "What the robot sees there. Untick what it shall forget:"),
        make("div", { class: "ab-questions" }, questions.map(({ node }) => node)),
      ),
      scene.row(...presets),
      found.bets,
      found.node,
    );
    scene.onLeave(() => clearTimeout(timer));

    // ---- counting, in slices, while the reader looks already

    function begin(state) {
      for (const side of sides) {
        side.map = parseMap(state[side.of]);
        scene.limit(side.task, [0, side.map.goals.length - 1]);
      }
      [counted, full, seen] = [{}, null, null];
      const jobs = [["away", away, false], ["home", home, false], ["home", home, true]].map(
        ([name, { map }, isSolved]) => ({ name, map, found: nothing(isSolved), task: 0 }),
      );
      clearTimeout(timer);
      timer = setTimeout(advance, 0, jobs);
    }
    function advance(jobs) {
      const end = performance.now() + 15;
      while (jobs.length && performance.now() < end) {
        const [job] = jobs;
        tally(job.found, job.map, job.task++);
        if (job.task < job.map.goals.length) continue;
        counted[job.name] = job.found;
        jobs.shift();
      }
      const isNew = counted.home && !seen;
      timer = jobs.length ? setTimeout(advance, 0, jobs) : null;
      if (!timer) full = counts(counted.home, counted.away, ALL);
      if (!timer || isNew) show(scene.state);
      if (!timer) scene.redraw();
    }

    // ---- what cells look like

    const masked = (z, state = scene.state) => z & state.features;
    const lookOf = (side, cell) => (side.tasks.terminal[cell] ? -1 : masked(side.tasks.rho[cell]));
    const alike = (side, z) =>
      z < 0 ? [] : [...side.tasks.rho.keys()].filter((cell) => lookOf(side, cell) === masked(z));
    const isNewLook = (z) => seen && !seen.small[masked(z)];
    const hasBet = (state) => state.bet && state.bet_new;

    function describe(side, cell) {
      const { map, tasks } = side;
      const at_ = place(map, cell);
      if (tasks.terminal[cell]) return `${at_}: the goal`;
      return `${at_}: ${map.goals.includes(cell) ? "the goal of another task; " : ""}${
        sights(masked(tasks.rho[cell]))
      }; ${plural(alike(side, tasks.rho[cell]).length, "cell")} of this task`;
    }
    function act(side, cell) {
      const other = side.map.goals.indexOf(cell);
      if (side.tasks.terminal[cell]) {
        return scene.say("This is the goal: nothing is left to decide there.");
      }
      if (other >= 0) return scene.set({ [side.task]: other });
      const z = side.tasks.rho[cell];
      scene.set({ z: z === scene.state.z ? -1 : z });
    }
    function point(side, cell) {
      const z = cell === null || side.tasks.terminal[cell] ? null : side.tasks.rho[cell];
      if (z === pointed) return;
      pointed = z;
      scene.redraw();
    }

    function show(state) {
      if (counted.home && counted.away) seen = looks(counted.home, counted.away, state.features);
      for (const side of sides) {
        const looks = Array.from(side.tasks.rho, (_, cell) => lookOf(side, cell));
        const isPlain = (z) => z < 0 || !seen || (hasBet(state) && isNewLook(z));
        side.view.classes(looks.map((z) => (isPlain(z) ? -1 : seen.look[z])));
        side.view.texts(looks.map((z) => (z >= 0 && hasBet(state) && isNewLook(z) ? "?" : null)));
      }
      torn.hidden = !hasBet(state) || !counted.home?.suits;
      if (!torn.hidden && state.torn) {
        const isWrong = wrong(home.tasks, counted.home, state.features);
        home.view.texts(isWrong.map((is) => (is ? "×" : null)));
      }
    }

    function light(state) {
      const z = pointed ?? state.z;
      for (const side of sides) side.view.lit(side.lit = alike(side, z));
      questions.forEach(({ set, answer, node }, f) => {
        const isKept = (state.features >> f) & 1;
        const isYes = isKept && z >= 0 && (z >> f) & 1;
        set(isKept);
        answer.textContent = !isKept ? "forgotten" : z < 0 ? "" : isYes ? "yes" : "no";
        node.classList.toggle("ab-now", Boolean(isYes));
      });
      words.textContent = z < 0
        ? "Point at a cell: what looks like it is lit in both buildings. A click keeps it lit."
        : `Lit, because alike: ${sides.map((side) => litText(side, z)).join("; ")}.`;
    }
    const total = (side, z) => seen[side.size][masked(z)];
    function litText(side, z) {
      const all = seen
        ? ` and ${plural(total(side, z), "state")} of all ${side.map.goals.length} tasks`
        : "";
      return `in the ${side.size} building ${plural(side.lit.length, "cell")} of this task${all}`;
    }

    const now = (
      state,
    ) => (full && hasBet(state) ? counts(counted.home, counted.away, state.features) : null);
    const twin = (counts) => ({
      caption: words.textContent,
      head: ["number", "with the features ticked", "with all 11"],
      rows: found.rows(counts, full),
    });

    return function draw(state, changed) {
      const has = (...names) => names.some((name) => changed.has(name));
      if (has("map", "source")) begin(state);
      for (const side of sides) {
        if (!has("map", "source", side.task)) continue;
        side.tasks = navigationTasks(side.map, { keep: [state[side.task]] });
        side.view.map(side.map, { aim: side.tasks.goal[0] });
      }
      if (changed.size) show(state);
      light(state);
      if (has("task", "away", "features")) sides.forEach(({ view }) => view.rename());
      const counts = now(state);
      if (has("features") && counts) scene.say(found.short(counts));
      else if (has("task", "away", "features", "z")) scene.say(words.textContent);
      found.show(state, counts, full);
      scene.twin(() => twin(counts));
      scene.close(found.closing(state, counts, full));
    };
  },
});
