// A figure of the library (portraits/figure.hpp) on any surface, and in it what the page draws itself: the reader's own
// orbits in colours of their own, the moving point, the isochrone that is dragged.
import { layOut, margin } from "./portrait_layout.js";
import { borderOf, widthOf } from "../drawing/surface.js";

const lineWidth = 0.9;  // pixels of a line of width 1
const dash = [5, 4];

/**
 * @typedef {OwnOrbit & {index: number, chosen: boolean, start: Float64Array | null}} Drawn  start: x and y in each panel
 * @param {{figure: Figure, own: Drawn[], isochrone: Float64Array[] | null, marker: {places: Float64Array, index: number} | null,
 *   cross: {panel: number, x: number, y: number} | null, ghosts?: {lines: Float64Array[]}[]}} scene  ghosts: of a pull
 * @returns the frames of the panels
 */
export function drawPortrait(surface, scene, theme) {
  const { figure, isochrone, marker, cross, ghosts } = scene;
  // The orbits of the reader come with the figure.
  const frames = surface.still([figure, isochrone, ghosts, theme], figure.ground, () => drawStill(surface, scene, theme));
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

function drawStill(surface, scene, theme) {
  const { figure } = scene;
  const size = theme.textSize;
  const layout = layOut(figure, surface.width, surface.height, size);
  for (const { thing, left, row } of layout.title) {
    surface.text(left, margin + (row + 0.75) * layout.lineHeight, thing, { colour: figure.ink, size, bold: true });
  }
  if (layout.bar) drawColourBar(surface, figure, layout.bar);
  figure.panels.forEach((panel, i) => {
    const frame = layout.frames[i];
    surface.inside(frame, () => {
      drawLayers(surface, figure, panel, frame);
      drawOwn(surface, scene, i, frame, theme);
    });
    for (const marks of panel.marks) drawMarks(surface, figure, marks, frame.lines(marks.points).flat());
    if (!panel.bare) frame.draw(surface, { ...theme, ink: figure.ink, soft: figure.faint });
    for (const { x, y, text, colour, align } of panel.labels) {
      surface.text(frame.px(x), frame.py(y), text, { colour, size: 0.92 * size, align, baseline: "middle", halo: figure.ground });
    }
    const title = layout.titles[i];
    surface.text(title.x, title.y, panel.title, { colour: figure.ink, size: title.size, align: "center" });
  });
  drawLegend(surface, figure, layout, size);
  return layout.frames;
}

function drawColourBar(surface, figure, bar) {
  const { name, colours, ticks } = figure.colourBar;
  const step = bar.width / colours.length;
  colours.forEach((fill, i) => surface.shape([borderOf({ ...bar, left: bar.left + i * step, width: step + 0.5 })], { fill }));
  const style = { colour: figure.ink, size: bar.size };
  const bottom = bar.top + bar.height;
  surface.text(bar.left - 0.6 * bar.size, bottom, name, { ...style, align: "right" });
  let free = -Infinity;
  for (const { at, text } of ticks) {
    const [x, half] = [bar.left + at * bar.width, widthOf(text, style) / 2];
    surface.shape([[x, bottom, x, bottom + 3]], { stroke: figure.ink });
    if (x - half < free) continue;
    surface.text(x, bottom + 4, text, { ...style, align: "center", baseline: "top" });
    free = x + half + 0.5 * bar.size;
  }
}

const strokeOf = ({ line }, { colour, width, dashed }) =>
  ({ stroke: colour, width: lineWidth * line * width, dash: dashed ? dash : [] });

function drawLayers(surface, figure, panel, frame) {
  for (const { border, colour } of panel.regions) surface.shape(frame.lines(border), { fill: colour });
  for (const layer of panel.lines) surface.shape(frame.lines(layer.lines), strokeOf(figure, layer));
  for (const { arrows, colour } of panel.arrows) surface.shape(headsOf(frame, arrows, 7.5), { fill: colour });
}

/** The heads of arrows, x and y of the tip and of the direction in turn. */
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
  if (shape !== "square") return surface.shape([points], { ...style, radius });
  const corners = [-1, -1, 1, -1, 1, 1, -1, 1, -1, -1].map((side) => side * radius);
  for (let i = 0; i < points.length; i += 2) surface.shape([corners.map((corner, j) => points[i + (j % 2)] + corner)], style);
}

function drawLegend(surface, figure, { legend, legendTop, lineHeight, sample }, size) {
  for (const { thing, left, row } of legend) {
    const y = legendTop + (row + 0.5) * lineHeight;
    if (thing.shape) drawMarks(surface, figure, thing, [left + sample / 2, y]);
    else surface.shape([[left, y, left + sample, y]], strokeOf(figure, thing));
    surface.text(left + sample + 0.4 * size, y, thing.legend, { colour: figure.ink, size, baseline: "middle" });
  }
}

/** The orbits of the reader and the isochrone that is dragged. */
function drawOwn(surface, { figure, own, isochrone, ghosts = [] }, panel, frame, theme) {
  for (const { lines } of ghosts) surface.shape(frame.lines(lines[panel]), { stroke: `${theme.swatch(own.at(-1)?.index ?? 0)}99`, width: 2 });
  if (isochrone) surface.shape(frame.lines(isochrone[panel]), { stroke: figure.ink, width: 2, dash: [2, 3] });
  for (const { panels, index, chosen, start } of own) {
    const lines = frame.lines(panels[panel].line);
    const swatch = theme.swatch(index);
    surface.shape(lines, { stroke: figure.ground, width: chosen ? 6 : 4 });
    surface.shape(lines, { stroke: swatch, width: chosen ? 3.2 : 2 });
    surface.shape(headsOf(frame, panels[panel].arrow, 11), { fill: swatch });
    if (start) surface.shape([frame.pixel(start, 2 * panel)], { radius: chosen ? 5 : 4, fill: swatch, stroke: figure.ground });
  }
}
