// A figure of the library (portraits/figure.hpp) on any surface, and in it what the page draws itself: the reader's own
// orbits in colours of their own, the moving point, the isochrone that is dragged.
import { layOut } from "./portrait_layout.js";
import { widthOf } from "./surface.js";
import { placesOf, stateOf } from "./views.js";

const lineWidth = 0.9;  // pixels of a line of width 1
const dash = [5, 4];

/**
 * @param scene  {figure, view, context, own: [{orbit, index, chosen, start, stop}], isochrone: {u, v} or null,
 *               marker: {state, index} or null, cross: {panel, x, y} or null}
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
  for (const { border, colour } of panel.regions) surface.polygon(frame.path(border), colour);
  for (const layer of panel.lines) {
    surface.lines(layer.lines.map((points) => frame.path(points)),
      { colour: layer.colour, width: lineWidth * figure.line * layer.width, dash: layer.dashed ? dash : [] });
  }
  const [perX, perY] = [frame.width / (frame.x.high - frame.x.low), frame.height / (frame.y.high - frame.y.low)];
  for (const { arrows, colour } of panel.arrows) {
    for (let i = 0; i < arrows.length; i += 4) {
      const [dx, dy] = [arrows[i + 2] * perX, -arrows[i + 3] * perY];
      drawHead(surface, frame.px(arrows[i]), frame.py(arrows[i + 1]), dx, dy, colour);
    }
  }
}

/** The head of an arrow whose tip is at (x, y). */
function drawHead(surface, x, y, dx, dy, colour, length = 7.5) {
  const long = Math.hypot(dx, dy);
  if (!(long > 0)) return;
  const [ex, ey] = [dx / long, dy / long];
  const [left, half] = [length, 0.36 * length];
  surface.polygon([x, y, x - left * ex - half * ey, y - left * ey + half * ex, x - left * ex + half * ey, y - left * ey - half * ex], colour);
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
function drawOwn(surface, scene, index, frame, theme) {
  const panel = scene.view.panels[index];
  const { context, figure } = scene;
  if (scene.isochrone && panel.state) {
    for (const sign of [1, -1]) {
      const places = Array.from(scene.isochrone.u, (u, i) => panel.place(stateOf(sign * u, scene.isochrone.v[i], context.mu), context));
      surface.lines([frame.line(places.map(([x]) => x), places.map(([, y]) => y))], { colour: figure.ink, width: 2, dash: [2, 3] });
    }
  }
  for (const { orbit, index: colour, chosen, start, stop } of scene.own) {
    const [xs, ys] = placesOf(orbit, panel, context, stop);
    const line = frame.line(xs, ys);
    const swatch = theme.swatch(colour);
    surface.lines([line], { colour: figure.ground, width: chosen ? 6 : 4 });
    surface.lines([line], { colour: swatch, width: chosen ? 3.2 : 2 });
    drawHeadAlong(surface, frame, line, swatch);
    if (!panel.state) continue;
    const [x, y] = panel.place(stateOf(start.u, start.v, context.mu), context);
    surface.disc(frame.px(x), frame.py(y), chosen ? 5 : 4, { fill: swatch, stroke: figure.ground, width: 1 });
  }
}

/** An arrow head at two fifths of what is seen of a line. */
function drawHeadAlong(surface, frame, line, colour) {
  const seen = (i) => frame.contains(line[i], line[i + 1]) && frame.contains(line[i + 2], line[i + 3]);
  const piece = (i) => (seen(i) ? Math.hypot(line[i + 2] - line[i], line[i + 3] - line[i + 1]) : 0);
  let length = 0;
  for (let i = 0; i + 3 < line.length; i += 2) length += piece(i);
  if (length < 40) return;
  let wanted = 0.4 * length;
  for (let i = 0; i + 3 < line.length; i += 2) {
    const here = piece(i);
    if (here > 0 && wanted <= here) {
      const [dx, dy] = [(line[i + 2] - line[i]) / here, (line[i + 3] - line[i + 1]) / here];
      drawHead(surface, line[i] + dx * (wanted + 5), line[i + 1] + dy * (wanted + 5), dx, dy, colour, 11);
      return;
    }
    wanted -= here;
  }
}

function drawMarker(surface, scene, index, frame, theme) {
  const { figure, marker, cross } = scene;
  if (marker) {
    const [x, y] = scene.view.panels[index].place(marker.state, scene.context);
    if (frame.contains(frame.px(x), frame.py(y))) {
      surface.disc(frame.px(x), frame.py(y), 6.5, { fill: theme.swatch(marker.index), stroke: figure.ground, width: 2 });
    }
  }
  if (cross?.panel === index) {
    const [x, y] = [frame.px(cross.x), frame.py(cross.y)];
    surface.lines([[x - 9, y, x + 9, y], [x, y - 9, x, y + 9]], { colour: figure.ink, width: 1.5 });
  }
}
