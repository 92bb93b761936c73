// Where the parts of a figure of the library go on a surface of any size.
import { Frame } from "./frame.js";
import { widthOf } from "./surface.js";

const narrowest = 230;  // pixels that a panel needs beside others
const margin = 8;

/** Panels stand side by side where there is room, else one above the other. */
export const rowsOf = (panels, width) => (width / panels < narrowest ? panels : 1);

/** Texts set in lines of at most that width, each {text, left}; `gap` between those of one line. */
function setLines(texts, width, widthOfText, gap) {
  /** @type {{text: any, left: number}[][]} */
  const lines = [];
  let left = Infinity;
  for (const text of texts) {
    const wide = widthOfText(text);
    if (left + wide > width) {
      lines.push([]);
      left = 0;
    }
    lines[lines.length - 1].push({ text, left });
    left += wide + gap;
  }
  return lines;
}

function legendOf(figure) {
  const entries = new Map();
  for (const panel of figure.panels) {
    for (const layer of [...panel.lines, ...panel.marks]) {
      if (layer.legend !== "" && !entries.has(layer.legend)) entries.set(layer.legend, layer);
    }
  }
  return [...entries.values()];
}

/** The largest rectangle in a place in which both axes have one scale. */
function toScale(place, { x, y }) {
  const unit = Math.min(place.width / (x.high - x.low), place.height / (y.high - y.low));
  const [width, height] = [unit * (x.high - x.low), unit * (y.high - y.low)];
  return { left: place.left + (place.width - width) / 2, top: place.top + (place.height - height) / 2, width, height };
}

/** {title: lines, bar, frames: one for each panel, titles: their {x, y, size}, legend: lines, legendTop, sample} */
export function layOut(figure, width, height, size) {
  const inner = width - 2 * margin;
  const bold = { size, bold: true };
  // The titles of the library are parts with ",  " between them.
  const parts = figure.title.split(",  ").map((part, i, all) => (i + 1 < all.length ? `${part},` : part));
  const title = setLines(parts, inner, (part) => widthOf(part, bold), 0.5 * size);
  const lineHeight = 1.45 * size;
  let top = margin + lineHeight * title.length;

  let bar = null;
  if (figure.colourBar) {
    const name = widthOf(figure.colourBar.name, { size });
    const strip = Math.min(18 * size, inner - name - 3 * size);
    const end = title[0]?.[title[0].length - 1];
    const beside = title.length === 1 && end.left + widthOf(end.text, bold) + name + strip + 4 * size < inner;
    const barTop = beside ? margin : top;
    bar = { left: margin + inner - strip - size, top: barTop + 0.35 * size, width: strip, height: 0.7 * size, size: 0.9 * size };
    top = Math.max(top, barTop + 2.5 * size);
  }

  const sample = 2 * size;
  const legend = setLines(legendOf(figure), inner, (entry) => sample + 0.4 * size + widthOf(entry.legend, { size }), 1.4 * size);
  const legendTop = height - margin - lineHeight * legend.length;
  const bottom = legendTop - (legend.length ? 0.3 * size : 0);

  const count = figure.panels.length;
  const rows = rowsOf(count, width);
  const columns = count / rows;
  const titled = figure.panels.some((panel) => panel.title !== "");
  const cell = { width: inner / columns, height: (bottom - top) / rows };
  const titles = [];
  const frames = figure.panels.map((panel, i) => {
    const [left, cellTop] = [margin + (i % columns) * cell.width, top + Math.floor(i / columns) * cell.height];
    const room = panel.bare
      ? { left: 0.3 * size, right: 0.3 * size, bottom: 0.3 * size }
      : { left: (panel.y.name ? 4.8 : 3.2) * size, right: size, bottom: (panel.x.name ? 3.4 : 1.8) * size };
    const above = titled ? 1.9 * size : 0.6 * size;
    const names = ({ name, low, high, ticks }) => ({ low, high, label: name || undefined, ticks });
    const height = Math.max(20, cell.height - above - room.bottom);
    if (!panel.bare) {
      const needed = new Frame({ left: 0, top: 0, width: cell.width, height }, names(panel.x), names(panel.y)).roomForTicks(size);
      room.left = Math.max(room.left, needed + (panel.y.name ? 2 * size : 0));
    }
    const place = {
      left: left + room.left, top: cellTop + above,
      width: Math.max(20, cell.width - room.left - room.right), height,
    };
    titles.push({
      x: left + room.left + place.width / 2, y: cellTop + 1.3 * size,
      size: size * Math.min(1, cell.width / Math.max(1, widthOf(panel.title, { size }))),
    });
    return new Frame(panel.toScale ? toScale(place, panel) : place, names(panel.x), names(panel.y));
  });
  return { title, bar, frames, titles, legend, legendTop, lineHeight, sample, margin };
}
