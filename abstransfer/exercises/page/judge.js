// What is said to an answer: the words that `check` has for it in Python.

import { forms, READ, Unreadable } from "./read.js";

/** @import { Lines, Reply, Task, Value, Verdict } from "./types.d.ts" */

const EXACTLY = 1e-6; // apart, relatively, from the number that a mistake leads to

/**
 * Judges the answers to one exercise, and remembers what was said.
 *
 * @param {Task} task
 */
export function makeJudge(task) {
  let hints = 0;
  const mistakes = new Set();
  /** @returns {string} */
  function nextHint() {
    hints = Math.min(hints + 1, task.hints.length);
    return `Hint ${hints} of ${task.hints.length}: ${task.hints[hints - 1]}`;
  }
  /**
   * @param {any} answer a text, or the chosen line of each blank
   * @returns {Reply}
   */
  function reply(answer) {
    const { name, text = "", mistake } = judged(task, answer);
    if (name === "not yet") return { name, text: `${nextHint()} ${text}`.trim() };
    if (name !== "mistake") return { name, text };
    const wrong = task.wrong[mistake];
    const words = [`This looks like: *${wrong.name}*. ${wrong.hint}`, text];
    if (mistakes.has(mistake)) words.push(nextHint());
    mistakes.add(mistake);
    return { name: "not yet", text: words.filter(Boolean).join(" ") };
  }
  return {
    reply,
    isRight: (answer) => judged(task, answer).name === "right",
    sawHint: (number) => (hints = Math.max(hints, number)),
  };
}

/**
 * @param {Task} task
 * @param {any} answer
 * @returns {Verdict}
 */
function judged(task, answer) {
  if (task.kind === "lines") return judgedLines(task, answer);
  try {
    return judgedValue(task, readings(task, answer));
  } catch (problem) {
    if (!(problem instanceof Unreadable)) throw problem;
    return { name: "no answer yet", text: `${problem.message}.`.replace("?.", "?") };
  }
}

/**
 * @param {Lines} task
 * @param {Record<string, string>} chosen
 * @returns {Verdict}
 */
function judgedLines({ blanks }, chosen) {
  const found = Object.entries(blanks).map(([name, lines]) =>
    lines.find(([line]) => line === chosen[name])?.[1]
  );
  if (found.includes(undefined)) {
    return { name: "no answer yet", text: "Choose a line for each blank." };
  }
  const [mistake, ...more] = found.filter((each) => each !== null);
  if (mistake === undefined) return { name: "right", text: "It agrees in every case." };
  return { name: "mistake", mistake, text: more.length ? "Another line is not right either." : "" };
}

/**
 * @param {Value} task
 * @param {string} answer
 */
function readings(task, answer) {
  const found = [];
  let reason = null;
  for (const form of forms(answer)) {
    try {
      found.push(READ[task.kind](form));
    } catch (problem) {
      reason = problem;
    }
  }
  if (!found.length) throw reason;
  return found;
}

/**
 * @param {Value} task
 * @param {any[]} found
 * @returns {Verdict}
 */
function judgedValue(task, found) {
  if (typeof found[0] === "string") return judgedWord(task, found[0]);
  const single = found.filter((numbers) => numbers.length === 1).flat();
  if (!single.length) {
    const verdicts = found.map((several) => judgedSeveral(task, several));
    return verdicts.find(({ name }) => name === "right") ?? verdicts[0];
  }
  // 78 percent is 0.78
  const shares = task.share ? single.filter((x) => x > 1).map((x) => x / 100) : [];
  return judgedNumber(task, [...single, ...shares]);
}

/**
 * @param {Value} task
 * @param {string} answer
 * @returns {Verdict}
 */
function judgedWord(task, answer) {
  const read = (word) => READ[task.kind](`${word}`);
  if (answer === read(task.solution)) return { name: "right" };
  const mistake = task.wrong.findIndex((wrong) => answer === read(wrong.answer));
  if (mistake >= 0) return { name: "mistake", mistake };
  if (["yes", "no"].includes(`${task.solution}`)) {
    throw new Unreadable('Begin your answer with "yes" or "no"');
  }
  return { name: "not yet" };
}

/**
 * Several numbers, where the page may ask for more than one.
 *
 * @param {Value} task
 * @param {number[]} several
 * @returns {Verdict}
 */
function judgedSeveral(task, several) {
  const wanted = [task.solution, ...task.also];
  if (wanted.length === 1 || several.length !== wanted.length) {
    const isComma = several.length === 2 && several.every(Number.isInteger);
    const more = ". If a comma was to begin the decimals, write a point";
    const asked = wanted.length === 1 ? "One number is" : `${wanted.length} numbers are`;
    throw new Unreadable(`${asked} asked for, not ${several.length}${isComma ? more : ""}`);
  }
  const fits = several.map((x, i) => isOrRounds(task, x, numberOf(task, wanted[i])));
  if (fits.every(Boolean)) return { name: "right" };
  const first = 1 + fits.indexOf(true);
  return { name: "not yet", text: first ? `Number ${first} of yours is right.` : "" };
}

function isOrRounds(task, number, wanted) {
  const isPercent = task.share && wanted <= 1 && number > 1;
  const meant = isPercent ? [number, number / 100] : [number];
  return meant.some((x) => same(x, wanted, task.tolerance) || rounds(x, wanted));
}

/**
 * @param {Value} task
 * @param {number[]} meant
 * @returns {Verdict}
 */
function judgedNumber(task, meant) {
  const right = numberOf(task, task.solution);
  const mistakes = task.wrong.map((wrong) => numberOf(task, wrong.answer));
  if (meant.some((x) => same(x, right, task.tolerance))) return { name: "right" };
  for (const x of meant) {
    const mistake = mistakes.findIndex((wrong) => same(x, wrong, EXACTLY));
    if (mistake >= 0) return { name: "mistake", mistake };
  }
  for (const x of meant) {
    if (rounds(x, right)) {
      return { name: "nearly", text: "Right as far as it goes: give more digits." };
    }
    const near = mistakes.flatMap((wrong, i) => (rounds(x, wrong) ? [i] : []));
    if (near.length === 1 && digits(x) > 1) return { name: "mistake", mistake: near[0] };
  }
  return { name: "not yet" };
}

function numberOf(task, value) {
  const x = value === "inf" ? Infinity : Number(value);
  return task.kind === "size" ? Math.abs(x) : x;
}

const same = (a, b, tolerance) =>
  a === b || Math.abs(a - b) <= tolerance + tolerance * Math.abs(b) && Number.isFinite(b);

// Decimals behind the point in a number's first digit, and its power of ten.
function written(x) {
  const [mantissa, exponent] = x.toExponential().split("e");
  return [Math.max(0, mantissa.replace("-", "").length - 2), Number(exponent)];
}

function places(x) {
  const [decimals, exponent] = written(x);
  return Math.max(0, decimals - exponent);
}

function digits(x) {
  const [decimals, exponent] = written(x);
  return Math.max(decimals, exponent) + 1;
}

/** Whether a number is an exact one, rounded to the digits that it has. */
function rounds(x, exact) {
  if (!Number.isFinite(x) || x === 0) return false;
  return Math.abs(x - exact) <= 0.5 * 10 ** -places(x) * (1 + 1e-9);
}
