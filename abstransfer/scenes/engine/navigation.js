// Navigation tasks: what a robot in a building can do, and what it sees.
//
// A state is a task and a cell, s = task * C + cell.  Every array over states is
// flat: entry 4 * s + direction, or A * s + action.  See Python's `navigation`.

/** @import { Building, TaskOptions, Tasks } from "../types.d.ts" */

export const KINDS = ["see_empty_space", "see_door_far", "see_room", "see_corridor"];
export const ORIENTATIONS = ["head_to_goal", "opposite_to_goal"];
export const LABELS = ORIENTATIONS.flatMap((side) => KINDS.map((kind) => `${kind}_${side}`));
export const FEATURES = [...LABELS, "near_goal", "almost_near_goal", "in_room"];
export const A = LABELS.length;

/**
 * What is seen in each direction, whichever the goal: index into KINDS, (C, 4).
 *
 * @param {Building} map
 */
function kindsSeen({ nCells, inRoom, neighbors, doors }) {
  const hasDoor = new Uint8Array(nCells);
  doors.forEach((door, i) => (hasDoor[i >> 2] |= door));
  return Int8Array.from(neighbors, (other, i) => {
    if (other < 0) return -1;
    if (doors[i]) return inRoom[other] ? 2 : 3;
    return hasDoor[other] ? 1 : 0;
  });
}

/**
 * Return the tasks of a map, one per goal, as one union MDP.
 *
 *   success      probability that a move succeeds
 *   reward       "cost" (-1 a step, 0 on reaching the goal) or "goal" (0 and 1)
 *   gamma        discount for solving and evaluating
 *   near, almostNear   largest distances of the features of that name
 *   features     those that make the abstract state
 *   keep         numbers of the tasks to keep
 *   actions      "relational" (the labels) or "compass" (N, E, S, W)
 *
 * @param {Building} map
 * @param {TaskOptions} options
 * @returns {Tasks}
 */
export function navigationTasks(map, options = {}) {
  const {
    success = 0.9,
    reward = "cost",
    gamma = 0.99,
    near = 5,
    almostNear = 8,
    keep,
    actions,
  } = options;
  const kept = options.features ?? FEATURES;
  const features = FEATURES.filter((name) => kept.includes(name));
  const goal = Int32Array.from(keep ?? map.goals.keys(), (task) => map.goals[task]);
  const { nCells, neighbors } = map;
  const nStates = goal.length * nCells;
  const isCompass = actions === "compass";
  const nActions = isCompass ? 4 : A;
  /** @type {any} filled in below */
  const tasks = {
    map,
    success,
    gamma,
    features,
    goal,
    neighbors,
    nCells,
    nStates,
    nTasks: goal.length,
    nActions,
    nAbstract: 2 ** features.length,
    labels: new Int8Array(4 * nStates), // the action that may go there, or -1
    nWays: new Uint8Array(nActions * nStates), // directions an action draws from
    rho: new Int32Array(nStates), // bit f is 1 iff feature f holds
    terminal: new Uint8Array(nStates),
    reward: new Float64Array(nStates), // for reaching a state
  };
  const kinds = kindsSeen(map);
  const bits = FEATURES.map((name) => 1 << features.indexOf(name));
  FEATURES.forEach((name, f) => features.includes(name) || (bits[f] = 0));
  for (let s = 0; s < nStates; s++) {
    const cell = s % nCells;
    const distance = look(tasks, s, kinds, bits, isCompass);
    if (distance <= near) tasks.rho[s] |= bits[A];
    else if (distance <= almostNear) tasks.rho[s] |= bits[A + 1];
    if (map.inRoom[cell]) tasks.rho[s] |= bits[A + 2];
    tasks.terminal[s] = distance === 0 ? 1 : 0;
    tasks.reward[s] = (distance === 0 ? 1 : 0) - (reward === "cost" ? 1 : 0);
  }
  tasks.possible = isCompass
    ? new Uint8Array(nActions * tasks.nAbstract).fill(1)
    : possibleActions(features);
  return tasks;
}

// Fill in labels, ways and the label bits of rho; return the distance to the goal.
function look(tasks, s, kinds, bits, isCompass) {
  const { map, goal, neighbors, nCells, nActions, labels, nWays, rho } = tasks;
  const cell = s % nCells;
  const aim = goal[(s - cell) / nCells];
  const distance = manhattan(cell, aim, map.width);
  for (let d = 0; d < 4; d++) {
    const other = neighbors[4 * cell + d];
    labels[4 * s + d] = -1;
    if (other < 0) continue;
    const isAway = manhattan(other, aim, map.width) > distance;
    const label = kinds[4 * cell + d] + (isAway ? KINDS.length : 0);
    const a = isCompass ? d : label;
    labels[4 * s + d] = a;
    nWays[nActions * s + a]++;
    rho[s] |= bits[label];
  }
  return distance;
}

/**
 * @param {number} cell
 * @param {number} other
 * @param {number} width
 */
function manhattan(cell, other, width) {
  const rows = Math.floor(cell / width) - Math.floor(other / width);
  return Math.abs(rows) + Math.abs((cell % width) - (other % width));
}

/**
 * Actions that an abstract state does not rule out, (Z, A); see Python.
 *
 * @param {readonly string[]} features
 */
function possibleActions(features) {
  const nAbstract = 2 ** features.length;
  const possible = new Uint8Array(A * nAbstract);
  for (let z = 0; z < nAbstract; z++) {
    const row = LABELS.map((label) => {
      const bit = features.indexOf(label);
      return bit < 0 || (z >> bit) & 1;
    });
    const seesNothing = !row.some(Boolean);
    row.forEach((can, a) => (possible[A * z + a] = seesNothing || can ? 1 : 0));
  }
  return possible;
}

/**
 * An abstract state in the paper's words: its true features.
 *
 * @param {number} z
 * @param {readonly string[]} features
 */
export function describe(z, features = FEATURES) {
  const names = features.filter((_, bit) => (z >> bit) & 1);
  return names.join(" ^ ") || "(no feature holds)";
}

/**
 * Numbers of the abstract states of the cells that are no goal, in order.
 *
 * @param {Tasks} tasks
 * @returns {number[]}
 */
export function abstractStates({ rho, terminal }) {
  return [...new Set(rho.filter((_, s) => !terminal[s]))].sort((a, b) => a - b);
}
