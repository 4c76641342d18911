// Table 1 as a ladder, page 7: advice that was made in a source drives in two
// buildings.  Edit the source, or how it is read, and the rungs move.

import { absprobPi, ITERATIONS } from "../engine/absprob_pi.js";
import { parseMap } from "../engine/maps.js";
import { navigationTasks } from "../engine/navigation.js";
import { inducedPolicies, randomPolicy } from "../engine/policies.js";
import { evaluatePolicy, mean, optimalValues } from "../engine/solvers.js";
import { PAPER, ROWS } from "../engine/paper.js";
import { makeLadders } from "./rungs.js";
import { makeEditor } from "../parts/editor.js";
import { button } from "../ui/controls.js";
import { armStyle, list, make, number, plural } from "../ui/dom.js";
import { defineScene } from "../ui/scene.js";

const ADVICE = ["nd", "prob", "grad"];
const SIDES = ["source", "target"];
const ACTIONS = { relational: "go to what you see", compass: "north, east, south, west" };
const GAPS = { // up to this share of the best driver's cost
  tenth: [0.3, "a tenth of its cost"],
  half: [1, "half of its cost"],
  more: [Infinity, "more than all of it again"],
};
const SETTING = ["text", "target", "success", "actions", "near", "almost_near"];
const LEVEL = 0.05; // values that differ by less are level
const ORDERS = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]].map((order) =>
  order.map((i) => ADVICE[i])
);

// Yield { source, target, iteration, grad }, values by policy, as they are found.
function* solving(maps, reading) {
  const [source, target] = maps.map((map) => navigationTasks(map, reading));
  const found = { source: {}, target: {}, iteration: 0, targetTasks: target };
  // What was yielded stays as it was: it may be drawn while the next is on its way.
  const now = () => ({ ...found, source: { ...found.source }, target: { ...found.target } });
  const drive = (name, policy) => {
    found.source[name] = mean(evaluatePolicy(source, policy, source.rho));
    found.target[name] = mean(evaluatePolicy(target, policy, target.rho));
  };
  const v = optimalValues(source);
  drive("rand", randomPolicy(source.nAbstract, source.nActions));
  found.source.optimal = mean(v);
  yield now();
  const { nd, prob } = inducedPolicies(source, { v });
  drive("nd", nd);
  drive("prob", prob);
  yield now();
  found.target.optimal = mean(optimalValues(target));
  for (const { iteration, policy, value } of absprobPi(source)) {
    Object.assign(found, { iteration, grad: policy });
    found.source.grad = value;
    yield now();
  }
}

defineScene("ladder", {
  title: "The ladder: Table 1",
  build(scene) {
    const name = (row) => armStyle(row).name;
    let [found, before, first, target, begun] = [null, null, null, null, ""];

    const me = makeEditor(scene, { label: "The source", begin });
    const ladders = makeLadders({ label: "Table 1 as two ladders", isCalm: () => scene.calm });
    // Bets stay: they are about it.
    const papers = button(
      "The paper's setting",
      () => scene.set(Object.fromEntries(SETTING.map((key) => [key, scene.spec.state[key]]))),
    );
    const [legend, status] = [1, 2].map(() => make("p", {}));
    const steps = (n) => plural(n, "step");
    scene.add(
      scene.bet("order", {
        question:
          "Bet first: in the large building, whose advice drives best, whose next, whose last?",
        options: Object.fromEntries(
          ORDERS.map((order) => [order.join(), order.map(name).join(", ")]),
        ),
      }),
      scene.bet("gap", {
        question: "And how much more than the best driver does the best advice pay there?",
        options: Object.fromEntries(Object.entries(GAPS).map(([key, [, text]]) => [key, text])),
      }),
      make(
        "div",
        { class: "ab-columns" },
        make(
          "div",
          { class: "ab-body" },
          make(
            "p",
            { class: "ab-ylabel" },
            "Mean value of a cell: minus the discounted steps to the goal. −100: it never arrives.",
          ),
          ladders.node,
          legend,
          status,
        ),
        make(
          "div",
          { class: "ab-body" },
          make("p", {}, "The source, where the advice is made. Edit it:"),
          me.tools.bar,
          me.view.node,
          me.legal,
          me.solve.node,
          me.tools.files,
        ),
      ),
      scene.row(
        scene.slider("success", {
          label: "A move succeeds with probability",
          step: 0.05,
          format: (p) => number(p, 2),
        }),
        scene.slider("near", { label: "The goal is near up to", format: steps }),
        scene.slider("almost_near", { label: "The goal is almost near up to", format: steps }),
      ),
      scene.row(
        scene.choice("actions", { label: "What an action says", options: ACTIONS }),
        papers.node,
      ),
    );

    // ---- solving, in slices: the rungs first, then Grad climbs

    const isDone = () => found?.iteration === ITERATIONS;
    const setting = () => `${SETTING.map((key) => scene.state[key])} ${me.isLarge()}`;
    function begin() {
      if (begun === setting()) return; // a reset changes all, maybe to what it is
      begun = setting();
      before = found ?? before;
      found = isPapers() ? first : null; // that one is solved once
      const { success, actions, near, almost_near: almostNear } = scene.state;
      const job = !found && !me.problem && !me.isLarge() &&
        solving([me.map, target], { success, actions, near, almostNear });
      me.work(job, (last, isOver) => {
        found = last ?? found;
        const { targetTasks: tasks, grad } = found;
        if (grad) found.target.grad = mean(evaluatePolicy(tasks, grad, tasks.rho));
        if (isOver && isPapers()) first ??= found;
      });
    }

    // ---- what is shown

    const isPapers = () => SETTING.every((key) => scene.state[key] === scene.spec.state[key]);
    const isOpen = () => Boolean(scene.state.order && scene.state.gap);
    const isHidden = (side, row) => side === "target" && ADVICE.includes(row) && !isOpen();
    const valueOf = (side, row) => (isHidden(side, row) ? null : (found?.[side][row] ?? null));
    // While the new rungs are not known, the old ones stay.
    const drawn = (side, row) =>
      valueOf(side, row) ??
        (me.problem || me.isLarge() || isHidden(side, row) ? null : before?.[side][row]);
    const ranked = (side, rows, of = found) => [...rows].sort((a, b) => of[side][b] - of[side][a]);
    // "Grad, then Prob about level with ND", the best first.
    const ordered = (of) =>
      ranked("target", ADVICE, of).map((row, i, rows) => {
        const isLevel = i && of.target[rows[i - 1]] - of.target[row] < LEVEL;
        return `${i ? (isLevel ? " about level with " : ", then ") : ""}${name(row)}`;
      }).join("");
    const priced = (side, rows) =>
      list(ranked(side, rows).map((row) => `${name(row)} ${number(found[side][row])}`));

    function show() {
      ladders.set(SIDES.map((side) => ({
        title: side,
        hint: side === "target" && !isOpen() && ["ND?", "Prob?", "Grad?"],
        isFaint: !isPapers(),
        rungs: ROWS.map((row) => ({
          arm: row,
          value: drawn(side, row),
          note: row === "grad" && !isDone(),
          mark: isHidden(side, row) ? null : PAPER[side][row],
        })),
      })));
      legend.textContent = isPapers()
        ? "Filled marks: here. Hollow marks: the paper's numbers."
        : "Filled marks: here. Hollow and grey: the paper's numbers; they are not of this source, or not of this reading.";
      status.textContent = me.problem
        ? "No rungs: the source is not legal yet."
        : me.isLarge()
        ? "A building of this size takes a while."
        : isDone()
        ? "Grad is at the top of its climb."
        : `Grad climbs: ${found?.iteration ?? 0} of ${ITERATIONS} steps.`;
      me.show();
      papers.enable(!isPapers());
    }

    // How much more than the best driver the best advice pays: 1 is as much again.
    const gapOf = ({ target: { optimal, ...rest } }) =>
      (optimal - Math.max(...ADVICE.map((row) => rest[row]))) / -optimal;
    function closing() {
      if (!isDone()) return "";
      if (!isOpen()) {
        return `In the source, where it was made, the advice stands at ${
          priced("source", ADVICE)
        }; the best driver at ` +
          `${number(found.source.optimal)}. Place your bets, and it drives in the target.`;
      }
      const order = ranked("target", ADVICE);
      const now =
        `In the target: ${priced("target", ROWS)}. The best advice, ${name(order[0])}, pays ` +
        `${number(100 * gapOf(found), 0)} % more than the best driver.`;
      if (isPapers()) {
        const gap = Object.keys(GAPS).find((key) => gapOf(found) <= GAPS[key][0]);
        return `${scene.betResult("order", order.join())} ${scene.betResult("gap", gap)} ${now}`
          .trim();
      }
      const bets = ["order", "gap"].map((bet) => scene.betResult(bet, "", "the paper's setting"));
      if (!first) return `${now} ${bets.join(" ")}`.trim();
      const [was, is] = [first, found].map(ordered);
      /** @type {[string, number][]} */
      const moves = ADVICE.map((row) => [row, found.target[row] - first.target[row]]);
      const [most, by] = moves.reduce((a, b) => (Math.abs(b[1]) > Math.abs(a[1]) ? b : a));
      const turn = was === is
        ? "The order of the advice is as it was"
        : `The order of the advice was ${was}; it is ${is}`;
      return `${now} ${turn}; ${name(most)} moved most, by ${by > 0 ? "+" : ""}${number(by)}.`;
    }
    const printed = (x, digits) => (Number.isFinite(x) ? number(x, digits) : "–");
    const twin = () => ({
      caption:
        `${status.textContent} ${legend.textContent} Mean value of a cell; source: ${me.map.height} × ${me.map.width} cells.`,
      head: ["policy", "source", "the paper", "target", "the paper"],
      rows: ROWS.map((row) => [
        name(row),
        ...SIDES.flatMap((
          side,
        ) => [
          printed(valueOf(side, row), 10),
          isHidden(side, row) ? "–" : printed(PAPER[side][row], 2),
        ]),
      ]),
    });

    return function draw(state, changed) {
      if (changed.has("text")) me.read();
      if (changed.has("target")) target = parseMap(state.target);
      if (
        SETTING.some((key) => changed.has(key))
      ) begin();
      show();
      scene.twin(twin);
      scene.close(closing());
      ladders.describe(isDone() ? closing() : "Table 1 as two ladders");
    };
  },
});
