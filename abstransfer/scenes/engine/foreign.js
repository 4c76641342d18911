// Text as it comes from elsewhere: the picture in it, or the name of its format.
//
// The same steps as the Python module `foreign`, which says what is forgiven; its tables
// come along.

import { drawing } from "../python.js";

/** @import { Picture } from "../types.d.ts" */

const { known, same, formats, tabSizes } = drawing;
const PLAIN = new Map(
  Object.entries(same).flatMap(([plain, chars]) => [...chars].map((char) => [char, plain])),
);
const PATTERNS = formats.map(([name, lacks, pattern]) => ({
  name,
  lacks,
  pattern: new RegExp(`^(?:${pattern})`),
}));
const [TOP, SIDE] = ["-", "\\|"].map((wall) =>
  new RegExp(`^${drawing.posts.replace("{0}", wall)}$`)
);

/**
 * An error as Python words it, with the place in the text and in the picture.
 *
 * @param {Omit<Picture, "lines">} picture
 * @param {number} row
 * @param {number} column
 * @param {string} problem
 * @param {string} remedy
 * @returns {never}
 */
export function refuse({ rows, columns }, row, column, problem, remedy) {
  const [y, x] = [rows[row], columns[column]];
  const text = `row ${y + 1}, column ${x + 1}: ${problem}; ${remedy}`;
  throw Object.assign(new Error(text), { row: y, column: x, inside: [row, column] });
}

// ---- lines as Python's `splitlines` and `strip` make them

// deno-lint-ignore no-control-regex
const ENDS = /\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]/;
// deno-lint-ignore no-control-regex
const OUTER = /^(?:[^\S\uFEFF]|\x1f)+|(?:[^\S\uFEFF]|\x1f)+$/g;

const stripped = (line) => line.replace(OUTER, "");
const isAround = (line, mark) =>
  /^(?:$|```|~~~)/.test(stripped(line)) ||
  stripped(line).startsWith(mark);

/** @param {string} text */
function toLines(text) {
  // deno-lint-ignore no-control-regex
  const bare = text.replace(/^\uFEFF/, "").replace(/\x1a+$/, "");
  return bare.replace(/[^ -~]/g, (char) => PLAIN.get(char) ?? char).split(ENDS);
}

/**
 * What a text looks like that is no map, and what it lacks; "" if unknown.
 *
 * @param {string} text
 */
export function named(text) {
  const lines = toLines(text);
  const texts = ["#", "`"].map((mark) =>
    lines.filter((line) => !isAround(line, mark)).map(stripped).join("\n")
  );
  const found = PATTERNS.find(({ pattern }) => texts.some((each) => pattern.test(each)));
  return found
    ? `this looks like ${found.name}: ${found.lacks}; ` +
      "page 1 of the book shows how a building is drawn"
    : "";
}

// ---- the picture

/**
 * The picture in a text, without what makes no difference.
 *
 * @param {string} text
 * @returns {Picture}
 */
export function findPicture(text) {
  const all = toLines(text);
  const rows = [...all.keys()];
  while (rows.length && isAround(all[rows.at(-1)], "#")) rows.pop();
  while (rows.length && isAround(all[rows[0]], "#")) rows.shift();
  const [left, lines] = withoutTabs(rows.map((row) => [...all[row]]), rows);
  const longest = Math.max(0, ...lines.map((line) => line.length));
  const columns = Array.from({ length: longest + 1 }, (_, i) => left + i);
  const picture = { lines, rows, columns };
  return narrowed(picture) ?? picture;
}

const isEven = (lines) => new Set(lines.map((line) => line.length)).size === 1;

// The common indent, and the lines without it and blanks at their ends.
function cut(lines) {
  const starts = lines.map((line) => line.findIndex((char) => char !== " "));
  const ends = lines.map((line) => line.findLastIndex((char) => char !== " ") + 1);
  const lengths = starts.map((start, i) => (start < 0 ? lines[i].length : start));
  const left = lines.length ? Math.min(...lengths) : 0;
  return [left, lines.map((line) => line.slice(left, Math.max(...ends)))];
}

function expanded(line, size) {
  const found = [];
  for (const char of line) {
    if (char !== "\t") found.push(char);
    else found.push(...Array(size - found.length % size).fill(" "));
  }
  return found;
}

function withoutTabs(lines, rows) {
  const row = lines.findIndex((line) => line.includes("\t"));
  if (row < 0) return cut(lines);
  const found = tabSizes.map((size) => cut(lines.map((line) => expanded(line, size))));
  const even = found.filter(([, drawn]) => isEven(drawn));
  const texts = even.map(([, drawn]) => drawn.map((line) => line.join("")).join("\n"));
  if (new Set(texts).size === 1) return even[0];
  const column = lines[row].indexOf("\t");
  const columns = [...lines[row].keys()];
  const tab = "a tab, of which nobody knows how wide it is";
  refuse({ rows, columns }, row, column, tab, "write blanks instead");
}

// ---- cells of several characters

/**
 * First and end of posts (one character) and of what lies between them (size).
 *
 * @param {number} length
 * @param {number} size
 */
function blocks(length, size) {
  /** @type {[number, number][]} */
  const found = [];
  for (let i = 0; i < length; i += size + 1) found.push([i, i + 1], [i + 1, i + 1 + size]);
  return found.slice(0, -1);
}

// The one letter in a block, or the character that fills it, or "".
function meaning(chars) {
  const letters = chars.filter((char) => !" |-".includes(char));
  if (letters.length === 1) return letters[0];
  return chars.every((char) => char === chars[0]) ? chars[0] : "";
}

// What we would draw for a "+" where no walls meet, "" where they do.
function wallsOf(lines, row, column) {
  const isWall = (y, x) => "-|d".includes(lines[y]?.[x] ?? "outside");
  const [n, e] = [isWall(row - 1, column), isWall(row, column + 1)];
  const [s, w] = [isWall(row + 1, column), isWall(row, column - 1)];
  if (n !== s || e !== w || (n && e)) return "";
  return n ? "|" : e ? "-" : " ";
}

/**
 * A drawing of larger cells as one of cells of one character, or null.
 *
 * @param {Picture} picture
 * @returns {Picture | null}
 */
function narrowed(picture) {
  const { lines } = picture;
  if (!isEven(lines)) return null;
  const top = TOP.exec(lines[0].join(""));
  const side = SIDE.exec(lines.map((line) => line[0]).join(""));
  if (!top || !side || top[2].length < 2) return null;
  const [high, wide] = [side[2].length, top[2].length];
  const [tall, broad] = [blocks(lines.length, high), blocks(lines[0].length, wide)];
  const drawn = tall.map(([y, yEnd]) =>
    broad.map(([x, xEnd]) => meaning(lines.slice(y, yEnd).flatMap((line) => line.slice(x, xEnd))))
  );
  const isPost = (row, column) => row % 2 === 0 && column % 2 === 0;
  const isLattice = drawn.every((line, row) =>
    line.every((char, column) => char && (char === top[1]) === isPost(row, column))
  );
  if (!isLattice || tall.length * broad.length === 9) return null; // 9: one cell
  if (mayBeOurs(lines)) {
    const starts = (places) => places.filter((_, i) => i % 2 === 0).map(([start]) => start);
    const posts = starts(tall).flatMap((y) => starts(broad).map((x) => [y, x]));
    const needless = posts.find(([y, x]) => wallsOf(lines, y, x));
    if (!needless) return null;
    if (high !== 1 || wide !== 3) {
      const [row, column] = needless;
      const problem = `here no walls meet, as if cells were ${wide} x ${high} characters`;
      const remedy = `write '${wallsOf(lines, row, column)}', or one character a cell`;
      refuse(picture, row, column, problem, remedy);
    }
  }
  const middle = (places) => ([start, end]) => places[Math.floor((start + end) / 2)];
  return {
    lines: drawn.map((line, row) =>
      line.map((char, column) => {
        if (isPost(row, column)) return "+";
        return row % 2 && column % 2 ? { G: "*", S: " " }[char] ?? char : char;
      })
    ),
    rows: tall.map(middle(picture.rows)),
    columns: broad.map(middle(picture.columns)),
  };
}

// Whether each character may stand where it does, one character a cell.
const mayBeOurs = (lines) =>
  lines.length % 2 === 1 && lines[0].length % 2 === 1 &&
  lines.every((line, row) =>
    line.every((char, column) => known[row % 2][column % 2].includes(char))
  );
