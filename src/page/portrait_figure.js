// A figure of the library (portraits/figure.hpp) on any surface, and in it what the page draws itself: the reader's own
// orbits in colours of their own, the moving point, the isochrone that is dragged.
import { layOut } from "./portrait_layout.js";
import { widthOf } from "./surface.js";

const lineWidth = 0.9;  // pixels of a line of width 1
const dash = [5, 4];

/**
 * @typedef {OwnOrbit & {index: number, chosen: boolean, start: Float64Array | null}} Drawn  start: x and y in each panel
 * @param {{figure: Figure, own: Drawn[], isochrone: Isochrone | null, marker: {places: Float64Array, index: number} | null,
 *   cross: {panel: number, x: number, y: number} | null}} scene
 * @returns the frames of the panels
 */
export function drawPortrait(surface, scene, theme) {
  const { figure } = scene;
  const size = theme.textSize;
  const layout = layOut(figure, surface.width, surface.height, size);
  surface.fill(0, 0, surface.width, surface.height, figure.ground);
  drawTitle(surface, figure, layout, size);
  if (layout.bar) drawColourBar(surface, figure, layout);
  figure.panels.forEach((panel, i) => {
    const frame = layout.frames[i];
    surface.inside(frame, () => {
      drawLayers(surface, figure, panel, frame);
      drawOwn(surface, scene, i, frame, theme);
    });
    drawMarks(surface, figure, panel, frame);
    if (!panel.bare) frame.draw(surface, { ...theme, ink: figure.ink, soft: figure.faint });
    drawLabels(surface, figure, panel, frame, size);
    const title = layout.titles[i];
    surface.text(title.x, title.y, panel.title, { colour: figure.ink, size: title.size, align: "center" });
    drawMarker(surface, scene, i, frame, theme);
  });
  drawLegend(surface, figure, layout, size);
  return layout.frames;
}

function drawTitle(surface, figure, { title, margin, lineHeight }, size) {
  title.forEach((line, row) => {
    for (const { text, left } of line) {
      surface.text(margin + left, margin + (row + 0.75) * lineHeight, text, { colour: figure.ink, size, bold: true });
    }
  });
}

function drawColourBar(surface, figure, { bar }) {
  const { name, colours, ticks } = figure.colourBar;
  const step = bar.width / colours.length;
  colours.forEach((colour, i) => surface.fill(bar.left + i * step, bar.top, step + 0.5, bar.height, colour));
  const style = { colour: figure.ink, size: bar.size };
  surface.text(bar.left - 0.6 * bar.size, bar.top + bar.height, name, { ...style, align: "right" });
  let free = -Infinity;
  for (const { at, text } of ticks) {
    const [x, half] = [bar.left + at * bar.width, widthOf(text, style) / 2];
    surface.lines([[x, bar.top + bar.height, x, bar.top + bar.height + 3]], { colour: figure.ink });
    if (x - half < free) continue;
    surface.text(x, bar.top + bar.height + 4, text, { ...style, align: "center", baseline: "top" });
    free = x + half + 0.5 * bar.size;
  }
}

function drawLayers(surface, figure, panel, frame) {
  for (const { border, colour } of panel.regions) surface.polygon(frame.lines(border)[0], colour);
  for (const layer of panel.lines) {
    surface.lines(frame.lines(layer.lines),
      { colour: layer.colour, width: lineWidth * figure.line * layer.width, dash: layer.dashed ? dash : [] });
  }
  for (const { arrows, colour } of panel.arrows) drawHeads(surface, frame, arrows, colour);
}

/** The heads of arrows, x and y of the tip and of the direction in turn. */
function drawHeads(surface, frame, arrows, colour, length = 7.5) {
  const half = 0.36 * length;
  for (let i = 0; i < arrows.length; i += 4) {
    const [x, y] = [frame.px(arrows[i]), frame.py(arrows[i + 1])];
    const [dx, dy] = [frame.px(arrows[i] + arrows[i + 2]) - x, frame.py(arrows[i + 1] + arrows[i + 3]) - y];
    const long = Math.hypot(dx, dy);
    if (!(long > 0)) continue;
    const [ex, ey] = [dx / long, dy / long];
    const [backX, backY] = [x - length * ex, y - length * ey];
    surface.polygon([x, y, backX - half * ey, backY + half * ex, backX + half * ey, backY - half * ex], colour);
  }
}

function drawMarks(surface, figure, panel, frame) {
  for (const marks of panel.marks) {
    for (let i = 0; i < marks.points.length; i += 2) drawMark(surface, figure, marks, frame.px(marks.points[i]), frame.py(marks.points[i + 1]));
  }
}

function drawMark(surface, figure, { shape, colour, size }, x, y) {
  const radius = 3.6 * size;
  const style = { fill: shape === "dot" ? colour : figure.ground, stroke: colour, width: 1.8 };
  if (shape !== "square") return surface.disc(x, y, radius, style);
  const square = [x - radius, y - radius, x + radius, y - radius, x + radius, y + radius, x - radius, y + radius, x - radius, y - radius];
  surface.polygon(square, figure.ground);
  surface.lines([square], { colour, width: 1.8 });
}

function drawLabels(surface, figure, panel, frame, size) {
  for (const { x, y, text, colour, align } of panel.labels) {
    surface.text(frame.px(x), frame.py(y), text, { colour, size: 0.92 * size, align, baseline: "middle", halo: figure.ground });
  }
}

function drawLegend(surface, figure, { legend, legendTop, lineHeight, sample, margin }, size) {
  legend.forEach((line, row) => {
    const y = legendTop + (row + 0.5) * lineHeight;
    for (const { text: entry, left } of line) {
      const x = margin + left;
      if (entry.shape) drawMark(surface, figure, entry, x + sample / 2, y);
      else surface.lines([[x, y, x + sample, y]], { colour: entry.colour, width: lineWidth * figure.line * entry.width, dash: entry.dashed ? dash : [] });
      surface.text(x + sample + 0.4 * size, y, entry.legend, { colour: figure.ink, size, baseline: "middle" });
    }
  });
}

/** The orbits of the reader and the isochrone that is dragged. */
function drawOwn(surface, { figure, own, isochrone }, index, frame, theme) {
  if (isochrone) surface.lines(frame.lines(isochrone.lines[index]), { colour: figure.ink, width: 2, dash: [2, 3] });
  for (const { panels, index: colour, chosen, start } of own) {
    const lines = frame.lines(panels[index].line);
    const swatch = theme.swatch(colour);
    surface.lines(lines, { colour: figure.ground, width: chosen ? 6 : 4 });
    surface.lines(lines, { colour: swatch, width: chosen ? 3.2 : 2 });
    drawHeads(surface, frame, panels[index].arrow, swatch, 11);
    if (!start) continue;
    const [x, y] = [frame.px(start[2 * index]), frame.py(start[2 * index + 1])];
    surface.disc(x, y, chosen ? 5 : 4, { fill: swatch, stroke: figure.ground, width: 1 });
  }
}

function drawMarker(surface, scene, index, frame, theme) {
  const { figure, marker, cross } = scene;
  if (marker) {
    const [x, y] = [marker.places[2 * index], marker.places[2 * index + 1]];
    if (frame.contains(frame.px(x), frame.py(y))) {
      surface.disc(frame.px(x), frame.py(y), 6.5, { fill: theme.swatch(marker.index), stroke: figure.ground, width: 2 });
    }
  }
  if (cross?.panel === index) {
    const [x, y] = [frame.px(cross.x), frame.py(cross.y)];
    surface.lines([[x - 9, y, x + 9, y], [x, y - 9, x, y + 9]], { colour: figure.ink, width: 1.5 });
  }
}
