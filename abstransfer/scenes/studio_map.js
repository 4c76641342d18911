// What Map Studio does with a building, without a page: paint cells and edges, walk
// a robot by compass, and rebuild Table 1 piece by piece.

(function studioMap(at) {
  "use strict";

  const LUCK = 1; // seed of the robot's slips
  const WORD = 4294967296;
  const GRAD = 300; // iterations

  // A building of one room with a goal in its middle.
  function blank(height, width) {
    const line = (corner, middle) => corner + middle.repeat(2 * width - 1) + corner;
    const lines = Array.from({ length: 2 * height + 1 }, (_, row) =>
      row % (2 * height) ? line("|", " ") : line("+", "-"),
    );
    const row = 2 * Math.floor(height / 2) + 1;
    const column = 2 * Math.floor(width / 2) + 1;
    return at.redraw(lines.join("\n"), [[row, column, at.GOAL]]);
  }

  const placeOf = ({ width }, cell) => [2 * Math.floor(cell / width) + 1, 2 * (cell % width) + 1];

  // The edges of a cell to N, E, S, W: { row, column, char, other } in the text;
  // `other` is the cell behind it, -1 outside.
  function edgesOf(map, cell) {
    const chars = map.text.split("\n");
    const [row, column] = placeOf(map, cell);
    return at.STEP.map(([dr, dc]) => {
      const [r, c] = [row + dr, column + dc];
      const isBorder = !r || !c || r === 2 * map.height || c === 2 * map.width;
      const other = isBorder ? -1 : cell + dr * map.width + dc;
      return { row: r, column: c, char: chars[r][c], other };
    });
  }

  // The text with an edge made what it is not: `kind` "wall" or "door", or open.
  // "" where the edge is the outer wall.
  function toggleEdge(map, cell, direction, kind) {
    const { row, column, char, other } = edgesOf(map, cell)[direction];
    if (other < 0) return "";
    const wall = row % 2 ? "|" : "-";
    const next = kind === "door" ? (char === at.DOOR ? wall : at.DOOR)
      : char === wall ? at.OPEN : wall;
    return at.redraw(map.text, [[row, column, next]]);
  }

  // The text with a cell made room or corridor.  It joins its like, and walls rise
  // where a room would open on the corridor.
  function paintCell(map, cell, kind) {
    const isRoom = kind === "room";
    if (map.inRoom[cell] === Number(isRoom)) return map.text;
    const changes = [[...placeOf(map, cell), isRoom ? at.ROOM : at.CORRIDOR]];
    for (const { row, column, char, other } of edgesOf(map, cell)) {
      if (other < 0 || char === at.DOOR) continue;
      const isAlike = map.inRoom[other] === Number(isRoom);
      changes.push([row, column, isAlike ? at.OPEN : row % 2 ? "|" : "-"]);
    }
    return at.redraw(map.text, changes);
  }

  function toggleGoal(map, cell) {
    const char = map.cells[cell] === at.GOAL ? at.ROOM : at.GOAL;
    return at.redraw(map.text, [[...placeOf(map, cell), char]]);
  }

  // Walk: letters N, E, S, W from a cell.  Return { cell, steps, total, isOver }, each
  // step { cell, d, a, next, r, slips }; `a` is the label of that edge, -1 a wall.
  function follow(tasks, start, walk) {
    const luck = at.seedState(LUCK);
    const steps = [];
    let [cell, total, weight] = [start, 0, 1];
    for (const letter of walk) {
      const d = at.DIRECTIONS.indexOf(letter);
      if (d < 0 || tasks.terminal[cell]) continue;
      const a = tasks.labels[4 * cell + d];
      const slips = at.nextWord(luck) / WORD >= tasks.success;
      const next = a < 0 || slips ? cell : tasks.neighbors[4 * cell + d];
      const r = tasks.reward[next];
      steps.push({ cell, d, a, next, r, slips: slips && a >= 0 });
      total += weight * tasks.reward[cell]; // a state pays on its own account, as in its value
      weight *= tasks.gamma;
      cell = next;
    }
    return { cell, steps, total, isOver: tasks.terminal[cell] === 1 };
  }

  // All that can happen next in a cell: { a, next, chance, r }; chances of one a sum to 1.
  function outcomes(tasks, cell) {
    const ways = at.LABELS.map(() => []);
    for (let d = 0; d < 4; d++) {
      const a = tasks.labels[4 * cell + d];
      if (a >= 0) ways[a].push(tasks.neighbors[4 * cell + d]);
    }
    return ways.flatMap((cells, a) => {
      if (!cells.length) return [];
      const moved = cells.map((next) => ({ a, next, chance: tasks.success / cells.length }));
      return [...moved, { a, next: cell, chance: 1 - tasks.success }].map((each) => ({
        ...each, r: tasks.reward[each.next],
      }));
    });
  }

  // Yield { tasks, states, row, policies, iteration } as it fills: number of abstract
  // states, row of Table 1, policies by name, iteration of Grad.
  function* solving(map) {
    const tasks = at.navigationTasks(map);
    const found = { tasks, row: {}, policies: {}, iteration: 0 };
    const drive = (name, policy) => {
      found.policies[name] = policy;
      found.row[name] = at.mean(at.evaluatePolicy(tasks, policy, tasks.rho));
    };
    found.states = at.abstractStates(tasks).length;
    drive("rand", at.randomPolicy(tasks.nAbstract));
    yield found;
    const v = at.optimalValues(tasks);
    found.row.optimal = at.mean(v);
    yield found;
    const { nd, prob } = at.inducedPolicies(tasks, { v });
    drive("nd", nd);
    drive("prob", prob);
    for (const { iteration, policy, value } of at.absprobPi(tasks, { iterations: GRAD })) {
      found.policies.grad = policy;
      found.iteration = iteration;
      found.row.grad = value;
      yield found;
    }
  }

  Object.assign(at.studio ??= {}, {
    GRAD, blank, edgesOf, toggleEdge, paintCell, toggleGoal, follow, outcomes, solving,
  });
})((globalThis.abstransfer ??= {}));
