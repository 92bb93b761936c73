// Verdicts on tries, and the places at which earlier tries ended. In the last round a stone stands half way to a mark, and a
// ball that rolls is to curl around it.
import { length, shown } from "../numbers.js";
import { rideOn } from "./turning.js";

export const reach = 0.02;  // m by which a throw may miss the line, and a ball the mark
const kept = { game: 8, "": 3 };  // earlier throws that stay on the table
const samples = 1000;  // of the time

/** The stone that the ball is to curl around, as large as the ball; null if there is none. */
export const stoneOf = ({ line, ball }, rolls) =>
  (line && rolls ? { x: line / 2, y: 0, radius: ball.radius, mark: line } : null);

/**
 * Finds how a ball goes by a stone and the mark behind it.
 *
 * @param ride   of turning.js
 * @param stone  of stoneOf
 * @returns until: the share of the time at which it touches the stone, or 1; place: where it is then, or nearest to the
 *   mark; off: how far it is from the mark there, in m; hit: whether this is near enough
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
  // A path that curves is seen from where it leads to the right, or where it was thrown to.
  const [endX, endY] = [x, y].map((column) => column.at(-1));
  return (Math.abs(endY) > 1e-12 * Math.abs(endX) ? Math.atan2(endY, endX) : 0) - thrown;
}

/** Places at which earlier straight throws ended; or at which tries touched the stone, or were nearest to the mark behind it. */
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
    const words = mode === "game" ? `${shown(orbit.u / (ball?.radius ?? 1), 3)} rad/s` : length(far, contact ? "m" : "");
    return { x: far * Math.cos(angle), y: far * Math.sin(angle), words, colour };
  });
}
