// Numbers in the story that can be taken hold of: a drag to the side, or keys, do what their slider does.
import { $, make } from "../dom.js";

const travel = 400;  // pixels of the hand for a whole slider
const steps = { ArrowRight: 10, ArrowUp: 10, ArrowLeft: -10, ArrowDown: -10, PageUp: 100, PageDown: -100, Home: -1000, End: 1000 };

/** @param {HTMLElement} story  in which they stand @returns {Record<string, HTMLElement>} by the names of the sliders */
export function makeHandles(story) {
  const sliderOf = (key) => $(`${key}-slider`);
  const set = (key, value) => {
    const slider = sliderOf(key);
    slider.value = Math.round(value);
    slider.dispatchEvent(new Event("input"));
  };
  /** @type {{key: string, x: number, value: number} | null} */
  let held = null;
  const keyOf = (event) => event.target.closest?.(".handle")?.dataset.key;
  story.addEventListener("pointerdown", (event) => {
    const key = keyOf(event);
    if (!key || event.button !== 0) return;
    // The story stays where a number in it may not.
    story.setPointerCapture(event.pointerId);
    held = { key, x: event.clientX, value: Number(sliderOf(key).value) };
  });
  story.addEventListener("pointermove", ({ buttons, clientX }) => {
    if (buttons === 0) held = null;
    if (held) set(held.key, held.value + (1000 * (clientX - held.x)) / travel);
  });
  for (const end of ["pointerup", "lostpointercapture"]) story.addEventListener(end, () => (held = null));
  story.addEventListener("keydown", (event) => {
    const key = keyOf(event);
    if (!key || !steps[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    set(key, Number(sliderOf(key).value) + steps[event.key] * (event.shiftKey ? 0.1 : 1));
  });
  return Object.fromEntries(["slip", "spin"].map((key) => {
    const handle = make("span", { className: "handle", tabIndex: 0, title: "Drag to the side, or use the arrow keys" });
    handle.dataset.key = key;
    for (const [name, value] of Object.entries({ "role": "slider", "aria-label": key, "aria-valuemin": 0, "aria-valuemax": 1000 })) handle.setAttribute(name, String(value));
    return [key, handle];
  }));
}
