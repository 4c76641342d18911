// A time line over one number of a scene's state: to the start, back, play, step, to
// the end, scrub.  Nothing plays by itself; a reader who asks for less motion sees
// single steps at a slow pace.

import { button, noted, slider } from "./controls.js";
import { count, drawn, make } from "./dom.js";

/** @import { Scene, TimelineOptions } from "../types.d.ts" */

const CALM = 2; // steps a second at most, without motion
const FRAME = 30; // pictures a second at most
const ICONS = {
  start: "M2 2V14M13 2L5 8L13 14Z",
  back: "M12 2L4 8L12 14Z",
  play: "M4 2L13 8L4 14Z",
  pause: "M4 2H7V14H4ZM9 2H12V14H9Z",
  step: "M4 2L12 8L4 14Z",
  end: "M3 2L11 8L3 14ZM14 2V14",
};

/**
 * `speeds` are steps a second; `moments` are places that "next" jumps to, if given:
 * { label, find(t) -> the next such t, or null }.
 *
 * @param {Scene} scene
 * @param {string} name
 * @param {TimelineOptions} options
 */
export function timeline(scene, name, options = {}) {
  const { label = "Step", format = count, speeds = [2, 8, 30], moments } = options;
  const icon = (kind) =>
    drawn(
      "svg",
      { class: "ab-icon", viewBox: "0 0 16 16", "aria-hidden": "true" },
      drawn("path", { d: ICONS[kind] }),
    );
  const iconButton = (kind, label, act) => button(icon(kind), act, { label });
  let timer = null;
  let perSecond = speeds[Math.min(1, speeds.length - 1)];

  const bounds = () => scene.limits[name];
  const now = () => scene.state[name];
  const go = (t) => scene.set({ [name]: t });

  function pause() {
    clearInterval(timer);
    timer = null;
    showPlay();
  }
  function play() {
    if (now() >= bounds()[1]) go(bounds()[0]);
    const rate = scene.calm ? Math.min(perSecond, CALM) : perSecond;
    const [time, first] = [performance.now(), now()];
    let last = first;
    timer = setInterval(() => {
      if (now() !== last) return pause(); // a reset, a link or Python moved it
      const t = first + Math.floor((rate * (performance.now() - time)) / 1000);
      if (t !== last) go(t);
      last = now();
      if (t >= bounds()[1]) pause();
    }, 1000 / Math.min(rate, FRAME));
    showPlay();
  }
  const jump = (t) => {
    if (timer) pause();
    go(t);
  };

  const start = iconButton("start", "To the start", () => jump(bounds()[0]));
  const back = iconButton("back", "One step back", () => jump(now() - 1));
  const playing = button(icon("play"), () => (timer ? pause() : play()), {
    primary: true,
    label: "Play",
  });
  const step = iconButton("step", "One step", () => jump(now() + 1));
  const end = iconButton("end", "To the end", () => jump(bounds()[1]));
  const next = moments && button(moments.label, () => {
    const t = moments.find(now());
    if (t !== null) jump(t);
  });
  const speed = make(
    "select",
    {
      "aria-label": "Speed",
      onchange: (event) => {
        perSecond = Number(event.target.value);
        if (timer) (pause(), play());
      },
    },
    speeds.map((each) =>
      make("option", { value: each, selected: each === perSecond }, `${each} a second`)
    ),
  );
  const scrub = slider({ label, format, onInput: jump });
  function showPlay() {
    const name = timer ? "Pause" : "Play";
    playing.node.replaceChildren(icon(name.toLowerCase()), name);
    playing.rename(name);
  }
  scene.control(name, (t, [low, high]) => {
    scrub.set(t, [low, high]);
    for (const each of [start, back]) each.enable(t > low);
    for (const each of [step, end]) each.enable(t < high);
    next?.enable(moments.find(t) !== null);
  });
  scene.onLeave(pause);
  scene.onReset(pause);
  showPlay();
  const node = make(
    "div",
    { class: "ab-timeline", role: "group", "aria-label": "Time line" },
    make(
      "div",
      { class: "ab-row" },
      [start, back, playing, step, end, next].map((b) => b?.node),
      speed,
    ),
    scrub.node,
  );
  return noted(scene, name, node);
}
