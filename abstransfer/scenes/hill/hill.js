// Climbing, page 6: advice with two knobs, the land of its values, and the
// path of AbsProb-PI from where the reader drops it.

import { runFor } from "../engine/absprob_pi.js";
import { button } from "../ui/controls.js";
import { drawn, make, marker, number } from "../ui/dom.js";
import { defineScene } from "../ui/scene.js";
import { timeline } from "../ui/timeline.js";
import * as land from "./land.js";

const [LEFT, TOP, SIDE] = [40, 14, 280]; // of the drawing
const DASHES = ["5 3", "1.5 3", "8 3 1.5 3", "3 6"];
const KEPT = 6; // earlier climbs
const RIM = 0.02; // beside the land that still means its border
const STEP = 0.05; // of the cross, by key
const MOVES = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
const ENDS = { same: "always on the same", other: "not always" };
const clip = (x) => Math.min(Math.max(Math.round(x * 100) / 100, 0), 1);

defineScene("hill", {
  title: "Climbing with two knobs",
  build(scene) {
    const { state } = scene;
    const x = (p) => LEFT + SIDE * p;
    const y = (q) => TOP + SIDE * (1 - q);
    const where = ({ p, q }) => `${x(p).toFixed(1)} ${y(q).toFixed(1)}`;
    let [ways, ends, timer, cross] = [{}, [], null, null];

    // ---- the picture: the land, starts, climbs, the cross of the keys

    const layers = Object.fromEntries(
      ["ground", "starts", "climbs", "over"].map((name) => [name, drawn("g", {})]),
    );
    const svg = drawn("svg", {
      viewBox: `0 0 400 ${TOP + SIDE + 38}`,
      class: "ab-chart ab-land",
      "aria-hidden": "true",
    }, Object.values(layers));
    const board = make("div", {
      tabindex: 0,
      role: "application",
      class: "ab-board",
      "aria-label": "The land of values. Arrow keys move a cross, Enter starts a climb there.",
    }, svg);
    const text = (left, top, words, more) => drawn("text", { x: left, y: top, ...more }, words);
    const middle = { "text-anchor": "middle" };

    function drawLand() {
      const heights = land.heights(state.start);
      const shape = {
        transform: `translate(${LEFT} ${TOP + SIDE}) scale(${SIDE / land.N} ${-SIDE / land.N})`,
      };
      const parts = [
        drawn("rect", { x: LEFT, y: TOP, width: SIDE, height: SIDE, class: "ab-lowland" }),
      ];
      const rims = [];
      land.LEVELS.forEach((level, i) => {
        const { fill, rim } = land.region(heights, level);
        parts.push(drawn("path", { d: fill, class: "ab-highland", ...shape }));
        rims.push(drawn("path", { d: rim, class: "ab-contour", ...shape }));
        // The scale beside it: as many layers as in the land.
        const high = TOP + SIDE - ((i + 1) * SIDE) / 11;
        parts.push(
          drawn("rect", { x: 350, y: TOP, width: 12, height: high - TOP, class: "ab-highland" }),
        );
        rims.push(text(366, high + 4, number(level, level % 1 ? 1 : 0)));
      });
      const names = land.labels(state.start).map(({ p, q, level }) =>
        text(x(p), y(q) + 4, number(level, level % 1 ? 1 : 0), { ...middle, class: "ab-level" })
      );
      const ticks = [0, 0.5, 1].flatMap((knob) => [
        text(x(knob), TOP + SIDE + 15, `${knob}`, middle),
        text(LEFT - 6, y(knob) + 4, `${knob}`, { "text-anchor": "end" }),
      ]);
      layers.ground.replaceChildren(
        ...parts,
        ...rims,
        ...names,
        ...ticks,
        drawn("rect", { x: 350, y: TOP, width: 12, height: SIDE, class: "ab-contour" }),
        text(x(0.5), TOP + SIDE + 32, "p: left in the hall", middle),
        text(12, y(0.5), "q: up on a landing", {
          ...middle,
          transform: `rotate(-90 12 ${y(0.5)})`,
        }),
      );
    }
    function drawClimb(way, dash) {
      const line = drawn("path", {
        d: `M${way.map(where).join("L")}`,
        class: "ab-climb",
        "stroke-dasharray": dash,
      });
      const dots = drawn("path", {
        d: way.slice(1).map((each) => `M${where(each)}h.01`).join(""),
        class: "ab-steps",
      });
      const [first] = way;
      const ring = drawn("circle", { cx: x(first.p), cy: y(first.q), r: 5, class: "ab-start" });
      return drawn("g", { class: dash && "ab-earlier" }, line, dots, ring);
    }
    function arrow({ p, q, up }) {
      const [right, upper] = up;
      const turn = (Math.atan2(-upper, right) * 180) / Math.PI;
      const place = `translate(${where({ p, q })}) rotate(${turn.toFixed(1)})`;
      return (right || upper) &&
        drawn("path", { d: "M0 0H34l-10-6M34 0l-10 6", transform: place, class: "ab-uphill" });
    }

    // ---- climbs, found once

    // An address may hold anything.
    const earlier = () =>
      state.earlier.filter((knobs) => knobs?.length === 2 && knobs.every((x) => x >= 0 && x <= 1))
        .slice(-KEPT);
    const wayOf = (p, q) => (ways[`${p} ${q} ${state.start}`] ??= land.climb(p, q, state.start));
    const way = () => wayOf(state.p, state.q);
    const top = (
      { p, q },
    ) => (Math.min(p, q) > 0.5
      ? "left and up"
      : Math.max(p, q) < 0.5
      ? "right and down"
      : "in between");

    function drop(p, q) {
      [p, q] = [clip(p), clip(q)];
      const isNew = (knobs) => `${knobs}` !== `${[p, q]}`;
      const others = earlier().filter((knobs) => `${knobs}` !== `${[state.p, state.q]}`);
      scene.set({ p, q, earlier: [...others, [state.p, state.q]].filter(isNew).slice(-KEPT) });
    }
    board.addEventListener("click", (event) => {
      const { left, width, top: upper } = svg.getBoundingClientRect();
      const unit = 400 / width;
      const p = ((event.clientX - left) * unit - LEFT) / SIDE;
      const q = 1 - ((event.clientY - upper) * unit - TOP) / SIDE;
      const isOutside = Math.max(Math.abs(p - 0.5), Math.abs(q - 0.5)) > 0.5 + RIM;
      if (isOutside) return; // an axis, or the scale
      drop(p, q);
      cross = null;
    });
    board.addEventListener("keydown", (event) => {
      const move = MOVES[event.key];
      const { p, q } = cross ?? state;
      if (move) {
        cross = { p: clip(p + STEP * move[0]), q: clip(q + STEP * move[1]) };
        scene.say(
          `p ${number(cross.p, 2)}, q ${number(cross.q, 2)}: worth ${
            number(land.value(cross.p, cross.q, state.start), 2)
          }.`,
        );
      } else if (event.key === "Enter" || event.key === " ") drop(p, q);
      else return;
      event.preventDefault();
      scene.redraw();
    });
    board.addEventListener("focusout", () => ((cross = null), scene.redraw()));

    function follow(work) {
      const { done } = runFor(work, 10);
      timer = done ? null : setTimeout(follow, 0, work);
      if (done) scene.redraw();
    }
    scene.onLeave(() => clearTimeout(timer));

    // ---- controls and words

    const words = make("p", {});
    const slope = make("p", {});
    const sides = scene.toggle("sides", {
      label: "100 starts: ▲ ends at left and up, ▽ at right and down",
    });
    const clear = button("Forget the earlier climbs", () => scene.set({ earlier: [] }));
    const knob = (name, label) =>
      scene.slider(name, { label, step: 0.01, format: (each) => number(each, 2) });
    scene.add(
      scene.bet("bet", {
        question: "Bet first: does a climb always end at the same advice, wherever it starts?",
        options: ENDS,
      }),
      make(
        "div",
        { class: "ab-columns" },
        make(
          "div",
          { class: "ab-body" },
          board,
          timeline(scene, "t", { label: "Iteration", speeds: [1, 4, 15] }),
        ),
        make(
          "div",
          { class: "ab-body" },
          scene.choice("start", { label: "The robot starts", options: land.WORDS }),
          knob("p", "Start: p (left in the hall)"),
          knob("q", "Start: q (up on a landing)"),
          words,
          slope,
          sides,
          scene.row(clear.node),
        ),
      ),
    );

    function tell(first, here) {
      words.textContent =
        `Iteration ${state.t}: p = ${number(here.p, 2)}, q = ${
          number(here.q, 2)
        }. This advice is worth ${number(here.value, 2)}; ` +
        `the first was worth ${number(first.value, 2)}. Left and up for sure: ${
          number(land.value(1, 1, state.start), 2)
        }; right and down: ${number(land.value(0, 0, state.start), 2)}.`;
      const turn = (name, by) => `${by > 0 ? "more" : "less"} ${name} (${number(by, 2)})`;
      slope.textContent = `The arrow, steepest way up: ${turn("left", here.up[0])}, ${
        turn("up", here.up[1])
      }. The rule goes towards a corner.`;
    }
    function closing() {
      if (!state.bet || timer) return "";
      const nLeft = ends.filter(({ isLeft }) => isLeft).length;
      const mine = [...earlier(), [state.p, state.q]].map(([p, q]) => top(wayOf(p, q).at(-1)));
      const own = mine.length > 1
        ? ` Of your ${mine.length} climbs, ${
          mine.filter((name) => name === mine.at(-1)).length
        } end at ${mine.at(-1)}.`
        : "";
      const reply = scene.betResult("bet", nLeft % ends.length ? "other" : "same");
      const sides = `Of ${ends.length} starts, ${nLeft} end at left and up, ${
        ends.length - nLeft
      } at right and down.`;
      if (state.t < land.LAST) return `${reply} ${sides}`.trim();
      const last = way().at(-1);
      const settled = way().findLastIndex(({ value }) => Math.abs(value - last.value) > 0.1) + 1;
      return (
        `${reply} From p = ${number(state.p, 2)}, q = ${number(state.q, 2)} the climb ends ` +
        `at ${top(last)}: worth ${
          number(last.value, 2)
        } after ${land.LAST} iterations, within a tenth of that from iteration ${settled} on; ` +
        `the best advice is worth ${number(Math.max(...land.heights(state.start)), 2)}. ` +
        `${sides}${own}`
      ).trim();
    }
    function twin() {
      const climbs = [...earlier(), [state.p, state.q]].map(([p, q]) => {
        const last = wayOf(p, q).at(-1);
        return `${number(p, 2)}, ${number(q, 2)}: ${top(last)}, ${number(last.value, 2)}`;
      });
      return {
        caption: `The climb, iteration by iteration; the robot starts ${
          land.WORDS[state.start]
        }. All climbs by start (p, q), and where they end: ${climbs.join("; ")}.`,
        head: ["iteration", "p", "q", "value"],
        rows: way().slice(0, state.t + 1).map((
          { p, q, value },
          t,
        ) => [t, number(p, 6), number(q, 6), number(value, 6)]),
      };
    }

    return function draw(_, changed) {
      if (changed.has("start")) {
        ends = [];
        clearTimeout(timer);
        timer = setTimeout(follow, 0, land.sides(state.start, ends));
        drawLand();
      }
      // No farther than is shown: a drag asks for many climbs.
      const sofar = land.climb(state.p, state.q, state.start, Math.round(state.t));
      const here = sofar.at(-1);
      const marks = (side, shape, kind) => {
        const d = ends.filter(({ isLeft }) => isLeft === side).map((knobs) =>
          `M${where(knobs)}${shape}`
        ).join("");
        return drawn("path", { d, class: kind });
      };
      layers.starts.replaceChildren(
        ...(state.sides
          ? [
            marks(true, "m-4 3h8l-4-7z", "ab-leftside"),
            marks(false, "m-4-3h8l-4 7z", "ab-rightside"),
          ]
          : []),
      );
      layers.climbs.replaceChildren(
        ...earlier().map(([p, q], i) => drawClimb(wayOf(p, q), DASHES[i % DASHES.length])),
        drawClimb(sofar),
      );
      layers.over.replaceChildren(...[
        arrow(here),
        marker("grad", x(here.p), y(here.q), 6),
        cross && drawn("path", { d: `M${where(cross)}m-9 0h18m-9-9v18`, class: "ab-cross" }),
      ].filter(Boolean));
      sides.hidden = !state.bet;
      clear.node.hidden = !earlier().length;
      tell(sofar[0], here);
      if (changed.has("t") || changed.has("p") || changed.has("q")) scene.say(words.textContent);
      scene.twin(twin);
      scene.close(closing());
    };
  },
});
