// Reading a typed answer, as `_read.py` does, and kind words where it cannot be read.

const QUOTES = " \\t\\r\\n\"'`\u201c\u201d\u201e\u2018\u2019\u00ab\u00bb$!";
const STRIP = new RegExp(`^[${QUOTES}]+|[${QUOTES}.]+$`, "g");
const SIGNS = [
  [/[\u2010-\u2013\u2212\ufe63\uff0d]/g, "-"],
  [/[\u00a0\u2007\u2009\u202f]/g, " "],
  [/[\u00d7\u00b7\u22c5]/g, "*"],
  [/\u00f7/g, "/"],
  [/\u221e/g, "inf"],
  [/\^/g, "**"],
];
const UNIT = /(?<=[\d.)])\s*(%|per cent|[a-z]{2,})?[.\s]*$/;
const PRODUCT = /(?<=[\d.)])\s*\(/g;
const LONGEST = 200; // letters of a formula
const NAN = "There is a `nan` in it, which comes from 0/0 or from inf - inf. " +
  "Where could that happen?";

/** Says in kind words why an answer cannot be judged. */
export class Unreadable extends Error {}

/**
 * The numbers in a text, which may be formulas.
 *
 * @param {string} text
 * @returns {number[]}
 */
function numbers(text) {
  let bare = plain(text);
  if ((bare.match(/,(?=\d)/g) ?? []).length === 1) bare = bare.replace(/,(?=\d)/, "."); // decimals
  if (bare.includes(",")) bare = bare.replace(/^[()[\]]+|[()[\]]+$/g, "");
  const found = bare.split(/;|,|\band\b/).map(formula);
  if (found.some(Number.isNaN)) throw new Unreadable(NAN);
  return found;
}

/**
 * A text without quotes, article and plural; yes or no if it says so.
 *
 * @param {string} text
 * @returns {string}
 */
function word(text) {
  const words = text.toLowerCase().match(/[\p{L}\p{N}_]+/gu) ?? [];
  if (["yes", "y", "true"].includes(words[0])) return "yes";
  if (["no", "n", "not", "false"].includes(words[0])) return "no";
  if (words.length > 1 && ["a", "an", "the"].includes(words[0])) words.shift();
  return words.map((w) => w.replace(/(?<=[\p{L}\p{N}_]{2}[^s])s$/u, "")).join(" ");
}

/**
 * The letters that stand alone in a text, each once, in order.
 *
 * @param {string} text
 * @returns {string}
 */
function letters(text) {
  const words = (text.match(/[A-Za-z]+/g) ?? []).map((each) => each.toUpperCase());
  const isOne = words.length === 1 && words[0].length <= 4; // AB
  const found = isOne ? [...words[0]] : words.filter((each) => each.length === 1);
  if (!found.length) throw new Unreadable("Write the letters, for instance: A and C");
  return [...new Set(found)].sort().join("");
}

/** By kind, what reads an answer. */
export const READ = {
  numbers,
  size: (text) => numbers(text).map(Math.abs),
  word,
  letters,
};

/**
 * What an answer may mean: a comma in it is one of two things.
 *
 * @param {string} text
 * @returns {string[]}
 */
export function forms(text) {
  const found = [];
  const isApart = /;|\band\b/.test(text); // 0,28; 6,6
  if (isApart || (text.match(/,\d/g) ?? []).length === 1) { // 0,28
    found.push(text.replace(/,(?=\d)/g, "."));
  }
  if (/\d,\d{3}(?!\d)/.test(text)) found.push(text.replace(/(?<=\d),(?=\d{3})/g, "")); // 5,000
  return found.length ? found : [text];
}

function plain(text) {
  const typed = SIGNS.reduce((text, [sign, key]) => text.replace(sign, key), text);
  const said = typed.replace(STRIP, "").split(/[=\u2248~]/).pop(); // "x = 5" says 5
  return said.replace(/(?<=\d) (?=\d{3}(?!\d))/g, ""); // 5 000
}

/**
 * A text in one line, cut to a length.
 *
 * @param {string} text
 * @param {number} length
 */
export function short(text, length = 200) {
  const line = text.slice(0, 4 * length).replace(/ at 0x[0-9a-fA-F]+/g, "").replace(/`/g, "'")
    .replace(/[\p{C}\p{Z}]/gu, " ").split(/\s+/).filter(Boolean).join(" ");
  return line.length <= length ? line : line.slice(0, length - 3).trimEnd() + "...";
}

// ---- formulas, by Python's rules; nothing of them is run

const TOKEN =
  /\s*(?:((?:0[xX](?:_?[\da-fA-F])+|0[bB](?:_?[01])+|0[oO](?:_?[0-7])+|(?:\d+(?:_\d+)*\.?(?:\d+(?:_\d+)*)?|\.\d+(?:_\d+)*)(?:[eE][+-]?\d+(?:_\d+)*)?)(?![\w.]))|(inf(?:inity)?(?!\w))|(\*\*|[-+*/()]))/y;

/**
 * The number that a text stands for.
 *
 * @param {string} text
 * @returns {number}
 */
export function formula(text) {
  const bare = text.trim().replace(UNIT, "").replace(/#.*/, "").trim() // Python's comments
    .replace(PRODUCT, "*("); // without its sign
  try {
    if (bare.length > LONGEST) throw new RangeError("too long");
    return worth(tokens(bare));
  } catch {
    throw new Unreadable(
      `A number is asked for; \`${short(text, 40)}\` cannot be read as one`,
    );
  }
}

function tokens(text) {
  const found = [];
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < text.length) {
    const [, digits, infinite, sign] = TOKEN.exec(text) ?? fail();
    found.push(sign ?? (infinite ? Infinity : numberOf(digits.replaceAll("_", ""))));
  }
  return found;
}

function numberOf(digits) {
  if (/^0\d*[1-9]\d*$/.test(digits)) fail(); // Python wants no zeros before a whole number
  return Number(digits);
}

/** @returns {never} */
function fail() {
  throw new RangeError("no number");
}

function worth(list) {
  let at = 0;
  const take = (...signs) => signs.includes(list[at]) && list[at++];
  function sum() {
    let x = product();
    for (let sign; (sign = take("+", "-"));) x += sign === "+" ? product() : -product();
    return x;
  }
  function product() {
    let x = signed();
    for (let sign; (sign = take("*", "/"));) x = sign === "*" ? x * signed() : divided(x, signed());
    return x;
  }
  function signed() {
    const sign = take("+", "-");
    if (sign) return sign === "-" ? -signed() : signed();
    const base = atom();
    return take("**") ? raised(base, signed()) : base;
  }
  function atom() {
    if (typeof list[at] === "number") return list[at++];
    const x = take("(") ? sum() : fail();
    return take(")") ? x : fail();
  }
  const x = sum();
  return at === list.length ? x : fail();
}

const divided = (x, y) => (y === 0 ? fail() : x / y);

function raised(base, exponent) {
  if (Math.abs(base) === 1 && !Number.isFinite(exponent)) return 1;
  const power = base ** exponent;
  const isLost = Number.isNaN(power) && !Number.isNaN(base) && !Number.isNaN(exponent);
  const isTooLarge = !Number.isFinite(power) && Number.isFinite(base) && Number.isFinite(exponent);
  return isLost || isTooLarge ? fail() : power;
}
