// The exercises of a built page: a box for each, and what resets, saves and loads them.

import { make } from "../../scenes/ui/elements.js";
import { everything, forget, pageHere, replace } from "../../scenes/ui/kept.js";
import { showBox } from "./box.js";
import { asText, fromText } from "./file.js";

const FILE = "my-answers.txt";

for (const data of document.querySelectorAll(".ab-answer > script")) {
  showBox(data.parentElement, JSON.parse(data.textContent));
}
document.getElementById("exercises")?.append(tools());

function tools() {
  const told = make("p", { class: "ab-reply", role: "status" });
  const say = (words) => told.textContent = words;
  let before = null; // what a reset took away

  const reset = make("button", { type: "button", onclick: onReset }, "");
  function nameReset() {
    reset.textContent = before ? "Undo the reset" : "Reset this page";
  }
  function onReset() {
    const page = pageHere();
    const now = { [page]: everything()[page] ?? {} };
    if (before) {
      replace({ [page]: { ...before[page], ...now[page] } });
      say("Your bets, answers and notes are back.");
    } else {
      forget(page);
      say("Bets, answers and notes of this page are gone.");
    }
    before = before ? null : now;
    nameReset();
  }

  function onSave() {
    const pages = everything();
    const text = new Blob([asText(pages)], { type: "text/plain" });
    const link = make("a", { href: URL.createObjectURL(text), download: FILE });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
    say(`Saved as ${FILE}: ${counted(pages)}.`);
  }

  const file = make("input", { type: "file", accept: ".txt,text/plain", hidden: true });
  file.addEventListener("change", async () => {
    const pages = fromText(await file.files[0].text());
    file.value = "";
    if (!Object.keys(pages).length) return say("This file holds nothing that was saved here.");
    replace(pages);
    say(`Loaded: ${counted(pages)}.`);
  });

  nameReset();
  return make(
    "div",
    { class: "ab-answers-tools", role: "group", "aria-label": "What you bet, answered and noted" },
    make("p", {}, "What you bet, answer and note stays in this tab, and is sent to nobody."),
    reset,
    make("button", { type: "button", onclick: onSave }, "Save my answers"),
    make("button", { type: "button", onclick: () => file.click() }, "Load"),
    file,
    told,
  );
}

function counted(pages) {
  const n = Object.values(pages).flatMap(Object.keys).length;
  const m = Object.keys(pages).length;
  return `${n} ${n === 1 ? "entry" : "entries"} of ${m} ${m === 1 ? "page" : "pages"}`;
}
