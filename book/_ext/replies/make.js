// One small thing that all parts use: an element with its attributes and children.

/**
 * @param {string} tag
 * @param {Record<string, any>} attributes those that begin with "on" are listeners
 * @param {...(Node | string)} children
 * @returns {any}
 */
export function make(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}
