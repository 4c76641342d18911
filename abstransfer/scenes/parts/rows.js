// Rows over one axis: a name, a text, and below them a box of runs with the mean of
// them, or the interval of an effect.

import { armStyle, drawn, marker, sheet } from "../ui/dom.js";
import { ticks } from "../ui/lines.js";

const [ink, ground] = ["var(--ab-ink)", "var(--ab-ground)"];
const [EDGE, HEIGHT, FOOT] = [10, 48, 34]; // margins, of a row

// set({ items, from, to, axis, format, zero }); an item is { arm, name, text, runs,
// box: [min, quartile, median, quartile, max], interval: [mid, low, high], lit }.
export function runRows(label) {
  const { svg, node, repaint, resize, describe } = sheet(label, paint);
  let data = null;

  function paint(width) {
    if (!data) return;
    const { items, from, to, axis, format, zero } = data;
    const bottom = HEIGHT * items.length + 4;
    const px = (v) => (EDGE + ((v - from) / (to - from)) * (width - 2 * EDGE)).toFixed(1);
    const path = (d, kind, style) => drawn("path", { d, class: kind, style });
    const text = (words, x, y, anchor, kind) =>
      drawn("text", { x, y, "text-anchor": anchor, class: kind }, words);
    const parts = ticks(from, to, width < 500 ? 4 : 6).flatMap((tick) => [
      path(`M${px(tick)} 0V${bottom}`, "ab-rule"),
      text(format(tick), px(tick), bottom + 15, "middle"),
    ]);
    if (zero !== undefined) parts.push(path(`M${px(zero)} 0V${bottom}`, "ab-mark"));
    parts.push(path(`M${EDGE} ${bottom}H${width - EDGE}`, "ab-axis"));
    parts.push(text(axis, width / 2, bottom + 30, "middle", "ab-faint"));
    items.forEach(({ arm, name, text: words, runs, box, interval, lit }, i) => {
      const y = HEIGHT * i;
      const { color, isFilled } = armStyle(arm);
      const middle = y + 27;
      parts.push(
        marker(arm, EDGE + 4, y + 10, 5),
        text(name, EDGE + 15, y + 14, "start", "ab-name"),
      );
      parts.push(text(words, width - EDGE, y + 14, "end"));
      if (box) {
        const [least, first, median, third, most] = box.map(px);
        const [fill, line] = isFilled ? [color, ground] : [ground, color];
        parts.push(
          path(`M${least} ${middle}H${most}`, "ab-line", `stroke:${color}`),
          path(
            `M${first} ${middle - 5}H${third}v10H${first}Z`,
            "ab-marker",
            `fill:${fill};stroke:${color}`,
          ),
          path(`M${median} ${middle - 6}v12`, "ab-line", `stroke:${line}`),
          path(
            runs.map((x) => `M${px(x)} ${middle + 13}h.01`).join(""),
            "ab-runs",
            `stroke:${color}`,
          ),
        );
      }
      if (interval) {
        const [mid, low, high] = interval.map(px);
        const top = middle + (box ? 8 : 0);
        if (interval[1] <= interval[2]) {
          parts.push(
            path(`M${low} ${top + 5}H${high}M${low} ${top}v10M${high} ${top}v10`, "ab-interval"),
          );
        }
        parts.push(
          path(
            `M${mid} ${top}l5 5l-5 5l-5-5Z`,
            "ab-marker",
            `stroke:${ink};fill:${lit ? ink : ground}`,
          ),
        );
      }
    });
    resize(width, bottom + FOOT);
    svg.replaceChildren(...parts);
  }
  return {
    node,
    set(next) {
      data = next;
      repaint();
    },
    describe,
  };
}
