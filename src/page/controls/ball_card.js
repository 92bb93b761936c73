// The card of a real ball: its values, and those of its motion that the plane knows nothing of.
import { $, make, write } from "../dom.js";
import { shown } from "../numbers.js";

const patchTitles = { patch_radius: "its radius ε (m)", spin_deceleration: "spin deceleration (rad/s²)", whole_face: "its whole face" };
const ballLabels = { radius: "radius R (m)", mass: "mass m (kg)", friction: "friction f", gravity: "gravity g (m/s²)" };
const motionLabels = {
  patch: "patch", along: "centre: along the slip (m/s)", across: "across it (m/s)", rollingFriction: "rolling friction (pool: 0.01)",
  slope: "slope (degrees; downhill < 0)",
};

/** As makeChoices. */
export function makeBallCard(controls, store) {
  /** The ball, or of what the chosen orbit owns the orbit, if there is one. */
  const ownerOf = (key, { ball, orbits, chosen }) => (key in ball ? ball : orbits[chosen]);
  const isHidden = (key, { state: { ball }, body }) =>
    !ball || (key === "patch" && ball.patchBy === "whole_face") || (/^(along|across|rolling)/.test(key) && body.chi === 1);
  const add = (labels) => Object.entries(labels).forEach(([key, label]) => controls.number($("ball-fields"), key, label,
    (store) => (isHidden(key, store) ? undefined : ownerOf(key, store.state)?.[key]),
    (state, value) => {
      // The spin in rad/s stays.
      if (key === "radius") for (const orbit of state.orbits) orbit.u *= value / state.ball.radius;
      ownerOf(key, state)[key] = value;
    }));
  add(ballLabels);
  const patchBy = make("select", { id: "patch-by" });
  $("ball-fields").append(make("label", {}, "patch known by", patchBy));
  controls.choose("patch-by", patchTitles, ({ ball }) => ball?.patchBy ?? "", (state, by) => {
    const { patchRadius, spinDeceleration } = store.contact;
    const patch = Number((by === "spin_deceleration" ? spinDeceleration : patchRadius).toPrecision(12));
    Object.assign(state.ball, { patchBy: by, patch });
  });
  add(motionLabels);
  controls.shows.push(() => {
    const { state, state: { ball }, body, contact } = store;
    $("ball-card").hidden = !ball;
    if (!ball || !contact) return;
    write($("ball-title"), ball.title);
    // A puck rests on its whole face, a stone on a band, and neither rolls.
    patchBy.options[patchBy.options.length - 1].disabled = body.mu === undefined;
    write($("ball-facts"), `Patch radius ${shown(1000 * contact.patchRadius, 4)} mm, μ = ${shown(state.mu, 5)}. ${ball.sources}`);
  });
}
