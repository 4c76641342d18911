// A building that the reader edits: the drawing in the state as `text`, its view, its
// tools, and what is not legal in it.  Map Studio and other scenes are made with it.

import { drawMap, parseMap } from "../engine/maps.js";
import { slices } from "./slices.js";
import { makeTools } from "./tools.js";
import { mapTexts } from "../python.js";
import { describeCell } from "./drawing.js";
import { building } from "../ui/building.js";
import { button } from "../ui/controls.js";
import { make, place } from "../ui/dom.js";

const MANY = 1500; // cells: from here on, solving waits to be asked for

// `onMap(problem)` hears of another drawing: `map` is it or, where it draws none, the
// last one.  `begin` solves it: a button calls it where that waits to be asked for.
// `buildings` are more to start from, by name; `walk` moves a robot.
export function makeEditor(scene, options = {}) {
  const { buildings, walk, onMap, begin, ...view } = options;
  const legal = make("p", {});
  const me = { map: null, text: null, walked: null, problem: "", bad: [], legal, read, walk };
  const tools = (me.tools = makeTools(scene, me, buildings));
  me.view = building({
    label: "The building",
    onAct: tools.act,
    onKey: tools.press,
    keys: tools.keys,
    describe: (cell) => describeCell(me.map, cell, me.walked?.cell),
    ...view,
  });
  tools.listen(me.view);
  let isAsked = false;
  const solve = (me.solve = button("Large building: solve it", () => {
    me.ask();
    begin();
    scene.redraw();
  }, { primary: true }));

  me.ask = () => (isAsked = true);
  me.isLarge = () => me.map.nCells > MANY && !isAsked;
  const { start, isWorking } = slices(scene);
  [me.work, me.isWorking] = [start, isWorking];
  // Renew what changes with the state; `cells` are lit unless some are wrong.
  me.show = (cells = null) => {
    me.view.lit(me.problem ? me.bad : cells);
    solve.node.hidden = Boolean(me.problem) || !me.isLarge();
    tools.show();
  };

  // Take a text; keep the last building where it draws none.
  function read() {
    const { text } = scene.state;
    const before = me.map;
    if (text === me.text) return onMap?.(me.problem);
    me.text = text;
    [me.problem, me.bad] = ["", []];
    try {
      me.map = drawMap(text);
      parseMap(text);
    } catch (error) {
      const { message, inside } = /** @type {any} */ (error);
      const [row, column] = inside ?? [];
      me.problem = message;
      me.bad = [row - 1, row, row + 1].flatMap((r) =>
        [column - 1, column, column + 1].map((c) => [r, c])
      );
    }
    const map = (me.map ??= parseMap(mapTexts.source));
    const isInside = ([r, c]) =>
      r % 2 && c % 2 && r > 0 && c > 0 && r < 2 * map.height && c < 2 * map.width;
    me.bad = me.bad.filter(isInside).map(([r, c]) => ((r - 1) / 2) * map.width + (c - 1) / 2);
    if (before && before.text !== map.text) tools.remember(before.text);
    me.view.map(map);
    legal.classList.toggle("ab-now", Boolean(me.problem));
    legal.textContent = me.problem ? `Not legal yet: ${me.problem}.` : "A legal building.";
    if (me.bad.length) {
      legal.append(` (Of the text; as a cell: ${place(map, me.bad[0])}.)`);
    }
    if (me.problem) scene.say(legal.textContent);
    tools.write(text);
    isAsked = false;
    onMap?.(me.problem);
  }
  return me;
}
