// The hands of Map Studio: tools for mouse, touch and keyboard, undo, and the building
// as text.

import { DIRECTIONS } from "../engine/maps.js";
import { mapTexts } from "../python.js";
import { blank, edgesOf, paintCell, SIDES, toggleEdge, toggleGoal } from "./drawing.js";
import { button } from "../ui/controls.js";
import { make, place } from "../ui/dom.js";

const TOOLS = {
  walk: "Walk",
  wall: "Wall",
  door: "Door",
  room: "Room",
  corridor: "Corridor",
  goal: "Goal",
};
const ARROWS = ["ArrowUp", "ArrowRight", "ArrowDown", "ArrowLeft"];
const MOST = 200; // buildings that are remembered
const [LEAST, LARGEST] = [2, 60]; // rows and columns of a blank room

// Buttons that copy and save what is in a text field.
export function textButtons(scene, area, name) {
  function copy() {
    area.select();
    if (!navigator.clipboard) document.execCommand("copy");
    navigator.clipboard?.writeText(area.value).catch(() => {});
    scene.say("Copied.");
  }
  function save() {
    const href = URL.createObjectURL(new Blob([`${area.value}\n`]));
    make("a", { href, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
  }
  return [scene.button("Copy", copy), scene.button("Save as a file", save)];
}

// `me` is what the scene shows: { map, walked, view }; `read` and `walk` renew it.
// Its tools are those that the state may hold; `buildings` more texts by name.
export function makeTools(scene, me, buildings = {}) {
  const known = Object.fromEntries(scene.limits.tool.map((tool) => [tool, TOOLS[tool]]));
  const KEYS = [
    ...("walk" in known ? [["arrow keys, Walk", "move the robot"]] : []),
    ["Shift + arrow", "a wall on that side, or none; with the tool Door, a door"],
    [`1 to ${scene.limits.tool.length}`, "choose the tool"],
    ["Ctrl + Z, Ctrl + Y", "undo, redo"],
  ];
  const isPaint = () => ["room", "corridor"].includes(scene.state.tool);
  let [past, future, isBack] = [[], [], false];

  function go(from, to) {
    if (!from.length) return scene.say("There is nothing more.");
    to.push(me.map.text);
    isBack = true;
    scene.set({ text: from.pop() });
    me.read();
  }
  const undo = button("Undo", () => go(past, future));
  const redo = button("Redo", () => go(future, past));
  // Note that the building is another one now.
  function remember(text) {
    if (!isBack) [past, future] = [[...past.slice(1 - MOST), text], []];
    isBack = false;
  }
  function show() {
    undo.enable(past.length > 0);
    redo.enable(future.length > 0);
  }

  // ---- the drawing

  function edit(text, what) {
    if (!text) return scene.say("The outer wall stays.");
    scene.set({ text });
    me.read(); // at once: the next change may come before the next picture
    scene.say(what);
  }
  const toggle = (cell, d) =>
    edit(
      toggleEdge(me.map, cell, d, scene.state.tool),
      `Changed: the ${SIDES[d]} side of ${place(me.map, cell)}.`,
    );
  const paint = (cell) => {
    const { tool } = scene.state;
    const change = tool === "goal" ? toggleGoal : paintCell;
    edit(change(me.map, cell, tool), `Changed: ${place(me.map, cell)}.`);
  };
  // The side of a cell that a pointer is nearest to.
  function sideOf({ clientX: x, clientY: y }, cell) {
    const box = me.view.cells[cell].getBoundingClientRect();
    const gaps = [y - box.top, box.right - x, box.bottom - y, x - box.left];
    return gaps.indexOf(Math.min(...gaps));
  }
  function act({ cell, event }) {
    const { tool } = scene.state;
    if (tool === "walk") goTo(cell);
    else if (tool === "goal" || isPaint()) paint(cell);
    else if (event.type === "click") toggle(cell, sideOf(event, cell));
    else scene.say("Shift and an arrow key choose the side.");
  }
  function press(key, cell, event) {
    const d = ARROWS.indexOf(key);
    const tool = scene.limits.tool[key - 1];
    if (tool) scene.set({ tool });
    else if (d >= 0 && event.shiftKey) toggle(cell, d);
    else if (d >= 0 && scene.state.tool === "walk" && me.walked) step(d);
    else return false;
    return true;
  }
  function drag({ buttons, pointerType, target: { dataset } }) {
    if (buttons === 1 && pointerType !== "touch" && dataset?.cell && isPaint()) {
      paint(Number(dataset.cell));
    }
  }
  function listen({ node, svg }) {
    for (const kind of ["pointerdown", "pointerover"]) svg.addEventListener(kind, drag);
    node.addEventListener("keydown", (event) => {
      const key = (event.ctrlKey || event.metaKey) && event.key.toLowerCase();
      if (key !== "z" && key !== "y") return;
      event.preventDefault();
      if (key === "y" || event.shiftKey) go(future, past);
      else go(past, future);
    });
  }

  // ---- the robot

  function step(d) {
    if (me.walked.isOver) return scene.say("The episode is over. Choose a cell to begin another.");
    scene.set({ walk: scene.state.walk + DIRECTIONS[d] });
    me.walk();
    me.view.focus(me.walked.cell);
  }
  // One step if the cell is next to the robot; a goal becomes the task.
  function goTo(cell) {
    const task = me.map.goals.indexOf(cell);
    const d = me.walked && !me.walked.isOver
      ? edgesOf(me.map, me.walked.cell).findIndex(({ other }) => other === cell)
      : -1;
    if (d >= 0) step(d);
    else if (task >= 0) scene.set({ task });
    else scene.set({ start: cell, walk: "" });
  }

  // ---- buildings to start from, and the text

  const area = make("textarea", {
    rows: 12,
    spellcheck: "false",
    autocapitalize: "off",
    autocorrect: "off",
    "aria-label": "The building as text",
    oninput: () => scene.set({ text: area.value }),
  });
  const load = (text) => () => scene.set({ text, task: 0, start: 0, walk: "" });
  const sizes = [["Rows", 9], ["Columns", 15]].map(([label, value]) =>
    make("input", { type: "number", min: LEAST, max: LARGEST, value, "aria-label": label })
  );
  scene.onReset(() => sizes.forEach((each) => (each.value = each.defaultValue)));
  const size = ({ value }) => Math.min(Math.max(Math.round(value), LEAST), LARGEST);
  const clear = () => load(blank(size(sizes[0]), size(sizes[1])))();
  const files = [
    scene.row(
      Object.entries({ ...buildings, "The source": mapTexts.source, "The target": mapTexts.target })
        .map(([name, text]) => scene.button(name, load(text))),
      scene.button("A blank room of", clear),
      make("span", {}, sizes[0], " × ", sizes[1]),
    ),
    make(
      "details",
      {},
      make("summary", {}, "The building as text"),
      area,
      scene.row(...textButtons(scene, area, "building.txt")),
    ),
  ];
  const bar = scene.row(
    scene.choice("tool", { label: "Tool", options: known }),
    undo.node,
    redo.node,
  );
  const write = (text) => document.activeElement === area || (area.value = text);
  return { keys: KEYS, bar, files, act, press, listen, remember, show, write };
}
