// The state of a scene: named JSON values, in the URL, resettable.
//
// `limits` hold two numbers (a value is clamped) or a list of values (others are
// refused).  The URL holds what differs from the start, as "microscope.t=24".

import { mapTexts } from "../python.js";

/** @import { Limits, Spec, State } from "../types.d.ts" */

/**
 * The value as a scene may use it, or undefined if it may not.
 *
 * @param {any} start
 * @param {any} bounds
 * @param {any} value
 */
function accepted(start, bounds, value) {
  if (typeof start === "number") {
    const x = value === "" || value === null ? NaN : Number(value);
    if (!Number.isFinite(x)) return undefined;
    return bounds ? Math.min(Math.max(x, bounds[0]), bounds[1]) : x;
  }
  if (typeof start === "boolean") return value === true || value === "true";
  if (typeof start === "string") {
    const isKnown = typeof value === "string" && (!bounds || bounds.includes(value));
    return isKnown ? value : undefined;
  }
  if (typeof value !== "string") return value ?? undefined;
  try {
    return JSON.parse(value);
  } catch {
    return undefined;
  }
}

const same = (a, b) => a === b || JSON.stringify(a) === JSON.stringify(b);

/**
 * @param {Spec} spec
 * @param {State} [options]
 */
export function makeState(spec, options) {
  const limits = { ...spec.limits };
  const values = { ...spec.state };
  // Return the names whose value changed.
  function set(changes) {
    const changed = [];
    for (const [name, value] of Object.entries(changes)) {
      if (!Object.hasOwn(values, name)) continue;
      const next = accepted(spec.state[name], limits[name], value);
      if (next === undefined || same(next, values[name])) continue;
      values[name] = next;
      changed.push(name);
    }
    return changed;
  }
  function limit(name, bounds) {
    limits[name] = bounds;
    const next = accepted(spec.state[name], bounds, values[name]);
    return set({ [name]: next ?? bounds[0] });
  }
  set(options ?? {});
  const start = { ...values };
  return { values, start, limits, set, limit };
}

// ---- the URL: maps that come along go by their names

const isLocal = (spec, name) => (spec.local ?? []).includes(name);

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

// ---- bets stay in this tab

export const kept = (key, value) => {
  try {
    if (value === undefined) return sessionStorage.getItem(key) ?? "";
    return sessionStorage.setItem(key, value);
  } catch {
    return "";
  }
};
