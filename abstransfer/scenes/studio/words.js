// What Map Studio says of a cell and of a step, and what it lays over the cells.

import { A, describe, LABELS } from "../engine/navigation.js";
import { breakTies } from "../engine/policies.js";
import { evaluatePolicy, optimalActions, optimalValues } from "../engine/solvers.js";
import { PAPER } from "../engine/paper.js";
import { outcomes } from "./walk.js";
import { SIDES } from "../parts/drawing.js";
import { count, number, place } from "../ui/dom.js";

export const nameOf = (a) => LABELS[a].replaceAll("_", " ");
const short = ({ width }, cell) => `(${Math.floor(cell / width) + 1}, ${(cell % width) + 1})`;

// The last step of a walk.
export function stepText(map, walked) {
  if (!walked) return "";
  const { steps, total } = walked;
  if (!steps.length) return "The robot waits: press an action below, or steer by a click.";
  const { cell, d, a, next, r, slips, nWays, isSteered } = steps.at(-1);
  const how = slips
    ? " The move failed: one in ten does."
    : a < 0
    ? isSteered ? ` A wall to the ${SIDES[d]}.` : " It finds nothing to go to here."
    : nWays < 2
    ? ""
    : isSteered
    ? ` You steered: a robot can only say “${nameOf(a)}”, which is true of ${nWays} ways here.`
    : ` Chance took one of ${nWays} ways.`;
  return (
    `Step ${steps.length}: (s, a, s′, r) = (${short(map, cell)}, ${a < 0 ? "–" : nameOf(a)}, ` +
    `${short(map, next)}, ${number(r, 0)}).${how} Return so far ${number(total, 2)}.`
  );
}

// The state of a cell, and the rows of what can happen there.
export function seenIn(map, tasks, task, cell) {
  const start = `State s = ${count(task * map.nCells + cell)}: task ${task + 1}, ${
    place(map, cell)
  }. `;
  if (tasks.terminal[cell]) return { text: `${start}The goal: an episode ends here.`, rows: [] };
  const seen = describe(tasks.rho[cell]).replaceAll("_", " ").replaceAll("^", "∧");
  const rows = outcomes(tasks, cell).map(({ a, next, chance, r }) => [
    a,
    next === cell ? "here" : short(map, next),
    number(chance, 2),
    number(r, 0),
  ]);
  return {
    text: `${start}What the robot sees: ${seen}.`,
    rows: [...rows, [-1, "here", "1.00", "−1"]],
  };
}

// Numbers of abstract states, or values and arrows of a policy; null what is not shown.
export function overlay(tasks, found, show) {
  const none = { states: null, values: null, arrows: null };
  const policy = found?.policies[show];
  if (tasks && show === "states") {
    const known = [...new Set(tasks.rho)].sort((a, b) => a - b);
    const numberOf = (z, cell) => (tasks.terminal[cell] ? -1 : known.indexOf(z));
    return { ...none, states: Array.from(tasks.rho, numberOf) };
  }
  if (!tasks || !(policy || show === "optimal")) return none;
  const values = policy ? evaluatePolicy(tasks, policy, tasks.rho) : optimalValues(tasks);
  const chosen = policy ?? breakTies(optimalActions(tasks, values));
  const arrows = Float64Array.from(tasks.labels, (a, i) => {
    const cell = i >> 2;
    if (a < 0 || tasks.terminal[cell]) return 0;
    return chosen[A * (policy ? tasks.rho[cell] : cell) + a] / tasks.nWays[A * cell + a];
  });
  return { ...none, values, arrows };
}

// The counts of a map; the paper's building that has them, by name, and its numbers:
// of the target, those that need no source.
export function likeness({ nCells, nRooms, goals }) {
  const size = { cells: nCells, rooms: nRooms, goals: goals.length };
  const { source, target } = PAPER;
  const isSame = (paper) => Object.entries(size).every(([what, n]) => paper[what] === n);
  if (isSame(source)) return { size, name: "source", marks: source };
  if (!isSame(target)) return { size, name: null, marks: {} };
  return { size, name: "target", marks: { rand: target.rand, optimal: target.optimal } };
}
