// Map Studio without its page: what it draws, walks and solves.

import assert from "node:assert/strict";
import { test } from "node:test";

import { at, readGolden, readMap } from "./engine.js";
import {
  blank,
  edgesOf,
  paintCell,
  toggleEdge,
  toggleGoal,
} from "../../../abstransfer/scenes/parts/drawing.js";
import { follow, outcomes, solving } from "../../../abstransfer/scenes/studio/walk.js";

const source = readMap("source");
const draw = at.drawMap;
const refusal = (text) => {
  try {
    at.parseMap(text);
  } catch ({ message }) {
    return message;
  }
  return "";
};

test("a blank room is legal, whatever its size", () => {
  for (const [height, width] of [[1, 2], [2, 2], [3, 3], [7, 4], [60, 60], [400, 400]]) {
    const map = at.parseMap(blank(height, width));

    assert.deepEqual([map.height, map.width, map.nRooms, map.goals.length], [height, width, 1, 1]);
  }
});

test("painting a cell raises the walls it needs, and painting it back takes them away", () => {
  const inside = 7 + 1; // away from the goal
  const room = draw(blank(7, 7));
  const painted = draw(paintCell(room, inside, "corridor"));

  assert.equal(
    refusal(painted.text),
    "row 4, column 4: " +
      "this region cannot be reached from the rest of the building; put a door in one of its walls",
  );
  assert.ok(edgesOf(painted, inside).every(({ char }) => "-|".includes(char)));
  assert.equal(refusal(toggleEdge(painted, inside, 0, "door")), "");
  assert.equal(paintCell(painted, inside, "room"), room.text);
  assert.equal(paintCell(room, inside, "room"), room.text);
});

test("neighbors painted alike are one region", () => {
  let map = draw(blank(7, 7));
  for (const cell of [8, 9, 10]) map = draw(paintCell(map, cell, "corridor"));

  assert.equal(new Set([8, 9, 10].map((cell) => map.regions[cell])).size, 1);
  assert.equal(map.nRooms, 1);
});

test("an edge toggles twice to what it was; the outer wall stays", () => {
  for (const kind of ["wall", "door"]) {
    const [cell, east] = [17, 1]; // a wall between two rooms
    const once = toggleEdge(source, cell, east, kind);

    assert.notEqual(once, source.text);
    assert.equal(toggleEdge(draw(once), cell, east, kind), source.text);
  }
  assert.equal(toggleEdge(source, 0, 0, "wall"), "");
  assert.equal(toggleGoal(draw(toggleGoal(source, 0)), 0), source.text);
});

test("a walk moves nine times in ten, pays for every step, and ends at the goal", () => {
  const tasks = at.navigationTasks(source, { keep: [0] });
  const door = source.goals[0] + 15; // south of the goal
  const { steps, total, cell, isOver } = follow(tasks, door, "NNNNNNNNNN");

  assert.ok(isOver);
  assert.equal(cell, source.goals[0]);
  const n = steps.length;
  assert.ok(Math.abs(total + (1 - 0.99 ** n) / 0.01) < 1e-9);
  const walk = follow(tasks, 5 * 15 + 8, "EW".repeat(500));
  const slips = walk.steps.filter((each) => each.slips).length;
  assert.ok(slips > 60 && slips < 140, `${slips} of 1000`);
  assert.deepEqual(follow(tasks, 80, "xyz").steps, []);
});

test("what can happen in a cell has the chances of the task, and sums to 1", () => {
  const tasks = at.navigationTasks(source, { keep: [3] });
  for (let cell = 0; cell < source.nCells; cell++) {
    const sums = {};
    for (const { a, chance, next, r } of outcomes(tasks, cell)) {
      sums[a] = (sums[a] ?? 0) + chance;
      assert.equal(r, next === source.goals[3] ? 0 : -1);
    }
    const seen = at.LABELS.flatMap((_, a) => (tasks.nWays[8 * cell + a] ? [String(a)] : []));
    assert.deepEqual(Object.keys(sums), seen);
    for (const sum of Object.values(sums)) assert.ok(Math.abs(sum - 1) < 1e-12);
  }
});

test("solving in pieces ends where Table 1 is", () => {
  let last;
  const iterations = [];
  const pieces = [];
  for (last of solving(source)) {
    pieces.push(last);
    iterations.push(last.iteration);
  }
  const { source: wanted } = readGolden("tasks").table1;

  assert.ok(pieces.length > 300);
  assert.deepEqual(pieces.map(({ iteration }) => iteration), iterations, "it stays as it was");
  assert.equal(last.states, wanted.abstract_states);
  for (const row of at.ROWS) assert.ok(Math.abs(last.row[row] - wanted[row]) < 1e-9, row);
});
