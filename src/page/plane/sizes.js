// The slider of sizes: the chosen start, c times as large. One that leaves the plane flies to the rim of the disc, one that
// vanishes in it into the blown-up origin.
import { pullWords } from "./copies.js";
import { $ } from "../dom.js";
import { forgiveTouches } from "../controls/fields.js";
import { moved } from "../state/page_state.js";

const decades = 4;      // to either end of the slider
const vanished = 0.04;  // of the window: a start so small is looked for in the blown-up origin
const ends = { uv: "", disc: " The circle is infinity.", blowup: " The inner circle is rest." };
const round = (value) => Number(value.toPrecision(6));

/** @param {import("../state/store.js").Store} store @returns show(): where the slider is; from: {base, stop} of the start that it has made larger, if it has */
export function makeSizes(store, ask, announce) {
  const slider = $("size");
  /** @type {{base: Speeds, at: Speeds, window: number[], stop: number} | null} what it began with, and where it has brought it */
  let sized = null;
  slider.addEventListener("input", () => {
    const { orbit, motion, portrait } = store;
    if (!orbit) return;
    const { base, window, stop } = sized ??= { base: { u: orbit.u, v: orbit.v }, at: orbit, window: portrait.window, stop: motion.stop };
    const c = 10 ** ((decades * Number(slider.value)) / 1000);
    const at = { u: round(c * base.u), v: round(c * base.v) };
    const share = Math.max(Math.abs(at.u) / window[0], at.v / window[1]);
    const view = share > 1 ? "disc" : share < vanished ? "blowup" : "uv";
    ask((state) => {
      state.orbits[state.chosen] = moved(state.orbits[state.chosen], at.u, at.v);
      Object.assign(state, { view, window, fraction: 0, isochrone: 0 });
      sized = { base, at, window, stop };
    }, () => announce(pullWords({ c, along: true }, stop, store.motion.stop, store) + ends[view]));
  });
  forgiveTouches(slider);
  const show = () => {
    slider.disabled = !store.orbit;
    if (sized && store.orbit && sized.at.u === store.orbit.u && sized.at.v === store.orbit.v) return;
    sized = null;
    slider.value = 0;
  };
  return { show, get from() { return sized; } };
}
