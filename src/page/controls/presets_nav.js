// Links to motions worth seeing, with a sentence about the chosen one below them.
import { $, make, write } from "../dom.js";
import { fromFragment, toFragment } from "../state/page_state.js";
import { presets } from "../state/presets.js";

/** Returns the part of a link that describes the motion. */
const motionOf = (state) => toFragment({ ...state, fraction: 0, isochrone: 0, window: null, step: 0, theme: "auto", embed: false, project: false, lab: false });

/** @param {Store} store @param go  called with the fragment of a preset */
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
