// What the reader sets: what moves and what the plane shows, the sliders, and the values of a real ball.
import { makeBallCard } from "./ball_card.js";
import { makeChoices } from "./choices.js";
import { makeSliders } from "./sliders.js";

/**
 * @param {import("../state/store.js").Store} store
 * @param {import("../plane/plane.js").Plane} plane
 * @param act  ask(edit) and attempt(action), which tell the reader what is rejected
 * @returns {() => void} shows the state
 */
export function makeControls(store, plane, act) {
  const shows = [makeChoices, makeSliders, makeBallCard].map((make) => make(store, plane, act));
  return () => shows.forEach((show) => show());
}
