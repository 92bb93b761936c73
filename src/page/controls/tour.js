// The tour: steps side by side that scroll. The page shows the step at which scrolling ends.
import { $, isStill, make } from "../dom.js";
import { tour } from "../state/presets.js";

const pause = 120;  // ms

/** @param {Store} store @param go  called with the fragment of a step */
export function makeTour(store, go) {
  const [list, back, on] = ["steps", "step-back", "step-on"].map($);
  let [at, timer, isScrolled] = [0, 0, false];
  const to = (step, /** @type {ScrollBehavior} */ behavior = isStill() ? "instant" : "smooth") => list.scrollTo({ left: step * list.clientWidth, behavior });
  const item = ({ title, text }, i) => make("li", {}, make("h3", { textContent: `${i + 1}. ${title}` }), make("p", { textContent: text }));
  list.append(...tour.map(item));
  // A layout that the browser tries for a moment scrolls, too. Only the reader's scrolling changes the step.
  for (const part of [list, back, on]) for (const event of ["pointerdown", "wheel", "keydown", "click"]) part.addEventListener(event, () => (isScrolled = true), { passive: true });
  list.addEventListener("scroll", () => {
    if (!isScrolled) return;
    clearTimeout(timer);
    timer = setTimeout(() => {
      const step = Math.round(list.scrollLeft / list.clientWidth);
      if (step !== at && tour[step]) go(`${tour[step].fragment}&step=${(at = step)}`);
    }, pause);
  });
  back.addEventListener("click", () => to(at - 1));
  on.addEventListener("click", () => to(at + 1));
  store.shows.push(({ step }) => {
    back.disabled = step === 0;
    on.disabled = step >= tour.length - 1;
    // Scroll at once: a slow machine would pause on the way and show another step.
    if (step === at) return;
    isScrolled = false;
    to(at = step, "instant");
  });
}
