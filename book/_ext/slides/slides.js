// Slides: one at a time, by arrow keys, a remote control's keys, or buttons; the address
// says which.  Without this script they stand one below the other.

const sections = [...document.querySelectorAll("section")];
/** @type {NodeListOf<HTMLButtonElement>} */
const buttons = document.querySelectorAll("nav button");
const dark = matchMedia("(prefers-color-scheme: dark)");
const KEYS = { ArrowRight: 1, PageDown: 1, " ": 1, ArrowLeft: -1, PageUp: -1 };

const here = () => Math.max(0, sections.findIndex(({ id }) => `#${id}` === location.hash));
const isSlide = (i) => i >= 0 && i < sections.length;

function show() {
  const i = here();
  sections.forEach((section, j) => (section.hidden = i !== j));
  document.querySelector("nav output").textContent = `${i + 1} of ${sections.length}`;
  for (const button of buttons) {
    button.setAttribute("aria-disabled", `${!isSlide(i + Number(button.value))}`);
  }
  scrollTo(0, 0);
}
function go(i) {
  if (!isSlide(i)) return;
  history.replaceState(null, "", `#${sections[i].id}`);
  show();
  sections[i].focus({ preventScroll: true }); // read aloud from its title on
}
function follow(event) {
  const { key, target, altKey, ctrlKey, metaKey } = event;
  if (altKey || ctrlKey || metaKey || (key === " " && target.matches("button, a"))) return;
  if (key in KEYS) go(here() + KEYS[key]);
  else if (key === "Home") go(0);
  else if (key === "End") go(sections.length - 1);
  else return;
  event.preventDefault();
}
const paint = () => (document.documentElement.dataset.theme = dark.matches ? "dark" : "light");

document.documentElement.classList.add("one");
addEventListener("keydown", follow);
addEventListener("hashchange", show);
dark.addEventListener("change", paint);
for (const button of buttons) {
  button.addEventListener("click", () => go(here() + Number(button.value)));
}
paint();
show();
