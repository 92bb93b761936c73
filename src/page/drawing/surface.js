// Surfaces for figures: a canvas, or the text of an SVG file. Both take pixels, x to the right and y down.
//
// A line is a flat array x0, y0, x1, y1, ...; the type of a text is in runs.js.
import { runsOf } from "./runs.js";

const fonts = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const mathematics = '"STIX Two Text", "Cambria Math", "DejaVu Serif", Georgia, serif';

const scriptSize = 0.72;
const scriptShift = { 1: -0.38, 0: 0, "-1": 0.24 };  // of an index or a power, in sizes of the text

let measuring;
const known = new Map();  // texts that were measured

/** Returns the width of a text, and its runs with fonts and places from the text's left end. */
function setText(text, /** @type {{size: number, bold?: boolean}} */ { size, bold = false }) {
  const key = JSON.stringify([size, bold, text]);
  if (known.size > 2000) known.clear();
  if (known.has(key)) return known.get(key);
  measuring ??= document.createElement("canvas").getContext("2d");
  const set = { width: 0, runs: /** @type {{words: string, font: string, left: number, down: number}[]} */ ([]) };
  for (const run of runsOf(text)) {
    const pixels = size * (run.level === 0 ? 1 : scriptSize);
    const font = `${run.italic ? "italic " : ""}${bold ? "600 " : ""}${pixels}px ${run.italic ? mathematics : fonts}`;
    measuring.font = font;
    set.runs.push({ words: run.words, font, left: set.width, down: scriptShift[run.level] * size });
    set.width += measuring.measureText(run.words).width;
  }
  known.set(key, set);
  return set;
}

/** Returns the width of a text in pixels. */
export const widthOf = (text, style) => setText(text, style).width;

/** The border of a box, or of a whole surface. */
export const borderOf = ({ left = 0, top = 0, width, height }) =>
  [left, top, left + width, top, left + width, top + height, left, top + height];

/**
 * fill, stroke: colours; width, dash: of the stroke; radius: discs around the points instead of lines through them
 * @typedef {{fill?: string, stroke?: string, width?: number, dash?: number[], radius?: number}} Style
 */

class Surface {
  constructor(width, height) {
    this.width = width;
    this.height = height;
  }

  /** Draws the ground and the parts of a picture that do not move. @returns the result of `draw` */
  still(_keys, ground, draw) {
    this.shape([borderOf(this)], { fill: ground });
    return draw();
  }

  /** @param {ArrayLike<number>[]} _lines @param {Style} _style */
  shape(_lines, _style) {}
}

/** A canvas of given pixels for a picture of a width and height. */
export class CanvasSurface extends Surface {
  constructor(canvas, { width = 0, height = 0 } = {}) {
    super(width, height);
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: false });
    if (width) this.context.scale(canvas.width / width, canvas.height / height);
  }

  /** @param {ArrayLike<number>[]} lines @param {Style} style */
  shape(lines, { fill, stroke, width = 1, dash = [], radius = 0 }) {
    const { context } = this;
    context.beginPath();
    for (const line of lines) {
      for (let i = 0; i < line.length; i += 2) {
        if (i === 0 || radius) context.moveTo(line[i] + radius, line[i + 1]);
        if (radius) context.arc(line[i], line[i + 1], radius, 0, 2 * Math.PI);
        else if (i) context.lineTo(line[i], line[i + 1]);
      }
    }
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (!stroke) return;
    this.pen(stroke, width, dash);
    context.stroke();
  }

  pen(strokeStyle, lineWidth, dash) {
    Object.assign(this.context, { strokeStyle, lineWidth, lineJoin: "round", lineCap: "round" });
    this.context.setLineDash(dash);
  }

  text(x, y, text, style) {
    const { context } = this;
    const { turned, align = "left", baseline = "alphabetic", halo = "", colour } = style;
    if (turned) {
      context.save();
      context.translate(x, y);
      context.rotate(-Math.PI / 2);
      this.text(0, 0, text, { ...style, turned: false });
      return context.restore();
    }
    const { runs, width } = setText(text, style);
    const left = x - width * { left: 0, center: 0.5, right: 1 }[align];
    context.textBaseline = baseline;
    context.fillStyle = colour;
    if (halo) this.pen(halo, 4, []);
    for (const draw of halo ? ["strokeText", "fillText"] : ["fillText"]) {
      for (const run of runs) {
        context.font = run.font;
        context[draw](run.words, left + run.left, y + run.down);
      }
    }
  }

  /** Draws with everything outside the box hidden. */
  inside({ left, top, width, height }, draw) {
    const { context } = this;
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    draw();
    context.restore();
  }
}

const coordinate = (value) => String(Math.round(value * 100) / 100);
const round = 'stroke-linejoin="round" stroke-linecap="round"';
const escaped = (text) => text.replace(/[&<>"]/g, (character) => `&#${character.charCodeAt(0)};`);

export class SvgSurface extends Surface {
  constructor(width, height, title) {
    super(width, height);
    this.parts = [`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}" role="img"><title>${escaped(title)}</title>`];
  }

  /** @param {ArrayLike<number>[]} lines @param {Style} style */
  shape(lines, { fill = "none", stroke = "none", width = 1, dash = [], radius = 0 }) {
    const disc = radius ? `a${radius} ${radius} 0 1 1 ${-2 * radius} 0a${radius} ${radius} 0 1 1 ${2 * radius} 0` : "";
    let path = "";
    for (const line of lines) {
      for (let i = 0; i < line.length; i += 2) {
        path += `${i === 0 || radius ? "M" : "L"}${coordinate(line[i] + radius)} ${coordinate(line[i + 1])}${disc}`;
      }
    }
    const dashed = dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : "";
    if (path) this.parts.push(`<path d="${path}" fill="${fill}" stroke="${stroke}" stroke-width="${width}" ${round}${dashed}/>`);
  }

  text(x, y, text, { size, colour, bold = false, align = "left", baseline = "alphabetic", turned = false, halo = "" }) {
    const lower = { alphabetic: 0, middle: 0.35, top: 0.8, bottom: -0.2 }[baseline] * size;
    let down = 0;
    const runs = runsOf(text).map((run) => {
      const shift = scriptShift[run.level] * size - down;
      down += shift;
      return `<tspan${shift ? ` dy="${coordinate(shift)}"` : ""}${run.level ? ` font-size="${coordinate(size * scriptSize)}"` : ""}` +
        `${run.italic ? ` font-style="italic" font-family='${mathematics}'` : ""}>${escaped(run.words)}</tspan>`;
    });
    const place = `transform="translate(${coordinate(x)} ${coordinate(y)})${turned ? " rotate(-90)" : ""}" y="${coordinate(lower)}"`;
    this.parts.push(`<text ${place} font-family='${fonts}' font-size="${size}"${bold ? ' font-weight="600"' : ""} fill="${colour}"` +
      ` text-anchor="${{ left: "start", center: "middle", right: "end" }[align]}" xml:space="preserve"` +
      `${halo ? ` stroke="${halo}" stroke-width="4" ${round} paint-order="stroke"` : ""}>${runs.join("")}</text>`);
  }

  inside({ left, top, width, height }, draw) {
    const id = `inside-${this.parts.length}`;
    this.parts.push(`<clipPath id="${id}"><rect x="${left}" y="${top}" width="${width}" height="${height}"/></clipPath>`,
      `<g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }

  toString() { return `${this.parts.join("\n")}\n</svg>\n`; }
}
