// Two equal balls on the table, seen from above, one of which spins; and the patch on which a ball stands, from below.
import { length, roundDown, shown } from "./numbers.js";
import { rotation, turnedBy } from "./turning.js";

const smallest = 11;    // pixels, radius of a ball
const spotSize = 0.36;  // rad
const ringed = Math.atan(2);  // rad, of the corners of an icosahedron around the one on top
const circle = Array.from({ length: 24 }, (_, i) => rotation([0, 0, (i * Math.PI) / 12]))
    .map((turn) => turnedBy(turn, [Math.sin(spotSize), 0, Math.cos(spotSize)]));

const rings = [0, 1, 2, 3, 4].flatMap((i) => [[ringed, i], [Math.PI - ringed, i + 2.5]]);

/** Spots in the twelve corners of an icosahedron, one of them on top: the middle, then points of the border. */
const spots = [[0, 0], ...rings, [Math.PI, 0]].map(([tilt, fifths]) => {
  const azimuth = (2 * Math.PI * fifths) / 5;
  const tilted = rotation([tilt * Math.cos(azimuth), tilt * Math.sin(azimuth), 0]);
  return [[0, 0, 1], ...circle].map((point) => turnedBy(tilted, point));
});

/** A ball with spots, turned by a matrix; a flat body shows the same spots on its face. */
function drawBall(surface, x, y, radius, turn, colour, theme) {
  surface.shape([[x, y]], { radius, fill: colour, stroke: theme.card, width: 2 });
  const turned = spots.map((spot) => spot.map((point) => turnedBy(turn, point))).filter(([middle]) => middle[2] > -0.3);
  surface.shape(turned.map(([, ...border]) => border.flatMap(([px, py, pz]) => {
    // Behind the horizon the border goes along it.
    const out = 0.985 * radius * (pz < 0 ? 1 / Math.hypot(px, py) : 1);
    return [x + out * px, y - out * py];
  })), { fill: theme.card });
  surface.shape([[x, y]], { radius, stroke: theme.ink, width: 1.2 });
}

/**
 * @param scene  lanes: title, xs, ys, slides (the line of the path until it ceases to slide), at (x, y, turn), colour; radius; unit: "m" or "", lengths in m
 */
export function drawLanes(surface, { lanes, radius, unit }, theme) {
  const size = theme.textSize;
  const keys = [radius, unit, theme, ...lanes.flatMap(({ xs, slides, colour }) => [xs, slides.length, slides.at(-2), colour])];
  const { px, py, pixels, laneHeight } = surface.still(keys, theme.card, () => drawPaths(surface, { lanes, radius, unit }, theme));
  lanes.forEach(({ at, title, colour }, row) => {
    drawBall(surface, px(at.x), py(at.y, row), pixels, at.turn, colour, theme);
    surface.text(4, laneHeight * row + 0.65 * size, title, { colour: theme.ink, size, baseline: "middle", halo: theme.card });
  });
}

/** The table with the paths; returns where the balls go. */
function drawPaths(surface, { lanes, radius, unit }, theme) {
  const size = theme.textSize;
  const [xs, ys] = ["xs", "ys"].map((key) => lanes.flatMap((lane) => lane[key]));
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const laneHeight = (surface.height - 1.6 * size) / lanes.length;
  const most = laneHeight / 2 - 1.1 * size;
  /** Pixels of a metre, with a rim of `metres` and of `rim` pixels around the paths. */
  const scaleWith = (metres, rim) =>
    Math.min((surface.width - 8 - 2 * rim) / (right - left + 2 * metres), (2 * most - 2 * rim) / (high - low + 2 * metres));
  // A ball too small to be seen is drawn larger than it is.
  const seen = radius * scaleWith(radius, 0) >= smallest;
  const scale = seen ? scaleWith(radius, 0) : scaleWith(0, smallest);
  const pixels = seen ? radius * scale : smallest;
  const larger = pixels / (radius * scale);
  const px = (x) => pixels + 4 + (x - left) * scale;
  const py = (y, row) => laneHeight * row + 1.4 * size + most - (y - (low + high) / 2) * scale;
  lanes.forEach((lane, row) => {
    const slides = lane.slides.map((value, i) => (i % 2 ? py(value, row) : px(value)));
    const rest = lane.xs.flatMap((x, i) => (2 * i < slides.length - 2 ? [] : [px(x), py(lane.ys[i], row)]));
    surface.shape([[...slides.slice(-2), ...rest]], { stroke: theme.soft, width: 1.5 });
    surface.shape([slides], { stroke: `${lane.colour}66`, width: Math.min(16, pixels / 2) });
  });
  const bar = roundDown((surface.width * 0.22) / scale);
  const [end, base] = [surface.width - 6, surface.height - 5];
  const start = end - bar * scale;
  surface.shape([[start, base - 4, start, base, end, base, end, base - 4]], { stroke: theme.soft, width: 1.5 });
  const caption = `${length(bar, unit)}${larger > 1.05 ? `; drawn ${shown(larger, 2)} times as large` : ""}`;
  surface.text(start - 6, base - 1, caption, { colour: theme.soft, size: 0.95 * size, align: "right" });
  return { px, py, pixels, laneHeight };
}

const arrowShare = 0.06;  // of the patch's radius, the longest slip in it
const steps = Array.from({ length: 11 }, (_, i) => i - 5);
/** Points of the patch whose slip is drawn, in radii. */
const points = steps.flatMap((i) => steps.map((j) => [(i + (j % 2) / 2) / 5.5, (0.92 * j) / 5.5]))
    .filter(([x, y]) => Math.hypot(x, y) <= 0.88);

/**
 * @param scene  still: no point slips; k, the slip of the centre over that of the rim; spin: its sign; force: fraction of f N
 */
export function drawPatch(surface, { still, k, spin, force }, theme) {
  const size = theme.textSize;
  const radius = Math.min(surface.width / 2 - 4, (surface.height - 4.4 * size) / 2);
  const [x0, y0] = [surface.width / 2, 1.5 * size + radius];
  const base = y0 + radius + 1.2 * size;
  const arrow = (share, fill) => {
    const tip = x0 - share * radius;
    surface.shape([[x0, base, Math.min(x0, tip + 6), base]], { stroke: fill, width: 5 });
    surface.shape([[tip, base, tip + 9, base - 6, tip + 9, base + 6]], { fill });
  };
  surface.still([theme], theme.card, () => {
    surface.text(x0, 0.7 * size, "the patch, from below", { colour: theme.soft, size, align: "center", baseline: "middle" });
    surface.shape([[x0, y0]], { radius, fill: theme.paper, stroke: theme.soft, width: 1.5 });
    arrow(1, theme.line);
  });
  // From below, a ball that spins to the left when seen from above turns to the right.
  const [sliding, turning] = still ? [0, 0] : spin === 0 || k === Infinity ? [1, 0] : [k / (1 + k), -spin / (1 + k)];
  const strokes = points.map(([x, y]) => {
    const [dx, dy] = [sliding - turning * y, -turning * x].map((slip) => slip * 2 * arrowShare * radius);
    const [px, py] = [x0 + x * radius, y0 - y * radius];
    return [px - dx, py - dy, px + dx, py + dy];
  });
  surface.shape(strokes, { stroke: theme.ink, width: 1.3 });
  surface.shape(strokes.map((stroke) => stroke.slice(2)), { radius: 1.9, fill: theme.ink });
  const accent = theme.swatch(0);
  const style = { colour: accent, size, align: "center", baseline: "middle", halo: theme.paper };
  if (spin !== 0 && k < 1) {
    const y = y0 - (sliding / turning) * radius;
    surface.shape([[x0, y]], { radius: 5, fill: accent, stroke: theme.card, width: 1.5 });
    surface.text(x0, y + (y > y0 ? -1 : 1) * 1.2 * size, "does not slip", style);
  }
  if (force > 0.02) arrow(force, accent);
  const left = force < 0.001 ? "none" : `${shown(100 * force, force < 0.1 ? 1 : 2)} %`;
  surface.text(x0, base + 1.2 * size, `friction left: ${left}`, style);
}
