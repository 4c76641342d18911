// Editing a map: each function returns a new map, or refuses as Python does.
//
// `redraw` edits a drawing that need not be legal (yet): while somebody draws, a
// page keeps the text and shows what `parseMap` says of it.

(function editing(at) {
  "use strict";

  // Return a drawing with characters [row, column, char] of the text replaced.
  function redraw(text, changes) {
    const chars = text.split("\n").map((line) => [...line]);
    for (const [row, column, char] of changes) chars[row][column] = char;
    return at.toText(chars);
  }

  // Place of an edge in the text; refuses what is not on the map.
  function edgePlace(map, cell, direction) {
    const [row, column] = cell;
    const { height, width } = map;
    if (!(row >= 0 && row < height && column >= 0 && column < width)) {
      throw new Error(
        `cell must lie within ${height} x ${width}, got ${at.tuple(cell)}`,
      );
    }
    const d = at.DIRECTIONS.indexOf(direction);
    if (d < 0) {
      const known = at.tuple(at.DIRECTIONS.map((name) => `'${name}'`));
      throw new Error(`direction must be one of ${known}, got '${direction}'`);
    }
    return [2 * row + 1 + at.STEP[d][0], 2 * column + 1 + at.STEP[d][1]];
  }

  // Make one edge a "wall", a "door" or "open".
  function setEdge(map, cell, direction, kind) {
    const place = edgePlace(map, cell, direction);
    const wall = place[0] % 2 ? "|" : "-";
    const chars = { wall, door: at.DOOR, open: at.OPEN };
    if (!Object.hasOwn(chars, kind)) {
      const known = at.tuple(Object.keys(chars).map((name) => `'${name}'`));
      throw new Error(`kind must be one of ${known}, got '${kind}'`);
    }
    return at.parseMap(redraw(map.text, [[...place, chars[kind]]]));
  }

  function toggleWall(map, cell, direction) {
    const [row, column] = edgePlace(map, cell, direction);
    const char = map.text.split("\n")[row][column];
    return setEdge(map, cell, direction, "-|".includes(char) ? "open" : "wall");
  }

  const addDoor = (map, cell, direction) => setEdge(map, cell, direction, "door");

  // Move the goal of one room cell to another.
  function moveGoal(map, from, to) {
    const changes = [
      [from, "old", at.GOAL, at.ROOM, "hold a goal"],
      [to, "new", at.ROOM, at.GOAL, "be a room cell without goal"],
    ].map(([cell, name, wanted, char, what]) => {
      const [row, column] = edgePlace(map, cell, "N");
      if (map.cells[cell[0] * map.width + cell[1]] !== wanted) {
        throw new Error(`${name} must ${what}, got cell ${at.tuple(cell)}`);
      }
      return [row + 1, column, char];
    });
    return at.parseMap(redraw(map.text, changes));
  }

  Object.assign(at, { redraw, edgePlace, setEdge, toggleWall, addDoor, moveGoal });
})(globalThis.abstransfer ??= {});
