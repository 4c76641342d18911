// Bets of a page: a box whose list of options becomes buttons, and the reply further
// down, where the answer is known.  Without this script both are read as they stand.
//
// A box is an admonition with an id "bet-...", its reply one with "reply-..."; the first
// bold words of the reply are the option that is right.  A box of class "asks-race-bet"
// asks for the scene "race" as well: the scene hears of the bet by events of the box
// (abstransfer/scenes/ui/asked.js), and does not ask again.

import { keep, kept, onReplaced, pageHere } from "../../../abstransfer/scenes/ui/kept.js";
import { make } from "../../../abstransfer/scenes/ui/elements.js";

const SKIP = "skip"; // as scenes call it

const words = (node) => node.textContent.trim().replace(/\.$/, "").toLowerCase();
// What an option says, once more: it may hold a formula.
const copy = (node) => [...node.cloneNode(true).childNodes];

export function bindBets() {
  for (const box of document.querySelectorAll(".admonition[id^='bet-']")) bind(box);
}

/** @param {any} box */
function bind(box) {
  const title = box.querySelector(".admonition-title");
  const list = box.querySelector("ul");
  const question = list.previousElementSibling;
  const reply = document.getElementById(box.id.replace("bet-", "reply-"));
  const scene = /(?:^| )asks-(\w+)-(\S+)/.exec(box.className);
  const id = scene ? `${scene[1]}.${scene[2]}` : box.id.replace("-", ".");

  const options = [...list.children].map((item) =>
    make("span", {}, ...(item.querySelector("p") ?? item).childNodes)
  );
  const names = options.map(words);
  const right = names.indexOf(words(reply.querySelector("strong")));
  if (scene) options.push(make("span", {}, "I do not bet: show me"));
  const buttons = options.map((option, i) => {
    const onclick = () => choose(i < names.length ? `${i}` : SKIP);
    return make("button", { type: "button", class: "bet-option", onclick }, option);
  });
  question.id ||= `${box.id}-question`;
  list.replaceWith(
    make(
      "div",
      { class: "bet-options", role: "group", "aria-labelledby": question.id },
      ...buttons,
    ),
  );
  const placed = make("span", {});
  const change = make("button", { type: "button", class: "bet-change", onclick: open }, "Change");
  const said = make("p", { class: "bet-said" });
  reply.querySelector(".admonition-title").after(said);

  // `value` is the number of an option, "skip", or "" before a bet.
  function show(value) {
    const i = value === SKIP ? names.length : value === "" ? -1 : Number(value);
    const option = options[i];
    box.dataset.bet = option ? value : "";
    box.classList.toggle("bet-folded", Boolean(option));
    buttons.forEach((button, j) => button.setAttribute("aria-pressed", `${i === j}`));
    placed.replaceChildren();
    change.remove();
    said.replaceChildren();
    if (!option) return;
    placed.append(": ", ...(value === SKIP ? ["none"] : copy(option)));
    change.setAttribute("aria-label", `Your bet: ${words(option)}. Change it`);
    title.append(placed, change);
    if (value !== SKIP) {
      said.append("You bet on “", ...copy(option), i === right ? "”: right." : "”.");
    }
  }
  const tell = () => box.dispatchEvent(new Event("abstransfer:bet"));
  function place(value) {
    keep(pageHere(), id, value);
    show(value);
  }
  function choose(value) {
    place(value);
    change.focus();
    tell();
  }
  function open() {
    box.classList.remove("bet-folded");
    change.remove();
    (buttons.find((b) => b.getAttribute("aria-pressed") === "true") ?? buttons[0]).focus();
  }
  // What the scene says: it was reset, or a state was set.
  box.addEventListener("abstransfer:place", ({ detail }) => place(detail));
  onReplaced(() => {
    show(kept(pageHere(), id));
    tell();
  });
  show(kept(pageHere(), id));
}
