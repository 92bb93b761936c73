// Where the parts of a figure of the library go on a surface of any size.
import { Frame } from "../drawing/frame.js";
import { plain, runsOf } from "../drawing/runs.js";
import { widthOf } from "../drawing/surface.js";

const narrowest = 230;  // pixels that a panel needs beside others
export const margin = 8;

/** Panels stand side by side, as many as the figure wants, where there is room, else one above the other. */
export function rowsOf({ panels, columns }, width) {
  const beside = Math.min(columns, panels.length);
  return width / beside < narrowest ? panels.length : Math.ceil(panels.length / beside);
}

/** Where things of those widths go in lines, `gap` between those of one line: {thing, left, row} of each. */
function setLines(things, width, widthOfThing, gap) {
  let [right, row] = [Infinity, -1];
  return things.map((thing) => {
    const wide = widthOfThing(thing);
    if (right + wide > width) [right, row] = [0, row + 1];
    const left = right;
    right += wide + gap;
    return { thing, left: margin + left, row };
  });
}

const rowsIn = (set) => (set.at(-1)?.row ?? -1) + 1;

/** The largest rectangle in a place in which both axes have one scale. */
function toScale(place, { x, y }) {
  const unit = Math.min(place.width / (x.high - x.low), place.height / (y.high - y.low));
  const [width, height] = [unit * (x.high - x.low), unit * (y.high - y.low)];
  return { left: place.left + (place.width - width) / 2, top: place.top + (place.height - height) / 2, width, height };
}

/** The titles of the library are parts with ",  " between them. */
function partsOf(title) {
  /** @type {import("../drawing/runs.js").Run[][]} */
  const parts = [[]];
  for (const run of runsOf(title)) {
    run.words.split(/(?<=,) {2}/).forEach((words, i) => {
      if (i > 0) parts.push([]);
      parts[parts.length - 1].push({ ...run, words });
    });
  }
  return parts;
}

/** {title, legend: {thing, left, row} of each part; bar; frames and titles, {x, y, size}, of the panels; ...} */
export function layOut(figure, width, height, size) {
  const { panels, colourBar } = figure;
  const inner = width - 2 * margin;
  const lineHeight = 1.45 * size;
  const widthOfPart = (part) => widthOf(part, { size, bold: true });
  const title = setLines(partsOf(figure.title), inner, widthOfPart, 0.5 * size);
  let top = margin + lineHeight * rowsIn(title);

  let bar = null;
  if (colourBar) {
    const name = widthOf(colourBar.name, { size });
    const strip = Math.min(18 * size, inner - name - 3 * size);
    const end = title[title.length - 1];
    const beside = end.row === 0 && end.left - margin + widthOfPart(end.thing) + name + strip + 4 * size < inner;
    const barTop = beside ? margin : top;
    bar = { left: margin + inner - strip - size, top: barTop + 0.35 * size, width: strip, height: 0.7 * size, size: 0.9 * size };
    top = Math.max(top, barTop + 2.5 * size);
  }

  const named = panels.flatMap(({ lines, marks }) => [...lines, ...marks]).filter(({ legend }) => legend.length > 0);
  const entries = named.filter(({ legend }, i) => named.findIndex((first) => plain(first.legend) === plain(legend)) === i);
  const sample = 2 * size;
  const legend = setLines(entries, inner, (entry) => sample + 0.4 * size + widthOf(entry.legend, { size }), 1.4 * size);
  const legendTop = height - margin - lineHeight * rowsIn(legend);

  const rows = rowsOf(figure, width);
  const columns = Math.ceil(panels.length / rows);
  const cell = { width: inner / columns, height: (legendTop - (legend.length ? 0.3 * size : 0) - top) / rows };
  const above = panels.some((panel) => panel.title.length > 0) ? 1.9 * size : 0.6 * size;
  const rangeOf = ({ name, low, high, ticks }) => ({ low, high, label: name.length > 0 ? name : undefined, ticks });
  const frames = panels.map((panel, i) => {
    const [x, y] = [rangeOf(panel.x), rangeOf(panel.y)];
    const below = panel.bare ? 0.3 * size : (x.label ? 3.4 : 1.8) * size;
    const place = { left: 0, top: 0, width: cell.width, height: Math.max(20, cell.height - above - below) };
    const beside = panel.bare ? 0.3 * size
      : Math.max((y.label ? 4.8 : 3.2) * size, new Frame(place, x, y).roomForTicks(size) + (y.label ? 2 * size : 0));
    place.left = margin + (i % columns) * cell.width + beside;
    place.top = top + Math.floor(i / columns) * cell.height + above;
    place.width = Math.max(20, cell.width - beside - (panel.bare ? 0.3 * size : size));
    return new Frame(panel.toScale ? toScale(place, panel) : place, x, y);
  });
  const titles = frames.map(({ left, width }, i) => ({
    x: left + width / 2, y: top + Math.floor(i / columns) * cell.height + 1.3 * size,
    size: size * Math.min(1, cell.width / Math.max(1, widthOf(panels[i].title, { size }))),
  }));
  return { title, bar, frames, titles, legend, legendTop, lineHeight, sample };
}
