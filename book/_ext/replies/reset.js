// One reset for the whole book, before the next class: what a reader bet, answered and
// noted on any page, and what scenes keep, is forgotten.  It asks first, and can be
// undone until the page is left.

import { everything, replace } from "../../../abstransfer/scenes/ui/kept.js";
import { make } from "../../../abstransfer/scenes/ui/elements.js";

export function bindReset() {
  document.querySelector(".reset-book")?.replaceChildren(...parts());
}

function parts() {
  const told = make("p", { class: "ab-reply", role: "status" });
  const act = (words, onclick) => make("button", { type: "button", onclick }, words);
  const first = act("Reset the whole book", ask);
  const yes = act("Yes, forget it", forgetAll);
  const no = act("No, keep it", () => show("Nothing was forgotten.", first));
  const undo = act("Undo the reset", bringBack);
  const buttons = make("div", { class: "ab-answers-tools", role: "group" }, first);
  buttons.setAttribute("aria-label", "Reset the whole book");
  let before = {}; // what a reset took away, by page

  function show(words, ...next) {
    const hadFocus = buttons.contains(document.activeElement);
    told.textContent = words;
    buttons.replaceChildren(...next);
    if (hadFocus) next.at(-1).focus(); // the harmless one
  }
  function ask() {
    const n = Object.keys(everything()).length;
    if (!n) return show("Nothing is kept in this tab.", first);
    const pages = n === 1 ? "one page" : `${n} pages`;
    show(`This tab keeps bets, answers or notes of ${pages}. Forget all of it?`, yes, no);
  }
  function forgetAll() {
    before = everything();
    replace(Object.fromEntries(Object.keys(before).map((page) => [page, {}])));
    show("Bets, answers and notes of all pages are gone.", first, undo);
  }
  function bringBack() {
    const now = everything();
    const pages = Object.entries(before);
    replace(Object.fromEntries(pages.map(([page, all]) => [page, { ...all, ...now[page] }])));
    show("Bets, answers and notes of all pages are back.", first);
  }
  return [buttons, told];
}
