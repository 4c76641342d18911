// What a scene is, and how it comes to live in an element; README.md has the contract.
// The file of a scene ends in `defineScene(name, spec)`.

import { learnAll } from "../engine/workers.js";
import { bind, button } from "./controls.js";
import { make } from "./dom.js";
import { lecture } from "./lecture.js";
import * as address from "./state.js";
import { dropBets, shell as makeShell } from "./texts.js";

/** @import { Own, Scene, Spec, State } from "../types.d.ts" */

const PAUSE = 400; // milliseconds between two changes of the URL
const SORRY = "What was asked for cannot be shown: the scene began at its start.";

/**
 * Define the one scene of a bundle: hand its `render` to the widget, or let it live in
 * the elements of the page that wait for it.
 *
 * @param {string} name
 * @param {Own} own
 */
export function defineScene(name, own) {
  const spec = withState(own);
  python.mount = (element, ...more) => mount(element, name, spec, ...more);
  python.render = renderer(name, spec);
  if (!python.isWidget) mountAll(name, spec);
}

/**
 * @param {Own} own
 * @returns {Spec}
 */
function withState(own) {
  const { fields } = python.spec;
  const of = (get) =>
    Object.fromEntries(Object.entries(fields).map(([name, field]) => [name, get(field)]));
  const local = Object.keys(fields).filter((name) => fields[name].isLocal);
  return {
    ...own,
    fields,
    state: of(({ start }) => start),
    limits: of(({ bounds }) => bounds),
    local,
  };
}

// A control that hides itself hands the focus to the next one: the keyboard keeps its
// place.
const isSeen = (element) => element.getClientRects().length > 0;
function nextTo(element, shell) {
  const stops = [...shell.querySelectorAll('button, input, select, summary, [tabindex="0"]')];
  const isAfter = (stop) =>
    element.compareDocumentPosition(stop) & Node.DOCUMENT_POSITION_FOLLOWING;
  return stops.find((stop) => isAfter(stop) && isSeen(stop));
}

/** @type {(selector: string) => NodeListOf<HTMLElement>} */
const htmlOf = (selector) => document.querySelectorAll(selector);

/**
 * Ids are unique on a page: the second race is "race-2".
 *
 * @param {HTMLElement} element
 * @param {string} name
 */
function idOf(element, name) {
  const others = [...htmlOf("[data-ab-id]")]
    .filter((other) => other !== element)
    .map((other) => other.dataset.abId);
  let [id, n] = [name, 1];
  while (others.includes(id)) id = `${name}-${++n}`;
  return (element.dataset.abId = id);
}

/**
 * Mount a scene.  `onChange(changes)` hears of each change made in the page;
 * `url: false` keeps the state out of the address.
 *
 * A scene that fails in a state that an address or Python asks for is mounted again as
 * it is at the start, and says so; one that fails at its start throws.
 *
 * @param {HTMLElement} element
 * @param {string} name
 * @param {Spec} spec
 * @param {State} options
 * @param {{ onChange?: (changes: State) => void, url?: boolean }} more
 */
export function mount(element, name, spec, options = {}, { onChange, url = true } = {}) {
  try {
    return mountOnce(element, name, spec, options, { onChange, url });
  } catch (error) {
    console.warn(error);
    return mountOnce(element, name, spec, {}, { onChange, url, sorry: SORRY });
  }
}

/**
 * `sorry`, if there is any, is said until a reset or another address; the address of
 * now is not read then.
 *
 * @param {HTMLElement} element
 * @param {string} name
 * @param {Spec} spec
 * @param {State} options
 * @param {{ onChange?: (changes: State) => void, url: boolean, sorry?: string }} more
 */
function mountOnce(element, name, spec, options, { onChange, url, sorry = "" }) {
  const id = idOf(element, name);
  const store = address.makeState(spec, options);
  let addressed = address.addressOf(id); // what was read or written last
  const calmQuery = matchMedia("(prefers-reduced-motion: reduce)");
  const controls = []; // { name, show(value, bounds) }
  const [leaving, resetting] = [[], []];
  let odd = ""; // what the address asks for in vain
  const changed = new Set(Object.keys(spec.state));
  let [paint, frame, timer, job, isLeft] = [null, null, null, null, false];

  function note(names, isOurs) {
    if (!names.length) return;
    names.forEach((each) => changed.add(each));
    if (isOurs) {
      onChange?.(Object.fromEntries(names.map((each) => [each, store.values[each]])));
    }
    if (url) timer ??= setTimeout(writeUrl, PAUSE);
    redraw();
  }
  function writeUrl() {
    timer = clearTimeout(timer) ?? null;
    if (isLeft) return;
    // A link was followed in this very moment: the scene follows first.
    if (addressed === address.addressOf(id)) address.toUrl(id, spec, store);
    else timer = setTimeout(writeUrl, PAUSE);
    addressed = address.addressOf(id);
  }
  function redraw() {
    if (paint && !isLeft) frame ??= requestAnimationFrame(drawNow);
  }
  function drawNow() {
    frame = cancelAnimationFrame(frame) ?? null;
    const names = new Set(changed);
    changed.clear();
    const focused = shell.contains(document.activeElement) ? document.activeElement : null;
    paint(store.values, names);
    me.warn(store.problems, `${sorry} ${odd}`.trim());
    for (const { name: of, show } of controls) show(store.values[of], store.limits[of]);
    const isLost = focused?.isConnected && !isSeen(focused);
    const isElsewhere = document.activeElement !== focused &&
      shell.contains(document.activeElement);
    if (isLost && !isElsewhere) nextTo(focused, shell)?.focus();
  }
  function stop() {
    job?.stop();
    job = null;
  }
  // Workers; a new call stops the last one.
  function learn(jobs, { onWindow, onDone, ...rest }) {
    stop();
    const after = (f) => (...found) => (f?.(...found), redraw());
    const mine = learnAll(jobs, { onWindow: after(onWindow), onDone: after(onDone), ...rest });
    job = mine;
    const finished = mine.finished.then((isDone) => {
      if (job === mine) job = null;
      redraw();
      return isDone;
    });
    return { ...mine, finished };
  }

  const body = make("div", { class: "ab-body" });
  /** @type {any} */
  const me = {
    id,
    spec,
    el: element,
    learn,
    stop,
    redraw,
    state: store.values,
    get calm() {
      return calmQuery.matches;
    },
    get isLearning() {
      return job !== null && job !== undefined;
    },
    set: (changes) => note(store.set(changes), true),
    limit: (of, bounds) => {
      note(store.limit(of, bounds), true);
      redraw();
    },
    limits: store.limits,
    parts: {},
    add: (...nodes) => body.append(...nodes.flat()),
    row: (...nodes) => make("div", { class: "ab-row" }, ...nodes),
    onLeave: (f) => leaving.push(f),
    onReset: (f) => resetting.push(f),
    control: (of, show) => controls.push({ name: of, show }),
  };
  function reset() {
    stop();
    resetting.forEach((f) => f());
    dropBets(me);
    sorry = "";
    store.reset();
    note(Object.keys(spec.state), true); // all is drawn anew, as at the start
    me.say("The scene is as it was at the start.");
  }
  // What the address asks for: also that there is nothing any more, after a step back.
  function fromUrl() {
    const found = url && address.fromUrl(id, spec);
    addressed = address.addressOf(id);
    if (found || (url && !location.hash)) {
      sorry = "";
      odd = forLecture.follow(found ?? {});
      note(store.set({ ...linkable(store.start), ...found }), true);
      redraw(); // there may be something to say of what was refused
    }
    return found;
  }
  function follow() {
    me.open(); // the reader asked for it
    fromUrl();
  }
  const linkable = (values) =>
    Object.fromEntries(Object.entries(values).filter(([of]) => !spec.local?.includes(of)));
  function leave() {
    if (isLeft) return;
    isLeft = true;
    stop();
    leaving.forEach((f) => f());
    clearTimeout(timer);
    cancelAnimationFrame(frame);
    removeEventListener("hashchange", follow);
    removeEventListener("pagehide", stop);
    removeEventListener("pageshow", redraw);
    shell.remove();
    element.classList.remove("ab-live");
    delete element.dataset.abId;
  }

  const forLecture = lecture(me, element);
  const shell = makeShell(me, body, [forLecture.node, button("Reset", reset).node]);
  let linked = null;
  try {
    bind(me);
    paint = spec.build(me);
    linked = sorry ? null : fromUrl();
    element.append(shell);
    drawNow();
  } catch (error) {
    leave();
    throw error;
  }
  element.classList.add("ab-live"); // hides the still picture, but in print
  addEventListener("hashchange", follow);
  addEventListener("pagehide", stop);
  addEventListener("pageshow", redraw);
  if (linked) element.scrollIntoView();
  return { scene: me, set: (changes) => note(store.set(changes), false), reset, leave };
}

/**
 * @param {string} name
 * @param {Spec} spec
 */
function mountAll(name, spec) {
  const waiting = `.abstransfer-scene[data-scene="${name}"]:not(.ab-live)`;
  for (const element of htmlOf(waiting)) {
    try {
      mount(element, name, spec, JSON.parse(element.dataset.options ?? "{}"));
    } catch (error) {
      console.error(error); // the still picture stays
      element.querySelector(".ab-scene")?.remove();
    }
  }
}

/**
 * What a widget's module exports: traits and state under the same names.
 *
 * @param {string} name
 * @param {Spec} spec
 */
function renderer(name, spec) {
  return function render({ model, el }) {
    // JupyterLab takes arrow keys for commands to its cells, unless the very element
    // that has the focus tells it not to.
    el.addEventListener("focusin", ({ target }) => {
      target.dataset.lmSuppressShortcuts = "true";
    });
    const names = Object.keys(spec.state);
    const host = make("div", { class: "abstransfer-scene" });
    el.append(host);
    const options = Object.fromEntries(names.map((each) => [each, model.get(each)]));
    let timer = null;
    const unsent = new Set(); // what Python repeats of these is older
    const send = () => {
      timer = null;
      unsent.clear();
      model.save_changes();
    };
    const mounted = mount(host, name, spec, options, {
      url: false,
      onChange(changes) {
        for (const [each, value] of Object.entries(changes)) {
          unsent.add(each);
          model.set(each, value);
        }
        timer ??= setTimeout(send, 100);
      },
    });
    const hear = names.map((each) => {
      const tell = () => unsent.has(each) || mounted.set({ [each]: model.get(each) });
      model.on(`change:${each}`, tell);
      return () => model.off(`change:${each}`, tell);
    });
    return () => {
      hear.forEach((forget) => forget());
      mounted.leave();
    };
  };
}
