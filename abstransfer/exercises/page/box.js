// The box of an exercise: a field, lines to choose from, or a place for notes.

import { make, newId } from "../../scenes/ui/elements.js";
import { keep, kept, onReplaced, pageHere } from "../../scenes/ui/kept.js";
import { makeJudge } from "./judge.js";

/** @import { Lines, Open, Reply, Task, Value } from "./types.d.ts" */

const MARKED = /`([^`]+)`|\*([^*`\s][^*`]*)\*/g;
const EXAMPLE = {
  numbers: "a number or a formula, such as 1/(1 - 0.9)",
  word: "a word",
  letters: "letters, such as A and C",
};

/**
 * Words in which code and stress are marked, as nodes.
 *
 * @param {string} words
 * @returns {any[]}
 */
export function marked(words) {
  const nodes = [];
  let end = 0;
  for (const { 0: found, 1: code, 2: stressed, index } of words.matchAll(MARKED)) {
    nodes.push(words.slice(end, index), make(code ? "code" : "em", {}, code ?? stressed));
    end = index + found.length;
  }
  return [...nodes, words.slice(end)];
}

/**
 * Put the box of an exercise into an element of its page.
 *
 * @param {HTMLElement} element
 * @param {Task | Open} task
 */
export function showBox(element, task) {
  const page = pageHere();
  const store = {
    keep: (name, value) => keep(page, task.id + name, value),
    kept: (name) => kept(page, task.id + name),
  };
  const { node, show } = task.kind === "open" ? notes(store) : question(element, task, store);
  if (task.kind === "lines") hideStub(element.parentElement, task.code);
  element.append(node);
  show();
  onReplaced(show);
}

/**
 * On the screen the box shows the code with its blanks: once is enough.
 *
 * @param {HTMLElement} exercise
 * @param {string} code
 */
function hideStub(exercise, code) {
  const head = code.split("\n")[0];
  for (const pre of exercise.querySelectorAll("pre")) {
    const block = pre.closest("[class*=highlight-]") ?? pre; // it has a ground of its own
    if (pre.textContent.startsWith(head)) block.classList.add("ab-in-box");
  }
}

function notes(store) {
  const id = newId();
  const field = make("textarea", { id, rows: 4, oninput: () => store.keep("", field.value) });
  const title = make("label", { for: id }, "Your notes, kept in this tab only");
  const node = make("div", { class: "ab-ask" }, title, field);
  return { node, show: () => (field.value = store.kept("")) };
}

/**
 * @param {HTMLElement} element
 * @param {Task} task
 * @param {any} store
 */
function question(element, task, store) {
  const judge = makeJudge(task);
  const answer = task.kind === "lines" ? lines(task, store) : field(task, store);
  const reply = make("p", { class: "ab-reply", role: "status" });
  /** @param {Reply} [said] */
  function say(said) {
    reply.dataset.verdict = said?.name ?? "";
    if (!said) return reply.replaceChildren();
    const verdict = said.name[0].toUpperCase() + said.name.slice(1);
    reply.replaceChildren(make("strong", {}, `${verdict}.`), " ", ...marked(said.text));
  }
  function submit(event) {
    event.preventDefault();
    say(
      answer.isEmpty() ? { name: "no answer yet", text: answer.ask } : judge.reply(answer.read()),
    );
  }
  // What was right before is right still; what was not is not judged again unasked.
  function show() {
    answer.show();
    const isRight = !answer.isEmpty() && judge.isRight(answer.read());
    say(isRight ? judge.reply(answer.read()) : undefined);
  }
  const button = make("button", { type: "submit" }, "Check");
  const node = make("form", { class: "ab-ask", onsubmit: submit }, answer.node, button, reply);
  for (const [i, hint] of hintsOf(element).entries()) {
    hint.addEventListener("toggle", () => hint.open && judge.sawHint(i + 1));
  }
  return { node, show };
}

/**
 * The foldings with the hints of the box: each lies inside the one before it.
 *
 * @param {HTMLElement} element
 * @returns {HTMLDetailsElement[]}
 */
function hintsOf(element) {
  const first = element.nextElementSibling;
  if (!(first instanceof HTMLDetailsElement)) return [];
  return [first, ...first.querySelectorAll("details")];
}

/**
 * @param {Value} task
 * @param {any} store
 */
function field({ task, kind }, store) {
  const id = newId();
  const input = make("input", {
    id,
    type: "text",
    autocomplete: "off",
    autocapitalize: "none",
    spellcheck: "false",
    placeholder: EXAMPLE[kind] ?? EXAMPLE.numbers,
    oninput: () => store.keep("", input.value),
  });
  return {
    node: make("div", {}, make("label", { for: id }, ...marked(task)), input),
    ask: "Write your answer into the field.",
    isEmpty: () => !input.value.trim(),
    read: () => input.value,
    show: () => (input.value = store.kept("")),
  };
}

/**
 * @param {Lines} task
 * @param {any} store
 */
function lines({ code, blanks }, store) {
  const names = Object.keys(blanks);
  const shown = Object.fromEntries(names.map((name) => [name, make("b", {})]));
  const chosen = {};
  const parts = code.trimEnd().split(/\{(\w+)\}/).map((part, i) => i % 2 ? shown[part] : part);
  const choices = names.map((name, i) =>
    choice(blanks[name], title(i), (line) => {
      store.keep(`.${name}`, line);
      put(name, line);
    })
  );
  function title(i) {
    return names.length > 1 ? `Blank ${i + 1}` : "The blank";
  }
  function put(name, line) {
    chosen[name] = line;
    shown[name].textContent = line || ` ${title(names.indexOf(name)).toLowerCase()} `;
  }
  return {
    node: make("div", {}, make("pre", { tabindex: 0 }, ...parts), choices.map(({ node }) => node)),
    ask: "Choose a line for each blank.",
    isEmpty: () => names.some((name) => !chosen[name]),
    read: () => chosen,
    show: () => names.forEach((name, i) => put(name, choices[i].set(store.kept(`.${name}`)))),
  };
}

function choice(offered, legend, onChoose) {
  const name = newId();
  const inputs = offered.map(([line]) =>
    make("input", { type: "radio", name, value: line, onchange: () => onChoose(line) })
  );
  const labels = inputs.map((input) => make("label", {}, input, make("code", {}, input.value)));
  return {
    node: make("fieldset", {}, make("legend", {}, legend), labels),
    /** Choose a line, or none; return which. */
    set(line) {
      inputs.forEach((input) => (input.checked = input.value === line));
      return inputs.some((input) => input.checked) ? line : "";
    },
  };
}
