// What the whole advice of page 5 is worth: bets, the curve along the dial, and
// the closing sentence.

import { BETAS, betaText, LAST, WINNER } from "./votes.js";
import { PAPER } from "../engine/paper.js";
import { make, number } from "../ui/dom.js";
import { lineChart } from "../ui/lines.js";

const ADVICE = { nd: [0, "ND"], prob: [1, "Prob"], winner: [WINNER, "Winner"] };
const MORE = {
  between: "yes, between ND and Prob",
  beyond: "yes, between Prob and the winner",
  no: "no",
};
const SIDES = [["small", "source", "dial-hard"], ["large", "map", "dial-soft"]];

// `drives`: by beta, the mean values of a cell in the small and the large building.
export function wholeAdvice(scene) {
  const now = make("p", {});
  const x = {
    label: "β (ND at 0, Prob at 1)",
    format: (beta) => number(beta, 0),
    min: 0,
    max: LAST + 1,
  };
  const y = {
    label: "Mean value of a cell if the whole advice is obeyed",
    format: (v) => number(v, 0),
  };
  const chart = lineChart({ label: "What the whole advice is worth, by beta", height: 260, x, y });
  const note = make(
    "p",
    { class: "ab-note" },
    "Hollow, in colour, at 0 and 1: the paper's ND and Prob.",
  );
  const large = scene.toggle("large", {
    label: "The large building, too: it answers a bet of the driving test (page 7)",
  });
  const node = make("div", { class: "ab-scene" }, now, chart.node, note, large);
  const bets = [
    scene.bet("bet", {
      question:
        "Bet first: whose advice drives best in the small building, where the votes were cast?",
      options: Object.fromEntries(Object.entries(ADVICE).map(([key, [, name]]) => [key, name])),
    }),
    scene.bet("bet_more", {
      question: "And is there advice that beats all three and needs nothing but the same votes?",
      options: MORE,
    }),
  ];

  // The large building is shown to who asks for it: it answers a bet of page 7.
  const sides = () => SIDES.slice(0, scene.state.large ? 2 : 1);
  const hasBet = () => scene.state.bet && scene.state.bet_more;
  const value = (
    drives,
    beta,
    side,
    digits = 1,
  ) => (drives[beta] ? number(drives[beta][side], digits) : "…");
  const best = (drives, side) =>
    BETAS.reduce((a, b) => (drives[b][side] > drives[a][side] ? b : a));
  const place = (beta) => (beta > LAST ? LAST + 1 : beta); // on the chart

  // Returns the sentence that is shown; none before the bets.
  function show(state, drives, isDone) {
    node.hidden = !hasBet();
    if (node.hidden) return "";
    now.textContent =
      `At β = ${betaText(state.beta)} the whole advice is worth ${
        value(drives, state.beta, 0, 2)
      } a cell in the small building` +
      (state.large ? `, ${value(drives, state.beta, 1, 2)} in the large one.` : ".");
    const known = BETAS.filter((beta) => beta <= LAST && drives[beta]);
    const curves = sides().flatMap(([name, , arm], side) => [
      { arm, points: known.map((beta) => [beta, drives[beta][side]]) },
      { name, arm, points: drives[WINNER] ? [[LAST + 1, drives[WINNER][side]]] : [] },
    ]);
    note.hidden = SIDES.some(([, of]) => state[of] !== scene.spec.state[of]);
    if (!note.hidden) {
      for (const paper of [PAPER.source, PAPER.target].slice(0, sides().length)) {
        for (const key of ["nd", "prob"]) {
          curves.push({ arm: `${key}-soft`, points: [[ADVICE[key][0], paper[key]]] });
        }
      }
    }
    const values = curves.flatMap(({ points }) => points.map(([, v]) => v));
    [y.min, y.max] = values.length
      ? [Math.min(...values) - 2, 0.9 * Math.max(...values)]
      : [-100, 0]; // room for words
    const marks = [{ x: LAST + 1, label: "winner" }];
    if (isDone) marks.push({ x: place(best(drives, 0)), label: "best" });
    chart.set({ curves, marks, cursor: place(state.beta) });
    return now.textContent;
  }
  function closing(drives) {
    if (!hasBet()) return "";
    const worth = (beta) => drives[beta][0];
    const top = Object.keys(ADVICE).reduce((
      a,
      b,
    ) => (worth(ADVICE[b][0]) > worth(ADVICE[a][0]) ? b : a));
    const [beta, other] = [0, 1].map((side) => best(drives, side));
    const isMore = worth(beta) > worth(ADVICE[top][0]) + 1e-9;
    const told = (of, side) =>
      `β = ${betaText(of)} with ${value(drives, of, side)} a cell ` +
      `(${
        Object.values(ADVICE).map(([at_, name]) => `${name} ${value(drives, at_, side)}`).join(", ")
      })`;
    return (
      `${scene.betResult("bet", top)} ${
        scene.betResult("bet_more", isMore ? (beta < 1 ? "between" : "beyond") : "no")
      } ` +
      `Of ${BETAS.length} places of the dial, best in the small building is ${told(beta, 0)}` +
      (scene.state.large ? `; in the large one ${told(other, 1)}.` : ".")
    ).trim();
  }
  const rows = (betas, drives) =>
    sides().map(([name], side) => [
      `the whole advice, ${name} building`,
      "",
      ...betas.map((beta) => (hasBet() ? value(drives, beta, side, 8) : "–")),
    ]);

  return { node, bets, show, closing, rows };
}
