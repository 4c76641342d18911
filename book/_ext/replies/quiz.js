// A quiz: who opens a choice has chosen it; the others of the question close, and the
// choice is kept.  Without this script the choices are the browser's own foldings.

import { keep, kept, onReplaced, pageHere } from "../../../abstransfer/scenes/ui/kept.js";

export function bindQuiz() {
  const quiz = document.querySelector("section#quiz");
  let question = 0;
  for (const node of quiz?.children ?? []) {
    if (node.matches("p") && node.querySelector("strong")) question++;
    if (node.matches("details")) bind(node, quiz, `quiz.${question}`);
  }
}

/**
 * @param {any} choice
 * @param {Element} quiz
 * @param {string} id of the question
 */
function bind(choice, quiz, id) {
  const place = `${quiz.querySelectorAll(`details[name="${id}"]`).length + 1}`;
  const reply = choice.querySelector(".sd-summary-content").textContent.trim();
  const show = () => (choice.open = kept(pageHere(), id) === place);
  choice.name = id; // one is open at a time
  choice.classList.add(reply.startsWith("Yes") ? "quiz-right" : "quiz-wrong");
  choice.addEventListener("toggle", () => {
    if (choice.open) keep(pageHere(), id, place);
    else if (kept(pageHere(), id) === place) keep(pageHere(), id, "");
  });
  onReplaced(show);
  show();
}
