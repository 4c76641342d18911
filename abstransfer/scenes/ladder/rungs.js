// Two ladders side by side: the higher a rung, the better its policy drives.  What is
// here is filled, the paper's number a hollow mark beside it; rungs glide.

import { armStyle, drawn, marker, number, sheet } from "../ui/dom.js";
import { spread } from "../ui/lines.js";

const [TOP, BOTTOM, LINE, SIZE] = [34, 12, 16, 6];
// Room to the left and right of the ladders, and between one and its labels; on a phone
// less, without numbers at the lines: each rung has its own.
const WIDE = { left: 142, right: 130, gap: 22 };
const NARROW = { left: 124, right: 122, gap: 14 };
const ASIDE = 2 * SIZE; // how far a mark steps that would cover another
const GLIDE = 400; // milliseconds
const NEAR = 0.3; // what differs by less is a pixel apart: no glide for it

// Steps aside of marks at these heights: every second one of those that are close.
function asides(heights) {
  const aside = [];
  [...heights.keys()].sort((i, j) => heights[i] - heights[j]).forEach((i, rank, order) => {
    const before = order[rank - 1];
    aside[i] = rank && heights[i] - heights[before] < 1.6 * SIZE && !aside[before] ? ASIDE : 0;
  });
  return aside;
}

// `isCalm` says whether rungs jump.
export function makeLadders({ label, isCalm, height = 400 }) {
  const { svg, node, repaint, resize, describe } = sheet(label, paint);
  const places = {}; // of rungs: { from, to, began }
  let [columns, frame] = [[], null];
  let [leftmost, rightmost] = [0, 0]; // what the texts need: a reader may space letters
  let measured = ""; // the texts of which that is known

  // Where a rung is on its way.
  function placeOf(place, now) {
    const part = Math.min((now - place.began) / GLIDE, 1);
    return place.to + (place.from - place.to) * (1 - part) ** 3;
  }
  // [{ title, hint, isFaint, rungs: [{ arm, value, mark, note }] }]: `mark` is hollow,
  // and faint where it does not belong to what is shown.
  function set(next) {
    columns = next;
    measured = "";
    const now = performance.now();
    for (const { title, rungs } of columns) {
      for (const { arm, value } of rungs) {
        const key = title + arm;
        const before = places[key];
        if (!Number.isFinite(value)) continue; // where it was, it glides from
        if (!before || isCalm()) places[key] = { from: value, to: value, began: 0 };
        else if (Math.abs(before.to - value) < NEAR) before.to = value;
        else places[key] = { from: placeOf(before, now), to: value, began: now };
      }
    }
    repaint();
  }
  function paint(width) {
    cancelAnimationFrame(frame);
    if (!svg.isConnected) return;
    const now = performance.now();
    const isNarrow = width < 400;
    const { gap, ...room } = isNarrow ? NARROW : WIDE;
    const [left, right] = [Math.max(room.left, leftmost), Math.max(room.right, rightmost)];
    const y = (value) => TOP - ((height - TOP - BOTTOM) * value) / 100;
    const thin = (arm) => `stroke:${armStyle(arm).color};stroke-width:1`;
    const text = (content, x, top, look) => drawn("text", { x, y: top, ...look }, content);
    const parts = [0, -20, -40, -60, -80, -100].flatMap((tick) => [
      drawn("path", { d: `M${isNarrow ? 0 : 28} ${y(tick)}H${width - 4}`, class: "ab-rule" }),
      ...(isNarrow ? [] : [text(number(tick, 0), 0, y(tick) + 4, { class: "ab-faint" })]),
    ]);
    const lines = {};
    columns.forEach(({ title, hint, isFaint, rungs }, side) => {
      const x = side ? width - right : left;
      const out = side ? 1 : -1;
      const end = side ? "start" : "end";
      parts.push(
        drawn("path", { d: `M${x} ${y(0)}V${y(-100)}`, class: "ab-axis" }),
        text(title, x, TOP - 18, { "text-anchor": isNarrow ? end : "middle", class: "ab-name" }),
      );
      const shown = rungs.filter(({ value }) => Number.isFinite(value));
      const heights = shown.map(({ arm }) => y(placeOf(places[title + arm], now)));
      const rows = spread(heights, LINE, TOP, height - BOTTOM);
      const aside = asides(heights);
      shown.forEach(({ arm, value, note }, i) => {
        const px = x + out * aside[i];
        (lines[arm] ??= []).push(`${px} ${heights[i]}`);
        const words = `${armStyle(arm).name} ${number(value)}${note ? " …" : ""}`;
        const [row, label] = [rows[i], x + out * gap];
        parts.push(
          drawn("path", {
            d: `M${px} ${heights[i]}L${label - out * 3} ${row}`,
            class: "ab-line",
            style: thin(arm),
          }),
          text(words, label, row + 4, {
            "text-anchor": end,
            class: "ab-name",
            style: `fill:${armStyle(arm).color}`,
          }),
        );
      });
      // Marks last, over all lines; the paper's on the inner side.
      const marks = shown.filter(({ mark }) => Number.isFinite(mark));
      const inner = asides(marks.map(({ mark }) => y(mark)));
      marks.forEach(({ arm, mark }, i) => {
        const ring = marker(`${arm}-soft`, x - out * (2.6 * SIZE + inner[i]), y(mark), SIZE - 0.5);
        if (isFaint) ring.style.stroke = "var(--ab-control)";
        parts.push(ring);
      });
      shown.forEach(({ arm }, i) => parts.push(marker(arm, x + out * aside[i], heights[i], SIZE)));
      if (hint) {
        const look = { "text-anchor": "middle", class: "ab-name" };
        hint.forEach((words, i) => parts.push(text(words, x, y(-56) + LINE * i, look)));
      }
    });
    const across = Object.entries(lines).filter(([, ends]) => ends.length === 2).map((
      [arm, ends],
    ) => drawn("path", { d: `M${ends.join("L")}`, class: "ab-line", style: thin(arm) }));
    resize(width, height);
    svg.replaceChildren(...across, ...parts);
    const isMoving = Object.values(places).some(({ began }) => now - began < GLIDE);
    if (isMoving) frame = requestAnimationFrame(repaint);
    // Not in each picture of a glide: that would cost as much as all the rest.
    const words = `${width} ${svg.textContent}`;
    if (words === measured) return;
    measured = words;
    const wide = (end) =>
      [...svg.querySelectorAll(`text[text-anchor="${end}"]`)].reduce(
        (most, each) => Math.max(most, each.getComputedTextLength()),
        0,
      );
    leftmost = Math.ceil(gap + (isNarrow ? 2 : 28) + wide("end"));
    rightmost = Math.ceil(gap + 2 + wide("start"));
    if (leftmost > left || rightmost > right) repaint();
  }
  return { node, set, describe };
}
