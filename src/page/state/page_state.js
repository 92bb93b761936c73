// The state that a link restores, and its text after the # of the address.
import { parseNumber, shown } from "../numbers.js";
import { tour } from "./presets.js";
import { lineOf } from "../hero/tries.js";

/**
 * Returns chi and gamma of the state's body, and mu if the body determines it.
 * @returns {{chi: number, gamma: number, mu: number | undefined}}
 */
export const bodyOf = ({ body }, { bodies }) => bodies.find(({ name }) => name === body);

export const ballKeys = ["radius", "mass", "friction", "gravity", "patch", "rollingFriction", "slope"];

const startKeys = ["u", "v", "along", "across", "heading"];

/** Allowed ranges of numbers. The default is 1e-9 to 1e9; beyond it, results may overflow. */
const ranges = {
  rollingFriction: [0, 1e3], slope: [-89, 89], along: [-1e9, 1e9], across: [-1e9, 1e9], mu: [1e-6, 1],
  U: [Number.MIN_VALUE, Infinity], V: [Number.MIN_VALUE, Infinity], u: [-Infinity, Infinity], v: [0, Infinity], heading: [-360, 360],
  chosen: [0, Infinity], tries: [0, 999], at: [0, 1], restitution: [0, 1], isochrone: [Number.MIN_VALUE, Infinity],
};

/** Returns the value. @throws {Error} if the value is outside the range of its name */
export function allowed(key, value) {
  const [low, high] = ranges[key] ?? [1e-9, 1e9];
  if (low > 0 && !(value > 0)) throw new Error("a positive number is needed");
  if (!(value >= low && value <= high)) throw new Error(`from ${shown(low)} to ${shown(high)} is allowed`);
  return value;
}

/** Returns a start with u and v; types.d.ts describes the other members. @returns {Start} */
export const startOf = (u, v, along = v, across = 0, heading = 0) => ({ u, v, along, across, heading });

/** The start of a ball that the library gives in SI units. */
export const startFrom = ({ slip, spin, along, across }, { radius }, digits = 17) =>
  startOf(...[spin * radius, slip, along, across].map((speed) => Number(speed.toPrecision(digits))));

/** Returns the start without rolling, for a body that cannot roll or has no size. */
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

// Readers of the parts of a link. Each throws if it cannot read its text.
const numberOf = (key, text) => allowed(key, parseNumber(text));
const numbersOf = (keys, text) => keys.map((key, i) => numberOf(key, text.split(",")[i] ?? ""));
const startIn = (text) => {
  const [u, v, along, across, heading] = numbersOf(startKeys.slice(0, Math.max(2, text.split(",").length)), text);
  return startOf(u, v, along, across, heading);
};

/** Returns the points of a text such as "1, 2; 3, 4". @throws {Error} if one cannot be read */
export const pointsIn = (text) => text.split(";").filter((point) => point.trim()).map((point) => {
  const [x, y, more] = point.split(",");
  if (more !== undefined) throw new Error(`'${point.trim()}' has more than two numbers; a point is 1, 2, and a semicolon stands between points`);
  return [parseNumber(x), parseNumber(y ?? "")];
});

function oneOf(names, text) {
  if (!names.includes(text)) throw new Error(`one of ${names} is needed`);
  return text;
}

const namesOf = (entries) => entries.map(({ name }) => name);

/**
 * Returns the value that `read` gives for a text of a link, or undefined.
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

/** Returns a day of the calendar. @throws {Error} if the text is none */
function dayIn(text) {
  const isDay = /^\d{4}-\d\d-\d\d$/.test(text) && new Date(text).getTime() && new Date(text).toISOString().startsWith(text);
  if (!isDay) throw new Error("a day such as 2026-11-28 is needed");
  return text;
}

/** A part of a link that is one value of the state. A link leaves out the initial value. */
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
 * The parts of the state by their names in a link, in the order of reading. first: initial values; write: returns the text
 * of the part, or null for none; read: returns the members of the state that a text sets.
 * @type {Record<string, {first?: Partial<State>, write: (state: State) => unknown,
 *   read: (text: string, known: Library, state: State, problems: string[]) => object | void | null}>}
 */
const parts = {
  body: {
    ...value("body", "ball", (text, { bodies }) => oneOf(namesOf(bodies), text)),
    write: ({ ball, body }) => (ball || body === "ball" ? null : body),
  },
  // In a link without a ball, mu shows that there is none.
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
  field: value("field", "none", (text) => oneOf(["none", "motion"], text)),  // field of directions
  isochrones: value("isochrones", 7, (text) => Number(oneOf(["0", "7"], text))),  // approximate number of lines of equal stop time
  // The shown part of the motion: "whole", or "sliding", the initial value for a ball.
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
  line: { ...value("line", 0, (text) => numberOf("line", text)), write: ({ line, day }) => (day || !line ? null : line) },
  // The day (UTC) whose line is to be reached, as YYYY-MM-DD; "" for none.
  day: { ...value("day", "", String), read: (text) => ({ day: dayIn(text), line: lineOf(text) }) },
  tries: value("tries", 0, (text) => Math.floor(numberOf("tries", text))),  // tries of the friend who sent the line; 0 for none
  // The fall of a ball that bounces: its height in m, and its coefficient of restitution.
  drop: value("drop", 0.1, (text) => numberOf("drop", text)),
  restitution: value("restitution", 0.8, (text) => numberOf("restitution", text)),
  // Typed equations of another plane, and points of orbits in this plane.
  system: value("system", "", String),
  points: { ...value("points", null, pointsIn), first: { points: [] }, write: ({ points }) => points.join(";") || null },
  step: value("step", 0, (text) => Number(oneOf(Object.keys(tour), text))),       // step of the tour
  // Place of the moving point, as a share of the stop time or of the shown part.
  at: { ...value("fraction", 0, (text) => numberOf("at", text)), write: ({ fraction }) => Number(fraction.toFixed(4)) || null },
  // Stop time of the isochrone that the reader has drawn; 0 for none.
  isochrone: value("isochrone", 0, (text) => numberOf("isochrone", text)),
  theme: value("theme", "auto", (text) => oneOf(["auto", "light", "dark"], text)),
  // Only the balls are shown, for a page around this one.
  embed: { ...value("embed", false, (text) => text !== "0"), write: ({ embed }) => (embed ? 1 : null) },
  // Headline, table and plane alone, in large letters.
  project: { ...value("project", false, (text) => text === "1"), write: ({ project }) => (project ? 1 : null) },
  // The Lab is open. A link with values that only the Lab shows opens it.
  lab: {
    ...value("lab", false, (text) => text === "1"),
    write: (state) => (state.lab === labParts.some((key) => parts[key].write(state) != null) ? null : Number(state.lab)),
  },
};

/** Parts of a link that only the Lab shows, except those of the look of the page. */
const labParts = ["law", "body", "mu", "view", "window", "against", "field", "isochrones", "system"];
const bodyParts = [...labParts, "ball", "orbits", "part", "isochrone"];
const motionParts = [...bodyParts, "line", "day"];

/** Replacement for a link without a motion: a puck whose spin lets it slide four times as far. */
const opening = "ball=puck&orbits=2.286,0.5";

/** @returns {State} */
export const initialState = () => structuredClone(Object.assign({}, ...Object.values(parts).map(({ first }) => first)));

/**
 * Returns the text of a link. The opening has none, so that its address asks the question again.
 * @param asks  true: the page asks the question; the link does not contain the moment
 */
export function toFragment(/** @type {State} */ state, asks = false) {
  const query = new URLSearchParams();
  for (const [key, { write }] of Object.entries(parts)) if (write(state) != null) query.set(key, String(write(state)));
  const opens = ["chosen", ...bodyParts].every((key) => query.get(key) === queryOf(opening).get(key));
  if (opens && (asks || state.fraction === 0 || state.fraction === 1)) for (const key of [...bodyParts, "at"]) query.delete(key);
  return query.toString().replaceAll("%2C", ",").replaceAll("%3B", ";").replaceAll("%3A", ":").replaceAll("%2F", "/");
}

const queryOf = (fragment) => new URLSearchParams(fragment.replace(/^#/, ""));

/** Returns the name of a ball in a link if the library does not contain this ball. */
function strangeBall(fragment, { balls }) {
  const name = queryOf(fragment).get("ball");
  return name === null || namesOf(balls).includes(name) ? "" : name || "no name";
}

/** Returns true for a link without a motion, such as the plain address, and for a link with an unknown ball. */
export const speaksOfNothing = (fragment, known) => !motionParts.some((key) => queryOf(fragment).has(key)) || strangeBall(fragment, known) !== "";

/**
 * Returns the state of a fragment. Parts that cannot be read keep their initial values.
 * @param known  the library
 * @param {string[]} problems  gets a sentence for each part that cannot be read
 * @returns {State}
 */
export function fromFragment(fragment, known, problems = []) {
  const query = queryOf(fragment);
  const opens = speaksOfNothing(fragment, known);
  const strange = strangeBall(fragment, known);
  if (strange) problems.push(`There is no ball '${strange}'. Balls: ${namesOf(known.balls).join(", ")}.`);
  if (opens) motionParts.forEach((key) => query.delete(key));
  // A link of the game may leave out the puck.
  const state = bodyParts.some((key) => query.has(key)) ? initialState() : fromFragment(opening, known);
  state.lab = labParts.some((key) => query.has(key));
  for (const [key, { read }] of Object.entries(parts)) {
    if (query.has(key)) Object.assign(state, readable(problems, key, query.get(key) ?? "", read, known, state, problems));
  }
  const { mu, chi } = bodyOf(state, known);
  state.mu = mu ?? state.mu;
  // Lines are reached in metres.
  if (!state.ball) Object.assign(state, { line: 0, day: "", tries: 0 });
  // A body that cannot roll starts without rolling.
  if (!state.ball || chi === 1) state.orbits = state.orbits.map(unrolled);
  state.chosen = Math.max(0, Math.min(state.orbits.length - 1, state.chosen));
  return state;
}
