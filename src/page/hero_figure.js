// Two equal balls on the table, seen from above, one of which spins; and the patch on which a ball stands, from below.
import { shown, roundDown } from "./numbers.js";
import { turnedBy } from "./turning.js";

const golden = (1 + Math.sqrt(5)) / 2;
/** Spots in the twelve corners of an icosahedron, one of them on top. */
const spots = (() => {
  const corners = [-1, 1].flatMap((a) => [-golden, golden].flatMap((b) => [[0, a, b], [a, b, 0], [b, 0, a]]));
  const length = Math.hypot(1, golden);
  const [cos, sin] = [golden / length, 1 / length];
  return corners.map(([x, y, z]) => [x / length, (y * cos - z * sin) / length, (y * sin + z * cos) / length]);
})();
const spotSize = 0.36;  // rad
const smallest = 11;    // pixels, radius of a ball

/** A ball with spots, turned by a matrix; a flat body shows the same spots on its face. */
function drawBall(surface, x, y, radius, turn, colour, theme) {
  surface.disc(x, y, radius, { fill: colour, stroke: theme.card, width: 2 });
  for (const spot of spots) {
    const [px, py, pz] = turnedBy(turn, spot);
    if (pz < -0.3) continue;
    const across = Math.hypot(px, py);
    const first = across > 1e-9 ? [-py / across, px / across, 0] : [1, 0, 0];
    const second = [py * first[2] - pz * first[1], pz * first[0] - px * first[2], px * first[1] - py * first[0]];
    const border = [];
    for (let i = 0; i < 24; ++i) {
      const [c, s] = [Math.cos(spotSize), Math.sin(spotSize)];
      const [a, b] = [s * Math.cos((i * Math.PI) / 12), s * Math.sin((i * Math.PI) / 12)];
      const point = [0, 1, 2].map((k) => [px, py, pz][k] * c + first[k] * a + second[k] * b);
      // Behind the horizon the border goes along it.
      const out = point[2] < 0 ? 1 / Math.hypot(point[0], point[1]) : 1;
      border.push(x + radius * 0.985 * out * point[0], y - radius * 0.985 * out * point[1]);
    }
    surface.polygon(border, theme.card);
  }
  surface.disc(x, y, radius, { stroke: theme.ink, width: 1.2 });
}

/**
 * @param scene  lanes: title, xs, ys, slidesTo, at (x, y, turn), colour; radius; unit: "m" or "", lengths in m
 */
export function drawLanes(surface, { lanes, radius, unit }, theme) {
  const size = theme.textSize;
  surface.fill(0, 0, surface.width, surface.height, theme.card);
  const flat = (key) => lanes.flatMap((lane) => [Math.min(...lane[key]), Math.max(...lane[key])]);
  const [left, right, low, high] = [Math.min(...flat("xs")), Math.max(...flat("xs")), Math.min(...flat("ys")), Math.max(...flat("ys"))];
  const laneHeight = (surface.height - 1.6 * size) / lanes.length;
  const most = laneHeight / 2 - 0.95 * size;
  /** Pixels of a metre, with a rim of `metres` and of `rim` pixels around the paths. */
  const scaleWith = (metres, rim) => Math.min((surface.width - 8 - 2 * rim) / (right - left + 2 * metres), (2 * most - 2 * rim) / (high - low + 2 * metres));
  // A ball too small to be seen is drawn larger than it is.
  const seen = radius * scaleWith(radius, 0) >= smallest;
  const scale = seen ? scaleWith(radius, 0) : scaleWith(0, smallest);
  const pixels = seen ? radius * scale : smallest;
  const larger = pixels / (radius * scale);
  const px = (x) => pixels + 4 + (x - left) * scale;
  lanes.forEach((lane, row) => {
    const middle = laneHeight * row + size + most;
    const py = (y) => middle - (y - (low + high) / 2) * scale;
    const line = (from, to) => Array.from({ length: Math.max(0, to - from) }, (_, i) => [px(lane.xs[from + i]), py(lane.ys[from + i])]).flat();
    const count = lane.xs.length;
    const slides = Math.min(count - 1, lane.slidesTo);
    if (slides < count - 1) surface.lines([line(Math.floor(slides), count)], { colour: theme.soft, width: 1.5 });
    const slid = [...line(0, Math.floor(slides) + 1)];
    if (slid.length > 2) surface.lines([slid], { colour: lane.faint, width: Math.min(16, pixels / 2) });
    drawBall(surface, px(lane.at.x), py(lane.at.y), pixels, lane.at.turn, lane.colour, theme);
    surface.text(4, laneHeight * row + 0.5 * size, lane.title, { colour: theme.ink, size, baseline: "middle", halo: theme.card });
  });
  const bar = roundDown((surface.width * 0.22) / scale);
  const [end, base] = [surface.width - 6, surface.height - 5];
  surface.lines([[end - bar * scale, base - 4, end - bar * scale, base, end, base, end, base - 4]], { colour: theme.soft, width: 1.5 });
  const caption = `${length(bar, unit)}${larger > 1.05 ? `; drawn ${shown(larger, 2)} times as large` : ""}`;
  surface.text(end - bar * scale - 6, base - 1, caption, { colour: theme.soft, size: 0.95 * size, align: "right" });
}

/** A length in words, such as 52.9 mm. */
export function length(metres, unit, digits = 3) {
  if (!unit) return shown(metres, digits);
  return metres < 0.1 ? `${shown(1000 * metres, digits)} mm` : `${shown(metres, digits)} m`;
}

const arrowShare = 0.06;  // of the patch's radius, the longest slip in it

/**
 * @param scene  still: no point slips; k, the slip of the centre over that of the rim; spin: its sign; force: fraction of f N
 */
export function drawPatch(surface, { still, k, spin, force }, theme) {
  const size = theme.textSize;
  surface.fill(0, 0, surface.width, surface.height, theme.card);
  const radius = Math.min(surface.width / 2 - 4, (surface.height - 4.4 * size) / 2);
  const [x0, y0] = [surface.width / 2, 1.5 * size + radius];
  surface.text(x0, 0.7 * size, "the patch, from below", { colour: theme.soft, size, align: "center", baseline: "middle" });
  surface.disc(x0, y0, radius, { fill: theme.paper, stroke: theme.soft });
  // From below, a ball that spins to the left when seen from above turns to the right.
  const [sliding, turning] = still ? [0, 0] : spin === 0 || k === Infinity ? [1, 0] : [k / (1 + k), -spin / (1 + k)];
  const step = radius / 5.5;
  for (let i = -5; i <= 5; ++i) {
    for (let j = -5; j <= 5; ++j) {
      const [x, y] = [(i + (j % 2) / 2) * step, j * step * 0.92];
      const [rx, ry] = [x / radius, y / radius];
      if (Math.hypot(rx, ry) > 0.88) continue;
      const [vx, vy] = [sliding - turning * ry, turning * rx];
      const [dx, dy] = [vx * 2 * arrowShare * radius, -vy * 2 * arrowShare * radius];
      const [px, py] = [x0 + x, y0 - y];
      surface.lines([[px - dx, py - dy, px + dx, py + dy]], { colour: theme.ink, width: 1.3 });
      surface.disc(px + dx, py + dy, 1.9, { fill: theme.ink });
    }
  }
  const style = { size, align: "center", baseline: "middle", halo: theme.paper };
  const accent = theme.swatch(0);
  if (spin !== 0 && k < 1) {
    const y = y0 - (sliding / turning) * radius;
    surface.disc(x0, y, 5, { fill: accent, stroke: theme.card });
    surface.text(x0, y + (y > y0 ? -1 : 1) * 1.2 * size, "does not slip", { ...style, colour: accent });
  }
  const base = y0 + radius + 1.2 * size;
  const arrow = (share, colour, width) => {
    const tip = x0 - share * radius;
    surface.lines([[x0, base, Math.min(x0, tip + 6), base]], { colour, width });
    surface.polygon([tip, base, tip + 9, base - 6, tip + 9, base + 6], colour);
  };
  arrow(1, theme.line, 5);
  if (force > 0.02) arrow(force, accent, 5);
  surface.text(x0, base + 1.2 * size, `friction left: ${force < 0.001 ? "none" : `${shown(100 * force, force < 0.1 ? 1 : 2)} %`}`, { ...style, colour: accent });
}
