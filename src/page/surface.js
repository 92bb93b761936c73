// What figures are drawn on: a canvas, or the text of an SVG file. Both take pixels, x to the right and y down.
//
// A line is a flat array x0, y0, x1, y1, ...; a text may have the library's markup.
import { runsOf } from "./markup.js";

const fonts = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const mathematics = '"STIX Two Text", "Cambria Math", "DejaVu Serif", Georgia, serif';

const scriptSize = 0.72;
const scriptShift = { 1: -0.38, 0: 0, "-1": 0.24 };  // of an index or a power, in sizes of the text

let measuring;
const known = new Map();  // texts that were measured

/** The runs of a text with their fonts, widths and places from the text's left end. */
function setRuns(text, style) {
  const key = `${style.size} ${style.bold} ${style.italic} ${text}`;
  if (known.size > 2000) known.clear();
  if (!known.has(key)) known.set(key, measured(text, style));
  return known.get(key);
}

function measured(text, style) {
  measuring ??= document.createElement("canvas").getContext("2d");
  let left = 0;
  return runsOf(text, style.italic).map((run) => {
    const size = style.size * (run.level === 0 ? 1 : scriptSize);
    const font = `${run.italic ? "italic " : ""}${style.bold ? "600 " : ""}${size}px ${run.italic ? mathematics : fonts}`;
    measuring.font = font;
    const width = measuring.measureText(run.text).width;
    const set = { ...run, font, size, left, width, down: scriptShift[run.level] * style.size };
    left += width;
    return set;
  });
}

/** How wide a text is, in pixels. */
export function widthOf(text, style) {
  return setRuns(text, style).reduce((sum, { width }) => sum + width, 0);
}

export class CanvasSurface {
  /** Fits the canvas to its place on the page, sharp on any screen. */
  constructor(canvas) {
    const ratio = globalThis.devicePixelRatio || 1;
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    const [width, height] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.context = canvas.getContext("2d");
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  fill(x, y, width, height, colour) {
    this.context.fillStyle = colour;
    this.context.fillRect(x, y, width, height);
  }

  lines(lines, { colour, width = 1, dash = [] }) {
    const context = this.context;
    context.beginPath();
    for (const line of lines) {
      context.moveTo(line[0], line[1]);
      for (let i = 2; i < line.length; i += 2) context.lineTo(line[i], line[i + 1]);
    }
    Object.assign(context, { strokeStyle: colour, lineWidth: width, lineJoin: "round", lineCap: "round" });
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  polygon(points, colour) {
    const context = this.context;
    context.beginPath();
    for (let i = 0; i < points.length; i += 2) context.lineTo(points[i], points[i + 1]);
    context.closePath();
    context.fillStyle = colour;
    context.fill();
  }

  disc(x, y, radius, { fill, stroke, width = 1.5 }) {
    const context = this.context;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (stroke) {
      Object.assign(context, { strokeStyle: stroke, lineWidth: width });
      context.stroke();
    }
  }

  text(x, y, text, style) {
    const context = this.context;
    context.save();
    context.translate(x, y);
    if (style.turned) context.rotate(-Math.PI / 2);
    context.textBaseline = style.baseline ?? "alphabetic";
    const runs = setRuns(text, style);
    const whole = widthOf(text, style);
    const start = -whole * { left: 0, center: 0.5, right: 1 }[style.align ?? "left"];
    const each = (draw) => runs.forEach((run) => {
      context.font = run.font;
      draw(run.text, start + run.left, run.down);
    });
    if (style.halo) {
      Object.assign(context, { strokeStyle: style.halo, lineWidth: 4, lineJoin: "round" });
      each((...run) => context.strokeText(...run));
    }
    context.fillStyle = style.colour;
    each((...run) => context.fillText(...run));
    context.restore();
  }

  /** Draws with everything outside the rectangle hidden. */
  inside({ left, top, width, height }, draw) {
    const context = this.context;
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
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

  fill(x, y, width, height, colour) {
    this.parts.push(`<rect x="${coordinate(x)}" y="${coordinate(y)}" width="${coordinate(width)}" ` +
      `height="${coordinate(height)}" fill="${colour}"/>`);
  }

  lines(lines, { colour, width = 1, dash = [] }) {
    const path = lines.map((line) => this.path(line)).join("");
    if (path === "") return;
    this.parts.push(`<path d="${path}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round" stroke-linecap="round"` +
      (dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : "") + "/>");
  }

  path(line) {
    let path = "";
    for (let i = 0; i < line.length; i += 2) path += `${i ? "L" : "M"}${coordinate(line[i])} ${coordinate(line[i + 1])}`;
    return path;
  }

  polygon(points, colour) {
    this.parts.push(`<path d="${this.path(points)}Z" fill="${colour}"/>`);
  }

  disc(x, y, radius, { fill = "none", stroke = "none", width = 1.5 }) {
    this.parts.push(`<circle cx="${coordinate(x)}" cy="${coordinate(y)}" r="${radius}" fill="${fill}" ` +
      `stroke="${stroke}" stroke-width="${width}"/>`);
  }

  text(x, y, text, style) {
    const anchor = { left: "start", center: "middle", right: "end" }[style.align ?? "left"];
    const lower = { alphabetic: 0, middle: 0.35, top: 0.8, bottom: -0.2 }[style.baseline ?? "alphabetic"] * style.size;
    const place = style.turned
      ? `transform="translate(${coordinate(x + lower)} ${coordinate(y)}) rotate(-90)"`
      : `x="${coordinate(x)}" y="${coordinate(y + lower)}"`;
    const halo = style.halo ? ` stroke="${style.halo}" stroke-width="4" stroke-linejoin="round" paint-order="stroke"` : "";
    let down = 0;
    const runs = runsOf(text, style.italic).map((run) => {
      const shift = scriptShift[run.level] * style.size - down;
      down += shift;
      return `<tspan${shift ? ` dy="${coordinate(shift)}"` : ""}${run.level ? ` font-size="${coordinate(style.size * scriptSize)}"` : ""}` +
        `${run.italic ? ` font-style="italic" font-family='${mathematics}'` : ""}>${escaped(run.text)}</tspan>`;
    });
    this.parts.push(`<text ${place} font-family='${fonts}' font-size="${style.size}" xml:space="preserve"` +
      `${style.bold ? ' font-weight="600"' : ""} text-anchor="${anchor}" fill="${style.colour}"${halo}>${runs.join("")}</text>`);
  }

  inside({ left, top, width, height }, draw) {
    const id = `inside-${++this.clips}`;
    this.parts.push(`<clipPath id="${id}"><rect x="${left}" y="${top}" width="${width}" height="${height}"/></clipPath>` +
      `<g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }

  toString() {
    return `${this.parts.join("\n")}\n</svg>\n`;
  }
}
