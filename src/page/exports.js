// Files that the page hands out.

export function save(name, blob) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export const textFile = (text, type) => new Blob([text], { type });

/** A figure as PNG of so many pixels across. */
export async function pngOf(svg, width) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width, height: Math.round((image.height * width) / image.width) });
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
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

/**
 * A film of a canvas, WebM.
 *
 * @param run  plays what is to be seen, and calls back at its end
 */
export function filmOf(canvas, run) {
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: "video/webm" });
  const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  return new Promise((resolve) => {
    recorder.onstop = () => resolve(new Blob(parts, { type: "video/webm" }));
    recorder.start();
    run(() => recorder.stop());
  });
}
