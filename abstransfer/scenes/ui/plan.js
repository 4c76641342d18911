// The plan of a building as SVG: walls, doors and goals, as Python's figures draw them.

(function plan(at) {
  "use strict";

  const ui = (at.ui ??= {});
  const CELL = 20; // units of the drawing

  const middle = ({ width }, cell) => [
    CELL * ((cell % width) + 0.5), CELL * (Math.floor(cell / width) + 0.5),
  ];

  // Walls as lines, doors as hollow bars in a gap of the wall, as Python draws them.
  function edges(map, above) {
    const { drawn } = ui;
    const chars = map.text.split("\n");
    let [walls, doors] = ["", ""];
    chars.forEach((line, row) => {
      for (let column = (row + 1) % 2; column < line.length; column += 2) {
        const char = line[column];
        if (char === at.OPEN) continue;
        const isFlat = row % 2 === 0;
        const [x, y] = isFlat
          ? [(CELL * (column - 1)) / 2, (CELL * row) / 2]
          : [(CELL * column) / 2, (CELL * (row - 1)) / 2];
        walls += `M${x} ${y}${isFlat ? "h" : "v"}${CELL}`;
        if (char !== at.DOOR) continue;
        const gap = 0.18 * CELL;
        doors += isFlat ? `M${x + gap} ${y}h${CELL - 2 * gap}` : `M${x} ${y + gap}v${CELL - 2 * gap}`;
      }
    });
    return drawn(
      "g",
      above,
      drawn("path", { d: walls, class: "ab-wall" }),
      drawn("path", { d: doors, class: "ab-door" }),
      drawn("path", { d: doors, class: "ab-doorway" }),
    );
  }

  function star(map, cell, isFull) {
    const mark = ui.marker("optimal", ...middle(map, cell), isFull ? 7 : 5.5);
    mark.setAttribute("class", isFull ? "ab-goal" : "ab-goal ab-othergoal");
    mark.removeAttribute("style");
    return mark;
  }

  Object.assign(ui, { CELL, middle, edges, star });
})((globalThis.abstransfer ??= {}));
