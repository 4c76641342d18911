// Map Studio, page 1: draw a building, walk a robot through it, and see what the
// abstraction and Table 1 make of it.

import { ITERATIONS } from "../engine/absprob_pi.js";
import { navigationTasks } from "../engine/navigation.js";
import { optimalValues } from "../engine/solvers.js";
import { PAPER, ROWS } from "../engine/paper.js";
import { makeEditor } from "../parts/editor.js";
import { spec } from "../python.js";
import { follow, solving } from "./walk.js";
import { likeness, nameOf, overlay, seenIn, stepText } from "./words.js";
import { barChart } from "../ui/bars.js";
import { button } from "../ui/controls.js";
import { armStyle, count, list, make, number, plural } from "../ui/dom.js";
import { addLayers } from "../ui/layers.js";
import { defineScene } from "../ui/scene.js";

const SHOWN = {
  plain: "the building",
  states: "abstract states",
  nd: "ND",
  prob: "Prob",
  grad: "Grad",
  optimal: "optimal",
};

defineScene("studio", {
  title: "Map Studio",
  build(scene) {
    const rows = Object.fromEntries(ROWS.map((row) => [row, armStyle(row).name]));
    let [tasks, pointed] = [null, null];
    let [found, first] = [null, null];

    const me = makeEditor(scene, {
      walk,
      onMap,
      begin,
      onPoint: (cell) => {
        pointed = cell;
        showCell();
      },
    });
    const { tools, legal } = me;
    const view = addLayers(me.view);
    const [counts, seen, told] = [1, 2, 3].map(() => make("p", {}));
    const lines = make("tbody");
    const bars = barChart({
      label: "Table 1: mean value of a cell",
      format: (x) => number(x, 2),
      low: -100,
      high: 0,
    });
    const head = ["action a", "next cell s′", "chance", "reward r"];
    const columns = make(
      "div",
      {},
      make("div", { class: "ab-body" }, view.node, legal, counts),
      make(
        "div",
        { class: "ab-body" },
        told,
        seen,
        make(
          "table",
          { "aria-label": "What can come of each action" },
          make("thead", {}, make("tr", {}, head.map((text) => make("th", { scope: "col" }, text)))),
          lines,
        ),
      ),
    );
    scene.add(
      tools.bar,
      columns,
      scene.choice("show", {
        label: "In the cells, for the task with the lit goal",
        options: SHOWN,
      }),
      make(
        "p",
        {},
        "Table 1, rebuilt for this building: mean value of a cell. Rings: the paper's numbers.",
      ),
      me.solve.node,
      bars.node,
      scene.bet("bet", spec.bets.bet),
      tools.files,
    );

    function onMap(problem) {
      columns.classList.toggle("ab-columns", me.map.width <= 20);
      if (!problem) {
        scene.limit("task", [0, me.map.goals.length - 1]);
        scene.limit("start", [0, me.map.nCells - 1]);
      }
    }

    function begin() {
      const canSolve = !me.problem && !me.isLarge();
      found = canSolve && first?.text === me.map.text ? first : null; // solved once
      me.work(canSolve && !found && solving(me.map), (last) => {
        found = last ?? found;
        if (isDone()) first ??= { ...found, text: me.map.text };
      });
    }

    // ---- the robot and the cell it is in, or that is pointed at

    function walk() {
      const { start, walk: letters } = scene.state;
      me.walked = tasks && follow(tasks, start, letters);
    }
    function showCell() {
      lines.parentNode.hidden = !tasks;
      seen.textContent = tasks ? "" : "States, actions and rewards: when the building is legal.";
      if (!tasks) return;
      const { text, rows: all } = seenIn(
        me.map,
        tasks,
        scene.state.task,
        pointed ?? me.walked.cell,
      );
      seen.textContent = text;
      // What the robot could say where it stands is said by a press.
      const isHere = (pointed ?? me.walked.cell) === me.walked.cell;
      const say = (a) => () => {
        scene.set({ walk: scene.state.walk + a });
        scene.redraw();
      };
      const at = lines.contains(document.activeElement) && document.activeElement.textContent;
      const told = new Set();
      const word = (a) => {
        if (a < 0) return "any other";
        if (!isHere || told.has(a)) return nameOf(a);
        told.add(a);
        return button(nameOf(a), say(a)).node;
      };
      lines.replaceChildren(
        ...all.map(([a, ...line]) =>
          make("tr", {}, [word(a), ...line].map((text) => make("td", {}, text)))
        ),
      );
      // The keyboard stays on the action, if it is there still.
      const buttons = [...lines.querySelectorAll("button")];
      if (at) (buttons.find((each) => each.textContent === at) ?? buttons[0])?.focus();
    }

    // ---- what lies over the cells, and below the building

    function layers({ show, task }) {
      const { states, values, arrows } = overlay(tasks, found, me.isLarge() ? "" : show);
      view.classes(states);
      view.values(values, { low: -100, high: 0 });
      view.arrows(arrows);
      me.show([me.map.goals[task]]);
    }

    function tell() {
      const { size: { cells, rooms, goals }, name, marks } = likeness(me.map);
      const parts = [
        plural(cells, "cell"),
        plural(rooms, "room"),
        plural(me.map.nDoors, "door"),
        plural(goals, "goal"),
        found && plural(found.states, "abstract state"),
      ];
      counts.replaceChildren(
        `${list(parts.filter(Boolean))}; ${count(cells * goals)} states. `,
        name && !me.problem
          ? make("strong", {}, `✓ Cells, rooms and goals as in the paper's ${name}.`)
          : "",
      );
      bars.set(ROWS.map((row) => ({
        name: rows[row],
        arm: row,
        value: found?.row[row] ?? null,
        mark: marks[row],
        lit: row === scene.state.show,
        note: row === "grad" && found && !isDone() &&
          `climbing: ${found.iteration} of ${ITERATIONS}`,
      })));
    }
    const isDone = () => found?.iteration === ITERATIONS;

    function closing({ start, walk: letters }) {
      if (me.walked?.isOver && letters) {
        return (
          `The goal, after ${plural(me.walked.steps.length, "step")}: a return of ${
            number(me.walked.total, 2)
          }. ` +
          `The best policy expects ${number(optimalValues(tasks)[start], 2)} from there.`
        );
      }
      if (!isDone()) return "";
      const { nd, prob, grad, optimal } = found.row;
      const text =
        `A cell of this building is worth ${number(nd, 1)} to ND, ${number(prob, 1)} to Prob, ` +
        `${number(grad, 1)} to Grad and ${number(optimal, 1)} to the best driver.`;
      if (first.text === me.map.text) return text;
      const moved = (row) => found.row[row] - first.row[row];
      const most = ROWS.reduce((a, b) => (Math.abs(moved(b)) > Math.abs(moved(a)) ? b : a));
      return `${scene.betResult("bet", most)} ${text} What moved most: ${rows[most]}, by ${
        number(moved(most), 2)
      }.`.trim();
    }
    function twin() {
      const { size, name, marks } = likeness(me.map);
      const paper = PAPER[name] ?? {};
      return {
        caption: `${legal.textContent} Counts, and the mean value of a cell.`,
        head: ["what", "here", "the paper"],
        rows: [
          ...Object.entries(size).map(([what, n]) => [what, n, paper[what] ?? "–"]),
          ["doors", me.map.nDoors, "–"],
          ["abstract states", found?.states ?? "–", "–"],
          ...ROWS.map((row) => [
            rows[row],
            found?.row[row] ? number(found.row[row], 10) : "–",
            marks[row] ? number(marks[row], 2) : "–",
          ]),
        ],
      };
    }

    return function draw(state, changed) {
      const isNew = changed.has("text");
      if (isNew) {
        me.read();
        begin();
      }
      if (isNew || changed.has("task")) {
        tasks = me.problem ? null : navigationTasks(me.map, { keep: [state.task] });
      }
      if (["text", "task", "start", "walk"].some((name) => changed.has(name))) {
        walk();
        view.robots(tasks ? [{ cell: me.walked.cell, arm: "none", name: "the robot" }] : []);
        view.trail(tasks && [state.start, ...me.walked.steps.map(({ next }) => next)]);
        view.rename();
        told.textContent = stepText(me.map, me.walked);
        showCell();
        if (changed.has("walk")) scene.say(told.textContent);
      }
      layers(state);
      tell();
      scene.twin(twin);
      scene.close(closing(state));
    };
  },
});
