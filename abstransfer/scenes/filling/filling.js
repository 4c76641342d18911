// Box plots fill run by run, page 9: sign a claim when you would; then see what all
// runs say, and how a reader fares who stops as soon as an interval leaves 0.

import { meanInterval, quantile } from "../parts/student.js";
import { runRows } from "../parts/rows.js";
import { spec } from "../python.js";
import { choice } from "../ui/controls.js";
import { armStyle, count, make, number } from "../ui/dom.js";
import { defineScene } from "../ui/scene.js";
import { timeline } from "../ui/timeline.js";
import { combine, findingsOf, HOLDS, SAME, UNDECIDED, verdictsOf } from "./verdicts.js";

const CLAIMS = { 1: "1", 2: "2", 3: "3", 4: "4", 5: "5", [SAME]: "each arm against itself" };
const ORDERS = { 0: "as run", 1: "shuffled 1", 2: "shuffled 2", 3: "shuffled 3", 4: "shuffled 4" };
defineScene("filling", {
  title: "When would you sign?",
  build(scene) {
    const { state } = scene;
    const thousands = (x) => `${count(x / 1000)}k`;
    const percent = (x, sign = false) => `${sign && x > 0 ? "+" : ""}${number(100 * x)} %`;
    const nameOf = (arm) => armStyle(arm).name;
    const boxes = runRows("Goals of a run, arm by arm");
    const effects = runRows("What the claim rests on");
    const title = make("p", {});
    const now = make("p", {});
    const sign = scene.button("I sign now", () => scene.set({ signed: state.n }), {
      primary: true,
    });
    const order = choice({
      label: "Order of the runs",
      options: ORDERS,
      onInput: (k) => scene.set({ order: Number(k) }),
    });
    scene.control("order", (k) => order.set(`${k}`));
    const part = (words, node) => make("div", {}, make("p", { class: "ab-ylabel" }, words), node);
    const compared = part(
      "Effect, with its 95 % interval; filled where it is decided",
      effects.node,
    );
    const judged = make("div", { class: "ab-scene" }, now, scene.row(sign));
    scene.add(
      scene.bet("bet", spec.bets.bet),
      scene.row(scene.choice("claim", { label: "Claim", options: CLAIMS }), order.node),
      title,
      timeline(scene, "n", { label: "Runs", speeds: [1, 4, 12] }),
      judged,
      make(
        "div",
        { class: "ab-columns" },
        part(
          "Goals of a run. Box: how runs differ. Diamond and bar: their mean, 95 % interval",
          boxes.node,
        ),
        compared,
      ),
    );

    // What all runs say is Python's: data.readings.
    function closing(runs) {
      const { claim, signed, data } = state;
      if (!state.bet || !signed) return "";
      const found = data.readings[claim];
      const n = found.stops.filter(Boolean);
      const looks = `who looks after each run from run ${data.firstLook} on, and signs as soon as`;
      if (claim === SAME) {
        return (
          `You signed after ${signed} runs. Each arm was compared with itself, with other luck, so there is nothing to sign. ` +
          `But a reader ${looks} the interval leaves 0, signs ${n.length} of ${found.stops.length} comparisons ` +
          `(nine arms, their runs dealt in halves in five ways): ${
            number((100 * n.length) / found.stops.length, 0)
          } % wrong, where one look is wrong in 5 %. Fix the number of runs before you look.`
        );
      }
      const truth = Object.keys(spec.settled).find((key) => found.settled <= spec.settled[key]);
      return (
        `${claim === "1" ? scene.betResult("bet", truth) : ""} You signed “${
          verdict(signed)
        }” after ${signed} runs; all ${runs} say “${found.verdict}”. ` +
        `From ${found.settled} runs on no order of five says otherwise. A reader ${looks} the claim is decided, ` +
        `${
          n.length
            ? `stops after ${[...new Set(n)].sort((a, b) => a - b).join(", ")}`
            : "never does"
        } and is wrong in ${found.wrong} of ${found.stops.length} orders` +
        `${
          found.wrong ? "" : ": an effect this large forgives it"
        }. Now compare each arm with itself.`
      ).trim();
    }
    const verdict = (n) => combine(findingsOf(state.data, state.claim, state.order, n));

    return function draw(state, changed) {
      const { data, claim } = state;
      if (!data.totals) return;
      const runs = data.lives[0].length;
      const looks = claim === SAME ? Math.floor(runs / 2) : runs;
      const n = Math.min(state.n, looks);
      if (changed.has("data")) scene.limit("signed", [0, runs]);
      if (changed.has("data") || changed.has("claim")) scene.limit("n", [data.firstLook, looks]);
      const isNew = ["claim", "order", "data"].some((name) => changed.has(name));
      if (isNew && !changed.has("signed")) scene.set({ signed: 0 });

      const lives = data.lives[state.order].slice(0, n);
      const rows = data.arms.map((arm, i) => {
        const goals = lives.map((life) => data.totals[i][life]);
        const sorted = [...goals].sort((a, b) => a - b);
        const box = [0, 0.25, 0.5, 0.75, 1].map((share) => quantile(sorted, share));
        const interval = meanInterval(goals);
        return { arm, name: nameOf(arm), runs: goals, box, interval, lit: true };
      });
      const all = data.totals.flat();
      const bounds = {
        from: Math.min(...all),
        to: Math.max(...all),
        axis: "goals of a run",
        format: thousands,
      };
      boxes.set({
        ...bounds,
        items: rows.map((row) => ({ ...row, text: thousands(row.interval[0]) })),
      });
      boxes.describe(
        `Goals of ${n} runs: ${
          rows.map((row) => `${row.name} ${thousands(row.interval[0])}`).join(", ")
        }`,
      );

      const isSame = claim === SAME;
      title.textContent = isSame
        ? "A trap: one half of each arm's runs against the other half. Nothing can be found here."
        : `Claim ${claim}: ${data.claims[claim].title}.`;
      compared.hidden = judged.hidden = !state.bet;
      const findings = state.bet ? findingsOf(data, claim, state.order, n) : [];
      const drawnOnes = findings.filter((f) => f.fixed === null);
      const ends = drawnOnes.flatMap((f) => f.effect).map((x) => 100 * x);
      const [least, most] = [Math.min(0, ...ends), Math.max(1, ...ends)];
      const pad = (most - least) / 12;
      effects.set({
        from: least - pad,
        to: most + pad,
        axis: "goals more, percent",
        format: count,
        zero: 100 * data.claims[claim].compared[0][3],
        items: drawnOnes.map((f) => ({
          arm: f.a,
          interval: f.effect.map((x) => 100 * x),
          lit: f.verdict !== UNDECIDED,
          name: isSame
            ? `${nameOf(f.a)} over itself`
            : `${nameOf(f.a)} over ${nameOf(f.b)}${f.main ? "" : " (condition)"}`,
          text: `${percent(f.effect[0], true)} ${f.verdict}`,
        })),
      });
      const said = findings.length ? verdictsOf(findings, claim) : [];
      const decided = said.filter((each) => each !== UNDECIDED).length;
      now.textContent = isSame
        ? `After ${n} runs: ${decided} of ${said.length} intervals leave 0.`
        : `After ${n} runs: claim ${claim} ${said[0] === UNDECIDED ? "is undecided" : said[0]} (${
          findings.filter((f) => f.verdict === HOLDS).length
        } of its ${findings.length} findings hold).`;
      effects.describe(now.textContent);
      if (state.bet && changed.has("n")) scene.say(now.textContent);
      scene.twin(() => ({
        caption: `After ${n} of ${looks} runs, ${
          ORDERS[state.order]
        }: mean goals of a run, then effects, each with its 95 % interval.`,
        head: ["of", "estimate", "low", "high", "verdict"],
        rows: [
          ...rows.map((row) => [row.name, ...row.interval.map(count), ""]),
          ...findings.map((
            f,
          ) => [
            f.text,
            ...f.effect.map((x) => (f.fixed === null ? percent(x) : number(x))),
            f.verdict,
          ]),
        ],
      }));
      scene.close(closing(runs));
    };
  },
});
