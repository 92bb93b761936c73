// Everything that a link has to reproduce, and its text after the # of the address.

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

export const ballKeys = ["radius", "mass", "friction", "gravity", "patch", "velocityX", "velocityY", "rollingFriction"];

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
    orbits: [{ u: 0.8, v: 3.5 }],
    chosen: 0,
    fraction: 0,       // of the stop time (or of the part that is shown) that the moving point has reached
    part: "whole",  // of the motion: "whole", or "sliding"
    isochrone: 0,   // stop time of the isochrone the reader has drawn; 0 for none
    ball: null,     // SI values of a real ball; then speeds are m/s
    theme: "auto",
    embed: false,   // only the balls are shown, for a page around this one
  };
}

/** What the page opens with: a gel ball whose spin lets it slide seven times as far. */
export function firstState({ balls }) {
  const state = initialState();
  const gel = balls.find(({ name }) => name === "gel");
  if (gel) takeBall(state, { ...gel, spin: 300 });
  return state;
}

/** A real ball with the start that the library has for it: its centre moves along the slip, so that it does not turn forward. */
export function takeBall(state, ball) {
  Object.assign(state, {
    ball: { ...ball, velocityX: ball.slip, velocityY: 0, rollingFriction: 0 },
    law: ball.law, body: ball.body, orbits: [{ u: ball.radius * ball.spin, v: ball.slip }], chosen: 0, fraction: 0, isochrone: 0, part: "sliding",
    window: null,
  });
  return state.ball;
}

export function toFragment(/** @type {State} */ state) {
  const { ball } = state;
  const unless = (usual, value) => (value === usual ? null : value);
  const parts = {
    law: state.law,
    ...(ball
      ? { ball: ball.name, patchBy: ball.patchBy, ...Object.fromEntries(ballKeys.map((key) => [key, ball[key]])) }
      : { body: state.body === "own" ? `${state.chi},${state.gamma}` : state.body, mu: state.mu }),
    view: state.view, window: state.window?.join(","), against: state.against, field: unless("none", state.field),
    isochrones: unless(initialState().isochrones, state.isochrones),
    orbits: state.orbits.map(({ u, v }) => `${u},${v}`).join(";"), chosen: state.chosen,
    at: unless(0, Number(state.fraction.toFixed(4))), part: unless(ball ? "sliding" : "whole", state.part),
    isochrone: unless(0, state.isochrone), theme: unless("auto", state.theme), embed: state.embed ? "1" : null,
  };
  const query = new URLSearchParams(Object.entries(parts).flatMap(([key, value]) => (value == null ? [] : [[key, String(value)]])));
  return query.toString().replaceAll("%2C", ",").replaceAll("%3B", ";").replaceAll("%3A", ":");
}

/**
 * The state of a fragment; what cannot be read in it keeps its first value.
 *
 * @param known  of library.js
 */
export function fromFragment(fragment, known) {
  const { views, balls } = known;
  const query = new URLSearchParams(fragment.replace(/^#/, ""));
  const state = [...query.keys()].every((key) => key === "embed") ? firstState(known) : initialState();
  state.embed = query.has("embed");
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
  const inertia = numbers(query.get("body"), 2, ([chi, gamma]) => chi > 0 && gamma > 0);
  if (inertia) Object.assign(state, { body: "own", chi: inertia[0], gamma: inertia[1] });
  number("mu", (mu) => (state.mu = mu), (mu) => mu > 0);
  const { mu, largestMu } = bodyOf(state, known);
  state.mu = mu ?? Math.min(state.mu, largestMu);
  choice("ball", balls.map((ball) => ball.name), (name) => {
    const ball = takeBall(state, balls.find((entry) => entry.name === name));
    choice("patchBy", [ball.patchBy, "patch_radius", "spin_deceleration"], (by) => (ball.patchBy = by));
    for (const key of ballKeys) {
      number(key, (value) => (ball[key] = value), (value) => key.startsWith("velocity") || value > 0 || (value === 0 && key === "rollingFriction"));
    }
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
    state.orbits = orbits.split(";").map((text) => numbers(text, 2, ([, v]) => v >= 0))
        .flatMap((start) => (start ? [{ u: start[0], v: start[1] }] : []));
  }
  number("chosen", (chosen) => (state.chosen = chosen), Number.isInteger);
  state.chosen = Math.max(0, Math.min(state.orbits.length - 1, state.chosen));
  number("at", (fraction) => (state.fraction = fraction), (fraction) => fraction >= 0 && fraction <= 1);
  number("isochrone", (tau) => (state.isochrone = tau), (tau) => tau > 0);
  return state;
}
