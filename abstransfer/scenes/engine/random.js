// The random stream of a run: the same as Python's, word by word.
//
// NumPy's SeedSequence turns a seed and a spawn key into four 32-bit words, the state
// of a xoshiro128++ generator (Blackman & Vigna 2019) that the learner advances.

const POOL = 4;

/**
 * A whole number >= 0, of any size, as 32-bit words, the lowest first.
 *
 * @param {number | bigint} number
 */
function toWords(number) {
  const words = [];
  let rest = BigInt(number);
  do words.push(Number(rest & 0xffffffffn)); while ((rest >>= 32n));
  return words;
}

/**
 * A hash of words whose constant changes from call to call (O'Neill's seed_seq).
 *
 * @param {number} constant
 * @param {number} multiplier
 */
function hasher(constant, multiplier) {
  return (word) => {
    word ^= constant;
    constant = Math.imul(constant, multiplier);
    word = Math.imul(word, constant);
    return word ^ (word >>> 16);
  };
}

/**
 * @param {number} x
 * @param {number} y
 */
function mixed(x, y) {
  const word = Math.imul(0xca01f9dd, x) - Math.imul(0x4973f715, y);
  return word ^ (word >>> 16);
}

/**
 * What numpy.random.SeedSequence(seed, spawn_key=key).generate_state(n) returns.
 *
 * @param {number | bigint} seed a whole number
 * @param {number[]} key
 * @param {number} n
 * @returns {Uint32Array}
 */
export function seedState(seed, key = [], n = 4) {
  const words = toWords(seed);
  while (key.length && words.length < POOL) words.push(0);
  words.push(...key.flatMap(toWords));

  const hash = hasher(0x43b0d7e5, 0x931e8875);
  const pool = Array.from({ length: POOL }, (_, i) => hash(words[i] ?? 0));
  for (let from = 0; from < POOL; from++) {
    for (let to = 0; to < POOL; to++) {
      if (from !== to) pool[to] = mixed(pool[to], hash(pool[from]));
    }
  }
  for (const word of words.slice(POOL)) {
    for (let to = 0; to < POOL; to++) pool[to] = mixed(pool[to], hash(word));
  }
  const draw = hasher(0x8b51f9dd, 0x58f38ded);
  return Uint32Array.from({ length: n }, (_, i) => draw(pool[i % POOL]));
}

/**
 * Return the next word, 0..2^32-1, of a state (4,), and advance the state.
 *
 * @param {Uint32Array} state
 * @returns {number}
 */
export function nextWord(state) {
  const sum = (state[0] + state[3]) | 0;
  const word = (((sum << 7) | (sum >>> 25)) + state[0]) >>> 0;
  const shifted = state[1] << 9;
  state[2] ^= state[0];
  state[3] ^= state[1];
  state[1] ^= state[2];
  state[0] ^= state[3];
  state[2] ^= shifted;
  state[3] = (state[3] << 11) | (state[3] >>> 21);
  return word;
}

/**
 * Write the next n words of a state to the front of an array.
 *
 * @param {Uint32Array} state
 * @param {Uint32Array} words
 * @param {number} n
 */
export function fillWords(state, words, n) {
  let [a, b, c, d] = Int32Array.from(state);
  for (let i = 0; i < n; i++) {
    const sum = (a + d) | 0;
    words[i] = ((sum << 7) | (sum >>> 25)) + a;
    const shifted = b << 9;
    c ^= a;
    d ^= b;
    b ^= c;
    a ^= d;
    c ^= shifted;
    d = (d << 11) | (d >>> 21);
  }
  state.set([a, b, c, d]);
}
