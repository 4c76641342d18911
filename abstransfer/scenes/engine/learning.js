// Q-learning with or without a guide: the same runs as Python's, to the bit.
//
// Python's `learning/loop.py` says what a run is; this loop looks up what that one computes.
// Beside the values it keeps, for every state, the largest and the set of actions
// that have it (a mask of 8 bits), renewed as a step changes one value.
//
// This file and `random` are all that a worker needs; a World, a Guide and a Rule are
// plain records of numbers and typed arrays, so they can be sent to one.

import { fillWords, nextWord, seedState } from "./random.js";

/** @import { Guide, Rule, Step, Tasks, World } from "../types.d.ts" */

const A = 8; // actions; a literal, so that a worker carries the loop only
const ROW = 5; // a row of outcomes: N, E, S, W, staying
const FIELD = 65536; // a field of 16 bits chooses the action
const WORD = 4294967296; // a word of 32 bits the outcome
const BLOCK = 1024; // steps whose words are drawn at once
const HOW = ["guided", "explored", "greedy"];

/**
 * Cumulative chances in units of 1/full: number u chooses the first k with
 * u < bound[k].  What cannot happen gets no number, the last possible all the rest.
 *
 * @param {number[]} prob
 * @param {number} full
 */
export function integerBounds(prob, full) {
  const last = prob.findLastIndex((p) => p > 0);
  let sum = 0;
  return prob.map((p, k) => {
    sum += p;
    return k >= last ? full : Math.min(full, Math.floor(sum * full + 0.5));
  });
}

/**
 * The tables of the loop.  An action draws from a set of directions; outcome row
 * `set` holds the moves of that set, as differences of state numbers.
 *
 * @param {Tasks} tasks
 * @returns {World}
 */
export function makeWorld(tasks) {
  const { nStates, labels, terminal, success, reward, map } = tasks;
  const ways = new Uint8Array(A * nStates);
  labels.forEach((label, i) => {
    if (label >= 0) ways[A * (i >> 2) + label] |= 1 << (i & 3);
  });
  const last = new Uint32Array(ROW * 16).fill(WORD - 1); // last word of an outcome
  const move = new Int32Array(ROW * 16);
  const moves = [-map.width, 1, map.width, -1, 0];
  for (let set = 0; set < 16; set++) {
    const isIn = moves.map((_, d) => d < 4 && (set >> d) & 1);
    const n = isIn.filter(Boolean).length;
    const prob = isIn.map((can) => (can ? success / n : 0));
    prob[4] = n ? 1 - success : 1;
    const bound = integerBounds(prob, WORD);
    const used = prob.flatMap((p, d) => (p > 0 ? [d] : []));
    used.forEach((d, k) => {
      last[ROW * set + k] = bound[d] - 1;
      move[ROW * set + k] = moves[d];
    });
  }
  const start = Int32Array.from(terminal.keys()).filter((s) => !terminal[s]);
  const goal = reward[terminal.indexOf(1)];
  const step = reward[start[0]];
  return { nStates, ways, last, move, terminal, start, step, goal };
}

/**
 * An abstract policy (Z, A) as the loop reads it: rows of bounds, one per state.
 *
 * @param {Float64Array} policy
 * @param {Int32Array} rho
 * @returns {Guide}
 */
export function makeGuide(policy, rho) {
  const bound = new Int32Array(policy.length);
  for (let i = 0; i < policy.length; i += A) {
    bound.set(integerBounds([...policy.subarray(i, i + A)], FIELD), i);
  }
  return { row: rho, bound };
}

/** @type {Rule} */
export const RULE = {
  alpha: 0.1,
  gamma: 0.9,
  epsilon: 0.1,
  q0: 0,
  maxEpisode: 5000,
  tau: 0,
  strategy: "hard",
};

// One run.
export class Run {
  /**
   * @param {World} world
   * @param {Guide | null} guide
   * @param {Partial<Rule>} rule
   * @param {number} seed a whole number
   * @param {number[]} key a spawn key
   * @param {Float64Array | null} notes the table that it begins with, else of q0
   */
  constructor(world, guide, rule, seed, key = [], notes = null) {
    this.world = world;
    this.guide = guide;
    /** @type {Rule} */
    this.rule = { ...RULE, ...rule };
    this.seed = seed;
    this.key = key;
    this.notes = notes;
    this.q = new Float64Array(A * world.nStates);
    this.top = new Float64Array(world.nStates); // the largest value of a state
    this.ties = new Uint8Array(world.nStates); // actions that have it; 0: terminal
    this.words = new Uint32Array(2 * BLOCK);
    this.reset();
  }

  // Go back to before the first step.
  reset() {
    const { q, top, ties, world, rule } = this;
    const state = seedState(this.seed, this.key, 8);
    this.rng = [state.subarray(0, 4), state.subarray(4)]; // of steps, of starts
    for (const words of this.rng) if (!words.some(Boolean)) words[0] = 1;
    q.fill(rule.q0);
    top.fill(rule.q0);
    ties.fill(255);
    world.terminal.forEach((isTerminal, s) => {
      if (!isTerminal) return;
      q.fill(0, A * s, A * s + A);
      top[s] = ties[s] = 0;
    });
    if (this.notes) {
      q.set(this.notes);
      world.start.forEach((s) => rescan(q, top, ties, s));
    }
    this.t = this.goals = this.cuts = 0;
    this.log = []; // what undoes the steps taken one at a time
    this.begin();
  }

  // Begin an episode.
  begin() {
    const { start } = this.world;
    this.s = start[Math.floor((nextWord(this.rng[1]) * start.length) / WORD)];
    this.left = this.rule.maxEpisode;
  }

  /**
   * Take n steps; return how many of them reached a goal.
   *
   * @param {number} n
   */
  learn(n) {
    const before = this.goals;
    const end = this.t + n;
    this.log = [];
    while (this.t < end) this.advance(Math.min(BLOCK, end - this.t));
    return this.goals - before;
  }

  /** @param {number} size */
  advance(size) {
    fillWords(this.rng[0], this.words, 2 * size);
    this.last = advance(this, size);
  }

  /**
   * Take one step, and return all there is to say of it.
   *
   * @returns {Step}
   */
  step() {
    const { s, t, left, goals, cuts, rng } = this;
    const q = this.q.slice(A * s, A * s + A);
    const [top, ties] = [this.top[s], this.ties[s]];
    const words = rng.map((state) => state.slice());
    this.log.push({ s, t, left, goals, cuts, rng: words, q, top, ties });
    this.advance(1);
    const { a, next, how } = this.last;
    const [luck, fate] = this.words;
    const isGoal = this.goals > goals;
    const reward = isGoal ? this.world.goal : this.world.step;
    const bestNext = next === s ? top : this.top[next];
    return {
      t: this.t,
      s,
      a,
      how: HOW[how],
      luck,
      fate,
      next,
      reward,
      bestNext,
      target: reward + this.rule.gamma * bestNext,
      before: q[a],
      after: this.q[A * s + a],
      ended: isGoal ? "goal" : this.cuts > cuts ? "cut" : null,
      here: this.s, // `next`, or the start of the next episode
    };
  }

  /**
   * Go to just after step t, forward or back.
   *
   * @param {number} t
   */
  goTo(t) {
    while (this.log.length && this.t > t) this.undo();
    if (this.t > t) this.reset();
    if (this.t < t) this.learn(t - this.t);
  }

  undo() {
    const { q, top, ties, ...before } = this.log.pop();
    Object.assign(this, before);
    this.q.set(q, A * this.s);
    this.top[this.s] = top;
    this.ties[this.s] = ties;
  }
}

/**
 * Take as many steps, at most BLOCK, as words were drawn for; return the last one.
 *
 * @param {Run} run
 * @param {number} size
 */
function advance(run, size) {
  const { q, top, ties, words } = run;
  const { ways, last, move, step, goal } = run.world;
  const { alpha, gamma, epsilon, tau, strategy } = run.rule;
  const { row, bound } = run.guide ?? {};
  const advice = run.guide ? tau : 0; // the guide has a say in steps 1..tau
  const isHard = strategy === "hard";
  const explore = Math.floor(epsilon * FIELD + 0.5);
  const keep = 1 - alpha;
  let { s, left, t } = run;
  let a, next, isGuided, isExplored;
  for (let i = 0; i < size; i++) {
    t++;
    const luck = words[2 * i];
    const fate = words[2 * i + 1];
    const mode = luck >>> 16;
    const field = luck & 0xffff;
    isGuided = false;
    isExplored = mode < explore;
    if (t <= advice) {
      const faded = (tau - t) * FIELD;
      isGuided = isHard || mode * tau < faded;
      isExplored = mode * tau < faded + t * explore;
    }
    if (isGuided) {
      let b = A * row[s];
      while (field >= bound[b]) b++;
      a = b & 7;
    } else {
      const set = isExplored ? 255 : ties[s];
      a = MEMBER[(set << 3) | ((field * SIZE[set]) >> 16)];
    }
    const place = (s << 3) | a;
    let k = ROW * ways[place];
    while (fate > last[k]) k++;
    next = s + move[k];
    const isEnd = ties[next] === 0;
    const target = (isEnd ? goal : step) + gamma * top[next];
    const x = keep * q[place] + alpha * target;
    q[place] = x;
    if (x > top[s]) {
      top[s] = x;
      ties[s] = 1 << a;
    } else if (x === top[s]) ties[s] |= 1 << a;
    else if ((ties[s] &= ~(1 << a)) === 0) rescan(q, top, ties, s);
    s = next;
    left--;
    if (isEnd || left === 0) {
      if (isEnd) run.goals++;
      else run.cuts++;
      run.begin();
      s = run.s;
      left = run.left;
    }
  }
  Object.assign(run, { s, left, t });
  return { a, next, how: isGuided ? 0 : isExplored ? 1 : 2 };
}

/**
 * Find the largest value of a state, and the actions that have it.
 *
 * @param {Float64Array} q
 * @param {Float64Array} top
 * @param {Uint8Array} ties
 * @param {number} s
 */
function rescan(q, top, ties, s) {
  let most = q[A * s];
  for (let i = A * s + 1; i < A * s + A; i++) if (q[i] > most) most = q[i];
  let set = 0;
  for (let a = 0; a < A; a++) if (q[A * s + a] === most) set |= 1 << a;
  top[s] = most;
  ties[s] = set;
}

// Size of each set of actions, and its members in order.
const SIZE = new Uint8Array(256);
const MEMBER = new Uint8Array(256 * A);
for (let set = 0; set < 256; set++) {
  for (let a = 0; a < A; a++) {
    if ((set >> a) & 1) MEMBER[A * set + SIZE[set]++] = a;
  }
}
