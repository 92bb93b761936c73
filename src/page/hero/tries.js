// Lines of the game, verdicts on tries, and the places at which earlier tries ended. In the last round a stone stands half way to a mark, and the
// ball must curl around it.
import { length, turnsOf } from "../numbers.js";
import { rideOn } from "./turning.js";

export const reach = 0.02;  // m by which a throw may miss the line, and a ball the mark
const kept = { game: 8, "": 3 };  // earlier throws that stay on the table
const samples = 1000;  // instants at which the distance is computed
const daily = { from: 0.6, until: 3 };  // m, limits of the line of a day
const far = 0.2;       // m, miss of a try with a double mark

/** Returns the speeds of a throw at its full length and of a full turn of the ring: m/s and rad/s, or without units. */
export const fullSpeeds = (contact) => (contact ? { slip: 2, spin: 500 } : { slip: 5, spin: 5 });

/** The day in UTC, so that everybody has the same line at one time. */
export const today = () => new Date().toISOString().slice(0, 10);

/** Returns the line of a day in m, in whole cm. The numbers of neighbouring days are far apart. */
export function lineOf(/** @type {string} */ day) {
  const share = (Math.imul(Date.parse(day) / 86_400_000, 0x9e3779b1) >>> 0) / 2 ** 32;
  return Math.round(100 * (daily.from + share * (daily.until - daily.from))) / 100;
}

/** Returns one mark for each try until the chosen one: short of the line, beyond it, or a hit. A mark contains no number that helps. */
export const marksOf = (store) => store.state.orbits.slice(1, store.state.chosen + 1).map((_, i) => {
  const { own: { path }, passage } = store.rideOf(store.state, i + 1);
  const off = path - store.state.line;
  if (passage ? passage.hit : Math.abs(off) <= reach) return "🎯";
  return passage ? "✖️" : off < -far ? "⏪" : off < 0 ? "◀️" : off > far ? "⏩" : "▶️";
}).join("");

/** Returns the stone around which the ball must curl, as large as the ball; null if there is none. */
export const stoneOf = ({ line, ball }, rolls) =>
  (line && rolls ? { x: line / 2, y: 0, radius: ball.radius, mark: line } : null);

/**
 * Finds how a ball passes a stone and the mark behind it.
 * @param ride   result of rideOn
 * @param stone  result of stoneOf
 * @returns until: share of the time at which the ball touches the stone, or 1; place: its place then, or nearest to the
 *   mark; off: its distance from the mark there, m; hit: true if this distance is small enough
 */
export function passageOf(ride, { x, y, radius, mark }) {
  let nearest = { place: ride.at(0), off: Infinity };
  for (let i = 0; i <= samples; ++i) {
    const place = ride.at(i / samples);
    const off = Math.hypot(place.x - mark, place.y);
    if (Math.hypot(place.x - x, place.y - y) < 2 * radius) return { until: i / samples, place, off, hit: false };
    if (off < nearest.off) nearest = { place, off };
  }
  return { until: 1, ...nearest, hit: nearest.off <= reach };
}

/** The angle of the table's right-hand side in the axes of a ride. */
export function rightOf(/** @type {Start} */ { along, across, heading }, { x, y }, stone) {
  const thrown = (heading * Math.PI) / 180;
  if (stone) return Math.atan2(across, along) - thrown;
  // The view is turned so that the end of a curved path lies to the right, or in the direction of the throw.
  const [endX, endY] = [x, y].map((column) => column.at(-1));
  return (Math.abs(endY) > 1e-12 * Math.abs(endX) ? Math.atan2(endY, endX) : 0) - thrown;
}

/** Returns the places at which earlier straight throws ended, or at which tries touched the stone or were nearest to the mark. */
export function ghostsOf(store, mode) {
  const { state: { orbits, chosen, ball, law, mu, body, part, fraction }, theme } = store;
  const stone = store.ride?.stone;
  const ended = fraction >= 1;
  const key = [orbits, chosen, ball, law, mu, body, part, mode, stone, ended, theme.kind];
  return store.keep("ghosts", key, () => ghosts(store, mode, stone, ended));
}

function ghosts(store, mode, stone, ended) {
  const { state: { orbits, chosen, ball }, theme, contact } = store;
  const isThere = ({ index, across }) => (stone ? index > 0 && (index !== chosen || ended) : index !== chosen && across === 0);
  const earlier = orbits.map((orbit, index) => ({ ...orbit, index })).filter(isThere);
  return earlier.filter((_, i) => i >= earlier.length - (kept[mode] ?? 0)).map((orbit) => {
    const { own: { path: far }, courses: [, course], passage } = store.rideOf(store.state, orbit.index);
    const colour = theme.swatch(orbit.index);
    if (stone) {
      const { x, y } = passage.place;
      return { x, y, words: String(orbit.index), colour, path: rideOn(course, rightOf(orbit, course, stone), 1).until(1) };
    }
    const angle = ((orbit.heading + (orbit.along < 0 ? 180 : 0)) * Math.PI) / 180;
    const words = mode === "game" ? turnsOf(orbit.u / (ball?.radius ?? 1)) : length(far, contact ? "m" : "");
    return { x: far * Math.cos(angle), y: far * Math.sin(angle), words, colour };
  });
}
