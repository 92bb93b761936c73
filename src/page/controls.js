// The choices: ball, law, body, patch, what the plane shows; and the sliders.
import { $, make, write } from "./dom.js";
import { addNumberField, choiceButtons, fillSelect, forgiveTouches, numberField, slider } from "./fields.js";
import { lawField } from "./law_field.js";
import { shown } from "./numbers.js";
import { bodyOf, fields, initialState, moved, requireAllowed, startOf, takeBall } from "./page_state.js";
import { isDark } from "./theme.js";
import { described } from "./views.js";

const fieldTitles = { none: "none", motion: "of the motion (2.6)", regularised: "regularised (2.7)" };
const patchTitles = { patch_radius: "its radius ε (m)", spin_deceleration: "spin deceleration (rad/s²)", whole_face: "its whole face" };
const smallestMu = 1e-3;
const mostFriction = 1.2;
const titled = (titles) => Object.entries(titles).map(([name, title]) => ({ name, title }));
const fractionToMu = (fraction, largest) => Number((largest * (smallestMu / largest) ** (1 - fraction)).toPrecision(3));
const muToFraction = (mu, largest) => 1 - Math.log(mu / largest) / Math.log(smallestMu / largest);
const round = (value) => Number(value.toPrecision(3));

/**
 * @param {import("./store.js").Store} store
 * @param {import("./plane.js").Plane} plane
 * @param act  ask(edit) and attempt(action), which tell the reader what is rejected
 * @returns {() => void} shows the state
 */
export function makeControls(store, plane, { ask, attempt }) {
  const { balls, bodies, laws, views, lawName } = store.library;
  const move = (state, edit) => {
    const orbit = state.orbits[state.chosen];
    const { u, v } = { ...orbit, ...edit(orbit) };
    state.orbits[state.chosen] = moved(orbit, u, v);
  };

  // --- choices ---------------------------------------------------------------------------------------------------------

  const choose = (id, choices, edit) => {
    fillSelect($(id), choices);
    $(id).addEventListener("change", () => ask((state) => edit(state, $(id).value)));
  };
  choose("ball", [{ name: "", title: "any size, any unit" }, ...balls], (state, value) => {
    const ball = balls.find(({ name }) => name === value);
    if (ball) takeBall(state, ball);
    else Object.assign(state, { ball: null, part: "whole", orbits: state.orbits.map(({ u, v }) => startOf(u, v)) });
  });
  const titles = bodies.map(({ name }) => ({ name, title: name.replace("-", " ") }));
  choose("body", [...titles, { name: "own", title: "your own χ and γ" }], (state, body) => {
    state.body = body;
    const { mu, largestMu } = bodyOf(state, store.library);
    state.mu = mu ?? Math.min(state.mu, largestMu);
  });
  choose("field", fields.map((name) => ({ name, title: fieldTitles[name] })), (state, field) => (state.field = field));
  const useLaw = (key) => (name) => store.change((state) => (state[key] = name && lawName(name)));
  const law = lawField("law", { laws, key: "exponent", attempt, use: useLaw("law") });
  const against = lawField("against", { laws, key: "against-exponent", none: "no other law", attempt, use: useLaw("against") });
  $("isochrones").addEventListener("change", () => ask((state) => {
    state.isochrones = $("isochrones").checked ? initialState().isochrones : 0;
  }));
  const viewButtons = choiceButtons($("views"), views.map(described), (name) => plane.view(name));
  $("fit").addEventListener("click", () => {
    plane.before = undefined;
    ask((state) => (state.window = null));
  });
  $("theme").addEventListener("click", () => ask((state) => {
    state.theme = state.theme === "auto" ? (isDark("auto") ? "light" : "dark") : "auto";
  }));

  // --- sliders and numbers ---------------------------------------------------------------------------------------------

  /** What the sliders of slip and spin go to: they do not move under the reader's hand. */
  const largest = ({ ball }) => {
    const built = balls.find(({ name }) => name === ball?.name);
    return built ? { v: Math.max(2, 2 * built.slip), spin: 500 } : { v: 5, spin: 5 };
  };
  const slip = slider("slip", "slip", (fraction) => ask((state) => {
    move(state, () => ({ v: round(Math.max(fraction, 0.01) * largest(state).v) }));
    plane.freeze(state);
  }));
  const spin = slider("spin", "spin", (fraction) => ask((state) => {
    const value = round(fraction * largest(state).spin);
    move(state, ({ u }) => ({ u: (u < 0 ? -1 : 1) * value * (state.ball?.radius ?? 1) }));
    plane.freeze(state);
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
  muSlider.addEventListener("input", () => ask((state) => setMu(state, fractionToMu(muSlider.value / 1000, store.body.largestMu))));
  forgiveTouches(muSlider);
  const muField = numberField($("mu"), $("mu-error"), (mu) => store.change((state) => setMu(state, mu)));

  const number = (parent, key, label, edit) => addNumberField(parent, {
    key, label,
    use(value) {
      requireAllowed(key, value);
      store.change((state) => edit(state, value));
    },
  });
  const inertia = Object.entries({ chi: "χ = 1 + mR²/J_h", gamma: "γ = mR²/J_z" }).map(([key, label]) =>
    ({ key, field: number($("inertia"), key, label, (state, value) => (state[key] = value)) }));
  const sides = ["U", "V"].map((name, side) => number($("window"), `window-${name}`, name, (state, value) => {
    plane.before = undefined;
    state.window = store.portrait.window.map((shown, i) => (i === side ? value : shown));
  }));

  // --- the card of a ball ----------------------------------------------------------------------------------------------

  const ofBall = (labels) => Object.entries(labels).map(([key, label]) => ({
    key, moves: /^(along|across|rolling)/.test(key),
    field: number($("ball-fields"), key, label, (state, value) => {
      // The spin in rad/s stays.
      if (key === "radius") for (const orbit of state.orbits) orbit.u *= value / state.ball.radius;
      ownerOf(key, state)[key] = value;
    }),
  }));
  /** The ball, or of what the chosen orbit owns the orbit, if there is one. */
  const ownerOf = (key, { ball, orbits, chosen }) => (key in ball ? ball : orbits[chosen]);
  const ballFields = ofBall({ radius: "radius R (m)", mass: "mass m (kg)", friction: "friction f", gravity: "gravity g (m/s²)" });
  const patchBy = make("select", { id: "patch-by" });
  $("ball-fields").append(make("label", {}, "patch known by", patchBy));
  choose("patch-by", titled(patchTitles), (state, by) => {
    const { patchRadius, spinDeceleration } = /** @type {Contact} */ (store.contact);
    const patch = Number((by === "spin_deceleration" ? spinDeceleration : patchRadius).toPrecision(12));
    Object.assign(state.ball, { patchBy: by, patch });
  });
  ballFields.push(...ofBall({ patch: "patch", along: "centre: along the slip (m/s)", across: "across it (m/s)", rollingFriction: "rolling friction (pool: 0.01)" }));

  function showBall(ball, { body, contact, state }) {
    friction.show(ball.friction / mostFriction, shown(ball.friction, 3));
    write($("ball-title"), ball.title);
    patchBy.value = ball.patchBy;
    // A puck rests on its whole face, a stone on a band, and neither rolls.
    patchBy.lastChild.disabled = body.mu === undefined;
    for (const { key, moves, field } of ballFields) {
      const owner = ownerOf(key, state);
      if (owner) field.show(owner[key]);
      field.hide(!owner || (key === "patch" && ball.patchBy === "whole_face") || (moves && body.chi === 1));
    }
    write($("ball-facts"), `Patch radius ${shown(1000 * contact.patchRadius, 4)} mm, μ = ${shown(state.mu, 5)}. ${ball.sources}`);
  }

  return function show() {
    const { state, body, facts, contact, portrait, orbit, view } = store;
    const { ball } = state;
    law.show(state.law);
    against.show(store.request.against);
    for (const option of $("against").options) option.disabled = option.value === state.law;
    for (const [id, value] of Object.entries({ ball: ball?.name ?? "", field: state.field, body: state.body })) $(id).value = value;
    $("isochrones").checked = state.isochrones > 0;
    $("field").disabled = $("isochrones").disabled = !view.layered;
    $("body-label").hidden = Boolean(ball);
    $("inertia").hidden = state.body !== "own";
    for (const { key, field } of inertia) field.show(state[key]);
    muSlider.value = Math.round(1000 * muToFraction(state.mu, body.largestMu));
    muSlider.disabled = $("mu").disabled = ball ? ball.patchBy === "whole_face" : body.mu !== undefined;
    const patch = contact ? `${shown(1000 * contact.patchRadius, 3)} mm` : "";
    write($("patch-size"), patch);
    muSlider.setAttribute("aria-valuetext", `${patch ? `${patch}, ` : ""}mu ${shown(state.mu)}`);
    muField.show(ball ? Number(state.mu.toPrecision(6)) : state.mu);
    sides.forEach((field, side) => field.show(Number(portrait.window[side].toPrecision(6))));
    viewButtons.show(state.view);
    write($("view-hint"), view.hint);
    write($("terminal"), `k → ${shown(facts.terminalRatio, 6)}: ${facts.meaning}`);
    $("theme").setAttribute("aria-label", `Theme: ${state.theme === "auto" ? "as the system" : state.theme}`);
    $("slip-control").hidden = $("spin-control").hidden = !orbit;
    $("friction-control").hidden = $("ball-card").hidden = !ball;
    if (orbit) {
      const most = largest(state);
      const turns = orbit.u / (ball?.radius ?? 1);
      slip.show(orbit.v / most.v, ball ? `${shown(orbit.v, 3)} m/s` : `v₀ = ${shown(orbit.v, 3)}`);
      spin.show(Math.abs(turns) / most.spin, ball ? `${shown(turns, 3)} rad/s` : `u₀ = ${shown(turns, 3)}`);
    }
    if (ball) showBall(ball, store);
  };
}
