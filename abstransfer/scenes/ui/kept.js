// What a reader bet, answered and noted: kept in this tab, told to nobody.
//
// All of a page lies under one key.  Where a browser keeps nothing (some do not from
// file://), it is kept until the page is left.

const PREFIX = "abstransfer:";
const CHANGED = "abstransfer:kept";
// One for the whole page: each script brings these lines anew.
const MEMORY = Symbol.for("abstransfer: what is kept without a store");

/** @typedef {Record<string, string>} Kept by id: "race.bet", "ex-3-1" */

const memory = () => (globalThis[MEMORY] ??= new Map());

/** The name of the page that is read now: "03_learning". */
export const pageHere = () => location.pathname.split("/").pop().replace(/\.html?$/, "") || "index";

/**
 * @param {string} page
 * @returns {Kept}
 */
function read(page) {
  let text = memory().get(page);
  try {
    text ??= sessionStorage.getItem(PREFIX + page);
  } catch {
    // There is no store.
  }
  return parsed(text);
}

/**
 * @param {string} text
 * @returns {Kept}
 */
function parsed(text) {
  try {
    const found = Object.entries(JSON.parse(text) ?? {});
    return Object.fromEntries(found.filter(([, value]) => typeof value === "string"));
  } catch {
    return {};
  }
}

/**
 * @param {string} page
 * @param {Kept} all
 */
function write(page, all) {
  const text = JSON.stringify(all);
  try {
    sessionStorage.setItem(PREFIX + page, text);
    memory().delete(page);
  } catch {
    memory().set(page, text);
  }
}

/**
 * What is kept; "" if nothing is.
 *
 * @param {string} page
 * @param {string} id
 */
export const kept = (page, id) => {
  const all = read(page);
  return Object.hasOwn(all, id) ? all[id] : "";
};

/**
 * @param {string} page
 * @param {string} id
 * @param {string} value "" forgets it
 */
export function keep(page, id, value) {
  const { [id]: before = "", ...all } = read(page);
  if (before === value) return;
  write(page, value ? { ...all, [id]: `${value}` } : all);
}

/**
 * Forget all that is kept of a page; who shows it hears of it.
 *
 * @param {string} page
 */
export const forget = (page) => replace({ [page]: {} });

/**
 * Put what was saved in place of what is kept; who shows it hears of it.
 *
 * @param {Record<string, Kept>} pages
 */
export function replace(pages) {
  for (const [page, all] of Object.entries(pages)) write(page, all);
  dispatchEvent(new Event(CHANGED));
}

/** @returns {Record<string, Kept>} what is kept, by page */
export function everything() {
  let names = [];
  try {
    names = Object.keys(sessionStorage).filter((key) => key.startsWith(PREFIX));
  } catch {
    // There is no store.
  }
  const pages = new Set([...names.map((name) => name.slice(PREFIX.length)), ...memory().keys()]);
  const found = [...pages].sort().map((page) => [page, read(page)]);
  return Object.fromEntries(found.filter(([, all]) => Object.keys(all).length));
}

/**
 * Call `f` after all of a page was forgotten, or a file was loaded: show it anew.
 *
 * @param {() => void} f
 * @returns {() => void} what ends it
 */
export function onReplaced(f) {
  addEventListener(CHANGED, f);
  return () => removeEventListener(CHANGED, f);
}
