// Two equal balls on the table, seen from above, one of which spins; and the patch on which a ball stands, from below.
import { length, roundDown, shown } from "../numbers.js";
import { borderOf, widthOf } from "../drawing/surface.js";
import { product, rotation, turnedBy } from "./turning.js";

const smallest = 11;    // pixels, radius of a ball
/** Pixels between a body and its ring; the ring of the game is 72 pixels wide at least, so that it is seen around a thumb. */
export const ringGap = (wide) => (wide ? 25 : 12);
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

/** Direction of view for a ball that rolls, from above and in front: spots move over the top, and those of a sliding ball stay. */
const seen = rotation([-0.7, 0, 0]);

/** A ball with spots, turned by a matrix; a flat body has one mark on its face, seen from above. */
export function drawBall(surface, { x, y, radius, rolls }, turn, colour, theme) {
  surface.shape([[x, y]], { radius, fill: colour, stroke: theme.card, width: 2 });
  if (rolls) {
    const view = product(seen, turn);
    const turned = spots.map((spot) => spot.map((point) => turnedBy(view, point))).filter(([middle]) => middle[2] > -0.3);
    surface.shape(turned.map(([, ...border]) => border.flatMap(([px, py, pz]) => {
      // Behind the horizon the border goes along it.
      const out = 0.985 * radius * (pz < 0 ? 1 / Math.hypot(px, py) : 1);
      return [x + out * px, y - out * py];
    })), { fill: theme.card });
  } else {
    const [px, py] = turnedBy(turn, [0.78 * radius, 0, 0]);
    surface.shape([[x, y, x + px, y - py]], { stroke: theme.card, width: Math.max(2.5, 0.18 * radius) });
  }
  surface.shape([[x, y]], { radius, stroke: theme.ink, width: 1.2 });
}

/**
 * @param scene  lanes: title, xs, ys, slid and rolled (lines of the path until now), at (x, y, turn), colour, and ruler:
 *   {from, to: places, more: m} between the end of the other body and this one; radius; unit: "m" or "", lengths in m; rolls: seen
 *   at an angle; ghosts: {x, y, words, colour, perhaps path: a line} of earlier throws; line: {at, reach, words, stone: of tries.js
 *   or null} to reach, or null; ring: {share, words} of the full spin, or null; wide: its size, see ringGap; aim: {from, to: pixels, words} of a throw
 * @returns {{places: {x: number, y: number, radius: number}[]}} places of the bodies in pixels; with a stone also the start of the ball
 */
export function drawLanes(surface, scene, theme) {
  const { lanes, radius, unit, rolls, ghosts, line, ring, wide, aim } = scene;
  const size = theme.textSize;
  const keys = [radius, unit, theme, line?.at, ...ghosts.map(({ x }) => x), ...lanes.map(({ xs }) => xs)];
  const table = surface.still(keys, theme.card, () => drawTable(surface, scene, theme));
  const { pixel, pixels, cells } = table;
  if (line) (line.stone ? drawStone : drawLine)(surface, table, line, theme);
  const last = lanes.length - 1;
  const pixelsOf = (path, i) => Array.from({ length: path.length / 2 }, (_, j) => pixel({ x: path[2 * j], y: path[2 * j + 1] }, i)).flat();
  ghosts.forEach(({ x: far, y: aside, words, colour, path = [] }, i) => {
    const [x, y] = pixel({ x: far, y: aside }, last);
    surface.shape([pixelsOf(path, last)], { stroke: colour, width: 1.5 });
    surface.shape([[x, y]], { radius: pixels, stroke: colour, width: 1.5, dash: [3, 3] });
    // Labels of neighbours do not meet.
    const below = [pixels + 0.8 * size, -pixels - 0.8 * size, pixels + 2 * size][i % 3];
    const half = widthOf(words, { size: 0.92 * size }) / 2;
    surface.text(Math.min(x, surface.width - half), y + below, words, { colour, size: 0.92 * size, align: "center", baseline: "middle", halo: theme.card });
  });
  const places = lanes.map(({ at, title, colour, ruler, slid, rolled }, i) => {
    if (rolled.length) surface.shape([pixelsOf(rolled, i)], { stroke: theme.soft, width: 1.5 });
    surface.shape([pixelsOf(slid, i)], { stroke: `${colour}66`, width: Math.min(16, pixels / 2) });
    const [x, y] = pixel(at, i);
    if (ruler && !aim && !ghosts.length) {
      surface.shape([pixel(ruler.from, i)], { radius: pixels, fill: theme.card, stroke: theme.soft, width: 1.5, dash: [4, 4] });
      drawRuler(surface, table, i, ruler, `${length(ruler.more, unit)} more`, theme);
    }
    drawBall(surface, { x, y, radius: pixels, rolls }, at.turn, colour, theme);
    const room = cells[1] && cells[1].top === cells[0].top ? cells[1].left : surface.width;
    const fitting = Math.min(1, (room - 8) / widthOf(title, { size }));
    surface.text(cells[i].left + 4, cells[i].top + 0.65 * size, title, { colour: theme.ink, size: fitting * size, baseline: "middle", halo: theme.card });
    return { x, y, radius: pixels };
  });
  if (ring) drawRing(surface, places[last], ring, ringGap(wide), theme);
  if (aim) drawAim(surface, aim, theme);
  const [x, y] = pixel({ x: 0, y: 0 }, last);
  return { places: line?.stone ? [...places, { x, y, radius: pixels }] : places };
}

/** Draws the line to reach; its width is the allowed miss. */
function drawLine(surface, { pixel, cells, height }, { at, reach, words }, theme) {
  const [[left], [x], [right]] = [at - reach, at, at + reach].map((far) => pixel({ x: far, y: 0 }, cells.length - 1));
  const cell = cells[cells.length - 1];
  const top = cell.top + 1.3 * theme.textSize;
  surface.shape([borderOf({ left, top, width: right - left, height: height - 1.3 * theme.textSize })], { fill: theme.line });
  surface.shape([[x, top, x, cell.top + height]], { stroke: theme.ink, width: 1.5 });
  surface.text(x, cell.top + 0.65 * theme.textSize, words, { colour: theme.ink, size: theme.textSize, bold: true, align: "center", baseline: "middle", halo: theme.card });
}

/** Draws a stone and the mark behind it; the width of the mark is the allowed miss. */
function drawStone(surface, { pixel, pixels, scale }, { at, reach, words, stone }, theme) {
  const [x, y] = pixel({ x: at, y: 0 }, 0);
  const mark = reach * scale;
  const style = { colour: theme.ink, size: theme.textSize, bold: true, align: "center", baseline: "middle", halo: theme.card };
  surface.shape([[x, y]], { radius: mark, fill: theme.line, stroke: theme.ink, width: 1.5 });
  surface.shape([[x - 2 * mark, y, x + 2 * mark, y], [x, y - 2 * mark, x, y + 2 * mark]], { stroke: theme.ink, width: 1.5 });
  surface.text(x, y - 2 * mark - 0.7 * theme.textSize, words, style);
  surface.shape([pixel({ x: 0, y: 0 }, 0)], { radius: pixels, stroke: theme.soft, width: 1.5, dash: [3, 3] });
  surface.shape([pixel(stone, 0)], { radius: pixels, fill: theme.soft, stroke: theme.ink, width: 1.5 });
}

/** Returns the line of an arrow from (x, y) along (dx, dy), and its head. */
export function arrowOf(x, y, dx, dy, size) {
  const length = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [(size * dx) / length, (size * dy) / length];
  const [px, py] = [x + dx, y + dy];
  return { line: [x, y, px - 0.8 * ux, py - 0.8 * uy], head: [px, py, px - ux - 0.5 * uy, py - uy + 0.5 * ux, px - ux + 0.5 * uy, py - uy - 0.5 * ux] };
}

/** Draws an arc from an angle, with the head of an arrow at its end; an arc too short for the head is left out. */
export function drawArc(surface, x, y, out, from, sweep, colour, width) {
  if (Math.abs(sweep) < 0.05) return;
  const at = (angle) => [x + out * Math.cos(angle), y - out * Math.sin(angle)];
  const [[ax, ay], [bx, by]] = [at(from + sweep - (9 * Math.sign(sweep)) / out), at(from + sweep)];
  surface.shape([Array.from({ length: 61 }, (_, i) => at(from + (sweep * i) / 60)).flat()], { stroke: colour, width });
  surface.shape([arrowOf(bx, by, bx - ax, by - ay, 13).head], { fill: colour });
}

/** Draws the ring that the reader pulls to spin a body; an arrow along it shows the spin. */
function drawRing(surface, { x, y, radius }, { share, words }, gap, theme) {
  const out = radius + gap;
  surface.shape([[x, y]], { radius: out, stroke: theme.soft, width: 2, dash: [2, 5] });
  drawArc(surface, x, y, out, Math.PI / 2, 1.8 * Math.PI * share, theme.ink, 3.5);
  const right = x + out + 8 + widthOf(words, { size: theme.textSize, bold: true }) < surface.width;
  surface.text(right ? x + out + 8 : x - out - 8, y, words, { colour: theme.ink, size: theme.textSize, bold: true, align: right ? "left" : "right", baseline: "middle", halo: theme.card });
}

/** Draws the arrow of a throw and its words. */
function drawAim(surface, { from: [x, y], to, words }, theme) {
  const [dx, dy] = [to[0] - x, to[1] - y];
  const { line, head } = arrowOf(x, y, dx, dy, 16);
  surface.shape([line], { stroke: theme.ink, width: 4 });
  surface.shape([head], { fill: theme.ink });
  const half = widthOf(words, { size: theme.textSize, bold: true }) / 2 + 4;
  const within = (value, rim, side) => Math.min(side - rim, Math.max(rim, value));
  const beyond = dy > 4 ? 1.6 : -1.6;
  surface.text(within(to[0], half, surface.width), within(to[1] + beyond * theme.textSize, theme.textSize, surface.height), words, { colour: theme.ink, size: theme.textSize, bold: true, align: "center", baseline: "middle", halo: theme.card });
}

/** Draws a ruler between two places. Its words stand on it or, without room, beside it. */
function drawRuler(surface, { pixel, pixels }, i, { from, to }, words, theme) {
  const [[ax, ay], [bx, by]] = [pixel(from, i), pixel(to, i)];
  const far = Math.hypot(bx - ax, by - ay);
  if (far < 2) return;
  const [nx, ny] = [ay - by, bx - ax].map((side) => (side * (bx < ax ? -1 : 1)) / far);
  const point = (share, out = 0) => [ax + share * (bx - ax) + (pixels + 0.8 * theme.textSize + out) * nx, ay + share * (by - ay) + (pixels + 0.8 * theme.textSize + out) * ny];
  const style = { colour: theme.ink, size: theme.textSize, bold: true, align: "center", baseline: "middle", halo: theme.card };
  const half = widthOf(words, style) / 2 + 8;
  const steep = Math.abs(by - ay) > 0.3 * far;
  const gap = 0.5 - (!steep && far > 2 * half + 16 ? half / far : 0);
  surface.shape([[...point(0), ...point(gap)], [...point(1 - gap), ...point(1)], ...[0, 1].map((end) => [...point(end, -5), ...point(end, 5)])], { stroke: theme.ink, width: 1.5 });
  const [[x, y], right] = [point(0.5), Math.max(ax, bx) + half];
  surface.text(steep || gap < 0.5 ? x : right + half < surface.width ? right : Math.min(ax, bx) - half, y, words, style);
}

/** Draws the table with its scale; returns the places of the lanes. */
function drawTable(surface, { lanes, radius, unit, ghosts, line, wide }, theme) {
  const size = theme.textSize;
  // A ball that curls around a stone may leave the table.
  const seen = line?.stone ? [{ xs: [0, 1.3 * line.at], ys: [-0.15, 0.15].map((share) => share * line.at) }] : lanes;
  const [xs, ys] = ["xs", "ys"].map((key) => [...seen.flatMap((lane) => lane[key]), ...(line?.stone ? [] : ghosts.map((ghost) => ghost[key[0]]))]);
  if (line) xs.push(1.12 * line.at);
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const above = 1.3 * size + 4;  // for a title
  const beside = ringGap(wide) + 3;
  const room = surface.height - 3.1 * size;  // without the bar of the scale, and a ruler
  /** Bodies one below the other, or side by side. */
  const tableOf = (columns, rows) => {
    const [width, height] = [surface.width / columns, room / rows];
    /** Pixels of a metre, with a rim of `metres` and of `rim` pixels around the paths. */
    const scaleWith = (metres, rim) =>
      Math.min((width - 2 * beside - 2 * rim) / (right - left + 2 * metres), (height - above - 2 * rim) / (high - low + 2 * metres));
    // A body too small to be seen is drawn larger than it is.
    const seen = radius * scaleWith(radius, 0) >= smallest;
    const scale = seen ? scaleWith(radius, 0) : scaleWith(0, smallest);
    const cells = lanes.map((_, i) => ({ left: width * (i % columns), top: height * Math.floor(i / columns) }));
    return { height, scale, cells, pixels: seen ? radius * scale : smallest };
  };
  const [rows, columns] = [tableOf(1, lanes.length), tableOf(lanes.length, 1)];
  const { height, scale, cells, pixels } = high - low > (right - left) / 4 && columns.scale > 1.2 * rows.scale ? columns : rows;
  const pixel = ({ x, y }, i) => [cells[i].left + pixels + beside + (x - left) * scale, cells[i].top + above + (height - above) / 2 - (y - (low + high) / 2) * scale];
  const bar = roundDown((surface.width * 0.22) / scale);
  const [end, base] = [surface.width - 6, surface.height - 5];
  const start = end - bar * scale;
  surface.shape([[start, base - 4, start, base, end, base, end, base - 4]], { stroke: theme.soft, width: 1.5 });
  const larger = pixels / (radius * scale);
  const caption = `${length(bar, unit)}${larger >= 1.3 ? `; drawn ${shown(larger, 2)} times as large` : ""}`;
  surface.text(start - 6, base - 1, caption, { colour: theme.soft, size: 0.95 * size, align: "right" });
  return { pixel, pixels, cells, height, scale };
}
