// Dots: how many goals more than the twin without advice, life by life.

(function projectDots(at) {
  "use strict";

  // A row per robot: a hollow mark per life, the mean filled beneath.
  function makeDots(label) {
    const { drawn, make, marker, armStyle, count, ticks } = at.ui;
    const [LEFT, RIGHT, ROW, FOOT] = [70, 74, 46, 40];
    const svg = drawn("svg", { class: "ab-chart", role: "img", "aria-label": label });
    const node = make("div", { class: "ab-chartbox" }, svg);
    let rows = [];
    new ResizeObserver(() => paint()).observe(node);
    const signed = (n) => `${n > 0 ? "+" : ""}${count(n)}`;

    // [{ name, arm, more: [goals by life] }]
    function set(next) {
      rows = next;
      paint();
    }
    function paint() {
      const width = node.clientWidth;
      if (!width) return;
      const all = [0, ...rows.flatMap(({ more }) => more)];
      const [low, high] = [Math.min(...all), Math.max(...all, 1)];
      const x = (n) => LEFT + ((n - low) / (high - low)) * (width - LEFT - RIGHT);
      const height = rows.length * ROW + FOOT;
      const text = (words, px, py, look) => drawn("text", { x: px, y: py, ...look }, words);
      const line = (d, look) => drawn("path", { d, class: look });
      const parts = ticks(low, high, width < 500 ? 3 : 6).flatMap((n) => [
        line(`M${x(n)} 0V${height - FOOT}`, n ? "ab-rule" : "ab-mark"),
        text(signed(n), x(n), height - 22, { "text-anchor": "middle" }),
      ]);
      parts.push(text("goals more than without advice, same luck", width / 2, height - 4, { "text-anchor": "middle", class: "ab-faint" }));
      rows.forEach(({ name, arm, more }, i) => {
        const y = i * ROW + 8;
        const mean = more.reduce((sum, n) => sum + n, 0) / more.length;
        const look = { class: "ab-name", style: `fill:${armStyle(arm).color}` };
        parts.push(text(name, 0, y + 18, look));
        more.forEach((n, life) => parts.push(marker(`${arm}-soft`, x(n), y + 2 + (20 * life) / more.length, 3.5)));
        if (!more.length) return;
        parts.push(line(`M${x(0)} ${y + 28}H${x(mean)}`, "ab-axis"), marker(arm, x(mean), y + 28, 6));
        parts.push(text(signed(mean), width - RIGHT + 14, y + 32, look));
      });
      svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
      svg.style.height = `${height}px`;
      svg.replaceChildren(...parts);
    }
    return { node, set, describe: (words) => svg.setAttribute("aria-label", words) };
  }

  Object.assign(at.project ??= {}, { makeDots });
})((globalThis.abstransfer ??= {}));
