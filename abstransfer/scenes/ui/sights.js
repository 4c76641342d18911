// Features and actions in words: what a robot sees, and goes to.

import { FEATURES, LABELS } from "../engine/navigation.js";
import { list } from "./dom.js";

const KINDS = {
  see_empty_space: "empty space",
  see_door_far: "a door further on",
  see_room: "a door into a room",
  see_corridor: "a door into the corridor",
};
const SIDES = { head_to_goal: "towards the goal", opposite_to_goal: "away from the goal" };
const OTHERS = {
  near_goal: "the goal is near",
  almost_near_goal: "the goal is almost near",
  in_room: "in a room",
};

/**
 * The words of a feature, or of an action: they go by the same names.
 *
 * @param {string} name
 */
export function sight(name) {
  if (OTHERS[name]) return OTHERS[name];
  const kind = Object.keys(KINDS).find((key) => name.startsWith(key));
  return `${KINDS[kind]} ${SIDES[name.slice(kind.length + 1)]}`;
}

/**
 * The words of an abstract state: all that holds.
 *
 * @param {number} z
 */
export const sights = (z) =>
  list(FEATURES.filter((_, bit) => (z >> bit) & 1).map(sight)) || "nothing of the list";

// ... in fewer words, where there is little room.
const SHORT = {
  see_empty_space: "empty space",
  see_door_far: "door far",
  see_room: "room",
  see_corridor: "corridor",
  head_to_goal: "to goal",
  opposite_to_goal: "away",
};
/** @param {number} a */
export const nameOf = (a) => {
  const [, kind, side] = /^(see_.*)_((?:head|opposite)_to_goal)$/.exec(LABELS[a]);
  return `${SHORT[kind]}, ${SHORT[side]}`;
};
