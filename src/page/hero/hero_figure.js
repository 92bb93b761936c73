// Two equal balls on the table, seen from above, one of which spins; and the patch on which a ball stands, from below.
import { length, roundDown, shown } from "../numbers.js";
import { borderOf, widthOf } from "../drawing/surface.js";
import { product, rotation, turnedBy } from "./turning.js";

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

/** What rolls is seen from above and before it: its spots go over the top and down, where one that slides shows the same ones. */
const seen = rotation([-0.7, 0, 0]);

/** A ball with spots, turned by a matrix; a flat body shows the same spots on its face, from above. */
function drawBall(surface, { x, y, radius, rolls }, turn, colour, theme) {
  surface.shape([[x, y]], { radius, fill: colour, stroke: theme.card, width: 2 });
  const view = rolls ? product(seen, turn) : turn;
  const turned = spots.map((spot) => spot.map((point) => turnedBy(view, point))).filter(([middle]) => middle[2] > -0.3);
  surface.shape(turned.map(([, ...border]) => border.flatMap(([px, py, pz]) => {
    // Behind the horizon the border goes along it.
    const out = 0.985 * radius * (pz < 0 ? 1 / Math.hypot(px, py) : 1);
    return [x + out * px, y - out * py];
  })), { fill: theme.card });
  surface.shape([[x, y]], { radius, stroke: theme.ink, width: 1.2 });
}

/**
 * @param scene  lanes: title, xs, ys, slides (the line of the path until it ceases to slide), at (x, y, turn), colour, and
 *   ruler: {from, to: places, more: m} between where the other stands and this one; radius; unit: "m" or "", lengths in m; rolls: seen at an angle;
 *   secret: the paths are not drawn; aim: {from, to: pixels, words} of a throw; placed: {from, to: places, words} of the
 *   reader's ruler, which then is the only one
 * @returns {{places: {x: number, y: number, radius: number}[], rulerEnds: number[][], toTable: (x: number, y: number) => {x: number, y: number}}}
 *   in pixels where the bodies are, and the ends of the ruler or of the bar of the scale; the place at a pixel on the second table
 */
export function drawLanes(surface, scene, theme) {
  const { lanes, radius, unit, rolls, secret, aim, placed } = scene;
  const size = theme.textSize;
  const keys = [radius, unit, secret, theme, ...lanes.flatMap(({ xs, slides, colour }) => [xs, slides.length, slides.at(-2), colour])];
  const table = surface.still(keys, theme.card, () => drawPaths(surface, scene, theme));
  let ends = table.bar;
  const places = lanes.map(({ at, title, colour, ruler }, i) => {
    const [x, y] = table.pixel(at, i);
    if (ruler && !secret && !aim) {
      surface.shape([table.pixel(ruler.from, i)], { radius: table.pixels, fill: theme.card, stroke: theme.soft, width: 1.5, dash: [4, 4] });
      if (!placed) ends = drawRuler(surface, besides(table, i, ruler, theme), `${length(ruler.more, unit)} more`, theme) ?? ends;
    }
    drawBall(surface, { x, y, radius: table.pixels, rolls }, at.turn, colour, theme);
    surface.text(table.cells[i].left + 4, table.cells[i].top + 0.65 * size, title, { colour: theme.ink, size, baseline: "middle", halo: theme.card });
    return { x, y, radius: table.pixels };
  });
  if (placed && !secret) ends = drawRuler(surface, [placed.from, placed.to].map((place) => table.pixel(place, 1)), placed.words, theme) ?? ends;
  if (aim) drawAim(surface, aim, theme);
  return { places, rulerEnds: ends, toTable: table.toTable };
}

/** The arrow of a throw, with what it says. */
function drawAim(surface, { from: [x, y], to, words }, theme) {
  const [dx, dy] = [to[0] - x, to[1] - y];
  const far = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [dx / far, dy / far];
  surface.shape([[x, y, to[0] - 8 * ux, to[1] - 8 * uy]], { stroke: theme.ink, width: 4 });
  surface.shape([[to[0] + 6 * ux, to[1] + 6 * uy, ...[1, -1].flatMap((side) => [to[0] - 10 * ux - side * 8 * uy, to[1] - 10 * uy + side * 8 * ux])]], { fill: theme.ink });
  const half = widthOf(words, { size: theme.textSize, bold: true }) / 2 + 4;
  const within = (value, rim, side) => Math.min(side - rim, Math.max(rim, value));
  const beyond = dy > 4 ? 1.6 : -1.6;
  surface.text(within(to[0], half, surface.width), within(to[1] + beyond * theme.textSize, theme.textSize, surface.height), words, { colour: theme.ink, size: theme.textSize, bold: true, align: "center", baseline: "middle", halo: theme.card });
}

/** The ends of a ruler between two places, beside the bodies, below them. */
function besides({ pixel, pixels }, i, { from, to }, theme) {
  const ends = [pixel(from, i), pixel(to, i)];
  const [[ax, ay], [bx, by]] = ends;
  const far = Math.hypot(bx - ax, by - ay) || 1;
  const out = ((bx < ax ? -1 : 1) * (pixels + 0.8 * theme.textSize)) / far;
  return ends.map(([x, y]) => [x - out * (by - ay), y + out * (bx - ax)]);
}

/** A ruler with its words in it, or where they do not fit beside it or at its end. @returns its ends, if it can be seen */
function drawRuler(surface, ends, words, theme) {
  const [[ax, ay], [bx, by]] = ends;
  const far = Math.hypot(bx - ax, by - ay);
  if (far < 2) return null;
  const side = bx < ax ? -1 : 1;
  const [nx, ny] = [(-side * (by - ay)) / far, (side * (bx - ax)) / far];
  const wide = widthOf(words, { size: theme.textSize, bold: true }) + 10;
  const steep = Math.abs(by - ay) > 0.3 * far;
  const fits = !steep && far > wide + 16;
  const gap = fits ? (1 - wide / far) / 2 : 0.5;  // a share, before and behind it
  const point = (share) => [ax + share * (bx - ax), ay + share * (by - ay)];
  surface.shape([[...point(0), ...point(gap)], [...point(1 - gap), ...point(1)], ...ends.map(([x, y]) => [x - 5 * nx, y - 5 * ny, x + 5 * nx, y + 5 * ny])],
    { stroke: theme.ink, width: 1.5 });
  const [middle, level] = point(0.5);
  // Where there is no room to the right, to the left.
  const before = steep ? nx < 0 || middle + 8 * nx + wide > surface.width : !fits && Math.max(ax, bx) + wide > surface.width;
  const [x, y] = steep ? [middle + (before ? -8 : 8) * Math.abs(nx), level + 8 * ny] : fits ? [middle, level] : [before ? Math.min(ax, bx) - 8 : Math.max(ax, bx) + 8, ay];
  const align = before ? "right" : fits ? "center" : "left";
  surface.text(x, y, words, { colour: theme.ink, size: theme.textSize, bold: true, baseline: "middle", align });
  return ends;
}

/** The table with the paths; returns where the bodies go. */
function drawPaths(surface, { lanes, radius, unit, secret, rolls }, theme) {
  const size = theme.textSize;
  const [xs, ys] = ["xs", "ys"].map((key) => lanes.flatMap((lane) => lane[key]));
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const above = 1.3 * size;  // for a title
  const room = surface.height - 3.1 * size;  // without the bar of the scale, and a ruler
  /** Bodies one below the other, or side by side. */
  const tableOf = (columns, rows) => {
    const [width, height] = [surface.width / columns, room / rows];
    /** Pixels of a metre, with a rim of `metres` and of `rim` pixels around the paths. */
    const scaleWith = (metres, rim) =>
      Math.min((width - 8 - 2 * rim) / (right - left + 2 * metres), (height - above - 2 * rim) / (high - low + 2 * metres));
    // A body too small to be seen is drawn larger than it is.
    const seen = radius * scaleWith(radius, 0) >= smallest;
    const scale = seen ? scaleWith(radius, 0) : scaleWith(0, smallest);
    const cells = lanes.map((_, i) => ({ left: width * (i % columns), top: height * Math.floor(i / columns) }));
    return { height, scale, cells, pixels: seen ? radius * scale : smallest };
  };
  const [rows, columns] = [tableOf(1, lanes.length), tableOf(lanes.length, 1)];
  const { height, scale, cells, pixels } = high - low > (right - left) / 4 && columns.scale > 1.2 * rows.scale ? columns : rows;
  const pixel = ({ x, y }, i) => [cells[i].left + pixels + 4 + (x - left) * scale, cells[i].top + above + (height - above) / 2 - (y - (low + high) / 2) * scale];
  if (!secret) lanes.forEach((lane, i) => {
    const pixelsOf = (line) => Array.from({ length: line.length / 2 }, (_, j) => pixel({ x: line[2 * j], y: line[2 * j + 1] }, i)).flat();
    const slides = pixelsOf(lane.slides);
    const rest = pixelsOf(lane.xs.flatMap((x, j) => (2 * j < slides.length - 2 ? [] : [x, lane.ys[j]])));
    if (rolls) surface.shape([[...slides.slice(-2), ...rest]], { stroke: theme.soft, width: 1.5 });
    surface.shape([slides], { stroke: `${lane.colour}66`, width: Math.min(16, pixels / 2) });
  });
  const bar = roundDown((surface.width * 0.22) / scale);
  const [end, base] = [surface.width - 6, surface.height - 5];
  const start = end - bar * scale;
  surface.shape([[start, base - 4, start, base, end, base, end, base - 4]], { stroke: theme.soft, width: 1.5 });
  const larger = pixels / (radius * scale);
  const caption = `${length(bar, unit)}${larger > 1.05 ? `; drawn ${shown(larger, 2)} times as large` : ""}`;
  surface.text(start - 6, base - 1, caption, { colour: theme.soft, size: 0.95 * size, align: "right" });
  const toTable = (x, y) => ({ x: left + (x - cells[1].left - pixels - 4) / scale, y: (low + high) / 2 - (y - cells[1].top - above - (height - above) / 2) / scale });
  return { pixel, pixels, cells, toTable, bar: [[start, base], [end, base]] };
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
  const style = { colour: accent, size, align: "center", baseline: "middle" };
  if (spin !== 0 && k < 1) {
    const y = y0 - (sliding / turning) * radius;
    surface.shape([[x0, y]], { radius: 5, fill: accent, stroke: theme.card, width: 1.5 });
    const [beside, half] = [y + (y > y0 ? -1 : 1) * 1.4 * size, widthOf("does not slip", style) / 2];
    surface.shape([borderOf({ left: x0 - half - 3, top: beside - 0.7 * size, width: 2 * half + 6, height: 1.4 * size })], { fill: theme.paper });
    surface.text(x0, beside, "does not slip", style);
  }
  if (force > 0.02) arrow(force, accent);
  const left = force < 0.001 ? "none" : `${shown(100 * force, force < 0.1 ? 1 : 2)} %`;
  surface.text(x0, base + 1.2 * size, `against sliding: ${left}`, style);
}
