// Controls for ball, body and law, for the contents of the plane, the sliders, and the card of a real ball.
import { $, isStill, make, write } from "../dom.js";
import { choiceButtons, fillSelect, numberField, withoutOptions } from "./fields.js";
import { isDark } from "../drawing/theme.js";
import { shown, spinText } from "../numbers.js";
import { bodyOf, initialState, moved, takeBall, unrolled } from "../state/page_state.js";

/** The titles of entries of the library, by their names. */
const titlesOf = (entries) => Object.fromEntries(entries.map(({ name, title = name.replace("-", " ") }) => [name, title]));

const fieldTitles = { none: "none", motion: "motion (2.6)" };
const patchTitles = { patch_radius: "radius ε (m)", spin_deceleration: "spin deceleration (rad/s²)", whole_face: "whole face" };
const ballLabels = {
  radius: "radius R (m)", mass: "mass m (kg)", friction: "friction f", gravity: "gravity g (m/s²)", patchBy: "patch given by",
  patch: "patch", rollingFriction: "rolling friction (pool: 0.01)", slope: "slope (degrees; downhill < 0)",
};

const smallestMu = 1e-3;
const mostFriction = 1.2;
const shareToMu = (share) => Number((smallestMu ** (1 - share)).toPrecision(3));
const muToShare = (mu) => 1 - Math.log(mu) / Math.log(smallestMu);
const round = (value) => Number(value.toPrecision(3));
const radiusOf = ({ ball }) => ball?.radius ?? 1;

/** @param {Controls} controls @param {Store} store @param {Plane} plane */
export function makeSettings(controls, store, plane) {
  makeChoices(controls, store, plane);
  makeSliders(controls, store, plane);
  makeBallCard(controls, store);
}

/** @param {Controls} controls @param {Store} store @param {Plane} plane */
function makeChoices(controls, store, plane) {
  const { balls, bodies, views, lawName } = store.library;
  const ofBalls = { "": "any size, any unit", ...titlesOf(balls) };
  controls.choose("ball", ofBalls, ({ ball }) => ball?.name ?? "", (state, value) => {
    const ball = balls.find(({ name }) => name === value);
    if (ball) takeBall(state, ball);
    else Object.assign(state, { ball: null, line: 0, day: "", part: "whole", orbits: state.orbits.map(unrolled) });
  });
  controls.choose("body", titlesOf(bodies), ({ body }) => body, (state, body) => {
    state.body = body;
    state.mu = bodyOf(state, store.library).mu ?? state.mu;
  });
  controls.choose("field", fieldTitles, ({ field }) => field, (state, field) => (state.field = field));
  const useLaw = (key) => (name) => store.change((state) => (state[key] = name && lawName(name)));
  const law = lawField("law", store, { key: "exponent", use: useLaw("law") });
  const against = lawField("against", store, { key: "against-exponent", none: "no other law", use: useLaw("against") });
  const formulas = $("formulas");
  formulas.addEventListener("change", () => store.attempt(() => {
    try {
      useLaw("law")(formulas.value.trim());
    } catch (error) {
      throw new Error(withoutOptions(error.message));
    }
  }));
  $("isochrones").addEventListener("change", () => store.ask((state) => {
    state.isochrones = $("isochrones").checked ? initialState().isochrones : 0;
  }));
  const showView = choiceButtons($("views"), titlesOf(views), (name) => plane.zooming.view(name));
  $("theme").addEventListener("click", () => store.ask((state) => {
    state.theme = state.theme === "auto" ? (isDark("auto") ? "light" : "dark") : "auto";
  }));
  $("lab").addEventListener("click", () => store.ask((state) => (state.lab = !state.lab), () => store.state.lab &&
    $("columns").scrollIntoView({ behavior: isStill() ? "instant" : "smooth" })));

  store.shows.push((state) => {
    const { facts, view, contact, request } = store;
    $("lab").setAttribute("aria-expanded", String(state.lab));
    law.show(state.law);
    if (state.law.includes("=") && document.activeElement !== formulas) formulas.value = state.law;
    against.show(request.against);
    for (const option of $("against").options) option.disabled = option.value === state.law;
    $("isochrones").checked = state.isochrones > 0;
    $("field").disabled = $("isochrones").disabled = !view.layered;
    $("body-label").hidden = Boolean(state.ball);
    showView(state.view);
    write($("view-hint"), view.hint);
    const without = contact?.without ? `. The plane is drawn without rolling friction: ${contact.without}.` : "";
    write($("terminal"), `k → ${shown(facts.terminalRatio, 6)}: ${facts.meaning}${without}`);
    $("theme").setAttribute("aria-label", `Theme: ${state.theme === "auto" ? "as the system" : state.theme}`);
  });
}

/** @param {Controls} controls @param {Store} store @param {Plane} plane */
function makeSliders(controls, store, plane) {
  /** Returns the upper ends of the sliders of slip and spin. These ends stay constant while the reader holds a slider. */
  const most = ({ ball }) => {
    const built = store.library.balls.find(({ name }) => name === ball?.name);
    return built ? { slip: Math.max(2, 2 * built.slip), spin: 500 } : { slip: 5, spin: 5 };
  };
  const move = (state, edit) => {
    const orbit = state.orbits[state.chosen];
    const { u, v } = { ...orbit, ...edit(orbit) };
    state.orbits[state.chosen] = moved(orbit, u, v);
    plane.zooming.freeze(state, { u, v });
  };
  controls.slider("slip", "slip", ({ orbit, state }) => orbit && {
    share: orbit.v / most(state).slip, text: state.ball ? `${shown(orbit.v, 3)} m/s` : `v₀ = ${shown(orbit.v, 3)}`,
  }, (state, share) => move(state, () => ({ v: round(Math.max(share, 0.01) * most(state).slip) })));
  controls.slider("spin", "spin", ({ orbit, state }) => {
    const spin = orbit && orbit.u / radiusOf(state);
    return orbit && { share: Math.abs(spin) / most(state).spin, text: spinText(orbit.u, state) };
  }, (state, share) => move(state, ({ u }) => ({ u: (u < 0 ? -1 : 1) * Number((round(share * most(state).spin) * radiusOf(state)).toPrecision(12)) })));
  controls.slider("friction", "friction f", ({ state: { ball } }) => ball && { share: ball.friction / mostFriction, text: shown(ball.friction, 3) },
    (state, share) => (state.ball.friction = round(Math.max(share, 0.002) * mostFriction)));
  const setMu = (state, mu) => {
    // Patch radius and spin deceleration are proportional to mu.
    if (state.ball) state.ball.patch = Number(((state.ball.patch * mu) / state.mu).toPrecision(12));
    else state.mu = mu;
  };
  const isGiven = () => (store.state.ball ? store.state.ball.patchBy === "whole_face" : store.body.mu !== undefined);
  controls.slider("mu", "patch", ({ state: { mu }, contact }) => {
    const text = contact ? `${shown(1000 * contact.patchRadius, 3)} mm` : "";
    return { share: muToShare(mu), disabled: isGiven(), text, spoken: `${text && `${text}, `}mu ${shown(mu)}` };
  }, (state, share) => setMu(state, shareToMu(share)));
  const muShown = ({ state: { ball, mu } }) => (isGiven() ? undefined : ball ? Number(mu.toPrecision(6)) : mu);
  controls.number($("settings"), "mu", "μ of the patch", muShown, setMu);
}

/** @param {Controls} controls @param {Store} store */
function makeBallCard(controls, store) {
  const isHidden = (key, { state: { ball }, body }) =>
    !ball || (key === "patch" && ball.patchBy === "whole_face") || (key === "rollingFriction" && body.chi === 1);
  // The link has all digits.
  const fewDigits = (value) => value && Number(value.toPrecision(6));
  const patchBy = make("select", { id: "patch-by" });
  for (const [key, label] of Object.entries(ballLabels)) {
    if (key === "patchBy") $("ball-fields").append(make("label", {}, label, patchBy));
    else controls.number($("ball-fields"), key, label, (store) => (isHidden(key, store) ? undefined : fewDigits(store.state.ball?.[key])), (state, value) => {
      // The spin in rad/s stays.
      if (key === "radius") for (const orbit of state.orbits) orbit.u *= value / state.ball.radius;
      state.ball[key] = value;
    });
  }
  controls.choose("patch-by", patchTitles, ({ ball }) => ball?.patchBy ?? "", (state, by) => {
    const { patchRadius, spinDeceleration } = /** @type {Contact} */ (store.contact);
    const patch = Number((by === "spin_deceleration" ? spinDeceleration : patchRadius).toPrecision(12));
    Object.assign(state.ball, { patchBy: by, patch });
  });
  store.shows.push(({ ball, mu }) => {
    const { body, contact } = store;
    $("ball-card").hidden = !ball;
    if (!ball || !contact) return;
    write($("ball-title"), ball.title);
    // A puck rests on its whole face, a stone on a band, and neither rolls.
    patchBy.options[patchBy.options.length - 1].disabled = body.mu === undefined;
    write($("ball-facts"), `Patch radius ${shown(1000 * contact.patchRadius, 4)} mm, μ = ${shown(mu, 5)}. ` +
      `${body.chi === 1 ? "" : `It counts as rolling once its slip is below ${shown(1000 * store.library.rollingSlip, 2)} mm/s. `}${ball.sources}`);
  });
}

/**
 * A list of the laws, with a field for the number of a law.
 * @param {string} id  id of the list; with -exponent, id of the parent of the number's field
 * @param {Store} store
 * @param {{key: string, none?: string, use: (name: string | null) => void}} how
 *   none: title of the choice of no law, if there is this choice;
 *   use: called with the name of a law, or null for none; throws an Error with the reason if the law is not allowed
 */
function lawField(id, store, { key, none, use }) {
  const { laws } = store.library;
  const [select, place] = [$(id), $(`${id}-exponent`)];
  const numbers = new Map(laws.filter(({ letter }) => letter).map(({ name, example }) => [name, example]));
  const titles = laws.map(({ name, meaning, letter }) => [name, `${letter ? `${name}:${letter}` : name} – ${meaning}`]);
  fillSelect(select, { ...(none && { "": none }), ...Object.fromEntries(titles) });
  const showNumber = numberField(place, {
    key, label: "its number",
    use: (value) => {
      use(`${select.value}:${value}`);
      numbers.set(select.value, value);
    },
  });
  select.addEventListener("change", () => store.attempt(() => {
    const number = numbers.get(select.value);
    use(number === undefined ? select.value || null : `${select.value}:${number}`);
  }));
  return {
    show(law) {
      const own = law?.includes("=") ? "your own formulas" : null;
      const [name, number] = own ? [law] : (law ?? "").split(":");
      if (own) ([...select.options].find(({ text }) => text === own) ?? select.appendChild(new Option(own))).value = name;
      select.value = name;
      place.hidden = number === undefined;
      showNumber(number && Number(number));
    },
  };
}
