// Everything that a link has to reproduce, and its text after the # of the address.
import { parseNumber, shown } from "../numbers.js";
import { tour } from "./presets.js";

/**
 * chi and gamma of the state's body, and mu where the body decides it.
 * @returns {{chi: number, gamma: number, mu: number | undefined}}
 */
export const bodyOf = ({ body }, { bodies }) => bodies.find(({ name }) => name === body);

export const ballKeys = ["radius", "mass", "friction", "gravity", "patch", "rollingFriction", "slope"];

const startKeys = ["u", "v", "along", "across", "heading"];

/** What a number may be, from 1e-9 to 1e9 if nothing else is said: beyond, what follows from it may be no number. */
const ranges = {
  rollingFriction: [0, 1e3], slope: [-89, 89], along: [-1e9, 1e9], across: [-1e9, 1e9], mu: [1e-6, 1],
  U: [Number.MIN_VALUE, Infinity], V: [Number.MIN_VALUE, Infinity], u: [-Infinity, Infinity], v: [0, Infinity], heading: [-360, 360],
  chosen: [0, Infinity], at: [0, 1], restitution: [0, 1], isochrone: [Number.MIN_VALUE, Infinity],
};

/** The value. @throws {Error} if a number of that name may not have it */
export function allowed(key, value) {
  const [low, high] = ranges[key] ?? [1e-9, 1e9];
  if (low > 0 && !(value > 0)) throw new Error("a positive number is needed");
  if (!(value >= low && value <= high)) throw new Error(`from ${shown(low)} to ${shown(high)} is allowed`);
  return value;
}

/** A motion from u and v; types.d.ts says what else it has. @returns {Start} */
export const startOf = (u, v, along = v, across = 0, heading = 0) => ({ u, v, along, across, heading });

/** The start of a ball that the library gives in SI units. */
export const startFrom = ({ slip, spin, along, across }, { radius }, digits = 17) =>
  startOf(...[spin * radius, slip, along, across].map((speed) => Number(speed.toPrecision(digits))));

/** The same of what does not turn forward: what cannot roll, and what has no size. */
export const unrolled = ({ u, v, heading }) => startOf(u, v, v, 0, heading);

/** The start with other speeds; the ball turns forward as before. */
export const moved = ({ v: before, along, across, heading }, u, v) => startOf(u, v, along === before ? v : along + v - before, across, heading);

/** A real ball with the start that the library has for it. */
export function takeBall(state, ball) {
  Object.assign(state, {
    ball: { ...ball, rollingFriction: 0, slope: 0, initial: { ...ball, rollingFriction: 0, slope: 0 } }, law: ball.law, body: ball.body, orbits: [startOf(ball.radius * ball.spin, ball.slip)],
    chosen: 0, fraction: 0, isochrone: 0, part: "sliding", window: null,
  });
  return state.ball;
}

// What is read in a link; each throws where it can not.
const numberOf = (key, text) => allowed(key, parseNumber(text));
const numbersOf = (keys, text) => keys.map((key, i) => numberOf(key, text.split(",")[i] ?? ""));
const startIn = (text) => {
  const [u, v, along, across, heading] = numbersOf(startKeys.slice(0, Math.max(2, text.split(",").length)), text);
  return startOf(u, v, along, across, heading);
};

function oneOf(names, text) {
  if (!names.includes(text)) throw new Error(`one of ${names} is needed`);
  return text;
}

const namesOf = (entries) => entries.map(({ name }) => name);

/**
 * Returns the value that `read` gives for a text of a link, or undefined.
 *
 * @param {string[]} problems  gets a sentence on a text that cannot be read
 */
function readable(problems, key, text, read, ...from) {
  try {
    return read(text, ...from);
  } catch (error) {
    const short = text.length > 60 ? `${text.slice(0, 60)}…` : text;
    problems.push(`${key}=${short} of the link is left out: ${error.message.replace(/\.$/, "")}.`);
    return undefined;
  }
}

/** A part of a link that is one value of the state; nothing is said of its first one. */
const value = (name, first, read) => ({
  first: { [name]: first },
  write: (state) => (state[name] === first ? null : state[name]),
  read: (text, known) => ({ [name]: read(text, known) }),
});
const ofBall = (key, read) => ({
  write: ({ ball }) => (ball?.[key] === ball?.initial[key] ? null : ball[key]),
  read: (text, _known, { ball }) => {
    if (!ball) throw new Error("only a real ball has it; add ball=pool, for example");
    return { ball: { ...ball, [key]: read(text, ball) } };
  },
});

/**
 * The state and what a link says of it, by the names in the link and in the order in which they are read: what a part of
 * the state is first; its text, or null for none; and what of the state a text decides.
 *
 * @type {Record<string, {first?: Partial<State>, write: (state: State) => unknown,
 *   read: (text: string, known: Library, state: State, problems: string[]) => object | void | null}>}
 */
const parts = {
  body: {
    ...value("body", "ball", (text, { bodies }) => oneOf(namesOf(bodies), text)),
    write: ({ ball, body }) => (ball || body === "ball" ? null : body),
  },
  // A link without a ball says so by its mu.
  mu: { ...value("mu", 0.3, (text) => numberOf("mu", text)), write: ({ ball, mu }) => (ball ? null : mu) },
  ball: {
    first: { ball: null },  // SI values of a real ball; then speeds are m/s
    write: ({ ball }) => ball?.name,
    read: (text, { balls }, state) => void takeBall(state, balls.find(({ name }) => name === text)),
  },
  patchBy: ofBall("patchBy", (text, ball) => oneOf([ball.patchBy, "patch_radius", "spin_deceleration"], text)),
  ...Object.fromEntries(ballKeys.map((key) => [key, ofBall(key, (text) => numberOf(key, text))])),
  law: {
    ...value("law", "exact", (text, { lawName }) => lawName(text)),
    write: ({ ball, law }) => (law === (ball?.law ?? "exact") ? null : law),
  },
  // Another law, whose portrait is drawn into the same figure.
  against: { ...value("against", null, (text, { lawName }) => lawName(text)), write: ({ law, against }) => (against === law ? null : against) },
  view: value("view", "uv", (text, { views }) => oneOf(namesOf(views), text)),
  // [U, V]: |u| <= U, v <= V are shown; null: the library's choice for the orbits.
  window: value("window", null, (text) => numbersOf(["U", "V"], text)),
  field: value("field", "none", (text) => oneOf(["none", "motion"], text)),  // of directions
  isochrones: value("isochrones", 7, (text) => Number(oneOf(["0", "7"], text))),  // of the stop time, about so many
  // Of the motion: "whole", or "sliding", as that of a ball is first.
  part: {
    ...value("part", "whole", (text) => oneOf(["whole", "sliding"], text)),
    write: ({ ball, part }) => (part === (ball ? "sliding" : "whole") ? null : part),
  },
  orbits: {
    first: { orbits: [startOf(0.8, 3.5)] },
    write: ({ orbits }) => orbits.map(({ u, v, along, across, heading }) =>
      (heading ? [u, v, along, across, heading] : along === v && across === 0 ? [u, v] : [u, v, along, across])).join(";"),
    read: (text, _known, _state, problems) => ({ orbits: (text ? text.split(";") : []).flatMap((start) => readable(problems, "orbits", start, startIn) ?? []) }),
  },
  chosen: value("chosen", 0, (text) => Math.floor(numberOf("chosen", text))),
  // The line to reach by spin alone; for a ball that rolls, the mark behind a stone. In m; 0 for none.
  line: value("line", 0, (text) => numberOf("line", text)),
  // The fall of a ball that bounces: its height in m, and its coefficient of restitution.
  drop: value("drop", 0.1, (text) => numberOf("drop", text)),
  restitution: value("restitution", 0.8, (text) => numberOf("restitution", text)),
  step: value("step", 0, (text) => Number(oneOf(Object.keys(tour), text))),       // of the tour
  // Of the stop time, or of the part that is shown, that the moving point has reached.
  at: { ...value("fraction", 0, (text) => numberOf("at", text)), write: ({ fraction }) => Number(fraction.toFixed(4)) || null },
  // The stop time of that which the reader has drawn; 0 for none.
  isochrone: value("isochrone", 0, (text) => numberOf("isochrone", text)),
  theme: value("theme", "auto", (text) => oneOf(["auto", "light", "dark"], text)),
  // Only the balls are shown, for a page around this one.
  embed: { ...value("embed", false, () => true), write: ({ embed }) => (embed ? 1 : null) },
  // All is shown, not the first floor alone. A link of what only the Lab shows opens it.
  lab: {
    ...value("lab", false, (text) => text === "1"),
    write: (state) => (state.lab === labParts.some((key) => parts[key].write(state) != null) ? null : Number(state.lab)),
  },
};

/** Of what a link speaks that only the Lab shows, and that is more than how the page looks. */
const labParts = ["law", "body", "mu", "view", "window", "against", "field", "isochrones"];
const motionParts = [...labParts, "ball", "orbits", "part", "isochrone", "line"];

/** What a link opens that speaks of no motion: a puck whose spin lets it slide four times as far. */
const opening = "ball=puck&orbits=2.286,0.5";

/** @returns {State} */
export const initialState = () => structuredClone(Object.assign({}, ...Object.values(parts).map(({ first }) => first)));

export function toFragment(/** @type {State} */ state) {
  const query = new URLSearchParams();
  for (const [key, { write }] of Object.entries(parts)) if (write(state) != null) query.set(key, String(write(state)));
  return query.toString().replaceAll("%2C", ",").replaceAll("%3B", ";").replaceAll("%3A", ":").replaceAll("%2F", "/");
}

const queryOf = (fragment) => new URLSearchParams(fragment.replace(/^#/, ""));

/** The name of a ball in a link that the library does not have. */
function strangeBall(fragment, { balls }) {
  const name = queryOf(fragment).get("ball");
  return name === null || namesOf(balls).includes(name) ? "" : name || "no name";
}

/** Whether a link speaks of no motion, such as that of the page alone, or of a ball that nobody knows. */
export const speaksOfNothing = (fragment, known) => !motionParts.some((key) => queryOf(fragment).has(key)) || strangeBall(fragment, known) !== "";

/**
 * The state of a fragment; what cannot be read in it keeps its first value.
 *
 * @param known  of library.js
 * @param {string[]} problems  gets sentences on what cannot be read
 * @returns {State}
 */
export function fromFragment(fragment, known, problems = []) {
  const query = queryOf(fragment);
  const opens = speaksOfNothing(fragment, known);
  const strange = strangeBall(fragment, known);
  if (strange) problems.push(`There is no ball '${strange}'. Balls: ${namesOf(known.balls).join(", ")}.`);
  if (opens) motionParts.forEach((key) => query.delete(key));
  const state = opens ? fromFragment(opening, known) : initialState();
  state.lab = labParts.some((key) => query.has(key));
  for (const [key, { read }] of Object.entries(parts)) {
    if (query.has(key)) Object.assign(state, readable(problems, key, query.get(key) ?? "", read, known, state, problems));
  }
  const { mu, chi } = bodyOf(state, known);
  state.mu = mu ?? state.mu;
  // Lines are reached in metres.
  if (!state.ball) state.line = 0;
  // What cannot roll does not turn forward.
  if (!state.ball || chi === 1) state.orbits = state.orbits.map(unrolled);
  state.chosen = Math.max(0, Math.min(state.orbits.length - 1, state.chosen));
  return state;
}
