// Figures of the library (portraits/figure.hpp), and figures of the page with the same fields. The library computes the layout.
// The page itself draws parts of the portrait: the reader's own orbits in colours of their own, the moving point, and the
// isochrone that is dragged.
import { Frame } from "./frame.js";
import { plain } from "./runs.js";
import { borderOf, widthOf } from "./surface.js";

const lineWidth = 0.9;  // pixels of a line of width 1
const dash = [5, 4];
const rim = 3;          // pixels beside a panel into which lines on its border reach
const tickSize = 0.9;      // size of ticks' texts, in letters
const leastWidth = 15.5;  // width of a panel with its numbers, in letters

/** Makes a panel of the page. @param {object} x {low, high} and perhaps {name, ticks} @param {object} y as x @returns {Panel} */
export const panelOf = (title, x, y, lines = /** @type {Partial<Lines>[]} */ ([]), marks = /** @type {Partial<Marks>[]} */ ([])) => ({
  title, x: { name: "", ticks: [], ...x }, y: { name: "", ticks: [], ...y }, arrows: [], regions: [], labels: [], bare: false, to_scale: false,
  lines: lines.map((line) => /** @type {Lines} */ ({ width: 1.5, dashed: false, legend: "", ...line })),
  marks: marks.map((mark) => /** @type {Marks} */ ({ size: 1, shape: "dot", legend: "", ...mark })),
});

/** Makes a figure of the page. @param shape  columns: largest number; narrowest: least width of a panel beside others, pixels @param {Panel[]} panels @returns {Figure} */
export const figureOf = (theme, shape, panels) => ({ title: "", ...shape, panels, ground: theme.card, ink: theme.ink, faint: theme.soft, line: 1 });

/**
 * @param {unknown[]} keys      values on which the figure depends
 * @param {() => Figure} make
 * @param {Store} store
 * @param covered   true: moving parts are drawn over the figure
 * @param labelled  false: the caller draws marks and labels later, over further lines
 * @returns {Frame[]} frames of the panels
 */
export function drawFigure(surface, keys, make, store, { covered = true, labelled = true } = {}) {
  const { library, theme } = store;
  return surface.still([...keys, theme], theme.card, () => {
    const figure = make();
    // Narrow panels have small letters.
    const letter = Math.min(theme.textSize, (surface.width * library.rowsOf(figure, surface.width)) / figure.panels.length / leastWidth);
    const layout = library.layOut(figure, surface.width, surface.height, letter);
    const style = { colour: figure.ink, baseline: "middle" };
    const frames = figure.panels.map(({ x, y }, i) => new Frame(layout.panels[i].box, x, y, letter));
    figure.panels.forEach((panel, i) => {
      const frame = frames[i];
      if (!panel.bare) drawAxes(surface, frame, layout.panels[i], figure.faint, tickSize * letter);
      // Lines and heads of arrows on the border are whole.
      const { left, top, width, height } = frame;
      surface.inside({ left: left - rim, top: top - rim, width: width + 2 * rim, height: height + 2 * rim }, () => drawLayers(surface, figure, panel, frame));
      if (labelled) drawLabels(surface, figure, panel, frame);
    });
    // The boxes stand from the bottom up.
    layout.colours.forEach((box, i) => surface.shape([borderOf(box)], { fill: figure.colour_bar?.colours[i] }));
    for (const { legend, x, y, width } of layout.legend) {
      const named = ({ legend: other }) => plain(other) === plain(legend);
      const lines = figure.panels.flatMap((panel) => panel.lines).find(named);
      if (lines) surface.shape([[x, y, x + width, y]], strokeOf(figure, lines));
      const marks = figure.panels.flatMap((panel) => panel.marks).find(named);
      if (marks) drawMarks(surface, figure, marks, [x + width / 2, y]);
    }
    for (const { x, y, text, ...how } of layout.texts) {
      // A title or an entry of the legend that is too long is small.
      const fitting = how.turned ? 1 : Math.min(1, (surface.width - (how.align === "left" ? x : 0)) / widthOf(text, how));
      surface.text(x, y, text, { ...style, ...how, size: fitting * how.size });
    }
    return frames;
  }, covered);
}

/**
 * @typedef {OwnOrbit & {index: number, chosen: boolean, start: Float64Array}} Drawn  start: x and y in each panel
 * @param {{figure: Figure, own: Drawn[], isochrone: Float64Array[] | null, marker: {places: Float64Array, index: number} | null,
 *   cross: {panel: number, x: number, y: number} | null, ghosts: OwnOrbit[]}} scene  ghosts: of a pull
 * @returns {Frame[]} frames of the panels
 */
export function drawPortrait(surface, scene, store) {
  const { figure, isochrone, marker, cross, ghosts } = scene;
  const { theme } = store;
  const frames = surface.still([figure, store.motions, isochrone, ghosts, theme], theme.card, () => {
    const frames = drawFigure(surface, [figure], () => figure, store, { labelled: false });
    frames.forEach((frame, i) => {
      surface.inside(frame, () => drawOwn(surface, scene, i, frame, theme));
      drawLabels(surface, figure, figure.panels[i], frame);
    });
    return frames;
  });
  frames.forEach((frame, i) => {
    if (marker) {
      const [x, y] = frame.pixel(marker.places, 2 * i);
      if (frame.contains(x, y)) surface.shape([[x, y]], { radius: 6.5, fill: theme.swatch(marker.index), stroke: figure.ground, width: 2 });
    }
    if (cross && cross.panel === i) {
      const [x, y] = frame.pixel([cross.x, cross.y]);
      surface.shape([[x - 9, y, x + 9, y], [x, y - 9, x, y + 9]], { stroke: figure.ink, width: 1.5 });
    }
  });
  return frames;
}

/** Draws marks and labels, which lie over lines. */
function drawLabels(surface, figure, { marks, labels }, frame) {
  for (const layer of marks) drawMarks(surface, figure, layer, frame.lines(layer.points).flat());
  for (const { x, y, text, colour, align } of labels) {
    surface.text(frame.px(x), frame.py(y), text, { colour, size: 0.92 * frame.letter, align, baseline: "middle", halo: figure.ground });
  }
}

function drawAxes(surface, frame, { x, y }, colour, size) {
  const [bottom, right] = [frame.top + frame.height, frame.left + frame.width];
  const lines = [[frame.left, frame.top, frame.left, bottom, right, bottom]];
  for (const { at, text } of x) {
    lines.push([frame.px(at), bottom, frame.px(at), bottom + 4]);
    surface.text(frame.px(at), bottom + 6, text, { colour, size, align: "center", baseline: "top" });
  }
  for (const { at, text } of y) {
    lines.push([frame.left - 4, frame.py(at), frame.left, frame.py(at)]);
    surface.text(frame.left - 6, frame.py(at), text, { colour, size, align: "right", baseline: "middle" });
  }
  surface.shape(lines, { stroke: colour });
}

const strokeOf = ({ line }, { colour, width, dashed }) =>
  ({ stroke: colour, width: lineWidth * line * width, dash: dashed ? dash : [] });

function drawLayers(surface, figure, panel, frame) {
  for (const { border, colour } of panel.regions) surface.shape(frame.lines(border), { fill: colour });
  for (const layer of panel.lines) surface.shape(frame.lines(layer.lines), strokeOf(figure, layer));
  for (const { arrows, colour } of panel.arrows) surface.shape(headsOf(frame, arrows, 7.5), { fill: colour });
}

/** Returns the heads of arrows. @param arrows  x and y of the tip and of the direction in turn */
function headsOf(frame, arrows, length) {
  const heads = [];
  for (let i = 0; i < arrows.length; i += 4) {
    const [x, y] = frame.pixel(arrows, i);
    const [dx, dy] = [frame.px(arrows[i] + arrows[i + 2]) - x, frame.py(arrows[i + 1] + arrows[i + 3]) - y];
    const part = length / Math.hypot(dx, dy);
    if (!Number.isFinite(part)) continue;
    const [backX, backY] = [x - part * dx, y - part * dy];
    const [acrossX, acrossY] = [-0.36 * part * dy, 0.36 * part * dx];
    heads.push([x, y, backX + acrossX, backY + acrossY, backX - acrossX, backY - acrossY]);
  }
  return heads;
}

/** Marks at points, in pixels. */
function drawMarks(surface, figure, { shape, colour, size }, points) {
  const radius = 3.6 * size;
  const style = { fill: shape === "dot" ? colour : figure.ground, stroke: colour, width: 1.8 };
  const sides = { square: [-1, -1, 1, -1, 1, 1, -1, 1, -1, -1], diamond: [-1.4, 0, 0, 1.4, 1.4, 0, 0, -1.4, -1.4, 0] }[shape];
  if (!sides) return surface.shape([points], { ...style, radius });
  const corners = sides.map((side) => side * radius);
  for (let i = 0; i < points.length; i += 2) surface.shape([corners.map((corner, j) => points[i + (j % 2)] + corner)], style);
}

/** The orbits of the reader and the isochrone that is dragged. */
function drawOwn(surface, { figure, own, isochrone, ghosts }, panel, frame, theme) {
  for (const { panels } of ghosts) surface.shape(frame.lines(panels[panel].line), { stroke: `${theme.swatch(own.at(-1)?.index ?? 0)}99`, width: 2 });
  if (isochrone) surface.shape(frame.lines(isochrone[panel]), { stroke: figure.ink, width: 2, dash: [2, 3] });
  for (const { panels, index, chosen, start } of own) {
    const lines = frame.lines(panels[panel].line);
    const swatch = theme.swatch(index);
    surface.shape(lines, { stroke: figure.ground, width: chosen ? 6 : 4 });
    surface.shape(lines, { stroke: swatch, width: chosen ? 3.2 : 2 });
    surface.shape(headsOf(frame, panels[panel].arrow, 11), { fill: swatch });
    surface.shape([frame.pixel(start, 2 * panel)], { radius: chosen ? 5 : 4, fill: swatch, stroke: figure.ground });
  }
}
