// The choices: ball, law, body, patch, what the plane shows; and the sliders.
import { $, make } from "./dom.js";
import { addNumberField, choiceButtons, fillSelect, numberField } from "./fields.js";
import { lawField } from "./law_field.js";
import { shown } from "./numbers.js";
import { bodyOf, fields, initialState, takeBall } from "./page_state.js";
import { isDark } from "./theme.js";
import { described } from "./views.js";

const fieldTitles = { none: "none", motion: "of the motion (2.6)", regularised: "regularised (2.7)" };
const smallestMu = 1e-3;
const sliderToMu = (value, largest) => Number((largest * (smallestMu / largest) ** (1 - value / 1000)).toPrecision(3));
const muToSlider = (mu, largest) => Math.round(1000 * (1 - Math.log(mu / largest) / Math.log(smallestMu / largest)));

export class Controls {
  /** @param act  {ask(edit), attempt(action)}; both tell the reader what is rejected */
  constructor(store, plane, { ask, attempt }) {
    Object.assign(this, { store, plane, ask, attempt });
    this.makeChoices();
    this.makeSliders();
    this.makeNumbers();
    this.makeBallFields();
  }

  makeChoices() {
    const { store, store: { library: { balls, bodies, laws, views } }, ask, attempt } = this;
    fillSelect($("ball"), [{ name: "", title: "any size, any unit" }, ...balls]);
    $("ball").addEventListener("change", () => ask((state) => {
      const ball = balls.find(({ name }) => name === $("ball").value);
      if (ball) takeBall(state, ball);
      else Object.assign(state, { ball: null, part: "whole" });
    }));
    fillSelect($("body"), [...bodies.map(({ name }) => ({ name, title: name.replace("-", " ") })), { name: "own", title: "your own χ and γ" }]);
    $("body").addEventListener("change", () => ask((state) => {
      state.body = $("body").value;
      const { mu, largestMu } = bodyOf(state, store.library);
      state.mu = mu ?? Math.min(state.mu, largestMu);
    }));
    const use = (key) => (name) => store.change((state) => (state[key] = name && store.library.lawName(name)));
    this.lawField = lawField($("law"), $("law-exponent"), { laws, key: "exponent", attempt, use: use("law") });
    this.againstField = lawField($("against"), $("against-exponent"), { laws, key: "against-exponent", none: "no other law", attempt, use: use("against") });
    fillSelect($("field"), fields.map((name) => ({ name, title: fieldTitles[name] })));
    $("field").addEventListener("change", () => ask((state) => (state.field = $("field").value)));
    $("isochrones").addEventListener("change", () => ask((state) => (state.isochrones = $("isochrones").checked ? initialState().isochrones : 0)));
    this.viewButtons = choiceButtons($("views"), views.map(described), (name) => this.plane.view(name));
    $("fit").addEventListener("click", () => {
      this.plane.before = undefined;
      ask((state) => (state.window = null));
    });
    $("theme").addEventListener("click", () => ask((state) => {
      state.theme = state.theme === "auto" ? (isDark("auto") ? "light" : "dark") : "auto";
    }));
  }

  /** Slip, spin and friction, and their numbers beside them; the patch has its own. */
  makeSliders() {
    const slider = (name, label, use) => {
      const input = make("input", { type: "range", min: 0, max: 1000, id: `${name}-slider` });
      const output = make("output", { htmlFor: input.id });
      const title = make("label", { htmlFor: input.id, textContent: label });
      $("mu-control").before(make("div", { className: "slider", id: `${name}-control` }, title, output, input));
      input.addEventListener("input", () => this.ask((state) => use(state, Number(input.value) / 1000)));
      return {
        show(value, largest, text) {
          if (document.activeElement !== input) input.value = Math.round((1000 * Math.abs(value)) / largest);
          output.textContent = text;
          input.setAttribute("aria-valuetext", text);
        },
      };
    };
    const round = (value) => Number(value.toPrecision(3));
    const chosen = (state) => state.orbits[state.chosen];
    this.slip = slider("slip", "slip", (state, share) => {
      const { v } = chosen(state);
      chosen(state).v = round(Math.max(share, 0.01) * this.largest(state).v);
      // The ball turns forward as before.
      if (state.ball) state.ball.velocityX += chosen(state).v - v;
      this.plane.freeze(state);
    });
    this.spin = slider("spin", "spin", (state, share) => {
      const spin = round(share * this.largest(state).spin);
      chosen(state).u = (chosen(state).u < 0 ? -1 : 1) * spin * (state.ball?.radius ?? 1);
      this.plane.freeze(state);
    });
    this.friction = slider("friction", "friction f", (state, share) => (state.ball.friction = round(Math.max(share, 0.002) * 1.2)));
  }

  /** What the sliders of slip and spin go to: they do not move under the reader's hand. */
  largest(state) {
    if (!state.ball) return { v: 5, spin: 5 };
    const built = this.store.library.balls.find(({ name }) => name === state.ball.name);
    return { v: Math.max(2, 2 * built.slip), spin: 500 };
  }

  makeNumbers() {
    const { store, ask } = this;
    const positive = (use) => (value) => {
      if (!(value > 0)) throw new Error("a positive number is needed");
      store.change((state) => use(state, value));
    };
    this.inertiaFields = [["chi", "χ = 1 + mR²/J_h"], ["gamma", "γ = mR²/J_z"]].map(([key, label]) =>
      [key, addNumberField($("inertia"), { key, label, use: positive((state, value) => (state[key] = value)) })]);
    this.windowFields = ["U", "V"].map((name, side) => addNumberField($("window"), {
      key: `window-${name}`, label: name,
      use: positive((state, value) => {
        this.plane.before = undefined;
        state.window = store.portrait.window.map((shown, i) => (i === side ? value : shown));
      }),
    }));
    this.muField = numberField($("mu"), $("mu-error"), (mu) => store.change((state) => this.setMu(state, mu)));
    $("mu-slider").addEventListener("input", () => ask((state) => this.setMu(state, sliderToMu(Number($("mu-slider").value), store.body.largestMu))));
  }

  setMu(state, mu) {
    const { largestMu } = this.store.body;
    if (!(mu > 0)) throw new Error("mu must be positive");
    if (mu > largestMu) throw new Error(`mu is the patch radius over R: at most ${largestMu} here`);
    // Patch radius and spin deceleration are proportional to mu.
    if (state.ball) state.ball.patch = Number(((state.ball.patch * mu) / state.mu).toPrecision(12));
    else state.mu = mu;
  }

  makeBallFields() {
    const { store } = this;
    const use = (key) => (value) => {
      if (!key.startsWith("velocity") && !(value > 0)) throw new Error("a positive number is needed");
      store.change((state) => {
        // The spin in rad/s stays.
        if (key === "radius") for (const orbit of state.orbits) orbit.u *= value / state.ball.radius;
        state.ball[key] = value;
      });
    };
    const add = (key, label) => [key, addNumberField($("ball-fields"), { key, label, use: use(key) })];
    this.ballFields = [["radius", "radius R (m)"], ["mass", "mass m (kg)"], ["friction", "friction f"], ["gravity", "gravity g (m/s²)"]].map((field) => add(...field));
    this.patchBy = make("select");
    fillSelect(this.patchBy, [{ name: "patch_radius", title: "its radius ε (m)" }, { name: "spin_deceleration", title: "spin deceleration (rad/s²)" }, { name: "whole_face", title: "its whole face" }]);
    $("ball-fields").append(make("label", {}, "patch known by", this.patchBy));
    this.patchBy.addEventListener("change", () => this.ask((state) => {
      const { patchRadius, spinDeceleration } = store.contact;
      const by = this.patchBy.value;
      Object.assign(state.ball, { patchBy: by, patch: Number((by === "spin_deceleration" ? spinDeceleration : patchRadius).toPrecision(12)) });
    }));
    this.ballFields.push(add("patch", "patch"), add("velocityX", "centre: along the slip (m/s)"), add("velocityY", "across it (m/s)"));
  }

  show() {
    const { store, store: { state, body, facts, contact, portrait, orbit, view } } = this;
    const { ball } = state;
    $("ball").value = ball?.name ?? "";
    this.lawField.show(state.law);
    this.againstField.show(store.request.against);
    for (const option of $("against").options) option.disabled = option.value === state.law;
    $("field").value = state.field;
    $("isochrones").checked = state.isochrones > 0;
    for (const control of [$("field"), $("isochrones")]) control.disabled = !view.layered;
    $("body").value = state.body;
    $("body-label").hidden = Boolean(ball);
    $("inertia").hidden = state.body !== "own";
    for (const [key, field] of this.inertiaFields) field.show(state[key]);
    $("mu-slider").value = muToSlider(state.mu, body.largestMu);
    $("mu-slider").disabled = $("mu").disabled = ball ? ball.patchBy === "whole_face" : body.mu !== undefined;
    const patch = ball ? `${shown(1000 * contact.patchRadius, 3)} mm` : "";
    $("patch-size").textContent = patch;
    $("mu-slider").setAttribute("aria-valuetext", `${patch ? `${patch}, ` : ""}mu ${shown(state.mu)}`);
    this.muField.show(ball ? Number(state.mu.toPrecision(6)) : state.mu);
    this.windowFields.forEach((field, side) => field.show(Number(portrait.window[side].toPrecision(6))));
    this.viewButtons.show(state.view);
    $("view-hint").textContent = view.hint;
    $("terminal").textContent = `k → ${shown(facts.terminalRatio, 6)}: ${facts.meaning}`;
    $("theme").setAttribute("aria-label", `Theme: ${state.theme === "auto" ? "as the system" : state.theme}`);
    $("slip-control").hidden = $("spin-control").hidden = !orbit;
    $("friction-control").hidden = $("ball-card").hidden = !ball;
    if (orbit) {
      const largest = this.largest(state);
      const spin = orbit.u / (ball?.radius ?? 1);
      this.slip.show(orbit.v, largest.v, ball ? `${shown(orbit.v, 3)} m/s` : `v₀ = ${shown(orbit.v, 3)}`);
      this.spin.show(spin, largest.spin, ball ? `${shown(spin, 3)} rad/s` : `u₀ = ${shown(spin, 3)}`);
    }
    if (!ball) return;
    this.friction.show(ball.friction, 1.2, shown(ball.friction, 3));
    $("ball-title").textContent = ball.title;
    for (const [key, field] of this.ballFields) field.show(ball[key]);
    this.patchBy.value = ball.patchBy;
    // A puck rests on its whole face, a stone on a band, and neither rolls.
    this.patchBy.lastChild.disabled = body.mu === undefined;
    for (const [key, field] of this.ballFields) field.hide((key === "patch" && ball.patchBy === "whole_face") || (key.startsWith("velocity") && body.chi === 1));
    $("ball-facts").textContent = `Patch radius ${shown(1000 * contact.patchRadius, 4)} mm, μ = ${shown(state.mu, 5)}. ${ball.sources}`;
  }
}
