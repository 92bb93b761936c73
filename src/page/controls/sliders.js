// The sliders: slip and spin of the chosen orbit, friction and patch.
import { make } from "../dom.js";
import { numberField } from "./fields.js";
import { shown } from "../numbers.js";
import { allowed, moved } from "../state/page_state.js";

const smallestMu = 1e-3;
const mostFriction = 1.2;
const shareToMu = (share, largest) => Number((largest * (smallestMu / largest) ** (1 - share)).toPrecision(3));
const muToShare = (mu, largest) => 1 - Math.log(mu / largest) / Math.log(smallestMu / largest);
const round = (value) => Number(value.toPrecision(3));

/** As makeChoices. */
export function makeSliders(controls, store, plane) {
  /** What the sliders of slip and spin go to: they do not move under the reader's hand. */
  const most = ({ ball }) => {
    const built = store.library.balls.find(({ name }) => name === ball?.name);
    return built ? { v: Math.max(2, 2 * built.slip), spin: 500 } : { v: 5, spin: 5 };
  };
  const move = (state, edit) => {
    const orbit = state.orbits[state.chosen];
    const { u, v } = { ...orbit, ...edit(orbit) };
    state.orbits[state.chosen] = moved(orbit, u, v);
    plane.zooming.freeze(state, { u, v });
  };
  controls.slider("slip", "slip", ({ orbit, state }) => orbit && {
    share: orbit.v / most(state).v, text: state.ball ? `${shown(orbit.v, 3)} m/s` : `v₀ = ${shown(orbit.v, 3)}`,
  }, (state, share) => move(state, () => ({ v: round(Math.max(share, 0.01) * most(state).v) })));
  controls.slider("spin", "spin", ({ orbit, state }) => {
    const spin = orbit && orbit.u / (state.ball?.radius ?? 1);
    return orbit && { share: Math.abs(spin) / most(state).spin, text: state.ball ? `${shown(spin, 3)} rad/s` : `u₀ = ${shown(spin, 3)}` };
  }, (state, share) => move(state, ({ u }) => ({ u: (u < 0 ? -1 : 1) * round(share * most(state).spin) * (state.ball?.radius ?? 1) })));
  controls.slider("friction", "friction f", ({ state: { ball } }) => ball && { share: ball.friction / mostFriction, text: shown(ball.friction, 3) },
    (state, share) => (state.ball.friction = round(Math.max(share, 0.002) * mostFriction)));
  const setMu = (state, mu) => {
    const { largestMu } = store.body;
    if (allowed("mu", mu) > largestMu) throw new Error(`mu is the patch radius over R: at most ${largestMu} here`);
    // Patch radius and spin deceleration are proportional to mu.
    if (state.ball) state.ball.patch = Number(((state.ball.patch * mu) / state.mu).toPrecision(12));
    else state.mu = mu;
  };
  const isGiven = () => (store.state.ball ? store.state.ball.patchBy === "whole_face" : store.body.mu !== undefined);
  const { all, output } = controls.slider("mu", "patch", ({ state: { mu }, body, contact }) => {
    const text = contact ? `${shown(1000 * contact.patchRadius, 3)} mm` : "";
    return { share: muToShare(mu, body.largestMu), disabled: isGiven(), text, spoken: `${text && `${text}, `}mu ${shown(mu)}` };
  }, (state, share) => setMu(state, shareToMu(share, store.body.largestMu)));
  // And mu as a number.
  const input = make("input", { id: "mu", className: "number", inputMode: "decimal", autocomplete: "off", ariaLabel: "mu, as a number" });
  const field = numberField(input, (mu) => store.change((state) => setMu(state, mu)));
  const line = make("span");
  output.before(line);
  line.append(output, " ", make("i", { textContent: "μ" }), " ", input);
  all.append(field.output);
  controls.shows.push(() => {
    input.disabled = isGiven();
    field.show(store.state.ball ? Number(store.state.mu.toPrecision(6)) : store.state.mu);
  });
}
