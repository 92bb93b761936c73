// The tour, and links to motions worth seeing.
import { $, isStill, make, write } from "../dom.js";
import { fromFragment, toFragment } from "../state/page_state.js";
import { presets, tour } from "../state/presets.js";

const pause = 120;  // ms

/**
 * Makes the steps, side by side in a list that scrolls. The page shows the step at which scrolling ends.
 * @param {Store} store @param go  called with the fragment of a step
 */
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

/** Returns the part of a link that describes the motion. */
const motionOf = (state) => toFragment({ ...state, fraction: 0, isochrone: 0, window: null, step: 0, theme: "auto", embed: false, project: false, lab: false });

/**
 * Makes the links, with a sentence about the chosen one below them.
 * @param {Store} store @param go  called with the fragment of a preset
 */
export function makePresets(store, go) {
  let chosen = -1;
  const say = (index) => write($("says"), presets[index]?.says ?? "");
  const links = presets.map(({ title, fragment, says }, index) => {
    const link = make("a", { href: `#${fragment}`, textContent: title, title: says });
    link.addEventListener("click", (event) => {
      event.preventDefault();
      go(fragment);
    });
    for (const event of ["pointerenter", "focus"]) link.addEventListener(event, () => say(index));
    for (const event of ["pointerleave", "blur"]) link.addEventListener(event, () => say(chosen));
    return link;
  });
  $("presets").append(...links);
  const motions = presets.map(({ fragment }) => motionOf(fromFragment(fragment, store.library)));
  store.shows.push((state) => {
    chosen = motions.indexOf(motionOf(state));
    links.forEach((link, index) => link.setAttribute("aria-current", String(index === chosen)));
    say(chosen);
  });
}
