// The sliders: slip and spin of the chosen orbit, friction and patch.
import { $, write } from "../dom.js";
import { forgiveTouches, numberField, slider } from "./fields.js";
import { shown } from "../numbers.js";
import { moved, requireAllowed } from "../state/page_state.js";

const smallestMu = 1e-3;
const mostFriction = 1.2;
const fractionToMu = (fraction, largest) => Number((largest * (smallestMu / largest) ** (1 - fraction)).toPrecision(3));
const muToFraction = (mu, largest) => 1 - Math.log(mu / largest) / Math.log(smallestMu / largest);
const round = (value) => Number(value.toPrecision(3));

/** As makeChoices. */
export function makeSliders(store, plane, { ask }) {
  const { balls } = store.library;
  const move = (state, edit) => {
    const orbit = state.orbits[state.chosen];
    const { u, v } = { ...orbit, ...edit(orbit) };
    state.orbits[state.chosen] = moved(orbit, u, v);
  };
  /** What the sliders of slip and spin go to: they do not move under the reader's hand. */
  const largest = ({ ball }) => {
    const built = balls.find(({ name }) => name === ball?.name);
    return built ? { v: Math.max(2, 2 * built.slip), spin: 500 } : { v: 5, spin: 5 };
  };
  const slip = slider("slip", "slip", (fraction) => ask((state) => {
    move(state, () => ({ v: round(Math.max(fraction, 0.01) * largest(state).v) }));
    plane.zooming.freeze(state);
  }));
  const spin = slider("spin", "spin", (fraction) => ask((state) => {
    const value = round(fraction * largest(state).spin);
    move(state, ({ u }) => ({ u: (u < 0 ? -1 : 1) * value * (state.ball?.radius ?? 1) }));
    plane.zooming.freeze(state);
  }));
  const friction = slider("friction", "friction f", (fraction) => ask((state) => {
    state.ball.friction = round(Math.max(fraction, 0.002) * mostFriction);
  }));
  const setMu = (state, mu) => {
    const { largestMu } = store.body;
    requireAllowed("mu", mu);
    if (mu > largestMu) throw new Error(`mu is the patch radius over R: at most ${largestMu} here`);
    // Patch radius and spin deceleration are proportional to mu.
    if (state.ball) state.ball.patch = Number(((state.ball.patch * mu) / state.mu).toPrecision(12));
    else state.mu = mu;
  };
  const muSlider = $("mu-slider");
  muSlider.addEventListener("input", () => ask((state) => setMu(state, fractionToMu(Number(muSlider.value) / 1000, store.body.largestMu))));
  forgiveTouches(muSlider);
  const muField = numberField($("mu"), $("mu-error"), (mu) => store.change((state) => setMu(state, mu)));

  return function show() {
    const { state, state: { ball }, body, contact, orbit } = store;
    muSlider.value = Math.round(1000 * muToFraction(state.mu, body.largestMu));
    muSlider.disabled = $("mu").disabled = ball ? ball.patchBy === "whole_face" : body.mu !== undefined;
    const patch = contact ? `${shown(1000 * contact.patchRadius, 3)} mm` : "";
    write($("patch-size"), patch);
    muSlider.setAttribute("aria-valuetext", `${patch ? `${patch}, ` : ""}mu ${shown(state.mu)}`);
    muField.show(ball ? Number(state.mu.toPrecision(6)) : state.mu);
    $("slip-control").hidden = $("spin-control").hidden = !orbit;
    $("friction-control").hidden = !ball;
    if (ball) friction.show(ball.friction / mostFriction, shown(ball.friction, 3));
    if (!orbit) return;
    const most = largest(state);
    const turns = orbit.u / (ball?.radius ?? 1);
    slip.show(orbit.v / most.v, ball ? `${shown(orbit.v, 3)} m/s` : `v₀ = ${shown(orbit.v, 3)}`);
    spin.show(Math.abs(turns) / most.spin, ball ? `${shown(turns, 3)} rad/s` : `u₀ = ${shown(turns, 3)}`);
  };
}
