// What a scene says: the frame around it, the live region, the closing sentence, the
// table of its numbers, and bets.

import { askedByPage } from "./asked.js";
import { make } from "./dom.js";
import { keep, kept, onReplaced, pageHere } from "./kept.js";

/** @import { Scene } from "../types.d.ts" */

const PAUSE = 1000; // milliseconds between two sentences

/**
 * The frame: a group with a name, the body, and what all scenes end in.
 *
 * @param {Scene} scene
 * @param {HTMLElement} body
 * @param {HTMLElement[]} below buttons at its foot
 */
export function shell(scene, body, below) {
  const live = make("p", { class: "ab-hidden ab-said", role: "status", "aria-live": "polite" });
  const closing = make("p", { class: "ab-closing", hidden: true });
  const table = make("div", {
    class: "ab-scroll",
    tabindex: 0,
    role: "region",
    "aria-label": "Numbers",
  });
  const twin = make(
    "details",
    { class: "ab-twin", ontoggle: () => fillTwin() },
    make("summary", {}, "The numbers behind the picture"),
    table,
  );
  const warning = make("p", { class: "ab-now", hidden: true });
  let rows = null;
  let next = null;
  let timer = null;
  let told = "";

  function speak() {
    timer = next === null ? null : setTimeout(speak, PAUSE);
    if (next !== null) live.textContent = next;
    next = null;
  }
  // One sentence a second at most; the last one wins.
  // What comes by itself, before the reader has come, is read in its place.
  let isOpen = false;
  scene.open = () => (isOpen = true);
  scene.say = (sentence) => {
    if (!isOpen) return;
    next = sentence;
    timer ??= setTimeout(speak, 50);
  };
  scene.onLeave(() => clearTimeout(timer));

  scene.close = (sentence) => {
    const text = sentence || "";
    if (text === told) return;
    // What is no longer so is not said any more.
    if (next === told) next = null;
    if (live.textContent === told) live.textContent = "";
    told = text;
    closing.hidden = !text;
    closing.textContent = text;
    if (text) scene.say(text);
  };

  // Say that a state was refused, which values were, and why; read aloud when it changes.
  scene.warn = (problems, sorry) => {
    const all = Object.entries(problems).map(([name, why]) => `“${name}” stays as it was: ${why}.`);
    const text = [sorry, ...all].filter(Boolean).join(" ");
    if (text === warning.textContent) return;
    warning.textContent = text;
    warning.hidden = !text;
    if (text) scene.say(text);
  };

  function fillTwin() {
    if (!twin.open || !rows) return;
    const { caption, head, rows: lines } = rows();
    const cells = (tag, line) => line.map((text) => make(tag, {}, `${text}`));
    table.replaceChildren(
      make(
        "table",
        {},
        make("caption", {}, caption),
        make("thead", {}, make("tr", {}, head.map((text) => make("th", { scope: "col" }, text)))),
        make(
          "tbody",
          {},
          lines.map(([first, ...rest]) =>
            make("tr", {}, make("th", { scope: "row" }, `${first}`), cells("td", rest))
          ),
        ),
      ),
    );
  }
  scene.twin = (f) => {
    rows = f;
    fillTwin();
  };

  const foot = make("div", { class: "ab-row ab-foot" }, below);
  const node = make(
    "div",
    { class: "ab-scene", role: "region", "aria-label": `Scene: ${scene.spec.title}` },
    warning,
    body,
    closing,
    foot,
    twin,
    live,
  );
  // On a phone what is said is seen as well, at the rim, while the scene is handled: a
  // control and what it moves may be a screen apart.
  const handle = ({ target }) => {
    const isHere = node.contains(target);
    node.classList.toggle("ab-handled", isHere);
    if (isHere) scene.open();
  };
  for (const kind of ["pointerdown", "focusin", "input"]) {
    document.addEventListener(kind, handle);
    scene.onLeave(() => document.removeEventListener(kind, handle));
  }
  return node;
}

// ---- bets: kept in this tab, told to nobody

const idOf = (scene, name) => `${scene.id}.${name}`;
const SKIP = "I do not bet: show me";

// A bet that is placed is one line: the picture that it is about comes nearer.  Who
// chooses by arrow keys has placed it on leaving.
function folded(scene, choice, options) {
  let isOpen = false;
  const words = make("span", {});
  const change = scene.button("Change", () => {
    isOpen = true;
    scene.redraw();
  });
  const line = make("p", {}, words, " ", change);
  choice.addEventListener("focusout", ({ relatedTarget }) => {
    if (choice.contains(relatedTarget)) return;
    isOpen = false;
    scene.redraw();
  });
  choice.addEventListener("click", ({ detail }) => detail && (isOpen = false));
  return [line, (value) => {
    const isFolded = Boolean(value) && !isOpen && !choice.querySelector(":focus-visible");
    const wasFolded = choice.hidden;
    [choice.hidden, line.hidden] = [isFolded, !isFolded];
    words.textContent = options[value] ? `You bet on “${options[value]}”.` : "You did not bet.";
    if (wasFolded && isOpen) choice.querySelector(":checked").focus();
  }];
}

/** @param {Scene} scene */
export function bindBets(scene) {
  const bets = (scene.bets = {});
  scene.bet = (name, { question, options }) => {
    bets[name] = options;
    scene.limits[name] = ["", ...Object.keys(options), "skip"];
    const asked = askedByPage(scene, name, { question, options });
    if (asked) {
      scene.control(name, asked.set);
      return asked.node;
    }
    const choice = scene.choice(name, { label: question, options: { ...options, skip: SKIP } });
    const before = () => kept(pageHere(), idOf(scene, name));
    if (before() && !scene.state[name]) scene.set({ [name]: before() });
    scene.onLeave(onReplaced(() => scene.set({ [name]: before() })));
    const [placed, show] = folded(scene, choice, options);
    scene.control(name, (value) => {
      keep(pageHere(), idOf(scene, name), value);
      show(value);
    });
    return make("div", { class: "ab-bet" }, choice, placed);
  };
  // What became of a bet; `other` says what it was about, where that is not shown now.
  scene.betResult = (name, truth, other = "") => {
    const bet = scene.state[name];
    if (!bet || bet === "skip") return "";
    const text = (option) => bets[name][option] ?? option;
    if (other) return `Your bet, “${text(bet)}”, is about ${other}.`;
    if (bet === truth) return `You bet on “${text(bet)}”: right.`;
    return `You bet on “${text(bet)}”; it was “${text(truth)}”.`;
  };
}

/** @param {Scene} scene */
export const dropBets = (scene) => {
  for (const name of Object.keys(scene.bets ?? {})) keep(pageHere(), idOf(scene, name), "");
};
