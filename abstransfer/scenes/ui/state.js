// The state of a scene: named JSON values, in the URL, resettable.
//
// What a value may be, its field says; fields are made from Python's traits.  The URL
// holds what differs from the start, as "microscope.t=24".

import { parseMap } from "../engine/maps.js";
import { mapTexts } from "../python.js";

/** @import { Field, Spec, State } from "../types.d.ts" */

const MOST = 40_000; // characters of a text: a map of about 100 x 100 cells
const FLAGS = { true: [true, "true"], false: [false, "false"] };
const NONE = { value: undefined, problem: "" };

// The value that a scene may use; undefined, and why, if it may not.  It may come from
// anywhere: an address, Python, a field that the reader writes in.
const READ = {
  flag(value) {
    if (FLAGS.true.includes(value)) return { value: true };
    return FLAGS.false.includes(value) ? { value: false } : NONE;
  },
  whole: (value, bounds) => number(value, bounds, Math.round),
  number: (value, bounds) => number(value, bounds, (x) => x),
  choice: (value, bounds) => ({ value: bounds.includes(value) ? value : undefined }),
  text(value, bounds) {
    if (typeof value !== "string") return NONE;
    if (value.length > MOST) return { problem: `it has more than ${MOST} characters` };
    return { value: bounds && !bounds.includes(value) ? undefined : value };
  },
  map(value) {
    const read = READ.text(value);
    if (read.value === undefined) return read;
    try {
      parseMap(value);
      return read;
    } catch (error) {
      return { problem: /** @type {Error} */ (error).message };
    }
  },
  // Values of a list that may be in it, each once.
  list(value, bounds) {
    const list = parsed(value);
    const isList = Array.isArray(list);
    return { value: isList ? bounds.filter((each) => list.includes(each)) : undefined };
  },
  json(value, _, start) {
    const found = parsed(value);
    const isAlike = found && typeof found === "object" &&
      Array.isArray(found) === Array.isArray(start);
    return { value: isAlike ? found : undefined };
  },
};

function number(value, bounds, round) {
  const isRead = typeof value === "number" || (typeof value === "string" && value.trim());
  const x = isRead ? Number(value) : NaN;
  if (!Number.isFinite(x)) return NONE;
  return { value: Math.min(Math.max(round(x), bounds[0]), bounds[1]) };
}

function parsed(value) {
  if (typeof value !== "string") return value;
  if (value.length > MOST) return undefined;
  try {
    return JSON.parse(value);
  } catch {
    return undefined;
  }
}

/**
 * @param {Field} field
 * @param {any} bounds of today: a map may have changed them
 * @param {any} value
 * @returns {{ value?: any, problem?: string }}
 */
export const accepted = (field, bounds, value) => READ[field.kind](value, bounds, field.start);

const same = (a, b) => a === b || JSON.stringify(a) === JSON.stringify(b);

/**
 * The state of a scene; `problems` are the reasons why the last value of a name was
 * refused.
 *
 * @param {Spec} spec
 * @param {State} [options]
 */
export function makeState(spec, options) {
  const limits = { ...spec.limits };
  const values = { ...spec.state };
  const problems = {};
  // Return the names whose value changed.
  function set(changes) {
    const changed = [];
    for (const [name, value] of Object.entries(changes)) {
      if (!Object.hasOwn(values, name)) continue;
      const { value: next, problem } = accepted(spec.fields[name], limits[name], value);
      delete problems[name];
      if (next === undefined) problems[name] = problem || "it is no value of this scene";
      if (next === undefined || same(next, values[name])) continue;
      values[name] = next;
      changed.push(name);
    }
    return changed;
  }
  function limit(name, bounds) {
    limits[name] = bounds;
    return set({ [name]: accepted(spec.fields[name], bounds, values[name]).value ?? bounds[0] });
  }
  // As it was at the start; the bounds go before, which a smaller map has narrowed.
  function reset() {
    for (const [name, bounds] of Object.entries(spec.limits)) {
      if (bounds) limits[name] = bounds;
    }
    set(start);
  }
  set(options ?? {});
  const start = { ...values };
  return { values, start, limits, problems, set, limit, reset };
}

// ---- the URL: maps that come along go by their names

const isLocal = (spec, name) => (spec.local ?? []).includes(name);

/**
 * What the URL says of a scene, as text.
 *
 * @param {string} id
 */
export const addressOf = (id) =>
  [...new URLSearchParams(location.hash.slice(1))]
    .filter(([key]) => key.startsWith(`${id}.`)).join("&");

/**
 * What the URL says of a scene; null if nothing.
 *
 * @param {string} id
 * @param {Spec} spec
 * @returns {State | null}
 */
export function fromUrl(id, spec) {
  const found = {};
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    if (!key.startsWith(`${id}.`)) continue;
    const name = key.slice(id.length + 1);
    const map = value.startsWith("@") && mapTexts[value.slice(1)];
    if (!isLocal(spec, name)) found[name] = map || value;
  }
  return Object.keys(found).length ? found : null;
}

/**
 * @param {string} id
 * @param {Spec} spec
 * @param {{ values: State, start: State }} store
 */
export function toUrl(id, spec, { values, start }) {
  const pairs = new URLSearchParams(location.hash.includes("=") ? location.hash.slice(1) : "");
  for (const name of Object.keys(spec.state)) {
    const value = values[name];
    pairs.delete(`${id}.${name}`);
    if (isLocal(spec, name) || same(value, start[name])) continue;
    const map = Object.keys(mapTexts).find((known) => mapTexts[known] === value);
    const text = typeof value === "object" ? JSON.stringify(value) : value;
    pairs.set(`${id}.${name}`, map ? `@${map}` : text);
  }
  const hash = pairs.toString();
  const kept = location.hash.includes("=") ? "" : location.hash;
  const url = location.pathname + location.search + (hash ? `#${hash}` : kept);
  try {
    history.replaceState(history.state, "", url);
  } catch {
    // Not allowed here: the scene works, its moments have no address.
  }
}
