// What page 4 finds: the bets, the counts as bars, and the closing sentence.

import { ALL } from "./counts.js";
import { FEATURES } from "../engine/navigation.js";
import { barChart } from "../ui/bars.js";
import { count, make, number, plural } from "../ui/dom.js";

const BETS = { // with the numbers they stand for
  bet: { few: [90, "about 90"], some: [500, "about 500"], all: [2048, "nearly all"] },
  bet_new: {
    third: [1 / 3, "one in three"],
    tenth: [0.1, "one in ten"],
    hundredth: [0.01, "one in a hundred"],
  },
};
const QUESTIONS = {
  bet: "Bet first: how many of 2,048 combinations of answers occur in the small building?",
  bet_new: "And of all states of the large building, how many look like nothing in the small one?",
};
const NAMES = {
  source: "abstract states in the small building",
  target: "abstract states in the large one",
  unseen: "of the large one's states look new",
  torn: "of the small one's states: in a conflict (no action suits all that look so)",
  right: "of the small one's states: one action for each abstract state is right",
};
const NUMBERS = ["source", "target"]; // the others are shares

const nearest = (name, x) =>
  Object.keys(BETS[name]).reduce((best, key) => {
    const far = (k) => Math.abs(Math.log(BETS[name][k][0] / Math.max(x, 1e-9)));
    return far(key) < far(best) ? key : best;
  });

// Bets and findings of a scene; `counts` are with the features kept, `full` with all.
export function findings(scene) {
  const percent = (x, digits = 1) => `${number(x, digits)} %`;
  const bars = {
    counts: barChart({ label: "Abstract states that occur", format: count, low: 0 }),
    shares: barChart({ label: "Shares of states", format: (x) => percent(x), low: 0, high: 100 }),
  };
  const note = make("p", { class: "ab-note" }, "A ring: with all 11 features.");
  const node = make("div", { class: "ab-scene" }, bars.counts.node, bars.shares.node, note);
  const bets = Object.entries(BETS).map(([name, of]) =>
    scene.bet(name, {
      question: QUESTIONS[name],
      options: Object.fromEntries(Object.entries(of).map(([key, [, text]]) => [key, text])),
    })
  );

  function show({ features }, counts, full) {
    node.hidden = !counts;
    if (!counts) return;
    note.hidden = features === ALL;
    const row = (key) => ({
      name: NAMES[key],
      value: counts[key],
      mark: features === ALL ? undefined : full[key],
    });
    bars.counts.set(NUMBERS.map(row));
    bars.shares.set(Object.keys(NAMES).slice(2).map(row));
  }
  function closing({ features }, counts, full) {
    if (!counts) return "";
    const n = FEATURES.filter((_, f) => (features >> f) & 1).length;
    const results = [["bet", full.source], ["bet_new", full.unseen / 100]].map(([name, x]) =>
      scene.betResult(name, nearest(name, x))
    );
    const before = features === ALL
      ? ""
      : `With all 11 it was ${full.source}, ${full.target}, ${percent(full.unseen)}, ${
        percent(full.torn, 0)
      } and ${percent(full.right, 0)}.`;
    return (
      `${results.join(" ")} With ${plural(n, "feature")}, ${counts.source} of ${
        count(2 ** n)
      } abstract states occur in the small ` +
      `building and ${counts.target} in the large one, where ${
        percent(counts.unseen)
      } of the states look new. At home ` +
      `${
        percent(counts.torn, 0)
      } of the states lie in a conflict; one action for each abstract state is right in ` +
      `${percent(counts.right, 0)}. ${before}`
    ).trim();
  }
  const short = ({ source, unseen, right }) =>
    `${source} abstract states; ${percent(unseen)} look new; one action is right in ${
      percent(right)
    }.`;
  const shown = (key, of) => (!of ? "–" : NUMBERS.includes(key) ? of[key] : percent(of[key], 4));
  const rows = (counts, full) =>
    Object.keys(NAMES).map((key) => [NAMES[key], shown(key, counts), shown(key, counts && full)]);

  return { node, bets, show, closing, short, rows };
}
