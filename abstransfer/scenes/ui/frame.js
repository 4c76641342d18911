// A frame around a picture that may be larger than its place: it scrolls, and shows at
// which sides something is cut off (a scroll bar that lies over the picture says nothing).

import { make } from "./dom.js";

/**
 * Where nothing inside takes the focus, the frame does while something is cut off, or
 * the keyboard could not reach it.
 *
 * @param {any} picture
 * @param {{ label: string, hasStops: boolean }} options
 */
export function frameOf(picture, { label, hasStops }) {
  const frame = make("div", { class: "ab-frame" }, picture);
  function look() {
    const { scrollLeft: left, scrollTop: top, clientWidth, clientHeight } = frame;
    const rest = { right: frame.scrollWidth - clientWidth - left };
    const gaps = { left, top, ...rest, bottom: frame.scrollHeight - clientHeight - top };
    const cut = Object.keys(gaps).filter((side) => gaps[side] >= 1).join(" ");
    if (cut === (frame.dataset.cut ?? "")) return;
    frame.dataset.cut = cut;
    const isNamed = { role: "group", "aria-label": `${label}: scroll to see all of it` };
    const wanted = hasStops ? isNamed : { ...isNamed, tabindex: 0 };
    for (const [name, value] of Object.entries(wanted)) {
      if (cut) frame.setAttribute(name, value);
      else frame.removeAttribute(name);
    }
  }
  frame.addEventListener("scroll", look, { passive: true });
  const observer = new ResizeObserver(look);
  observer.observe(frame);
  observer.observe(picture);
  return frame;
}
