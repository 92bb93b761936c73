// Files that the page hands out.

export function save(name, blob) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export const textFile = (text, type) => new Blob([text], { type });

/** A figure as PNG, twice as fine as CSS pixels, or as the screen. */
export async function pngOf(svg) {
  const scale = Math.max(2, devicePixelRatio);
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width: image.width * scale, height: image.height * scale });
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

/**
 * The orbits of the reader as CSV, all digits; infinities as the program writes them.
 *
 * @param secondsPerTau  of a real ball: then with a column of seconds
 */
export function csvOf(orbits, secondsPerTau) {
  const number = (value) => (value === Infinity ? "inf" : value === -Infinity ? "-inf" : String(value));
  const rows = [`orbit,${secondsPerTau ? "t," : ""}tau,u,v,ln_v,k`];
  orbits.forEach((motion, index) => {
    motion.tau.forEach((tau, i) => {
      rows.push([index + 1, ...(secondsPerTau ? [tau * secondsPerTau] : []), tau, motion.u[i], motion.v[i], motion.lnV[i], motion.k[i]].map(number).join(","));
    });
  });
  return `${rows.join("\n")}\n`;
}

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
