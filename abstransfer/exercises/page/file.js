// What was bet, answered and noted as a text that can be read, and loaded again.

/** @import { Kept } from "../../scenes/ui/kept.js" */

const HEAD = `What I bet, answered and noted in "Advice for Robots".
To go on with it, open any page of the book, and load this file below its exercises.
`;

/**
 * @param {Record<string, Kept>} pages
 * @returns {string}
 */
export function asText(pages) {
  const quoted = (value) => value.split(/\r?\n/).map((line) => `> ${line}\n`).join("");
  const each = ([id, value]) => `\n## ${id}\n${quoted(value)}`;
  const page = ([name, all]) => `\n# ${name}\n${Object.entries(all).map(each).join("")}`;
  return HEAD + Object.entries(pages).map(page).join("");
}

/**
 * What a text holds; what is no part of the form is passed over.
 *
 * @param {string} text
 * @returns {Record<string, Kept>}
 */
export function fromText(text) {
  const pages = new Map();
  let [page, id] = ["", ""];
  for (const line of text.split(/\r?\n/)) {
    const [, mark, rest] = /^(##?|>) ?(.*)$/.exec(line) ?? [];
    if (mark === "#") [page, id] = [rest.trim(), ""];
    else if (mark === "##") id = rest.trim();
    else if (mark === ">" && page && id) {
      const all = pages.get(page) ?? pages.set(page, new Map()).get(page);
      all.set(id, all.has(id) ? `${all.get(id)}\n${rest}` : rest);
    }
  }
  return Object.fromEntries([...pages].map(([name, all]) => [name, Object.fromEntries(all)]));
}
