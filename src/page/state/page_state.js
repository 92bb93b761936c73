// Everything that a link has to reproduce, and its text after the # of the address.
import { shown } from "../numbers.js";
import { tour } from "./presets.js";

const largestOwnMu = 10;

/**
 * chi, gamma and the largest mu of the state's body; and mu itself where the body decides it.
 * @returns {{chi: number, gamma: number, largestMu: number, mu: number | undefined}}
 */
export function bodyOf(state, { bodies }) {
  return state.body === "own"
    ? { chi: state.chi, gamma: state.gamma, largestMu: largestOwnMu, mu: undefined }
    : { ...bodies.find(({ name }) => name === state.body), largestMu: 1 };
}

export const fields = ["none", "motion", "regularised"];

export const ballKeys = ["radius", "mass", "friction", "gravity", "patch", "rollingFriction", "slope"];

/** What a number may be, from 1e-9 to 1e9 if nothing else is said: beyond, what follows from it may be no number. */
const ranges = {
  rollingFriction: [0, 1e3], slope: [-89, 89], along: [-1e9, 1e9], across: [-1e9, 1e9], chi: [1e-3, 1e3], gamma: [1e-3, 1e3], mu: [1e-6, 10],
  "window-U": [Number.MIN_VALUE, Infinity], "window-V": [Number.MIN_VALUE, Infinity],
};
const rangeOf = (key) => ranges[key] ?? [1e-9, 1e9];
const isAllowed = (key, value) => value >= rangeOf(key)[0] && value <= rangeOf(key)[1];

/** @throws {Error} if a number of that name may not have the value */
export function requireAllowed(key, value) {
  const [low, high] = rangeOf(key);
  if (low > 0 && !(value > 0)) throw new Error("a positive number is needed");
  if (!isAllowed(key, value)) throw new Error(`from ${shown(low)} to ${shown(high)} is allowed`);
}

/**
 * A motion from u and v.
 *
 * @param along   the velocity of a real ball's centre, m/s, in the direction of the slip
 * @param across  and to the left of it
 * @param heading  degrees to the left, in which it is seen to be thrown
 * @returns {Start}
 */
export const startOf = (u, v, along = v, across = 0, heading = 0) => ({ u, v, along, across, heading });

/** The same of what does not turn forward: what cannot roll, and what has no size. */
export const unrolled = ({ u, v, heading }) => startOf(u, v, v, 0, heading);

/** The start with other speeds; the ball turns forward as before. */
export const moved = ({ v: before, along, across, heading }, u, v) => startOf(u, v, along === before ? v : along + v - before, across, heading);

/** @returns {State} */
export function initialState() {
  return {
    law: "exact",
    body: "ball",
    chi: 1,         // of a body of the reader's own
    gamma: 2,
    mu: 0.3,
    view: "uv",
    window: null,   // [U, V]: |u| <= U, v <= V are shown; null: the library's choice for the orbits
    against: null,  // another law, whose portrait is drawn into the same figure
    field: "none",  // of directions: "motion" or "regularised"
    isochrones: 7,  // of the stop time, about so many
    orbits: [startOf(0.8, 3.5)],
    chosen: 0,
    fraction: 0,       // of the stop time (or of the part that is shown) that the moving point has reached
    part: "whole",  // of the motion: "whole", or "sliding"
    isochrone: 0,   // stop time of the isochrone the reader has drawn; 0 for none
    ball: null,     // SI values of a real ball; then speeds are m/s
    step: 0,        // of the tour
    theme: "auto",
    lab: false,     // all is shown, not the first floor alone
    embed: false,   // only the balls are shown, for a page around this one
  };
}

/** What the page opens with: a puck whose spin lets it slide four times as far. */
export function firstState({ balls }) {
  const state = initialState();
  const puck = balls.find(({ name }) => name === "puck");
  if (puck) takeBall(state, { ...puck, slip: 0.5, spin: 60 });
  return state;
}

/** A real ball with the start that the library has for it. */
export function takeBall(state, ball) {
  Object.assign(state, {
    ball: { ...ball, rollingFriction: 0, slope: 0 }, law: ball.law, body: ball.body, orbits: [startOf(ball.radius * ball.spin, ball.slip)],
    chosen: 0, fraction: 0, isochrone: 0, part: "sliding", window: null,
  });
  return state.ball;
}

/** Of what a link speaks that only the Lab shows, and that is more than how the page looks. */
const labKeys = new Set(["law", "body", "mu", "view", "window", "against", "field", "isochrones"]);
const stateKeys = new Set([...labKeys, "ball", "orbits", "part", "isochrone"]);

export function toFragment(/** @type {State} */ state) {
  const { ball } = state;
  const unless = (usual, value) => (value === usual ? null : value);
  const parts = {
    law: state.law,
    ...(ball
      ? { ball: ball.name, patchBy: ball.patchBy, ...Object.fromEntries(ballKeys.map((key) => [key, ball[key]])) }
      : { body: state.body === "own" ? `${state.chi},${state.gamma}` : state.body, mu: state.mu }),
    view: state.view, window: state.window?.join(","), against: unless(state.law, state.against), field: unless("none", state.field),
    isochrones: unless(initialState().isochrones, state.isochrones),
    orbits: state.orbits.map(({ u, v, along, across, heading }) =>
      (heading ? [u, v, along, across, heading] : along === v && across === 0 ? [u, v] : [u, v, along, across]).join(",")).join(";"),
    chosen: state.chosen, step: unless(0, state.step),
    at: unless(0, Number(state.fraction.toFixed(4))), part: unless(ball ? "sliding" : "whole", state.part),
    isochrone: unless(0, state.isochrone), theme: unless("auto", state.theme), embed: state.embed ? "1" : null, lab: state.lab ? "1" : "0",
  };
  const query = new URLSearchParams(Object.entries(parts).flatMap(([key, value]) => (value == null ? [] : [[key, String(value)]])));
  return query.toString().replaceAll("%2C", ",").replaceAll("%3B", ";").replaceAll("%3A", ":").replaceAll("%2F", "/");
}

/** Whether a link speaks of no motion, such as that of the page alone. */
export const speaksOfNothing = (fragment) => ![...new URLSearchParams(fragment.replace(/^#/, "")).keys()].some((key) => stateKeys.has(key));

/**
 * The state of a fragment; what cannot be read in it keeps its first value.
 *
 * @param known  of library.js
 */
export function fromFragment(fragment, known) {
  const { views, balls } = known;
  const query = new URLSearchParams(fragment.replace(/^#/, ""));
  const state = speaksOfNothing(fragment) ? firstState(known) : initialState();
  state.embed = query.has("embed");
  state.lab = query.has("lab") ? query.get("lab") === "1" : [...query.keys()].some((key) => labKeys.has(key));
  const choice = (key, allowed, use) => allowed.includes(query.get(key)) && use(query.get(key));
  const number = (key, use, allowed = (/** @type {number} */ _) => true) => {
    const value = Number(query.get(key));
    if (query.has(key) && query.get(key) !== "" && Number.isFinite(value) && allowed(value)) use(value);
  };
  /** @param {(values: number[]) => boolean} allowed */
  const numbers = (text, count, allowed) => {
    const values = (text ?? "").split(",").map(Number);
    return values.length === count && values.every(Number.isFinite) && allowed(values) ? values : null;
  };

  choice("field", fields, (field) => (state.field = field));
  number("isochrones", (count) => (state.isochrones = count), (count) => count === 0 || count === 7);
  choice("view", views.map(({ name }) => name), (view) => (state.view = view));
  choice("theme", ["light", "dark"], (theme) => (state.theme = theme));
  choice("body", known.bodies.map(({ name }) => name), (body) => (state.body = body));
  const inertia = numbers(query.get("body"), 2, ([chi, gamma]) => isAllowed("chi", chi) && isAllowed("gamma", gamma));
  if (inertia) Object.assign(state, { body: "own", chi: inertia[0], gamma: inertia[1] });
  number("mu", (mu) => (state.mu = mu), (mu) => isAllowed("mu", mu));
  const { mu, largestMu } = bodyOf(state, known);
  state.mu = mu ?? Math.min(state.mu, largestMu);
  choice("ball", balls.map((ball) => ball.name), (name) => {
    const ball = takeBall(state, balls.find((entry) => entry.name === name));
    choice("patchBy", [ball.patchBy, "patch_radius", "spin_deceleration"], (by) => (ball.patchBy = by));
    for (const key of ballKeys) number(key, (value) => (ball[key] = value), (value) => isAllowed(key, value));
  });
  for (const key of ["law", "against"]) {
    try {
      if (query.get(key)) state[key] = known.lawName(query.get(key));
    } catch {
      // Not a law.
    }
  }
  choice("part", ["whole", "sliding"], (part) => (state.part = part));
  state.window = numbers(query.get("window"), 2, ([U, V]) => U > 0 && V > 0) ?? state.window;
  const orbits = query.get("orbits");
  if (orbits !== null) {
    const start = (text) => [2, 4, 5].map((count) => numbers(text, count, ([, v]) => v >= 0)).find(Boolean);
    state.orbits = orbits.split(";").map(start).flatMap((found) => (found ? [startOf(found[0], found[1], ...found.slice(2))] : []));
  }
  // Links of before gave one velocity to all.
  for (const [key, own] of [["velocityX", "along"], ["velocityY", "across"]]) number(key, (value) => state.orbits.forEach((orbit) => (orbit[own] = value)));
  // What cannot roll does not turn forward.
  if (!state.ball || bodyOf(state, known).chi === 1) state.orbits = state.orbits.map(unrolled);
  number("step", (step) => (state.step = step), (step) => step in tour);
  number("chosen", (chosen) => (state.chosen = chosen), Number.isInteger);
  state.chosen = Math.max(0, Math.min(state.orbits.length - 1, state.chosen));
  number("at", (fraction) => (state.fraction = fraction), (fraction) => fraction >= 0 && fraction <= 1);
  number("isochrone", (tau) => (state.isochrone = tau), (tau) => tau > 0);
  return state;
}
