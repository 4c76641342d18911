// What a robot sees, on the intro and on page 1: point at a cell, and its sights are
// told; advice that was made in the small building is drawn as arrows, in both.

import { DIRECTIONS, parseMap } from "../engine/maps.js";
import { A, LABELS, navigationTasks } from "../engine/navigation.js";
import { nextWord, seedState } from "../engine/random.js";
import { mapTexts, spec } from "../python.js";
import { button } from "../ui/controls.js";
import { make, place, plural } from "../ui/dom.js";
import { layered } from "../ui/layers.js";
import { defineScene } from "../ui/scene.js";
import { sight } from "../ui/sights.js";

const MAPS = { small: "source", large: "target" };
const WAYS = { N: "north", E: "east", S: "south", W: "west" };
const LUCK = 1; // seed of the walk
const WORD = 4294967296;
const [FAST, CALM] = [150, 600]; // milliseconds a step
const percent = (share) => `${Math.round(100 * share)} %`;

/**
 * How likely advice heads N, E, S, W from each cell: flat, 4 a cell.
 *
 * @param {any} tasks of one goal
 */
function headings(tasks) {
  const arrows = new Float64Array(4 * tasks.nCells);
  for (let cell = 0; cell < tasks.nCells; cell++) {
    if (tasks.terminal[cell]) continue;
    const ways = tasks.nWays.subarray(A * cell, A * cell + A);
    const there = ways.reduce((n, way) => n + (way > 0 ? 1 : 0), 0);
    const row = spec.advice[tasks.rho[cell]] ?? Array.from(ways, (n) => (n ? 1 / there : 0));
    for (let d = 0; d < 4; d++) {
      const a = tasks.labels[4 * cell + d];
      if (a >= 0) arrows[4 * cell + d] = row[a] / ways[a];
    }
  }
  return arrows;
}

// The cells of a walk that obeys, from a start to the goal or for so many steps.
function follow(tasks, arrows, start, most) {
  const luck = seedState(LUCK);
  const cells = [start];
  while (cells.length <= most && !tasks.terminal[cells.at(-1)]) {
    const cell = cells.at(-1);
    let field = nextWord(luck) / WORD;
    const isSlip = nextWord(luck) / WORD >= tasks.success;
    const d = [0, 1, 2, 3].find((way) => (field -= arrows[4 * cell + way]) < 0);
    cells.push(isSlip || d === undefined ? cell : tasks.neighbors[4 * cell + d]);
  }
  return cells;
}

defineScene("sights", {
  title: "What a robot sees",
  build(scene) {
    let [tasks, arrows, walk, pointed, timer] = [null, null, [], null, null];
    const { limits } = scene;

    const view = layered({
      label: "The building of a robot",
      describe: (cell) => `${place(tasks.map, cell)}: ${told(cell)}`,
      onAct: ({ cell }) => act(cell),
      onPoint: (cell) => {
        pointed = cell;
        scene.redraw();
      },
      keys: [["Enter, Space", "set the robot down; on a hollow star: make it the goal"]],
      minCell: 11,
    });
    const words = make("p", {});
    const sees = make("ul", {});
    const go = button("Start", () => (timer ? stop() : start()), { primary: true });
    scene.add(
      scene.row(
        go.node,
        scene.choice("size", {
          label: "Building",
          options: { small: "the small one", large: "the large one" },
        }),
        scene.toggle("advice", { label: "Show the advice" }),
      ),
      view.node,
      words,
      sees,
    );
    scene.onLeave(stop);
    scene.onReset(stop);

    function stop() {
      clearInterval(timer);
      timer = null;
      go.set("Start");
    }
    function start() {
      if (scene.state.t >= walk.length - 1) scene.set({ t: 0 });
      timer = setInterval(advance, scene.calm ? CALM : FAST);
      go.set("Stop");
    }
    function advance() {
      const { t } = scene.state;
      if (t >= walk.length - 1) return stop();
      scene.set({ t: t + 1 });
    }
    function act(cell) {
      const other = [...tasks.map.goals].indexOf(cell);
      if (tasks.terminal[cell]) return scene.say("This is the goal: nothing is left to decide.");
      stop();
      scene.set(other >= 0 ? { task: other, t: 0 } : { cell, t: 0 });
    }

    const waysFrom = (cell) =>
      DIRECTIONS.map((letter, d) => ({ way: WAYS[letter], a: tasks.labels[4 * cell + d], d }))
        .filter(({ a }) => a >= 0);
    const said = (cell, { way, a, d }) => {
      const advised = scene.state.advice ? `; the advice: ${percent(arrows[4 * cell + d])}` : "";
      return `${way}: ${sight(LABELS[a])}${advised}`;
    };
    const told = (cell) =>
      tasks.terminal[cell] ? "the goal" : waysFrom(cell).map((way) => said(cell, way)).join(". ");

    return function draw(state, changed) {
      const { size, task, cell, advice, t } = state;
      if (["size", "task"].some((name) => changed.has(name))) {
        const map = parseMap(mapTexts[MAPS[size]]);
        scene.limit("task", [0, map.goals.length - 1]);
        scene.limit("cell", [0, map.nCells - 1]);
        const goal = Math.min(task, limits.task[1]);
        tasks = navigationTasks(map, { keep: [goal] });
        arrows = headings(tasks);
        view.map(map, { aim: tasks.goal[0] });
        if (changed.has("size") && changed.size === 1) {
          stop();
          scene.set({ t: 0 });
        }
      }
      if (["size", "task", "cell"].some((name) => changed.has(name))) {
        walk = follow(tasks, arrows, Math.min(cell, tasks.nCells - 1), spec.fields.t.bounds[1]);
      }
      const now = Math.min(t, walk.length - 1);
      const at = walk[now];
      // Who is not told the advice sees nobody obey it.
      go.node.hidden = !advice;
      if (!advice && timer) stop();
      view.arrows(advice ? arrows : null);
      view.robots([{ cell: at, arm: "prob", name: "the robot" }]);
      view.trail(walk.slice(0, now + 1));
      const looked = pointed ?? at;
      const isGoal = tasks.terminal[looked];
      view.lit(isGoal ? [] : waysFrom(looked).map(({ d }) => tasks.neighbors[4 * looked + d]));
      words.textContent = isGoal
        ? `${pointed === null ? `Arrived after ${plural(now, "step")}` : "This is the goal"}.`
        : `From ${place(tasks.map, looked)} ${
          pointed === null ? "the robot sees" : "it would see"
        }:`;
      sees.replaceChildren(
        ...(isGoal ? [] : waysFrom(looked).map((way) => make("li", {}, said(looked, way)))),
      );
      if (["size", "task", "cell", "advice"].some((name) => changed.has(name))) view.rename();
      scene.twin(() => ({
        caption: words.textContent,
        head: ["way", "sees", ...(advice ? ["the advice"] : [])],
        rows: isGoal ? [] : waysFrom(looked).map(({ way, a, d }) => [
          way,
          sight(LABELS[a]),
          ...(advice ? [percent(arrows[4 * looked + d])] : []),
        ]),
      }));
      scene.close(
        tasks.terminal[at] === 1 && pointed === null &&
          `The goal of the ${size} building, after ${plural(now, "step")}.`,
      );
    };
  },
});
