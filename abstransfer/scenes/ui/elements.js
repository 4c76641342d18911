// Elements, and ids for them.

const SVG = "http://www.w3.org/2000/svg";

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat().filter((child) => child || child === 0));
  return node;
}

/**
 * make("p", { class: "x", onclick: act }, "text", node): false children are left out.
 *
 * @param {string} tag
 * @param {Record<string, any>} [attributes]
 * @param {...any} children
 * @returns {any} an HTML element
 */
export const make = (tag, attributes, ...children) =>
  filled(document.createElement(tag), attributes, children);
/**
 * @param {string} tag
 * @param {Record<string, any>} [attributes]
 * @param {...any} children
 * @returns {any} an SVG element
 */
export const drawn = (tag, attributes, ...children) =>
  filled(document.createElementNS(SVG, tag), attributes, children);

// Counted for the whole page: each script brings these lines anew.
const LAST_ID = Symbol.for("abstransfer: the last id");
export const newId = () => `ab-${(globalThis[LAST_ID] = (globalThis[LAST_ID] ?? 0) + 1)}`;
