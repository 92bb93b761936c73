// What figures are drawn on: a canvas, or the text of an SVG file. Both take pixels, x to the right and y down.
//
// A line is a flat array x0, y0, x1, y1, ...; a text may have the library's markup.
import { runsOf } from "./markup.js";

const fonts = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const mathematics = '"STIX Two Text", "Cambria Math", "DejaVu Serif", Georgia, serif';

const scriptSize = 0.72;
const scriptShift = { 1: -0.38, 0: 0, "-1": 0.24 };  // of an index or a power, in sizes of the text
const smallestWidth = 120;  // pixels; a hidden or minimised page has none

let measuring;
const known = new Map();  // texts that were measured

/** How wide a text is, and its runs with their fonts and places from the text's left end. */
function setText(text, style) {
  const key = `${style.size} ${style.bold} ${text}`;
  if (known.size > 2000) known.clear();
  if (!known.has(key)) known.set(key, measured(text, style));
  return known.get(key);
}

function measured(text, { size, bold }) {
  measuring ??= document.createElement("canvas").getContext("2d");
  let width = 0;
  const runs = runsOf(text).map((run) => {
    const font = `${run.italic ? "italic " : ""}${bold ? "600 " : ""}${size * (run.level === 0 ? 1 : scriptSize)}px ${run.italic ? mathematics : fonts}`;
    measuring.font = font;
    const left = width;
    width += measuring.measureText(run.text).width;
    return { ...run, font, left, down: scriptShift[run.level] * size };
  });
  return { runs, width };
}

/** How wide a text is, in pixels. */
export const widthOf = (text, style) => setText(text, style).width;

/** The border of a box, or of a whole surface. */
export const borderOf = ({ left = 0, top = 0, width, height }) =>
  [left, top, left + width, top, left + width, top + height, left, top + height];

export class CanvasSurface {
  width = 0;
  height = 0;
  kept = { keys: /** @type {any[]} */ ([]), value: /** @type {any} */ (null), picture: /** @type {HTMLCanvasElement | null} */ (null) };

  /** @param picture  draws on the surface, also when the page gives the canvas another size */
  constructor(canvas, picture) {
    this.canvas = canvas;
    this.picture = picture;
    this.context = canvas.getContext("2d", { alpha: false });
    new ResizeObserver(() => {
      this.measure();
      this.draw();
    }).observe(canvas);
  }

  /** Asks the page for the size, which lays the page out. */
  measure() {
    const { clientWidth, clientHeight } = this.canvas;
    [this.width, this.height] = [clientWidth, clientHeight];
  }

  draw() {
    if (this.width === 0) this.measure();
    if (this.width >= smallestWidth) this.picture(this);
  }

  /**
   * Begins a picture with what stays while only the moment moves: where none of `keys` has changed, as a copy.
   *
   * @returns what `draw` has returned
   */
  still(keys, draw) {
    const { canvas, context, width, height, kept } = this;
    const ratio = globalThis.devicePixelRatio || 1;
    const size = [width, height].map((side) => Math.round(side * ratio));
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    const all = [...keys, ratio, ...size];
    const again = all.length === kept.keys.length && all.every((key, i) => key === kept.keys[i]);
    if (again && kept.picture) {
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(kept.picture, 0, 0);
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (again && kept.picture) return kept.value;
    this.kept = { keys: all, value: draw(), picture: null };
    // What changes at each drawing is not worth a copy.
    if (again) {
      this.kept.picture = Object.assign(document.createElement("canvas"), { width: size[0], height: size[1] });
      this.kept.picture.getContext("2d")?.drawImage(canvas, 0, 0);
    }
    return this.kept.value;
  }

  /** Areas within lines, or the lines themselves, or both. */
  shape(lines, { fill = "", stroke = "", width = 1, dash = /** @type {number[]} */ ([]) }) {
    const { context } = this;
    context.beginPath();
    for (const line of lines) {
      context.moveTo(line[0], line[1]);
      for (let i = 2; i < line.length; i += 2) context.lineTo(line[i], line[i + 1]);
    }
    this.paint(fill, stroke, width, dash);
  }

  /** Discs of one radius around points x0, y0, x1, y1, ... */
  discs(points, radius, { fill = "", stroke = "", width = 1.5 }) {
    const { context } = this;
    context.beginPath();
    for (let i = 0; i < points.length; i += 2) {
      context.moveTo(points[i] + radius, points[i + 1]);
      context.arc(points[i], points[i + 1], radius, 0, 2 * Math.PI);
    }
    this.paint(fill, stroke, width, []);
  }

  paint(fill, stroke, width, dash) {
    const { context } = this;
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (!stroke) return;
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.lineJoin = context.lineCap = "round";
    if (dash.length) context.setLineDash(dash);
    context.stroke();
    if (dash.length) context.setLineDash([]);
  }

  text(x, y, text, { align = "left", baseline = "alphabetic", turned = false, halo = "", ...style }) {
    const { context } = this;
    const { runs, width } = setText(text, style);
    const start = -width * { left: 0, center: 0.5, right: 1 }[align];
    const [left, line] = turned ? [start, 0] : [x + start, y];
    const each = (draw) => {
      for (const run of runs) {
        context.font = run.font;
        draw(run.text, left + run.left, line + run.down);
      }
    };
    if (turned) {
      context.save();
      context.translate(x, y);
      context.rotate(-Math.PI / 2);
    }
    context.textBaseline = baseline;
    if (halo) {
      Object.assign(context, { strokeStyle: halo, lineWidth: 4, lineJoin: "round" });
      each((...run) => context.strokeText(...run));
    }
    context.fillStyle = style.colour;
    each((...run) => context.fillText(...run));
    if (turned) context.restore();
  }

  /** Draws with everything outside the rectangle hidden. */
  inside(box, draw) {
    const { context } = this;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    draw();
    context.restore();
  }
}

const coordinate = (value) => String(Math.round(value * 100) / 100);
const escaped = (text) => text.replace(/[&<>"]/g, (character) => `&#${character.charCodeAt(0)};`);

export class SvgSurface {
  constructor(width, height, title) {
    this.width = width;
    this.height = height;
    this.clips = 0;
    this.parts = [`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}" role="img"><title>${escaped(title)}</title>`];
  }

  still(_keys, draw) {
    return draw();
  }

  shape(lines, { fill = "none", stroke = "none", width = 1, dash = /** @type {number[]} */ ([]) }) {
    let path = "";
    for (const line of lines) {
      for (let i = 0; i < line.length; i += 2) path += `${i ? "L" : "M"}${coordinate(line[i])} ${coordinate(line[i + 1])}`;
    }
    if (path === "") return;
    const how = stroke === "none" ? "" : ` stroke-width="${width}" stroke-linejoin="round" stroke-linecap="round"`;
    this.parts.push(`<path d="${path}" fill="${fill}" stroke="${stroke}"${how}${dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : ""}/>`);
  }

  discs(points, radius, { fill = "none", stroke = "none", width = 1.5 }) {
    for (let i = 0; i < points.length; i += 2) {
      this.parts.push(`<circle cx="${coordinate(points[i])}" cy="${coordinate(points[i + 1])}" r="${radius}" fill="${fill}" ` +
        `stroke="${stroke}" stroke-width="${width}"/>`);
    }
  }

  text(x, y, text, style) {
    const anchor = { left: "start", center: "middle", right: "end" }[style.align ?? "left"];
    const lower = { alphabetic: 0, middle: 0.35, top: 0.8, bottom: -0.2 }[style.baseline ?? "alphabetic"] * style.size;
    const place = style.turned
      ? `transform="translate(${coordinate(x + lower)} ${coordinate(y)}) rotate(-90)"`
      : `x="${coordinate(x)}" y="${coordinate(y + lower)}"`;
    const halo = style.halo ? ` stroke="${style.halo}" stroke-width="4" stroke-linejoin="round" paint-order="stroke"` : "";
    let down = 0;
    const runs = runsOf(text).map((run) => {
      const shift = scriptShift[run.level] * style.size - down;
      down += shift;
      return `<tspan${shift ? ` dy="${coordinate(shift)}"` : ""}${run.level ? ` font-size="${coordinate(style.size * scriptSize)}"` : ""}` +
        `${run.italic ? ` font-style="italic" font-family='${mathematics}'` : ""}>${escaped(run.text)}</tspan>`;
    });
    this.parts.push(`<text ${place} font-family='${fonts}' font-size="${style.size}" xml:space="preserve"` +
      `${style.bold ? ' font-weight="600"' : ""} text-anchor="${anchor}" fill="${style.colour}"${halo}>${runs.join("")}</text>`);
  }

  inside(box, draw) {
    const id = `inside-${++this.clips}`;
    this.parts.push(`<clipPath id="${id}"><rect x="${box.left}" y="${box.top}" width="${box.width}" height="${box.height}"/></clipPath>` +
      `<g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }

  toString() {
    return `${this.parts.join("\n")}\n</svg>\n`;
  }
}
