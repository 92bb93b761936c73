// Files that the page hands out.
import { make } from "../dom.js";
import { CanvasSurface } from "../drawing/surface.js";

/** Hands out a text, or a blob, as a file. */
export function save(name, content, type) {
  const link = make("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Returns a figure as PNG with a width in pixels. @param draw  draws it on a surface @param size  size of this surface */
export async function pngOf(draw, size, width) {
  const canvas = make("canvas", { width, height: Math.round((size.height * width) / size.width) });
  draw(new CanvasSurface(canvas, size));
  const blob = await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  if (!blob) throw new Error(`this browser cannot draw ${canvas.width} × ${canvas.height} pixels`);
  return blob;
}

/** Columns of numbers as CSV, all digits; infinities as the program writes them. */
function csv(columns) {
  const values = Object.values(columns);
  const rows = Array.from(values[0], (_, row) => values.map((column) => String(column[row]).replace("Infinity", "inf")));
  return [Object.keys(columns), ...rows].map((row) => `${row.join(",")}\n`).join("");
}

/** The reader's orbits one after the other. */
export function csvOfOrbits(motions) {
  const column = (key) => motions.flatMap((motion) => [...motion[key]]);
  const orbit = motions.flatMap(({ tau }, index) => Array.from(tau, () => index + 1));
  return csv({ orbit, tau: column("tau"), u: column("u"), v: column("v"), ln_v: column("lnV"), k: column("k") });
}

/** The motion of a real ball in SI units, with the columns of `contensou roll`. */
export const csvOfRide = ({ t, x, y, vx, vy, wx, wy, wz, slip, energy }) => csv({ t, x, y, vx, vy, wx, wy, wz, slip, energy });

/** Returns measured and fitted values of a film, and their differences. An angle is known up to whole turns. */
export function csvOfFilm(/** @type {Columns} */ { t, ...columns }) {
  const whole = 2 * Math.PI;
  const parts = Object.keys(columns).filter((name) => columns[`${name}_fitted`]).flatMap((name) => {
    const [measured, fitted] = [columns[name], columns[`${name}_fitted`]];
    const residual = measured.map((value, i) => value - fitted[i] - (name === "angle" ? whole * Math.round((value - fitted[i]) / whole) : 0));
    return Object.entries({ [name]: measured, [`${name}_fitted`]: fitted, [`${name}_residual`]: residual });
  });
  return csv({ t, ...Object.fromEntries(parts) });
}
