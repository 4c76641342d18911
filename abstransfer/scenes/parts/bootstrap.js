// The bootstrap of page 9, number for number: NumPy's PCG64 draws the same runs.

import { seedState } from "../engine/random.js";

const RESAMPLES = 2000;
const LEVEL = 0.95;
const WORD = 2 ** 32;
const MULTIPLIER = [0x9fccf645, 0x4385df64, 0x1fc65da4, 0x2360ed05]; // lowest word first
const low = (a, b) => Math.imul(a, b) >>> 0;
function high(a, b) {
  const [a0, a1, b0, b1] = [a & 0xffff, a >>> 16, b & 0xffff, b >>> 16];
  const u = a1 * b0 + ((a0 * b0) >>> 16);
  return a1 * b1 + (u >>> 16) + ((a0 * b1 + (u & 0xffff)) >>> 16);
}

// The 32-bit words of numpy.random.default_rng(seed) (O'Neill's PCG64, XSL-RR).
function pcg(seed) {
  const w = seedState(seed, [], 8);
  const start = [w[2], w[3], w[0], w[1]];
  const inc = [
    w[6] << 1,
    (w[7] << 1) | (w[6] >>> 31),
    (w[4] << 1) | (w[7] >>> 31),
    (w[5] << 1) | (w[4] >>> 31),
  ];
  inc[0] |= 1;
  let [s0, s1, s2, s3, rest] = [0, 0, 0, 0, null];
  const [m0, m1, m2, m3] = MULTIPLIER;
  /** @param {number[]} words */
  function add([a0, a1, a2, a3]) {
    let sum = s0 + (a0 >>> 0);
    s0 = sum >>> 0;
    sum = s1 + (a1 >>> 0) + Number(sum >= WORD);
    s1 = sum >>> 0;
    sum = s2 + (a2 >>> 0) + Number(sum >= WORD);
    s2 = sum >>> 0;
    s3 = (s3 + (a3 >>> 0) + Number(sum >= WORD)) >>> 0;
  }
  function step() {
    const one = high(s0, m0) + low(s0, m1) + low(s1, m0);
    const two = Math.floor(one / WORD) + high(s0, m1) + high(s1, m0) + low(s0, m2) + low(s1, m1) +
      low(s2, m0);
    const three = Math.floor(two / WORD) + high(s0, m2) + high(s1, m1) + high(s2, m0) +
      low(s0, m3) + low(s1, m2) + low(s2, m1) + low(s3, m0);
    [s0, s1, s2, s3] = [low(s0, m0), one >>> 0, two >>> 0, three >>> 0];
    add(inc);
  }
  step();
  add(start);
  step();
  return function next() {
    if (rest !== null) {
      const word = rest;
      rest = null;
      return word;
    }
    step();
    let [x, y] = [s0 ^ s2, s1 ^ s3];
    const turn = s3 >>> 26;
    if (turn > 31) [x, y] = [y, x];
    const k = turn & 31;
    rest = (k ? (y >>> k) | (x << (32 - k)) : y) >>> 0;
    return (k ? (x >>> k) | (y << (32 - k)) : x) >>> 0;
  };
}

// Which of n runs are drawn, RESAMPLES x n: default_rng(0).integers(0, n), Lemire's way.
const known = {};
export function drawn(n) {
  if (known[n]) return known[n];
  const [next, out] = [pcg(0), new Uint8Array(RESAMPLES * n)];
  const least = (WORD - n) % n;
  for (let i = 0; i < out.length; i++) {
    let product = next() * n;
    while (product % WORD < least) product = next() * n;
    out[i] = Math.floor(product / WORD);
  }
  return (known[n] = out);
}

// Ascending numbers, and a share: as numpy.quantile.
export function quantile(sorted, share) {
  const place = share * (sorted.length - 1);
  const i = Math.floor(place);
  return sorted[i] + (place - i) * ((sorted[i + 1] ?? sorted[i]) - sorted[i]);
}
const sum = (x) => x.reduce((a, b) => a + b, 0);

// [estimate, low, high] of mean(a) / mean(b) - 1, or of mean(a); run i of a with run i of b.
export function interval(a, b) {
  const n = a.length;
  const [runs, found] = [drawn(n), new Float64Array(RESAMPLES)];
  for (let r = 0, i = 0; r < RESAMPLES; r++) {
    let [x, y] = [0, 0];
    for (const end = i + n; i < end; i++) {
      x += a[runs[i]];
      if (b) y += b[runs[i]];
    }
    found[r] = b ? x / y - 1 : x / n;
  }
  found.sort();
  const estimate = b ? sum(a) / sum(b) - 1 : sum(a) / n;
  return [estimate, quantile(found, (1 - LEVEL) / 2), quantile(found, (1 + LEVEL) / 2)];
}
