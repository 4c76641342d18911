// A scene to copy: a coin is thrown, and the share of heads comes close to a half.

import { seedState } from "../engine/random.js";
import { spec } from "../python.js";
import { number, plural } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";
import { defineScene } from "../ui/scene.js";

/** @import { Scene, State } from "../types.d.ts" */

/**
 * The share of heads after each of all throws: the numbers of `widget.py`.
 *
 * @param {number} luck
 */
function sharesOf(luck) {
  let heads = 0;
  const words = seedState(luck, [], spec.most);
  return Array.from(words, (word, i) => (heads += word >>> 31) / (i + 1));
}

defineScene("template", {
  title: "A coin", // read aloud as the name of the scene
  /** @param {Scene} scene */
  build(scene) {
    /** @type {number[]} */
    let shares = [];
    const chart = lineChart({
      label: "The share of heads, by throw",
      x: { label: "throws", min: 1, max: spec.most },
      y: { label: "Share of heads", format: (x) => number(x, 2), min: 0, max: 1 },
    });
    scene.add(
      scene.bet("bet", {
        question: "Bet first: after all throws, are more than half of them heads?",
        options: { more: "yes", less: "no" },
      }),
      scene.row(
        scene.slider("n", { label: "Throws", step: 1 }),
        scene.slider("luck", { label: "Luck: which random numbers", step: 1 }),
      ),
      chart.node,
    );

    /**
     * Once per frame, after any change.
     *
     * @param {State} state
     * @param {Set<string>} changed
     */
    return function draw({ n, luck, bet }, changed) {
      if (changed.has("luck")) shares = sharesOf(luck);
      const points = shares.slice(0, n).map((share, i) => [i + 1, share]);
      chart.set({ curves: [{ name: "heads", arm: "none", points }] });
      scene.twin(() => ({
        caption: `Luck ${luck}`,
        head: ["throws", "share of heads"],
        rows: points.map(([i, share]) => [i, number(share, 4)]),
      }));
      const truth = shares[spec.most - 1] > 0.5 ? "more" : "less";
      const [here, last] = [n, spec.most].map((at) => number(shares[at - 1], 2));
      const found = `The share of heads is ${here} after ${plural(n, "throw")}, ${last} after all.`;
      scene.close(bet && `${scene.betResult("bet", truth)} ${found}`);
    };
  },
});
